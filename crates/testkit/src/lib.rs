//! What the tests of several crates share.

#![allow(clippy::missing_panics_doc, reason = "a test may panic")]

pub mod gauss_legendre;
pub mod house;
pub mod layered;
pub mod tridiagonal;

use ground_field::{
    Base, Displacement, DuctLine, DuctMotion, GroundError, GroundField, Soil, SoilLayer, SoilProfile, Vehicle,
};

/// Weight of the truck of the full-scale experiment \[N\]: 20 tf.
pub const TRUCK: f64 = 196_133.0;

/// Everything a float can be.
pub const NASTY: [f64; 16] = [
    f64::NAN,
    f64::INFINITY,
    f64::NEG_INFINITY,
    f64::MIN,
    -1.0,
    -0.0,
    0.0,
    5e-324,
    f64::MIN_POSITIVE,
    1e-160,
    1e-9,
    1.0,
    1e9,
    1e160,
    1e300,
    f64::MAX,
];

/// Grounds whose numbers are as far apart as numbers can be.
pub fn nasty_grounds() -> Vec<SoilProfile> {
    let sizes = [5e-324, 1e-300, 1e-9, 1.0, 1e9, 1e300, f64::MAX];
    let mut grounds = Vec::new();
    for thickness in sizes {
        for modulus in sizes {
            for poisson in [0.0, 0.5] {
                let soil = Soil::new(modulus, poisson).expect("a soil");
                let other = Soil::new(1e7, 0.3).expect("a soil");
                let layer = SoilLayer::uniform(thickness, soil).expect("a layer");
                let thin = SoilLayer::uniform(0.1, other).expect("a layer");
                for layers in [vec![], vec![layer], vec![thin, layer], vec![layer, thin, layer]] {
                    for base in [Base::Rigid, Base::HalfSpace(soil), Base::HalfSpace(other)] {
                        grounds.extend(SoilProfile::new(layers.clone(), base));
                    }
                }
            }
        }
    }
    grounds
}

/// Soil with Young's modulus \[Pa\] and Poisson's ratio.
pub fn soil(young_modulus: f64, poisson_ratio: f64) -> Soil {
    Soil::new(young_modulus, poisson_ratio).expect("a soil")
}

/// Uniform layer of `thickness` \[m\].
pub fn layer(thickness: f64, soil: Soil) -> SoilLayer {
    SoilLayer::uniform(thickness, soil).expect("a layer")
}

/// Motion of a duct at 1.2 m in `ground` under the truck as a point load at `speed` \[m/s\], far beyond any test's duct.
///
/// # Errors
///
/// Whatever the ground returns.
pub fn truck(ground: &dyn GroundField, speed: f64) -> Result<DuctMotion, GroundError> {
    let truck = Vehicle::point("truck", TRUCK, speed)?;
    DuctMotion::new(ground, &truck, DuctLine::new(1.2, 0.0)?, 400.0, 1e-10)
}

/// Point load on a half-space: K. L. Johnson, Contact Mechanics (1985), eq. 3.18.
pub fn johnson(soil: Soil, force: f64, r: f64, z: f64) -> Displacement {
    let (e, nu) = (soil.young_modulus(), soil.poisson_ratio());
    let d = r.hypot(z);
    let scale = (1.0 + nu) * force / (2.0 * std::f64::consts::PI * e);
    Displacement {
        radial: scale * (r * z / d.powi(3) - (1.0 - 2.0 * nu) * r / (d * (d + z))),
        vertical: scale * (z * z / d.powi(3) + 2.0 * (1.0 - nu) / d),
    }
}

/// A number from the standard normal distribution (Box and Muller).
pub fn gaussian(random: &mut fastrand::Rng) -> f64 {
    let radius = (-2.0 * (1.0 - random.f64()).ln()).sqrt();
    radius * (std::f64::consts::TAU * random.f64()).cos()
}

/// A number between two others, evenly.
pub fn between(random: &mut fastrand::Rng, low: f64, high: f64) -> f64 {
    low + (high - low) * random.f64()
}

/// The same, evenly in its logarithm.
pub fn log_between(random: &mut fastrand::Rng, low: f64, high: f64) -> f64 {
    low * (high / low).powf(random.f64())
}
