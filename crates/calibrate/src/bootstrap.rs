//! Uncertainty by refitting to data drawn anew.
//!
//! Each replicate takes the calibrated model's predictions, adds noise, and is fitted from the optimum on; the spread of the
//! replicates is that of the estimates (B. Efron, R. J. Tibshirani, An Introduction to the Bootstrap, 1993, sections 6.5, 9.4 and 13.3).
//! Priors are drawn anew as well. Replicates run in parallel; the same seed draws the same replicates.

use fastrand::Rng;
use rayon::prelude::*;
use statrs::distribution::{ContinuousCDF, Normal};
use statrs::statistics::{Data, Distribution, OrderStatistics};

use crate::estimate::Interval;
use crate::evaluator::{Evaluator, feasible};
use crate::fit::Fit;
use crate::parameter::physical;
use crate::point::Point;
use crate::search::Search;
use crate::{Calibration, CalibrationError, Parameter, Prior};

/// Share of replicates that may fail: more of them would no longer show the spread.
const MOST_FAILED: f64 = 0.1;

/// How to draw replicates: each takes the fit's own residuals, drawn with replacement.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct BootstrapOptions {
    /// Number of replicates, at least 10.
    pub replicates: usize,
    /// Seed of the random generator.
    pub seed: u64,
}

/// Replicated estimates, of [`Calibration::bootstrap`].
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
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
    /// ```
    /// use calibrate::{BootstrapOptions, Calibration, ModelError, Parameter, Scale};
    ///
    /// let model = |p: &[f64]| -> Result<Vec<f64>, ModelError> { Ok(vec![p[0]; 5]) };
    /// let level = Parameter::new("level", 0.0, 100.0, Scale::Linear)?;
    /// let calibration = Calibration::new(&model, vec![level], vec![40.0, 41.0, 38.5, 40.5, 39.0])?;
    /// let fit = calibration.fit()?;
    /// let options = BootstrapOptions { replicates: 200, seed: 1 };
    /// let spread = calibration.bootstrap(&fit, &options)?;
    /// assert!((spread.standard_errors[0] / 0.46 - 1.0).abs() < 0.3);
    /// # Ok::<(), calibrate::CalibrationError>(())
    /// ```
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
        if self.discrepancy.is_some() {
            let allowed = "none beside a discrepancy, whose residuals are not independent";
            return Err(invalid("replicates", options.replicates, allowed));
        }
        if fit.fitted.len() != self.observations.len() || fit.free.len() != self.parameters.len() {
            return Err(invalid(
                "observations of the fit",
                fit.fitted.len(),
                "those of this calibration",
            ));
        }
        let mut seeds = Rng::with_seed(options.seed);
        let seeds: Vec<u64> = (0..options.replicates).map(|_| seeds.u64(..)).collect();
        let replicates: Vec<(usize, Result<Vec<f64>, CalibrationError>)> =
            seeds.par_iter().map(|&seed| self.replicate(fit, seed)).collect();
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
        let columns: Vec<Data<Vec<f64>>> = (0..self.parameters.len())
            .map(|k| Data::new(samples.iter().map(|sample| sample[k]).collect()))
            .collect();
        Ok(Bootstrap {
            standard_errors: columns
                .iter()
                .map(|column| column.std_dev().unwrap_or(0.0))
                .collect(),
            intervals: columns
                .into_iter()
                .zip(&self.parameters)
                .map(|(column, parameter)| self.percentiles(column, parameter))
                .collect(),
            samples,
            failed,
            evaluations,
        })
    }

    fn percentiles(&self, mut sample: Data<Vec<f64>>, parameter: &Parameter) -> Interval {
        let tail = 0.5 * (1.0 - self.options.confidence);
        let [lower, upper] = [tail, 1.0 - tail].map(|share| {
            let value = sample.quantile(share);
            (!parameter.is_at_bound(value)).then_some(value)
        });
        Interval { lower, upper }
    }

    /// One refit; model runs and the values found.
    fn replicate(&self, fit: &Fit, seed: u64) -> (usize, Result<Vec<f64>, CalibrationError>) {
        let mut random = Rng::with_seed(seed);
        // Residuals are smaller than the noise by the parameters' share.
        let count = fit.residuals.len();
        let lost = (count as f64 / fit.degrees_of_freedom.max(0.5)).sqrt();
        let mut drawn = self.clone();
        for ((value, fitted), sigma) in drawn.observations.iter_mut().zip(&fit.fitted).zip(&self.sigmas) {
            let index = random.usize(..count);
            *value = fitted + sigma * lost * fit.residuals[index] / self.sigmas[index];
        }
        for parameter in &mut drawn.parameters {
            if let Some(prior) = parameter.prior() {
                let moved = Normal::standard().inverse_cdf(random.f64());
                let value = parameter.value(parameter.coordinate(prior.value) + prior.sigma * moved);
                // A prior beyond the bounds stays where it was.
                if let Ok(other) = parameter.clone().with_prior(Prior { value, ..prior }) {
                    *parameter = other;
                }
            }
        }
        drawn.options.observer = None;
        let evaluator = Evaluator::new(&drawn);
        let found = || {
            let start = Point {
                free: fit.free.clone(),
                residuals: evaluator.residuals(&fit.free)?,
            };
            if !feasible(&start.residuals) {
                let source = evaluator.last_failure();
                return Err(CalibrationError::NoFeasibleStart { starts: 1, source });
            }
            let mut search = Search::new(&evaluator);
            search.known_noise &= !fit.noise_estimated;
            let optimum = search.refine(start, Some(fit.jacobian.clone()))?;
            Ok(physical(&self.parameters, &optimum.point.free))
        };
        let found = found();
        (evaluator.count(), found)
    }
}
