//! The largest value of a smooth function that is known at places which resolve it.

/// Local maxima below this share of the largest value seen are not looked at: between two places the function rises by less.
const CONTENDER: f64 = 0.8;
/// Steps of the golden section: the bracket shrinks to 1e-8 of itself, where a maximum is flat to rounding.
const STEPS: usize = 40;

/// Largest of `value` over the ascending `places` and between them; `seen(k)` is its value at `places[k]`.
pub(crate) fn largest(places: &[f64], seen: impl Fn(usize) -> f64, value: impl Fn(f64) -> f64) -> f64 {
    let last = places.len().saturating_sub(1);
    let highest = (0..places.len()).map(&seen).fold(0.0, f64::max);
    (0..places.len())
        .filter(|&k| {
            let (before, here, after) = (seen(k.saturating_sub(1)), seen(k), seen((k + 1).min(last)));
            here > CONTENDER * highest && here >= before && here >= after
        })
        .map(|k| {
            let bracket = (places[k.saturating_sub(1)], places[(k + 1).min(last)]);
            golden_section(bracket, &value).max(seen(k))
        })
        .fold(highest, f64::max)
}

/// Maximum of a single bump within the bracket.
fn golden_section((mut low, mut high): (f64, f64), value: impl Fn(f64) -> f64) -> f64 {
    const GOLDEN: f64 = 0.618_033_988_749_894_9;
    for _ in 0..STEPS {
        let (left, right) = (high - GOLDEN * (high - low), low + GOLDEN * (high - low));
        if value(left) > value(right) {
            high = right;
        } else {
            low = left;
        }
    }
    value(0.5 * (low + high))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The higher of two bumps is found although the places show the lower one higher.
    #[test]
    fn contenders_are_compared_where_they_are_highest() {
        let bumps = |x: f64| (-(x - 1.5) * (x - 1.5)).exp() + 0.97 * (-(x - 8.0) * (x - 8.0)).exp();
        let places: Vec<f64> = (0..=10).map(f64::from).collect();
        let found = largest(&places, |k| bumps(places[k]), bumps);
        assert!((found - 1.0).abs() < 1e-12, "{found}");
    }
}
