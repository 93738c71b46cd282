//! Point load on a half-space.
//!
//! [Boussinesq's solution](crate::HalfSpace), with R² = r² + z². Written in sin θ = r/R and cos θ = z/R, each bracket is 1/R times a number of order one, so nothing but the answer
//! itself can overflow. The displacement grows as 1/R toward the load and has no value at R = 0.

use crate::shape::Shape;

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

/// The shape at a point `distance` > 0 from the load, with `distance` as its length.
#[inline]
pub(crate) fn shape(radius: f64, depth: f64, distance: f64) -> Shape {
    let sine = radius / distance;
    let cosine = depth / distance;
    Shape {
        shear_radial: sine * cosine,
        surface_radial: sine / (1.0 + cosine),
        shear_vertical: cosine * cosine,
        surface_vertical: 1.0,
    }
}
