//! A unit point load on a homogeneous half-space, which the mesh uses where it is exact: next to the load, where only the top
//! soil counts, and far away, where only the base does.

use boussinesq::Stress;
use ground_field::{Displacement, GroundField, Soil, SurfaceLoad};

use crate::material::LARGEST_POISSON_RATIO;

/// The closed form of the crate `boussinesq`, with the Poisson's ratio that the elements use.
#[derive(Debug, Clone, Copy)]
pub(crate) struct HalfSpace(boussinesq::HalfSpace);

impl HalfSpace {
    pub(crate) fn new(soil: Soil) -> Self {
        let ratio = soil.poisson_ratio().min(LARGEST_POISSON_RATIO);
        Self(boussinesq::HalfSpace::new(
            Soil::new(soil.young_modulus(), ratio).unwrap_or(soil),
        ))
    }

    /// Young's modulus \[Pa\].
    pub(crate) fn young_modulus(self) -> f64 {
        self.0.soil().young_modulus()
    }

    /// Displacement \[m/N\]; not a number at the load.
    pub(crate) fn displacement(self, r: f64, z: f64) -> Displacement {
        let unit = SurfaceLoad::point(1.0);
        unit.and_then(|load| self.0.displacement(load, r, z))
            .unwrap_or(Displacement::ZERO * f64::NAN)
    }

    /// Stress \[1/m²\], tension positive; zero at the load, where there is none.
    pub(crate) fn stress(self, r: f64, z: f64) -> Stress {
        self.0.point_stress(1.0, r, z).unwrap_or_default()
    }
}
