//! Points of the search: the free variables of all parameters, and the residuals there.

use nalgebra::DVector;

/// Free variables and the residuals of a model there.
#[derive(Debug, Clone)]
pub(crate) struct Point {
    pub free: DVector<f64>,
    pub residuals: DVector<f64>,
}

/// `count` places all over the range, by the generalised golden ratio (M. Roberts, "The unreasonable effectiveness of quasirandom
/// sequences", 2018).
pub(crate) fn all_over(dimensions: usize, count: usize) -> Vec<DVector<f64>> {
    let mut ratio = 2.0_f64;
    for _ in 0..60 {
        ratio = (1.0 + ratio).powf(1.0 / (dimensions as f64 + 1.0));
    }
    let place = |index: usize| {
        DVector::from_fn(dimensions, |k, _| {
            let share = (0.5 + (index + 1) as f64 * ratio.powi(-(k as i32) - 1)).fract();
            (share / (1.0 - share)).ln().clamp(-5.0, 5.0)
        })
    };
    (0..count).map(place).collect()
}

/// −2 log likelihood under noise with heavy tails, whose scale is known or estimated from these residuals. The first `data` of them are
/// those of the observations, the others those of the priors.
pub(crate) fn score(residuals: &DVector<f64>, data: usize, known_noise: bool) -> f64 {
    let sum: f64 = residuals.iter().take(data).map(|r| r.abs()).sum();
    let priors: f64 = residuals.iter().skip(data).map(|r| r * r).sum();
    if known_noise {
        2.0 * sum + priors
    } else {
        2.0 * data as f64 * sum.max(f64::MIN_POSITIVE).ln() + priors
    }
}
