//! What depends on the stiffness of a spring, read between those that were run.

use creepage_run::Limited;

/// Force or movement with a spring of `stiffness`, or its share of a limit, between its values with
/// springs of the `levels`, which ascend, with 0 for none and infinity for a fixed end. Of a spring
/// against a spring it is exact: 1/u is linear in k, and 1/F in 1/k.
pub fn read(levels: &[f64], stiffness: f64, quantity: Limited, value: impl Fn(usize) -> f64) -> f64 {
    let above = levels.partition_point(|level| *level < stiffness);
    let above = above.min(levels.len() - 1);
    let below = above.saturating_sub(1);
    let (low, high) = (levels[below], levels[above]);
    if high <= stiffness || low == 0.0 || high.is_infinite() || above == below {
        return value(above);
    }
    let share = quantity.of([
        (1.0 / low - 1.0 / stiffness) / (1.0 / low - 1.0 / high),
        (stiffness - low) / (high - low),
    ]);
    1.0 / ((1.0 - share) / value(below) + share / value(above))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A spring k in series with one of stiffness c that is compressed by d together: u = c d / (k
    /// + c), F = k u.
    #[test]
    fn between_two_springs_in_series_it_is_exact() {
        let (c, d) = (3e5, 2e-3);
        let levels = [0.0, 1e4, 1e5, 1e6, f64::INFINITY];
        let movement = |k: f64| c * d / (k + c);
        for k in [1e4, 2e4, 8e4, 1e5, 7e5] {
            let moved = read(&levels, k, Limited::Movement, |level| movement(levels[level]));
            assert!((moved / movement(k) - 1.0).abs() < 1e-12, "{k}");
            let force = |k: f64| k * movement(k);
            let pressed = read(&levels, k, Limited::Force, |level| force(levels[level]));
            assert!((pressed / force(k) - 1.0).abs() < 1e-12, "{k}");
        }
        // Next to none and next to a fixed end the spring itself is read.
        let index = |k| read(&levels, k, Limited::Force, |level| level as f64);
        assert_eq!([5e3, 2e6, f64::INFINITY].map(index), [1.0, 4.0, 4.0]);
    }
}
