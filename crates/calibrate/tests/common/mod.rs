//! A closed-form model whose covariance is known exactly, and seeded noise.

use calibrate::{ModelError, Parameter, Scale};
use fastrand::Rng;

/// F = F_s (1 − e^(−n/τ)) after passes n, with parameters F_s and τ.
pub fn saturation(passes: &[f64]) -> impl Fn(&[f64]) -> Result<Vec<f64>, ModelError> + Sync + use<> {
    let passes = passes.to_vec();
    move |p| {
        Ok(passes
            .iter()
            .map(|n: &f64| p[0] * (1.0 - (-n / p[1]).exp()))
            .collect())
    }
}

/// Its parameters.
pub fn saturation_parameters() -> Vec<Parameter> {
    vec![
        Parameter::new("force", 10.0, 5000.0, Scale::Linear).unwrap(),
        Parameter::new("passes", 0.5, 500.0, Scale::Logarithmic).unwrap(),
    ]
}

/// 1, 2, … `count`.
pub fn passes(count: u32) -> Vec<f64> {
    (1..=count).map(f64::from).collect()
}

/// A standard normal number (G. E. P. Box, M. E. Muller, 1958).
pub fn gaussian(random: &mut Rng) -> f64 {
    let radius = (-2.0 * (1.0 - random.f64()).ln()).sqrt();
    radius * (std::f64::consts::TAU * random.f64()).cos()
}

/// `exact` with Gaussian noise of `sigma`.
pub fn noisy(exact: &[f64], sigma: f64, seed: u64) -> Vec<f64> {
    let mut random = Rng::with_seed(seed);
    exact
        .iter()
        .map(|value| value + sigma * gaussian(&mut random))
        .collect()
}
