//! The disc's integrals by complete elliptic integrals.
//!
//! With φ = π − 2θ the distances on the rim become
//!
//! ```text
//! s² = (1+ρ)² (cos²θ + p sin²θ),   p = ((1−ρ)/(1+ρ))²
//! R² = A² (cos²θ + k_c² sin²θ),    A² = (1+ρ)² + ζ²,   k_c² = ((1−ρ)² + ζ²)/A²
//! ```
//!
//! and with B, D, J of [`elliptic`](crate::elliptic), H = 1 inside the rim, ½ on it, 0 outside:
//!
//! ```text
//! Γ = H − ζ(1−ρ)/(πA(1+ρ)) · (B + D + (1−p) J)
//! shear_radial     = 4ζ/(πA) (D − B)
//! surface_radial   = ρ min(1, ρ⁻²) − 4ζ/(πA) (D − pJ)
//! shear_vertical   = 2ζ Γ − 2ζ²/(πA) (B + D)
//! surface_vertical = 2/(πA) [(2+2ρ+ζ²) B + (2−2ρ+ζ²) D] − 2ζ Γ
//! ```
//!
//! The first comes from ∮ cos φ/R, the others from 1/(R+ζ) = (R−ζ)/s². Γ, Heuman's lambda function in another guise, is
//! the part of the solid angle that would jump at the rim if H stood alone.
//!
//! Limits: r = a and z = 0 (k_c = 0) is the one point where D diverges; it does so logarithmically, against factors
//! that vanish, and the limit is taken. Near the axis D − B and D − pJ lose their leading digits: not used there.

use std::f64::consts::{FRAC_1_PI, FRAC_2_PI};

use crate::elliptic::complete;
use crate::shape::Shape;

/// The integrals at (ρ, ζ), in units of the disc's radius; `inward` = 1 − ρ, free of rounding near the rim.
pub(super) fn shape(rho: f64, zeta: f64, inward: f64) -> Shape {
    let outward = 1.0 + rho;
    let ratio = inward / outward;
    let p = ratio * ratio;
    let surface_radial = if rho <= 1.0 { rho } else { 1.0 / rho };
    if zeta == 0.0 && inward == 0.0 {
        return Shape {
            shear_radial: 0.0,
            surface_radial,
            shear_vertical: 0.0,
            surface_vertical: 2.0 * FRAC_2_PI,
        };
    }
    let longest = (outward * outward + zeta * zeta).sqrt();
    let kc = inward.hypot(zeta) / longest;
    let integrals = complete(kc, p);
    let first_kind = integrals.b + integrals.d;
    let third_kind = first_kind + (1.0 - p) * integrals.j;
    let inverse = FRAC_1_PI / longest;
    let heaviside = if inward > 0.0 {
        1.0
    } else if inward < 0.0 {
        0.0
    } else {
        0.5
    };
    let angle = heaviside - zeta * ratio * inverse * third_kind;
    let bulk = 2.0 + zeta * zeta;
    Shape {
        shear_radial: 4.0 * zeta * inverse * (integrals.d - integrals.b),
        surface_radial: surface_radial - 4.0 * zeta * inverse * (integrals.d - p * integrals.j),
        shear_vertical: 2.0 * zeta * (angle - zeta * inverse * first_kind),
        surface_vertical: 2.0
            * (inverse * ((bulk + 2.0 * rho) * integrals.b + (bulk - 2.0 * rho) * integrals.d)
                - zeta * angle),
    }
}
