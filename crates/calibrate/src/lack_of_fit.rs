//! Whether the residuals of a fit are the noise that the fit takes them for.
//!
//! Residuals that are noise change their sign from one to the next as coins do; too few changes
//! show a curve that the model does not follow (A. Wald, J. Wolfowitz, "On a test whether two samples
//! are from the same population", 1940; here with signs that are positive and negative alike, so that
//! residuals all of one sign count).

use statrs::distribution::{Binomial, ChiSquared, ContinuousCDF, DiscreteCDF, FisherSnedecor};

/// Minimum number of residuals that are judged.
const MIN_FREEDOM: f64 = 3.0;

/// Probability of so few changes of sign by chance, of residuals in the order in which they were
/// measured; `series` are independent.
pub fn probability_of_signs(series: &[Vec<f64>]) -> f64 {
    let pairs = series.iter().flat_map(|residuals| residuals.windows(2));
    let (mut changes, mut chances) = (0, 0);
    for pair in pairs {
        chances += 1;
        changes += u64::from((pair[0] < 0.0) != (pair[1] < 0.0));
    }
    Binomial::new(0.5, chances).map_or(1.0, |binomial| binomial.cdf(changes))
}

/// Probability that noise alone gains as much from one parameter more: the sum of squared residuals falls
/// from `before` to `after`, with these degrees of freedom left. Noise is `known`, in the unit of the
/// residuals, or estimated from them. `None` of too few.
pub fn probability_of_gain(before: f64, after: f64, freedom: f64, known: Option<f64>) -> Option<f64> {
    let gain = (before - after).max(0.0);
    match known {
        Some(noise) => Some(1.0 - ChiSquared::new(1.0).ok()?.cdf(gain / (noise * noise))),
        None if freedom < MIN_FREEDOM => None,
        None => {
            let noise = (after / freedom).max(f64::MIN_POSITIVE);
            Some(1.0 - FisherSnedecor::new(1.0, freedom).ok()?.cdf(gain / noise))
        }
    }
}

/// Probability that noise like that between neighbours makes residuals so large, of which `used` are
/// determined by parameters: a ratio of variances, one from all residuals and one from how far each lies
/// off the line between its neighbours, which a curve hardly moves (J. von Neumann, "Distribution of the
/// ratio of the mean square successive difference to the variance", 1941). `None` of too few.
pub fn probability_of_size(series: &[Vec<f64>], used: f64) -> Option<f64> {
    let (count, square) = squares(series.iter().flatten().copied());
    let off = |three: &[f64]| (three[1] - 0.5 * (three[0] + three[2])) / 1.5_f64.sqrt();
    let (pieces, rough) = squares(series.iter().flat_map(|residuals| residuals.windows(3)).map(off));
    // Neighbouring pieces share readings: they count as half as many.
    let (freedom, half) = (count - used, 0.5 * pieces);
    if rough <= 0.0 || freedom < MIN_FREEDOM || half < MIN_FREEDOM {
        return None;
    }
    let ratio = square / freedom / (rough / pieces);
    Some(1.0 - FisherSnedecor::new(freedom, half).ok()?.cdf(ratio))
}

/// Probability that noise of known sigmas makes residuals so large, which are in units of these, and of
/// which `used` are determined by parameters: χ² with what is left, or with one where nothing is, which
/// is cautious.
pub fn probability_of_scatter(series: &[Vec<f64>], used: f64) -> f64 {
    let (count, square) = squares(series.iter().flatten().copied());
    ChiSquared::new((count - used).max(1.0)).map_or(1.0, |squares| 1.0 - squares.cdf(square))
}

/// How many numbers there are, and the sum of their squares.
fn squares(numbers: impl Iterator<Item = f64>) -> (f64, f64) {
    numbers.fold((0.0, 0.0), |(count, square), r| (count + 1.0, square + r * r))
}

#[cfg(test)]
mod tests {
    use super::{probability_of_gain, probability_of_scatter, probability_of_signs, probability_of_size};

    #[test]
    fn sigmas_bound_the_scatter() {
        // 1.96 standard deviations of one residual, and the 95 % quantile of χ² with two degrees of
        // freedom, −2 ln 0.05.
        assert!((probability_of_scatter(&[vec![1.959_963_984_540_054]], 1.0) - 0.05).abs() < 1e-9);
        let root = (-0.05_f64.ln()).sqrt();
        assert!((probability_of_scatter(&[vec![root, -root], vec![0.0]], 1.0) - 0.05).abs() < 1e-9);
        assert_eq!(probability_of_scatter(&[], 0.0), 1.0);
    }

    /// The 95 % quantile of χ² with one degree of freedom is 1.96², that of F with one and ten 4.9646.
    #[test]
    fn a_parameter_gains_something_by_chance() {
        let near = |found: Option<f64>| assert!((found.unwrap() - 0.05).abs() < 1e-5, "{found:?}");
        near(probability_of_gain(20.0 + 4.0 * 3.841_459, 20.0, 10.0, Some(2.0)));
        near(probability_of_gain(20.0 + 2.0 * 4.964_603, 20.0, 10.0, None));
        assert_eq!(probability_of_gain(2.0, 1.0, 2.0, None), None);
    }

    #[test]
    fn a_curve_is_larger_than_its_neighbours_differ() {
        let curve: Vec<f64> = (0..40)
            .map(|k| f64::from(k) * 0.1 + if k % 2 == 0 { 0.2 } else { -0.2 })
            .collect();
        assert!(probability_of_size(&[curve], 2.0).unwrap() < 1e-6);
        let noise: Vec<f64> = (0..40).map(|k| f64::from(k * 7 % 11) - 5.0).collect();
        assert!(probability_of_size(&[noise], 2.0).unwrap() > 0.3);
        assert_eq!(probability_of_size(&[vec![1.0, 2.0]], 0.0), None);
    }

    #[test]
    fn signs_count_as_coins_do() {
        // All ten of one sign: nine coins.
        assert!((probability_of_signs(&[vec![1.0; 10]]) - 0.5_f64.powi(9)).abs() < 1e-12);
        assert!((probability_of_signs(&[vec![1.0, -1.0, 1.0, -1.0]]) - 1.0).abs() < 1e-12);
        // Two series of three are four coins.
        let two = [vec![1.0, 1.0, 1.0], vec![-1.0, -1.0, -1.0]];
        assert!((probability_of_signs(&two) - 0.0625).abs() < 1e-12);
        assert_eq!(probability_of_signs(&[vec![1.0]]), 1.0);
    }
}
