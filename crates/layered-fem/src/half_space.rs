//! Closed form of a point load on a homogeneous half-space, which the mesh uses where it is exact: next to the load, where
//! only the top soil counts, and far away, where only the base does.
//!
//! With R² = r² + z², a unit load and tension positive (z down):
//!
//! ```text
//! u_r = (1+ν)/(2πE) · [ r z/R³ − (1−2ν) r/(R(R+z)) ]      u_z = (1+ν)/(2πE) · [ z²/R³ + 2(1−ν)/R ]
//! σ_z = −3z³/(2πR⁵)        τ_rz = −3 r z²/(2πR⁵)
//! σ_r = [ (1−2ν)/(R(R+z)) − 3 r² z/R⁵ ]/(2π)        σ_θ = (1−2ν)/(2π) · [ z/R³ − 1/(R(R+z)) ]
//! ```
//!
//! Reference: K. L. Johnson, *Contact Mechanics* (1985), equations 3.18 and 3.20.

use std::f64::consts::PI;

use crate::material::LARGEST_POISSON_RATIO;

/// A homogeneous half-space under a unit point load at the origin of its surface.
#[derive(Debug, Clone, Copy)]
pub(crate) struct HalfSpace {
    young_modulus: f64,
    poisson_ratio: f64,
}

impl HalfSpace {
    pub(crate) fn new(young_modulus: f64, poisson_ratio: f64) -> Self {
        Self {
            young_modulus,
            poisson_ratio: poisson_ratio.min(LARGEST_POISSON_RATIO),
        }
    }

    /// Young's modulus \[Pa\].
    pub(crate) fn young_modulus(self) -> f64 {
        self.young_modulus
    }

    /// Displacement (`u_r`, `u_z`) \[m/N\]; infinite at the load.
    pub(crate) fn displacement(self, r: f64, z: f64) -> [f64; 2] {
        let nu = self.poisson_ratio;
        let distance = r.hypot(z);
        // Direction cosines, so that no power of a large distance overflows.
        let (cr, cz) = (r / distance, z / distance);
        let scale = (1.0 + nu) / (2.0 * PI * self.young_modulus) / distance;
        [
            scale * (cr * cz - (1.0 - 2.0 * nu) * cr / (1.0 + cz)),
            scale * (cz * cz + 2.0 * (1.0 - nu)),
        ]
    }

    /// Stress (`σ_r`, `σ_z`, `σ_θ`, `τ_rz`) \[1/m²\], tension positive; infinite at the load.
    pub(crate) fn stress(self, r: f64, z: f64) -> [f64; 4] {
        let free = 1.0 - 2.0 * self.poisson_ratio;
        let distance = r.hypot(z);
        let (cr, cz) = (r / distance, z / distance);
        let scale = 1.0 / (2.0 * PI * distance * distance);
        [
            scale * (free / (1.0 + cz) - 3.0 * cr * cr * cz),
            scale * -3.0 * cz * cz * cz,
            scale * free * (cz - 1.0 / (1.0 + cz)),
            scale * -3.0 * cr * cz * cz,
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::material::Elasticity;
    use approx::assert_relative_eq;

    #[test]
    fn stress_is_hookes_law_of_the_displacement() {
        let soil = HalfSpace::new(80e6, 0.35);
        let (r, z, h) = (0.7, 1.1, 1e-4);
        let slope = |along_z: bool| -> [f64; 2] {
            let at = |t: f64| {
                if along_z {
                    soil.displacement(r, z + t)
                } else {
                    soil.displacement(r + t, z)
                }
            };
            let (plus, minus) = (at(h), at(-h));
            [0, 1].map(|c| (plus[c] - minus[c]) / (2.0 * h))
        };
        let (d_r, d_z) = (slope(false), slope(true));
        let strain = [d_r[0], d_z[1], soil.displacement(r, z)[0] / r, d_z[0] + d_r[1]];
        let stress = Elasticity::new(80e6, 0.35).stress(strain);
        for (found, exact) in stress.into_iter().zip(soil.stress(r, z)) {
            assert_relative_eq!(found, exact, epsilon = 1e-8);
        }
    }
}
