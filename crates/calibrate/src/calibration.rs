//! A calibration: model, parameters, observations and options.

use std::fmt;

use nalgebra::DVector;

use crate::evaluator::Evaluator;
use crate::{CalibrationError, Model, Options, Parameter};

/// Scanned points for each parameter and one more: 24 for two, of which the emulator learns as well.
const SCAN: usize = 8;
/// Least noise of the model itself, as a share of its largest prediction: rounding.
const ROUNDING: f64 = 1e-12;

/// A model to be fitted to observations.
///
/// ```
/// use calibrate::{Calibration, ModelError, Parameter, Scale};
///
/// // A line through the origin, measured at 1, 2, 3 and 4 with a standard deviation of 0.1.
/// let model = |p: &[f64]| -> Result<Vec<f64>, ModelError> { Ok([1.0, 2.0, 3.0, 4.0].map(|x| p[0] * x).to_vec()) };
/// let slope = Parameter::new("slope", 0.0, 10.0, Scale::Linear)?;
/// let calibration = Calibration::new(&model, vec![slope], vec![2.1, 3.9, 6.05, 7.95])?.with_sigmas(vec![0.1; 4])?;
/// let fit = calibration.fit()?;
/// assert!((fit.estimates[0].value - 2.0).abs() < 0.02);
/// # Ok::<(), calibrate::CalibrationError>(())
/// ```
#[derive(Clone)]
pub struct Calibration<'a> {
    model: &'a dyn Model,
    pub(crate) parameters: Vec<Parameter>,
    pub(crate) observations: Vec<f64>,
    sigmas: Option<Vec<f64>>,
    pub(crate) options: Options,
}

impl fmt::Debug for Calibration<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Calibration")
            .field("parameters", &self.parameters)
            .field("observations", &self.observations)
            .field("sigmas", &self.sigmas)
            .field("options", &self.options)
            .finish_non_exhaustive()
    }
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

    /// The model against the observations, for at most `limit` runs.
    pub(crate) fn evaluator<'e>(&'e self, units: &'e [f64], limit: usize) -> Evaluator<'e> {
        Evaluator::new(
            self.model,
            &self.parameters,
            &self.observations,
            units,
            self.options.relative_noise,
            limit,
        )
    }

    /// Points to scan.
    pub(crate) fn scan(&self) -> usize {
        self.options.scan.unwrap_or(SCAN * (1 + self.parameters.len()))
    }

    /// Priors count as observations; noise to be estimated needs one more, and at least two of the data.
    pub(crate) fn check_count(&self) -> Result<(), CalibrationError> {
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
}
