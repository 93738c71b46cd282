//! Gauss–Legendre rules on [−1, 1], of the few sizes the quadrature chooses from.
//!
//! Nodes by Newton's iteration on `P_n` from Tricomi's first guess; made once, kept for the life of the program.

use std::f64::consts::PI;
use std::sync::OnceLock;

/// Node and weight.
type Rule = Vec<(f64, f64)>;

/// Sizes in ascending order.
pub(crate) const SIZES: [usize; 20] = [
    4, 6, 8, 10, 12, 14, 16, 20, 24, 28, 32, 38, 44, 52, 60, 70, 82, 96, 112, 128,
];

static RULES: OnceLock<Vec<Rule>> = OnceLock::new();

/// The rule of size `SIZES[class]`.
pub(crate) fn rule_of_class(class: usize) -> &'static [(f64, f64)] {
    &RULES.get_or_init(|| SIZES.iter().map(|&n| rule(n)).collect())[class]
}

/// The rule with `n` nodes.
pub(crate) fn rule(n: usize) -> Rule {
    (0..n)
        .map(|i| {
            let mut x = (PI * (i as f64 + 0.75) / (n as f64 + 0.5)).cos();
            let mut slope = 1.0;
            for _ in 0..20 {
                let (value, derivative) = legendre(n, x);
                slope = derivative;
                let step = value / derivative;
                x -= step;
                if step.abs() < 1e-16 {
                    break;
                }
            }
            (x, 2.0 / ((1.0 - x * x) * slope * slope))
        })
        .collect()
}

/// `P_n`(x) and its derivative.
fn legendre(n: usize, x: f64) -> (f64, f64) {
    let (mut previous, mut current) = (1.0, x);
    for k in 1..n {
        let k = k as f64;
        let next = ((2.0 * k + 1.0) * x * current - k * previous) / (k + 1.0);
        previous = current;
        current = next;
    }
    (current, n as f64 * (x * current - previous) / (x * x - 1.0))
}
