//! A closed-form model whose covariance is known exactly, and seeded noise.

use calibrate::{Calibration, Fit, Model, ModelError, Parameter, Scale};
use fastrand::Rng;

/// F = F_s (1 − e^(−n/τ)) after passes n, with parameters F_s and τ.
pub fn saturation(passes: &[f64]) -> impl Fn(&[f64]) -> Result<Vec<f64>, ModelError> + Sync + use<> {
    let passes = passes.to_vec();
    move |p| {
        let force = |n: &f64| p[0] * (1.0 - (-n / p[1]).exp());
        Ok(passes.iter().map(force).collect())
    }
}

/// Its parameters.
pub fn saturation_parameters() -> Vec<Parameter> {
    vec![linear("force", 10.0, 5000.0), logarithmic("passes", 0.5, 500.0)]
}

/// Data of a model with its truth and noise.
pub fn measured(model: &dyn Model, truth: &[f64], sigma: f64, seed: u64) -> Vec<f64> {
    noisy(&model.predict(truth).unwrap(), sigma, seed)
}

/// A model of `predict` that always has an answer.
pub fn answering(
    predict: impl Fn(&[f64]) -> Vec<f64> + Sync,
) -> impl Fn(&[f64]) -> Result<Vec<f64>, ModelError> + Sync {
    move |parameters| Ok(predict(parameters))
}

/// Fitted to `data`, with a sigma of all of them that is known or not.
pub fn fitted(model: &dyn Model, parameters: Vec<Parameter>, data: Vec<f64>, sigma: Option<f64>) -> Fit {
    fitted_with(model, parameters, data, sigma, |calibration| calibration)
}

/// [`fitted`] after a change of the calibration.
pub fn fitted_with<'a>(
    model: &'a dyn Model,
    parameters: Vec<Parameter>,
    data: Vec<f64>,
    sigma: Option<f64>,
    change: impl FnOnce(Calibration<'a>) -> Calibration<'a>,
) -> Fit {
    let count = data.len();
    let mut calibration = Calibration::new(model, parameters, data).unwrap();
    if let Some(sigma) = sigma {
        calibration = calibration.with_sigmas(vec![sigma; count]).unwrap();
    }
    change(calibration).fit().unwrap()
}

pub fn linear(name: &str, lower: f64, upper: f64) -> Parameter {
    Parameter::new(name, lower, upper, Scale::Linear).unwrap()
}

pub fn logarithmic(name: &str, lower: f64, upper: f64) -> Parameter {
    Parameter::new(name, lower, upper, Scale::Logarithmic).unwrap()
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
    let read = |value| value + sigma * gaussian(&mut random);
    exact.iter().map(read).collect()
}

/// Asserts that two numbers are no farther apart than `allowed`.
#[track_caller]
pub fn assert_near(found: f64, expected: f64, allowed: f64) {
    let off = (found - expected).abs();
    assert!(off <= allowed, "{found}, not {expected} within {allowed}");
}
