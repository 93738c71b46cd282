//! Uniform pressure on a disc, on a half-space.
//!
//! The point load's four terms are derivatives of the potentials 1/R and ln(R+z), so their integrals over the disc become
//! integrals around its rim. In units of the disc's radius a, with ρ = r/a, ζ = z/a, and on the rim
//! s² = 1 + ρ² − 2ρ cos φ, R² = s² + ζ², φ from 0 to 2π:
//!
//! ```text
//! shear_radial     = ζρ/π ∮ sin²φ / R³ dφ                     (from z ∂/∂r of 1/R, by parts along the rim)
//! surface_radial   =  ρ/π ∮ sin²φ / (R(R+ζ)) dφ               (from ∂/∂r of ln(R+z), likewise)
//! shear_vertical   =  ζ/π ∮ (1 − ρ cos φ) / (R(R+ζ)) dφ       (ζ times the disc's solid angle)
//! surface_vertical =  1/π ∮ (1 − ρ cos φ) / (R+ζ) dφ          (the disc's Newtonian potential)
//! ```
//!
//! with a as the length of the [shape](crate::shape). The radial pair has positive integrands: it keeps its digits
//! everywhere. Three evaluations of the same integrals share the quarter-space r, z ≥ 0:
//!
//! | where | how |
//! |---|---|
//! | R ≥ 4a | [`far`]: multipole series, which loses no digits however far |
//! | ρ small against 1 + ζ² | [`near_axis`]: the integrands are analytic and periodic; 16 points are exact to rounding |
//! | else | [`elliptic form`](rim): complete elliptic integrals |
//!
//! They agree to rounding where they meet, so the field is continuous to rounding.
//!
//! References: K. Terazawa, "On the elastic equilibrium of a semi-infinite solid", J. Coll. Sci. Univ. Tokyo 37 (1916);
//! A. E. H. Love, Phil. Trans. R. Soc. A 228 (1929) 377–420; K. L. Johnson, *Contact Mechanics* (1985), §3.4(a);
//! G. Eason, B. Noble, I. N. Sneddon, Phil. Trans. R. Soc. A 247 (1955) 529–551 for the same integrals as Bessel integrals.

mod far;
mod near_axis;
mod rim;

use ground_field::SurfaceLoad;

use crate::shape::{Shape, distance, point};

/// From this distance on, in units of the disc's radius, the multipole series is used.
const FAR: f64 = 4.0;

/// The shape of `load`, a point load too, at a point, and its length; not a number under a point load.
pub(crate) fn shape(load: SurfaceLoad, radius: f64, depth: f64) -> (Shape, f64) {
    let distance = distance(radius, depth);
    if load.is_point() {
        return (point(radius, depth, distance), distance);
    }
    let contact_radius = load.contact_radius();
    if distance >= FAR * contact_radius {
        return (far::shape(radius, depth, distance, contact_radius), distance);
    }
    let rho = radius / contact_radius;
    let zeta = depth / contact_radius;
    let shape = if near_axis::covers(rho, zeta) {
        near_axis::shape(rho, zeta)
    } else {
        // The difference of the lengths is exact where it matters, near the rim.
        rim::shape(rho, zeta, (contact_radius - radius) / contact_radius)
    };
    (shape, contact_radius)
}

#[cfg(test)]
mod tests {
    use super::{FAR, Shape, far, near_axis, rim};

    fn entries(shape: Shape, factor: f64) -> [f64; 4] {
        [
            shape.shear_radial,
            shape.surface_radial,
            shape.shear_vertical,
            shape.surface_vertical,
        ]
        .map(|value| value * factor)
    }

    fn assert_meet(one: [f64; 4], two: [f64; 4], place: (f64, f64), tolerance: f64) {
        for (a, b) in one.into_iter().zip(two) {
            let size = one[2].abs().max(one[3].abs());
            assert!(
                (a - b).abs() <= tolerance * size,
                "{one:?} and {two:?} at {place:?}"
            );
        }
    }

    /// The elliptic form and the multipole series are derived apart; they must meet where one takes over.
    #[test]
    fn elliptic_form_meets_multipoles() {
        for step in 0..=1000 {
            let angle = std::f64::consts::FRAC_PI_2 * f64::from(step) / 1000.0;
            let (rho, zeta) = (FAR * angle.sin(), FAR * angle.cos().max(0.0));
            if near_axis::covers(rho, zeta) {
                continue;
            }
            let here = entries(rim::shape(rho, zeta, 1.0 - rho), 1.0);
            let there = entries(far::shape(rho, zeta, rho.hypot(zeta), 1.0), 1.0 / rho.hypot(zeta));
            assert_meet(here, there, (rho, zeta), 2e-14);
        }
    }

    /// The same between the elliptic form and the rule near the axis.
    #[test]
    fn elliptic_form_meets_axis() {
        for step in 0..=1000 {
            let zeta = FAR * f64::from(step) / 1000.0;
            let (mut inside, mut outside) = (0.0, 1.0);
            for _ in 0..60 {
                let middle: f64 = 0.5 * (inside + outside);
                if near_axis::covers(middle, zeta) {
                    inside = middle;
                } else {
                    outside = middle;
                }
            }
            let rho = inside;
            let here = entries(rim::shape(rho, zeta, 1.0 - rho), 1.0);
            let there = entries(near_axis::shape(rho, zeta), 1.0);
            assert_meet(here, there, (rho, zeta), 2e-14);
        }
    }
}
