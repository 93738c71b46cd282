//! Uncertainty by refitting to data drawn anew.
//!
//! Each replicate takes the calibrated model's predictions, adds noise, and is fitted from the optimum on; the spread of the
//! replicates is that of the estimates (B. Efron, R. J. Tibshirani, An Introduction to the Bootstrap, 1993, sections 6.5, 9.4 and 13.3).
//! Priors are drawn anew as well. Replicates run in parallel; the same seed draws the same replicates.

use fastrand::Rng;
use nalgebra::DVector;
use rayon::prelude::*;

use crate::evaluator::{Evaluator, feasible};
use crate::fit::{Fit, Interval};
use crate::search::{Point, Search};
use crate::{Calibration, CalibrationError, Parameter, Prior};

/// Share of replicates that may fail.
const MOST_FAILED: f64 = 0.1;

/// Where the noise of a replicate comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Resampling {
    /// The fit's own residuals, drawn with replacement.
    #[default]
    Residuals,
    /// Gaussian noise of the fit's standard deviation.
    Gaussian,
}

/// How to draw replicates.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct BootstrapOptions {
    /// How many.
    pub replicates: usize,
    /// Seed of the generator.
    pub seed: u64,
    /// Where their noise comes from.
    pub resampling: Resampling,
}

/// Replicated estimates.
#[derive(Debug, Clone, PartialEq)]
pub struct Bootstrap {
    /// Values of the parameters in each replicate that could be fitted.
    pub samples: Vec<Vec<f64>>,
    /// Standard deviation of each parameter.
    pub standard_errors: Vec<f64>,
    /// Percentile interval of each parameter at the fit's level of confidence; an end is open where it lies at a bound.
    pub intervals: Vec<Interval>,
    /// Replicates that could not be fitted.
    pub failed: usize,
    /// Model runs.
    pub evaluations: usize,
}

impl Calibration<'_> {
    /// Refits to replicates of the data around `fit`.
    ///
    /// # Errors
    ///
    /// [`CalibrationError::InvalidOption`] for fewer than 10 replicates or a fit of another calibration,
    /// [`CalibrationError::Bootstrap`] where more than a tenth of the replicates cannot be fitted.
    pub fn bootstrap(&self, fit: &Fit, options: &BootstrapOptions) -> Result<Bootstrap, CalibrationError> {
        let invalid = |name, value: usize, allowed| CalibrationError::InvalidOption {
            name,
            value: value as f64,
            allowed,
        };
        if options.replicates < 10 {
            return Err(invalid("replicates", options.replicates, "at least 10"));
        }
        if fit.fitted.len() != self.observations().len() || fit.free.len() != self.parameters().len() {
            return Err(invalid(
                "observations of the fit",
                fit.fitted.len(),
                "those of this calibration",
            ));
        }
        let mut seeds = Rng::with_seed(options.seed);
        let seeds: Vec<u64> = (0..options.replicates).map(|_| seeds.u64(..)).collect();
        let replicates: Vec<(usize, Result<Vec<f64>, CalibrationError>)> = seeds
            .par_iter()
            .map(|&seed| self.replicate(fit, options.resampling, seed))
            .collect();
        let evaluations = replicates.iter().map(|(runs, _)| runs).sum();
        let mut samples = Vec::new();
        let mut failure = None;
        for (_, replicate) in replicates {
            match replicate {
                Ok(sample) => samples.push(sample),
                Err(error) => failure = Some(error),
            }
        }
        let failed = options.replicates - samples.len();
        if let Some(source) = failure
            && failed as f64 > MOST_FAILED * options.replicates as f64
        {
            return Err(CalibrationError::Bootstrap {
                failed,
                replicates: options.replicates,
                source: Box::new(source),
            });
        }
        let tail = 0.5 * (1.0 - self.options().confidence);
        let columns: Vec<Vec<f64>> = (0..self.parameters().len())
            .map(|k| {
                let mut column: Vec<f64> = samples.iter().map(|sample| sample[k]).collect();
                column.sort_unstable_by(f64::total_cmp);
                column
            })
            .collect();
        Ok(Bootstrap {
            standard_errors: columns.iter().map(|column| standard_deviation(column)).collect(),
            intervals: columns
                .iter()
                .zip(self.parameters())
                .map(|(column, parameter)| percentiles(column, parameter, tail))
                .collect(),
            samples,
            failed,
            evaluations,
        })
    }

    /// One refit; model runs and the values found.
    fn replicate(
        &self,
        fit: &Fit,
        resampling: Resampling,
        seed: u64,
    ) -> (usize, Result<Vec<f64>, CalibrationError>) {
        let mut random = Rng::with_seed(seed);
        let units = self.units();
        // Residuals are smaller than the noise by the parameters' share.
        let count = fit.residuals.len();
        let lost = (count as f64 / fit.degrees_of_freedom.max(0.5)).sqrt();
        let values: Vec<f64> = fit
            .fitted
            .iter()
            .zip(&units)
            .map(|(fitted, unit)| {
                let noise = match resampling {
                    Resampling::Gaussian => fit.noise * gaussian(&mut random),
                    Resampling::Residuals => {
                        let drawn = random.usize(..count);
                        lost * fit.residuals[drawn] / units[drawn]
                    }
                };
                fitted + unit * noise
            })
            .collect();
        let parameters: Vec<Parameter> = self
            .parameters()
            .iter()
            .map(|parameter| {
                let drawn = parameter.prior().and_then(|prior| {
                    let moved = parameter.coordinate(prior.value) + prior.sigma * gaussian(&mut random);
                    let value = parameter.value(moved);
                    parameter.clone().with_prior(Prior { value, ..prior }).ok()
                });
                drawn.unwrap_or_else(|| parameter.clone())
            })
            .collect();
        let options = self.options();
        let evaluator = Evaluator::new(
            self.model(),
            &parameters,
            &values,
            &units,
            options.relative_noise,
            options.max_evaluations,
        );
        let search = Search {
            evaluator: &evaluator,
            observer: None,
            known_noise: self.sigmas().is_some() && !fit.noise_estimated,
            tolerance: options.tolerance,
            loss: options.loss,
            dear: true,
            least_noise: self.least_noise(&units),
        };
        let free = DVector::from_column_slice(&fit.free);
        let found = evaluator.residuals(&free).and_then(|residuals| {
            if !feasible(&residuals) {
                return Err(CalibrationError::NoFeasibleStart {
                    starts: 1,
                    source: evaluator.last_failure(),
                });
            }
            let optimum = search.refine(Point { free, residuals }, Some(fit.jacobian.clone()))?;
            Ok(evaluator.physical(&optimum.point.free))
        });
        (evaluator.count(), found)
    }
}

/// A standard normal number (G. E. P. Box, M. E. Muller, Annals of Mathematical Statistics 29, 1958).
fn gaussian(random: &mut Rng) -> f64 {
    let radius = (-2.0 * (1.0 - random.f64()).ln()).sqrt();
    radius * (std::f64::consts::TAU * random.f64()).cos()
}

fn standard_deviation(sample: &[f64]) -> f64 {
    let count = sample.len() as f64;
    let mean = sample.iter().sum::<f64>() / count;
    let square: f64 = sample.iter().map(|value| (value - mean).powi(2)).sum();
    (square / (count - 1.0)).sqrt()
}

/// Percentiles of an ascending sample.
fn percentiles(sample: &[f64], parameter: &Parameter, tail: f64) -> Interval {
    let at = |share: f64| {
        let place = share * (sample.len() - 1) as f64;
        let (low, rest) = (place.floor() as usize, place.fract());
        let high = (low + 1).min(sample.len() - 1);
        let value = sample[low] + rest * (sample[high] - sample[low]);
        (!parameter.is_at_bound(value)).then_some(value)
    };
    Interval {
        lower: at(tail),
        upper: at(1.0 - tail),
    }
}
