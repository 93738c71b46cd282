//! Levin's method: the integral of a smooth function times a fast Bessel function from the ends of the interval alone.
//!
//! Slowly varying p, q with (p J0 + q J1)' = f J0 + g J1, all of argument m r, obey
//!
//! ```text
//! p' + r q = f,   q' − q/m − r p = g
//! ```
//!
//! Alternating between the two equations converges like a power of 1/(r × half width), on an interval away from m = 0.
//! The first equation is met exactly; what the second one still lacks, times the width, bounds the error.
//!
//! Reference: D. Levin, Math. Comp. 38 (1982) 531–538, with the collocation system solved by iteration.

use crate::panel::{Series, derivative_of};

const MAX_ITERATIONS: usize = 40;

/// Values at the nodes of p and q with (p J0 + q J1)' = f J0 + g J1 of argument m `radius`, over an interval of `half` the width with
/// nodes at the `wavenumbers`, and a bound of the integral's error; `None` if the alternation does not reach `tolerance`.
pub(crate) fn antiderivative(
    radius: f64,
    (half, wavenumbers): (f64, &Series),
    (f, g): (&Series, &Series),
    tolerance: f64,
) -> Option<(Series, Series, f64)> {
    let derivative = |values: &Series| derivative_of(values).map(|slope| slope / half);
    let mut p: Series = g.map(|v| -v / radius);
    let mut last = f64::INFINITY;
    for _ in 0..MAX_ITERATIONS {
        let slope = derivative(&p);
        let q: Series = std::array::from_fn(|i| (f[i] - slope[i]) / radius);
        let slope = derivative(&q);
        let next: Series = std::array::from_fn(|i| (slope[i] - q[i] / wavenumbers[i] - g[i]) / radius);
        let gaps = next.iter().zip(&p).map(|(a, b)| (a - b).abs());
        let lack = gaps.fold(0.0, f64::max);
        // Twice the half width, |J| ≤ 1; another factor for values between the nodes.
        let error = 4.0 * lack * radius * half;
        if error <= tolerance {
            return Some((p, q, error));
        }
        if error > 2.0 * last || !error.is_finite() {
            return None;
        }
        last = error;
        p = next;
    }
    None
}
