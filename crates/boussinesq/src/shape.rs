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

/// Distance from the load, safe against overflow and underflow of the squares.
#[inline]
pub(crate) fn distance(radius: f64, depth: f64) -> f64 {
    let squares = radius * radius + depth * depth;
    // Within these bounds neither square has lost digits that matter.
    if (1e-200..1e200).contains(&squares) {
        squares.sqrt()
    } else {
        radius.hypot(depth)
    }
}

/// The shape of a [point load](crate::HalfSpace) at a point `distance` > 0 from it, with `distance` as its length, R² = r² + z². Written
/// in sin θ = r/R and cos θ = z/R, each bracket is 1/R times a number of order one, so nothing but the answer itself can overflow. It grows
/// as 1/R toward the load and has no value at R = 0.
#[inline]
pub(crate) fn point(radius: f64, depth: f64, distance: f64) -> Shape {
    let sine = radius / distance;
    let cosine = depth / distance;
    Shape {
        shear_radial: sine * cosine,
        surface_radial: sine / (1.0 + cosine),
        shear_vertical: cosine * cosine,
        surface_vertical: 1.0,
    }
}
