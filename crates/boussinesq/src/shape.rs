//! What the point load and the disc load have in common.
//!
//! Every vertical load on a half-space displaces it through the same four integrals of the load's distribution, none of
//! which knows the soil. With s a length that makes them dimensionless,
//!
//! ```text
//! u_r = (1+ν)P/(2πE s) · [ shear_radial   − (1−2ν) surface_radial ]
//! u_z = (1+ν)P/(2πE s) · [ shear_vertical + 2(1−ν) surface_vertical ]
//! ```
//!
//! The first of each pair vanishes on the surface. At ν = 0.5 the second radial one drops out exactly.

use ground_field::Displacement;

/// The four dimensionless integrals of a load at one point; see the [module](self).
#[derive(Debug, Clone, Copy)]
pub(crate) struct Shape {
    pub shear_radial: f64,
    pub surface_radial: f64,
    pub shear_vertical: f64,
    pub surface_vertical: f64,
}

impl Shape {
    /// Displacement with `scale` = (1+ν)P/(2πE s).
    #[inline]
    pub fn displacement(self, scale: f64, poisson_ratio: f64) -> Displacement {
        Displacement {
            radial: scale * (self.shear_radial - (1.0 - 2.0 * poisson_ratio) * self.surface_radial),
            vertical: scale * (self.shear_vertical + 2.0 * (1.0 - poisson_ratio) * self.surface_vertical),
        }
    }
}
