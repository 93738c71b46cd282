//! A calibration: model, parameters, observations and options, and how they become a fit.

use nalgebra::DVector;
use statrs::distribution::{ChiSquared, ContinuousCDF};

use crate::deviance::Deviance;
use crate::evaluator::Evaluator;
use crate::fit::{Estimate, Fit, Interval, Warning};
use crate::parameter::FARTHEST;
use crate::profile::{Outcome, ProfileInterval, Profiler};
use crate::search::{Optimum, Search};
use crate::uncertainty::{Covariance, parameters_from_data, quantile};
use crate::valley::Valley;
use crate::{CalibrationError, Loss, Model, Options, Parameter, Profiles};

/// Scanned points: so many, and so many more a parameter.
const SCAN: usize = 8;
/// Probability of residuals as large as these under the given sigmas, below which the sigmas are not believed.
const MISFIT: f64 = 0.001;
/// Correlation from which two parameters count as hardly told apart.
const CORRELATED: f64 = 0.99;
/// Weight below which an observation counts as an outlier.
const OUTLIER: f64 = 0.35;
/// Degrees of freedom below which the user is warned.
const FEW: f64 = 5.0;
/// Distance to the minimum, in standard errors, that is worth a warning.
const ROUGH: f64 = 0.1;
/// Times that a profile may find a lower optimum before the fit gives up.
const MAX_OPTIMA: usize = 12;
/// Least noise of the model itself, as a share of its largest prediction: rounding.
const ROUNDING: f64 = 1e-12;

/// A model to be fitted to observations.
pub struct Calibration<'a> {
    model: &'a dyn Model,
    parameters: Vec<Parameter>,
    observations: Vec<f64>,
    sigmas: Option<Vec<f64>>,
    options: Options,
}

impl<'a> Calibration<'a> {
    /// Fits `parameters` of `model` to `observations`, whose noise is the same for all and is estimated from the residuals.
    ///
    /// # Errors
    ///
    /// [`CalibrationError::DuplicateParameter`], [`CalibrationError::InvalidObservation`], and
    /// [`CalibrationError::TooFewObservations`] where there are no parameters or more than observations could determine.
    pub fn new(
        model: &'a dyn Model,
        parameters: Vec<Parameter>,
        observations: Vec<f64>,
    ) -> Result<Self, CalibrationError> {
        for (index, parameter) in parameters.iter().enumerate() {
            let name = parameter.name();
            if parameters[..index].iter().any(|other| other.name() == name) {
                return Err(CalibrationError::DuplicateParameter {
                    name: name.to_owned(),
                });
            }
        }
        if let Some(index) = observations.iter().position(|value| !value.is_finite()) {
            return Err(CalibrationError::InvalidObservation {
                index,
                quantity: "value",
                value: observations[index],
                allowed: "finite",
            });
        }
        Ok(Self {
            model,
            parameters,
            observations,
            sigmas: None,
            options: Options::default(),
        })
    }

    /// The standard deviation of each observation is known.
    ///
    /// # Errors
    ///
    /// [`CalibrationError::SigmaCount`], and [`CalibrationError::InvalidObservation`] unless every sigma is finite and positive.
    pub fn with_sigmas(mut self, sigmas: Vec<f64>) -> Result<Self, CalibrationError> {
        if sigmas.len() != self.observations.len() {
            return Err(CalibrationError::SigmaCount {
                sigmas: sigmas.len(),
                observations: self.observations.len(),
            });
        }
        if let Some(index) = sigmas.iter().position(|s| !(s.is_finite() && *s > 0.0)) {
            return Err(CalibrationError::InvalidObservation {
                index,
                quantity: "sigma",
                value: sigmas[index],
                allowed: "finite and positive",
            });
        }
        self.sigmas = Some(sigmas);
        Ok(self)
    }

    /// How to fit.
    ///
    /// # Errors
    ///
    /// [`CalibrationError::InvalidOption`].
    pub fn with_options(mut self, options: Options) -> Result<Self, CalibrationError> {
        options.check(self.parameters.len())?;
        self.options = options;
        Ok(self)
    }

    /// The parameters.
    pub fn parameters(&self) -> &[Parameter] {
        &self.parameters
    }

    /// The observations.
    pub fn observations(&self) -> &[f64] {
        &self.observations
    }

    pub(crate) fn model(&self) -> &'a dyn Model {
        self.model
    }

    pub(crate) fn sigmas(&self) -> Option<&[f64]> {
        self.sigmas.as_deref()
    }

    pub(crate) fn options(&self) -> &Options {
        &self.options
    }

    /// Sigma of every observation, 1 where the noise is to be estimated.
    pub(crate) fn units(&self) -> Vec<f64> {
        self.sigmas
            .clone()
            .unwrap_or_else(|| vec![1.0; self.observations.len()])
    }

    /// Noise that the model's predictions have at least, in units of the sigmas.
    pub(crate) fn least_noise(&self, units: &[f64]) -> f64 {
        let share = self.options.relative_noise.max(ROUNDING);
        self.observations
            .iter()
            .zip(units)
            .fold(f64::MIN_POSITIVE, |most, (value, unit)| {
                most.max(share * value.abs() / unit)
            })
    }

    /// Fits.
    ///
    /// # Errors
    ///
    /// [`CalibrationError`] where there are too few observations, the model has no answer anywhere, the fit does not converge or needs
    /// more model runs than allowed.
    pub fn fit(&self) -> Result<Fit, CalibrationError> {
        self.check_count()?;
        let units = self.units();
        let evaluator = Evaluator::new(
            self.model,
            &self.parameters,
            &self.observations,
            &units,
            self.options.relative_noise,
            self.options.max_evaluations,
        );
        let mut search = Search {
            evaluator: &evaluator,
            observer: self.options.observer.clone(),
            known_noise: self.sigmas.is_some(),
            tolerance: self.options.tolerance,
            loss: self.options.loss,
            least_noise: self.least_noise(&units),
        };
        let start = self.options.start.as_ref().map(|start| self.free(start));
        let count = self.options.scan.unwrap_or(SCAN * (1 + self.parameters.len()));
        let scan = search.scan(start, if start_only(&self.options) { 0 } else { count })?;
        let (mut optimum, rival) = search.best(&scan, self.options.restart)?;
        let mut warnings = Vec::new();
        if let Some(misfit) = self.misfit(&optimum) {
            // The sigmas are not believed: only their ratios are.
            warnings.push(misfit);
            search.known_noise = false;
            optimum = search.refine(optimum.point.clone(), Some(optimum.jacobian.clone()))?;
        }
        for _ in 0..MAX_OPTIMA {
            match self.describe(&search, &optimum)? {
                Described::Estimates(estimates, covariance) => {
                    warnings.extend(rival.and_then(|rival| self.ambiguity(&estimates, &rival.free)));
                    return Ok(self.answer(&search, &optimum, estimates, &covariance, warnings));
                }
                Described::Better(point) => optimum = search.refine(point, None)?,
            }
        }
        Err(CalibrationError::NotConverged {
            iterations: optimum.iterations,
            offset: f64::INFINITY,
        })
    }

    /// Priors count as observations; noise to be estimated needs one more, and at least two of the data.
    fn check_count(&self) -> Result<(), CalibrationError> {
        let (observations, parameters) = (self.observations.len(), self.parameters.len());
        let priors = self.parameters.iter().filter(|p| p.prior().is_some()).count();
        let unknown = parameters - priors;
        let needed = match self.sigmas {
            Some(_) => unknown.max(1),
            None => (unknown + 1).max(2),
        };
        if parameters == 0 || observations < needed {
            return Err(CalibrationError::TooFewObservations {
                observations,
                parameters,
                needed,
            });
        }
        Ok(())
    }

    pub(crate) fn free(&self, values: &[f64]) -> DVector<f64> {
        DVector::from_iterator(
            self.parameters.len(),
            self.parameters.iter().zip(values).map(|(parameter, &value)| {
                let inside = value.clamp(parameter.lower(), parameter.upper());
                parameter.free(parameter.coordinate(inside))
            }),
        )
    }

    /// A rival outside of the intervals.
    fn ambiguity(&self, estimates: &[Estimate], rival: &DVector<f64>) -> Option<Warning> {
        let values: Vec<f64> = self
            .parameters
            .iter()
            .zip(rival.iter())
            .map(|(parameter, &free)| parameter.value(parameter.bounded(free)))
            .collect();
        let outside = estimates
            .iter()
            .zip(&values)
            .any(|(estimate, &value)| !estimate.interval.contains(value));
        outside.then_some(Warning::Ambiguous { values })
    }

    /// Whether the residuals are larger than known sigmas allow. A robust loss judges its own spread.
    fn misfit(&self, optimum: &Optimum) -> Option<Warning> {
        if self.sigmas.is_none() || self.options.loss != Loss::Squares {
            return None;
        }
        let deviance = Deviance {
            normalisation: 1.0,
            ..optimum.deviance
        };
        let residuals = &optimum.point.residuals;
        let freedom = self.freedom(optimum);
        let sum: f64 = residuals.iter().take(deviance.data).map(|r| r * r).sum();
        let probability = 1.0 - ChiSquared::new(freedom).ok()?.cdf(sum);
        // Residuals within the model's own rounding are no misfit.
        (freedom >= 1.0 && probability < MISFIT).then_some(Warning::Misfit {
            reduced_chi_square: sum / freedom,
            probability,
        })
    }

    /// Observations less the parameters that they determine.
    fn freedom(&self, optimum: &Optimum) -> f64 {
        let used = parameters_from_data(&optimum.jacobian, &optimum.deviance, &optimum.point.residuals);
        (self.observations.len() as f64 - used).max(0.0)
    }

    /// Estimates with their intervals, or a better optimum found on the way.
    fn describe(&self, search: &Search<'_>, optimum: &Optimum) -> Result<Described, CalibrationError> {
        let curvatures = optimum.deviance.curvatures(&optimum.point.residuals);
        let covariance = Covariance::new(&optimum.jacobian, &curvatures);
        let degrees_of_freedom =
            (!search.known_noise || self.options.loss.is_robust()).then(|| self.freedom(optimum).max(0.5));
        let tail = 1.0 - self.options.confidence;
        let mut profiler = Profiler {
            search,
            optimum,
            covariance: &covariance,
            degrees_of_freedom,
            tail,
            valley: Valley::new(&optimum.point.free),
        };
        let mut estimates = vec![None; self.parameters.len()];
        // What is known least first: along it the valley is followed best, and the others follow in its track.
        let mut order: Vec<usize> = (0..self.parameters.len()).collect();
        let error = |k: usize| covariance.standard_error(k).unwrap_or(f64::INFINITY);
        order.sort_by(|&a, &b| error(b).total_cmp(&error(a)));
        for k in order {
            let parameter = &self.parameters[k];
            let free = optimum.point.free[k];
            let coordinate = parameter.bounded(free);
            let error = covariance
                .standard_error(k)
                .map(|error| error * parameter.bounded_slope(free));
            let wanted = match &self.options.profiles {
                Profiles::All => true,
                Profiles::Of(names) => names.iter().any(|name| name == parameter.name()),
                Profiles::None => false,
            };
            let interval = if wanted {
                match profiler.interval(k)? {
                    Outcome::Interval(interval) => interval,
                    Outcome::Better(point) => return Ok(Described::Better(point)),
                }
            } else {
                let reach = error.map(|error| error * quantile(0.5 * tail, degrees_of_freedom));
                symmetric(parameter, coordinate, reach)
            };
            let value = |coordinate: f64| parameter.value(coordinate);
            let ends = Interval {
                lower: interval.lower.map(value),
                upper: interval.upper.map(value),
            };
            estimates[k] = Some(Estimate {
                name: parameter.name().to_owned(),
                value: value(coordinate),
                standard_error: error.map(|error| error * parameter.value_slope(coordinate)),
                interval: ends,
                identifiable: ends.is_closed(),
                profile: interval
                    .curve
                    .iter()
                    .filter(|(_, rise)| rise.is_finite())
                    .map(|&(s, rise)| (value(s), rise))
                    .collect(),
            });
        }
        let estimates = estimates.into_iter().flatten().collect();
        Ok(Described::Estimates(estimates, covariance))
    }

    fn answer(
        &self,
        search: &Search<'_>,
        optimum: &Optimum,
        estimates: Vec<Estimate>,
        covariance: &Covariance,
        mut warnings: Vec<Warning>,
    ) -> Fit {
        let data = self.observations.len();
        let standardised = &optimum.point.residuals;
        let residuals: Vec<f64> = standardised
            .iter()
            .zip(search.evaluator.sigmas)
            .map(|(r, sigma)| -r * sigma)
            .collect();
        let square: f64 = residuals.iter().map(|r| r * r).sum();
        let mean = self.observations.iter().sum::<f64>() / data as f64;
        let variation: f64 = self.observations.iter().map(|y| (y - mean).powi(2)).sum();
        let weights: Vec<f64> = standardised
            .iter()
            .take(data)
            .map(|r| self.options.loss.weight(r / optimum.deviance.spread))
            .collect();
        let count = self.parameters.len();
        let correlation: Vec<Vec<Option<f64>>> = (0..count)
            .map(|i| (0..count).map(|j| covariance.correlation(i, j)).collect())
            .collect();
        let degrees_of_freedom = self.freedom(optimum);
        let noise_estimated = !search.known_noise || self.options.loss.is_robust();
        for (k, estimate) in estimates.iter().enumerate() {
            if !estimate.identifiable {
                warnings.push(Warning::NotIdentifiable {
                    name: estimate.name.clone(),
                    interval: estimate.interval,
                });
            } else if optimum.point.free[k].abs() >= FARTHEST {
                warnings.push(Warning::AtBound {
                    name: estimate.name.clone(),
                    value: estimate.value,
                });
            }
            for (other, correlation) in estimates.iter().zip(&correlation[k]).take(k) {
                if let Some(correlation) = correlation.filter(|c| c.abs() > CORRELATED) {
                    warnings.push(Warning::Correlated {
                        first: other.name.clone(),
                        second: estimate.name.clone(),
                        correlation,
                    });
                }
            }
        }
        let indices: Vec<usize> = (0..data).filter(|&i| weights[i] < OUTLIER).collect();
        if !indices.is_empty() {
            warnings.push(Warning::Outliers { indices });
        }
        if optimum.offset > ROUGH {
            warnings.push(Warning::Rough {
                offset: optimum.offset,
            });
        }
        if noise_estimated && degrees_of_freedom < FEW {
            warnings.push(Warning::FewObservations { degrees_of_freedom });
        }
        Fit {
            estimates,
            correlation,
            fitted: self
                .observations
                .iter()
                .zip(&residuals)
                .map(|(y, r)| y - r)
                .collect(),
            residual_rms: (square / data as f64).sqrt(),
            r_squared: (variation > 0.0).then(|| 1.0 - square / variation),
            residuals,
            weights,
            noise: if noise_estimated {
                optimum.deviance.noise(standardised)
            } else {
                1.0
            },
            degrees_of_freedom,
            noise_estimated,
            deviance: optimum.value(),
            evaluations: search.evaluator.count(),
            iterations: optimum.iterations,
            warnings,
            free: optimum.point.free.iter().copied().collect(),
            jacobian: optimum.jacobian.clone(),
            curvatures: optimum
                .deviance
                .curvatures(standardised)
                .iter()
                .zip(search.evaluator.sigmas)
                .map(|(curvature, sigma)| curvature / sigma)
                .collect(),
            covariance: covariance.matrix.clone(),
        }
    }
}

enum Described {
    Estimates(Vec<Estimate>, Covariance),
    Better(crate::search::Point),
}

/// A start and nothing else.
fn start_only(options: &Options) -> bool {
    options.start.is_some() && options.scan == Some(0)
}

/// The interval of so many standard errors to either side; open where it would leave the bounds.
fn symmetric(parameter: &Parameter, coordinate: f64, reach: Option<f64>) -> ProfileInterval {
    let [lowest, highest] = [-FARTHEST, FARTHEST].map(|free| parameter.bounded(free));
    let end = |sign: f64| {
        reach
            .map(|reach| coordinate + sign * reach)
            .filter(|end| (lowest..=highest).contains(end))
    };
    ProfileInterval {
        lower: end(-1.0),
        upper: end(1.0),
        curve: Vec::new(),
    }
}
