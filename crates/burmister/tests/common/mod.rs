//! Layered grounds of the tests.

use burmister::LayeredHalfSpace;
use ground_field::{Base, SoilProfile, SurfaceLoad};

/// Ground from thicknesses \[mm\], moduli \[`MPa`\] and Poisson's ratios; without a last soil it stands on rock.
pub fn profile(thickness_mm: &[f64], modulus_mpa: &[f64], poisson_ratio: &[f64]) -> SoilProfile {
    let soil = |i: usize| testkit::soil(modulus_mpa[i] * 1e6, poisson_ratio[i]);
    let layers = thickness_mm.iter().enumerate();
    let layers = layers.map(|(i, h)| testkit::layer(h * 1e-3, soil(i))).collect();
    let base = if modulus_mpa.len() > thickness_mm.len() {
        Base::HalfSpace(soil(thickness_mm.len()))
    } else {
        Base::Rigid
    };
    SoilProfile::new(layers, base).expect("profile")
}

pub fn ground(thickness_mm: &[f64], modulus_mpa: &[f64], poisson_ratio: &[f64]) -> LayeredHalfSpace {
    LayeredHalfSpace::new(&profile(thickness_mm, modulus_mpa, poisson_ratio)).expect("ground")
}

/// Ground and load of a named case of the tables.
pub fn case(name: &str) -> (LayeredHalfSpace, SurfaceLoad) {
    let (profile, load) = testkit::layered::system(name);
    (LayeredHalfSpace::new(&profile).expect("ground"), load)
}
