//! Grounds of the tests.

use ground_field::{Base, SoilLayer, SoilProfile};

/// Uniform layer from metres and `MPa`.
pub fn layer(thickness: f64, young_modulus: f64, poisson_ratio: f64) -> SoilLayer {
    testkit::layer(thickness, testkit::soil(young_modulus * 1e6, poisson_ratio))
}

/// Layers on a half-space (`MPa`).
pub fn on_soil(layers: Vec<SoilLayer>, young_modulus: f64, poisson_ratio: f64) -> SoilProfile {
    let base = Base::HalfSpace(testkit::soil(young_modulus * 1e6, poisson_ratio));
    SoilProfile::new(layers, base).unwrap()
}

/// The paper's road: 50 mm asphalt and 50 mm base course on subgrade.
pub fn task3() -> SoilProfile {
    testkit::layered::system("task3").0
}
