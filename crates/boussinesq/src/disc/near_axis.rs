//! The disc's integrals near its axis.
//!
//! As functions of φ the rim's integrands are periodic and analytic as far as the zero of R at φ = i η,
//! cosh η = (1 + ρ² + ζ²)/(2ρ). The trapezoidal rule with N points around the rim is then in error by about q^N,
//! q = e^−η ≈ ρ/(1 + ρ² + ζ²) (two powers less for the pair with sin²φ): below rounding for N = 16 and q ≤ 1/12.
//! Unlike the elliptic form it keeps all digits of u_r as r → 0.

use std::f64::consts::FRAC_1_SQRT_2;

use crate::shape::Shape;

/// Bound on ρ/(1 + ρ² + ζ²).
const REACH: f64 = 1.0 / 12.0;

/// cos φ at φ = π/8, π/4, 3π/8; with 0, π/2 and the mirror images these are the sixteen points.
const COSINES: [f64; 3] = [0.923_879_532_511_286_7, FRAC_1_SQRT_2, 0.382_683_432_365_089_8];

/// Whether the rule is exact to rounding here.
#[inline]
pub(super) fn covers(rho: f64, zeta: f64) -> bool {
    rho <= REACH * (1.0 + rho * rho + zeta * zeta)
}

/// The integrals at (ρ, ζ), in units of the disc's radius.
pub(super) fn shape(rho: f64, zeta: f64) -> Shape {
    let squares = 1.0 + rho * rho + zeta * zeta;
    let mut sum = Shape {
        shear_radial: 0.0,
        surface_radial: 0.0,
        shear_vertical: 0.0,
        surface_vertical: 0.0,
    };
    // Weights of 2π/16 at 0 and π, twice that for the points that stand for their mirror image; π cancels.
    let mut add = |cosine: f64, sine_squared: f64, weight: f64| {
        let distance = (squares - 2.0 * rho * cosine).sqrt();
        let inverse = 1.0 / (distance * (distance + zeta));
        let cubed = 1.0 / (distance * distance * distance);
        let normal = weight * (1.0 - rho * cosine) * inverse;
        sum.shear_radial += weight * sine_squared * cubed;
        sum.surface_radial += weight * sine_squared * inverse;
        sum.shear_vertical += normal;
        sum.surface_vertical += normal * distance;
    };
    add(1.0, 0.0, 0.125);
    add(-1.0, 0.0, 0.125);
    add(0.0, 1.0, 0.25);
    for cosine in COSINES {
        let sine_squared = 1.0 - cosine * cosine;
        add(cosine, sine_squared, 0.25);
        add(-cosine, sine_squared, 0.25);
    }
    Shape {
        shear_radial: rho * zeta * sum.shear_radial,
        surface_radial: rho * sum.surface_radial,
        shear_vertical: zeta * sum.shear_vertical,
        surface_vertical: sum.surface_vertical,
    }
}
