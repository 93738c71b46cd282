//! Gauss and Legendre's rule, for oracles that share nothing with the crates.

use std::f64::consts::PI;

/// Nodes and weights on [−1, 1].
pub fn gauss_legendre(points: usize) -> Vec<(f64, f64)> {
    let n = points as f64;
    let pair = |i: usize| {
        let mut x = (PI * (i as f64 + 0.75) / (n + 0.5)).cos();
        let mut slope = 1.0;
        // Newton's iteration.
        for _ in 0..10 {
            let (mut before, mut value) = (1.0, x);
            for k in 2..=points {
                let k = k as f64;
                (before, value) = (value, ((2.0 * k - 1.0) * x * value - (k - 1.0) * before) / k);
            }
            slope = n * (x * value - before) / (x * x - 1.0);
            x -= value / slope;
        }
        (x, 2.0 / ((1.0 - x * x) * slope * slope))
    };
    (0..points).map(pair).collect()
}

/// Radii of rings that stand for a disc of radius 1, and their shares of it: the rule in the square of the radius.
pub fn rings(points: usize) -> Vec<(f64, f64)> {
    let ring = |(t, weight): (f64, f64)| ((0.5 * (1.0 + t)).sqrt(), 0.5 * weight);
    gauss_legendre(points).into_iter().map(ring).collect()
}
