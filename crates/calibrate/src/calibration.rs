//! A calibration: model, parameters, observations and options.

use std::fmt;
use std::sync::Arc;

use nalgebra::DVector;

use crate::whitening::Whitening;
use crate::{CalibrationError, Discrepancy, Loss, Model, Options, Parameter, Part};

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
    pub(crate) model: &'a dyn Model,
    pub(crate) parameters: Vec<Parameter>,
    pub(crate) observations: Vec<f64>,
    /// 1 where the noise is to be estimated.
    pub(crate) sigmas: Vec<f64>,
    pub(crate) knows_noise: bool,
    pub(crate) options: Options,
    pub(crate) discrepancy: Option<Discrepancy>,
    /// That of the noise that is being tried.
    pub(crate) whitening: Option<Arc<Whitening>>,
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
        for parameter in &parameters {
            if let Some(column) = parameter
                .column()
                .filter(|column| column.len() != observations.len())
            {
                return Err(CalibrationError::InvalidParameter {
                    name: parameter.name().to_owned(),
                    quantity: "length of its column",
                    value: column.len() as f64,
                    allowed: "an entry for each observation",
                });
            }
        }
        check_each(&observations, "value", "finite", f64::is_finite)?;
        Ok(Self {
            model,
            parameters,
            sigmas: vec![1.0; observations.len()],
            observations,
            knows_noise: false,
            options: Options::default(),
            discrepancy: None,
            whitening: None,
        })
    }

    /// The model may be off by a smooth function of the observations, of given size.
    ///
    /// # Errors
    ///
    /// [`CalibrationError::InvalidOption`] for one of another number of observations.
    pub fn with_discrepancy(mut self, discrepancy: Discrepancy) -> Result<Self, CalibrationError> {
        if discrepancy.count() != self.observations.len() {
            return Err(CalibrationError::InvalidOption {
                name: "observations of the discrepancy",
                value: discrepancy.count() as f64,
                allowed: "as many as there are",
            });
        }
        self.discrepancy = Some(discrepancy);
        Ok(self)
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
        let positive = |s: f64| s.is_finite() && s > 0.0;
        check_each(&sigmas, "sigma", "finite and positive", positive)?;
        (self.sigmas, self.knows_noise) = (sigmas, true);
        Ok(self)
    }

    /// The standard deviations of the observations are known but for a factor that all share, which is fitted.
    ///
    /// # Errors
    ///
    /// As for [`with_sigmas`](Self::with_sigmas).
    pub fn with_relative_sigmas(self, sigmas: Vec<f64>) -> Result<Self, CalibrationError> {
        let calibration = self.with_sigmas(sigmas)?;
        Ok(Self {
            knows_noise: false,
            ..calibration
        })
    }

    /// The same calibration, scanned all over the range beside its start.
    #[must_use]
    pub fn scanned(mut self) -> Self {
        self.options.scan = None;
        self
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

    /// Noise that the model's predictions have at least, in units of the sigmas.
    pub(crate) fn least_noise(&self) -> f64 {
        let share = self.options.relative_noise.max(ROUNDING);
        let sizes = self.observations.iter().zip(&self.sigmas);
        let noise = sizes.map(|(value, sigma)| share * value.abs() / sigma);
        noise.fold(f64::MIN_POSITIVE, f64::max)
    }

    /// Number of parameters with prior knowledge.
    pub(crate) fn priors(&self) -> usize {
        self.parameters.iter().filter(|p| p.prior().is_some()).count()
    }

    pub(crate) fn scan(&self) -> usize {
        self.options.scan.unwrap_or(SCAN * (1 + self.of_model().len()))
    }

    /// What acts on which predictions: by default every parameter of the model on all.
    pub(crate) fn parts(&self) -> Result<Vec<Part>, CalibrationError> {
        let (observations, parameters) = (self.observations.len(), self.of_model().len());
        let parts = self.model.parts();
        if parts.is_empty() {
            return Ok(vec![Part {
                predictions: observations,
                parameters: (0..parameters).collect(),
            }]);
        }
        let predictions: usize = parts.iter().map(|part| part.predictions).sum();
        if predictions != observations {
            return Err(CalibrationError::InvalidOption {
                name: "predictions of the model's parts",
                value: predictions as f64,
                allowed: "as many as there are observations",
            });
        }
        let indices = || parts.iter().flat_map(|part| &part.parameters);
        if let Some(&index) = indices().find(|&&index| index >= parameters) {
            return Err(CalibrationError::InvalidOption {
                name: "index of a parameter of the model's parts",
                value: index as f64,
                allowed: "below the number of the model's parameters",
            });
        }
        Ok(parts)
    }

    /// Indices of the parameters that the model takes.
    pub(crate) fn of_model(&self) -> Vec<usize> {
        let of_model = |&k: &usize| self.parameters[k].column().is_none();
        (0..self.parameters.len()).filter(of_model).collect()
    }

    /// Priors count as observations; noise to be estimated needs one more, and at least two of the data.
    pub(crate) fn check_count(&self) -> Result<(), CalibrationError> {
        let (observations, parameters) = (self.observations.len(), self.parameters.len());
        let unknown = parameters - self.priors();
        let needed = if self.knows_noise {
            unknown.max(1)
        } else {
            (unknown + 1).max(2)
        };
        if parameters == 0 || observations < needed {
            return Err(CalibrationError::TooFewObservations {
                observations,
                parameters,
                needed,
            });
        }
        if self.discrepancy.is_some() && self.options.loss != Loss::Squares {
            return Err(CalibrationError::InvalidOption {
                name: "threshold of the loss",
                value: self.options.loss.threshold().unwrap_or(f64::NAN),
                allowed: "least squares beside a discrepancy",
            });
        }
        Ok(())
    }

    /// Free variables of the values to try first.
    pub(crate) fn start(&self) -> Option<DVector<f64>> {
        let free = |(parameter, &value): (&Parameter, &f64)| {
            let inside = value.clamp(parameter.lower(), parameter.upper());
            parameter.free(parameter.coordinate(inside))
        };
        let start = self.options.start.as_ref()?;
        Some(DVector::from_vec(
            self.parameters.iter().zip(start).map(free).collect(),
        ))
    }
}

fn check_each(
    values: &[f64],
    quantity: &'static str,
    allowed: &'static str,
    holds: impl Fn(f64) -> bool,
) -> Result<(), CalibrationError> {
    match values.iter().position(|&value| !holds(value)) {
        None => Ok(()),
        Some(index) => Err(CalibrationError::InvalidObservation {
            index,
            quantity,
            value: values[index],
            allowed,
        }),
    }
}
