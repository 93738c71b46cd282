//! Isotropic linear elasticity: at a point, in the two moduli the element integrals need, and in closed form. The stress is
//! σ = 2 G ε + λ (tr ε) I with G = E / (2 (1 + ν)) and λ = 2 G ν / (1 − 2 ν).
//!
//! # Limit
//!
//! At ν = 1/2 λ is infinite. A ratio above [`LARGEST_POISSON_RATIO`] is replaced by it: that changes displacements by
//! about 1/2 − ν = 1e-5 of themselves, far below what a mesh resolves. The elements keep their accuracy up to it.

use boussinesq::Stress;
use ground_field::{Displacement, GroundField, Soil, SurfaceLoad};

/// The largest Poisson's ratio the elements use.
pub(crate) const LARGEST_POISSON_RATIO: f64 = 0.499_99;

/// Elastic moduli at a point \[Pa\].
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Elasticity {
    /// Shear modulus G \[Pa\].
    pub shear: f64,
    /// Lamé's first parameter λ \[Pa\].
    pub lame: f64,
}

impl Elasticity {
    /// The moduli of `soil`, its Poisson's ratio taken as [`LARGEST_POISSON_RATIO`] at most.
    pub(crate) fn new(soil: Soil) -> Self {
        let soil = compressible(soil);
        let (shear, nu) = (soil.shear_modulus(), soil.poisson_ratio());
        let lame = 2.0 * shear * nu / (1.0 - 2.0 * nu);
        Self { shear, lame }
    }
}

/// `soil` with the [`LARGEST_POISSON_RATIO`] at most.
fn compressible(soil: Soil) -> Soil {
    let nu = soil.poisson_ratio().min(LARGEST_POISSON_RATIO);
    Soil::new(soil.young_modulus(), nu).unwrap_or(soil)
}

/// A unit point load on a homogeneous half-space, which the mesh uses where it is exact: next to the load, where only the top soil counts,
/// and far away, where only the base does. The closed form of the crate `boussinesq`, with the Poisson's ratio that the elements use.
#[derive(Debug, Clone, Copy)]
pub(crate) struct HalfSpace(boussinesq::HalfSpace);

impl HalfSpace {
    pub(crate) fn new(soil: Soil) -> Self {
        Self(boussinesq::HalfSpace::new(compressible(soil)))
    }

    /// Displacement \[m/N\]; not a number at the load.
    pub(crate) fn displacement(self, r: f64, z: f64) -> Displacement {
        let unit = SurfaceLoad::point(1.0);
        unit.and_then(|load| self.0.displacement(load, r, z))
            .unwrap_or(Displacement::ZERO * f64::NAN)
    }

    /// Stress \[1/m²\], tension positive; zero at the load itself, which has none.
    pub(crate) fn stress(self, r: f64, z: f64) -> Stress {
        self.0.point_stress(1.0, r, z).unwrap_or_default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    /// Stress (r, z, θ, rz) from strain (`ε_r`, `ε_z`, `ε_θ`, `γ_rz`).
    fn stress(moduli: Elasticity, strain: [f64; 4]) -> [f64; 4] {
        let pressure = moduli.lame * (strain[0] + strain[1] + strain[2]);
        let twice = 2.0 * moduli.shear;
        [
            twice * strain[0] + pressure,
            twice * strain[1] + pressure,
            twice * strain[2] + pressure,
            moduli.shear * strain[3],
        ]
    }

    #[test]
    fn stress_is_hookes_law_of_the_displacement() {
        let soil = Soil::new(80e6, 0.35).unwrap();
        let half_space = HalfSpace::new(soil);
        let (r, z, h) = (0.7, 1.1, 1e-4);
        let slope = |dr: f64, dz: f64| {
            let gap = half_space.displacement(r + dr, z + dz) - half_space.displacement(r - dr, z - dz);
            gap * (0.5 / h)
        };
        let (d_r, d_z) = (slope(h, 0.0), slope(0.0, h));
        let hoop = half_space.displacement(r, z).radial / r;
        let strain = [d_r.radial, d_z.vertical, hoop, d_z.radial + d_r.vertical];
        let exact = half_space.stress(r, z);
        let exact = [exact.radial, exact.vertical, exact.hoop, exact.shear];
        for (found, exact) in stress(Elasticity::new(soil), strain).into_iter().zip(exact) {
            assert_relative_eq!(found, exact, epsilon = 1e-8);
        }
    }
}
