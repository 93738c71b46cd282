//! Isotropic linear elasticity at a point, in the two moduli the element integrals need.
//!
//! Stress σ = 2 G ε + λ (tr ε) I with G = E / (2 (1 + ν)) and λ = 2 G ν / (1 − 2 ν). In axisymmetry without torsion the
//! components are (r, z, θ, rz) with the engineering shear strain `γ_rz` = 2 `ε_rz`.
//!
//! # Limit
//!
//! At ν = 1/2 λ is infinite. A ratio above [`LARGEST_POISSON_RATIO`] is replaced by it: that changes displacements by
//! about 1/2 − ν = 1e-5 of themselves, far below what a mesh resolves. The elements keep their accuracy up to it.

/// The largest Poisson's ratio the elements use; see the [module documentation](self).
pub const LARGEST_POISSON_RATIO: f64 = 0.499_99;

/// Elastic moduli at a point \[Pa\].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Elasticity {
    /// Shear modulus G \[Pa\].
    pub shear: f64,
    /// Lamé's first parameter λ \[Pa\].
    pub lame: f64,
}

impl Elasticity {
    /// From Young's modulus \[Pa\] and Poisson's ratio, the latter at most [`LARGEST_POISSON_RATIO`].
    pub fn new(young_modulus: f64, poisson_ratio: f64) -> Self {
        let nu = poisson_ratio.min(LARGEST_POISSON_RATIO);
        let shear = young_modulus / (2.0 * (1.0 + nu));
        Self {
            shear,
            lame: 2.0 * shear * nu / (1.0 - 2.0 * nu),
        }
    }

    /// Stress (r, z, θ, rz) \[Pa\] from strain (`ε_r`, `ε_z`, `ε_θ`, `γ_rz`), tension positive.
    pub fn stress(self, strain: [f64; 4]) -> [f64; 4] {
        let pressure = self.lame * (strain[0] + strain[1] + strain[2]);
        let twice = 2.0 * self.shear;
        [
            twice * strain[0] + pressure,
            twice * strain[1] + pressure,
            twice * strain[2] + pressure,
            self.shear * strain[3],
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn uniaxial_stress_gives_back_young_and_poisson() {
        let (e, nu) = (80e6, 0.3);
        let stress = Elasticity::new(e, nu).stress([-nu * 1e-4, 1e-4, -nu * 1e-4, 0.0]);
        assert_relative_eq!(stress[1], e * 1e-4, max_relative = 1e-13);
        assert!(stress[0].abs() < 1e-10 * stress[1] && stress[2].abs() < 1e-10 * stress[1]);
    }

    #[test]
    fn incompressible_soil_stays_finite() {
        assert!(Elasticity::new(40e6, 0.5).lame.is_finite());
    }
}
