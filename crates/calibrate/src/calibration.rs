//! The front door: a calibration is put together, then fitted.

use std::fmt;
use std::sync::Arc;

use crate::learning::Learner;
use crate::problem::Problem;
use crate::{CalibrationError, Discrepancy, Emulator, Fit, Model, Options, Parameter};

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
pub struct Calibration<'a>(Problem<'a>);

impl fmt::Debug for Calibration<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Calibration")
            .field("parameters", &self.0.parameters)
            .field("observations", &self.0.observations)
            .field("sigmas", &self.0.sigmas)
            .field("options", &self.0.options)
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
        Ok(Self(Problem {
            model,
            parameters,
            sigmas: vec![1.0; observations.len()],
            observations,
            knows_noise: false,
            options: Options::default(),
            discrepancy: None,
            coarse: None,
        }))
    }

    /// The model may be off by a smooth function of the observations, of given size.
    ///
    /// # Errors
    ///
    /// [`CalibrationError::InvalidOption`] for one of another number of observations.
    pub fn with_discrepancy(mut self, discrepancy: Discrepancy) -> Result<Self, CalibrationError> {
        if discrepancy.count() != self.0.observations.len() {
            return Err(CalibrationError::InvalidOption {
                name: "observations of the discrepancy",
                value: discrepancy.count() as f64,
                allowed: "as many as there are",
            });
        }
        self.0.discrepancy = Some(discrepancy);
        Ok(self)
    }

    /// The standard deviation of each observation is known.
    ///
    /// # Errors
    ///
    /// [`CalibrationError::SigmaCount`], and [`CalibrationError::InvalidObservation`] unless every sigma is finite and positive.
    pub fn with_sigmas(mut self, sigmas: Vec<f64>) -> Result<Self, CalibrationError> {
        if sigmas.len() != self.0.observations.len() {
            return Err(CalibrationError::SigmaCount {
                sigmas: sigmas.len(),
                observations: self.0.observations.len(),
            });
        }
        let positive = |s: f64| s.is_finite() && s > 0.0;
        check_each(&sigmas, "sigma", "finite and positive", positive)?;
        (self.0.sigmas, self.0.knows_noise) = (sigmas, true);
        Ok(self)
    }

    /// The standard deviations of the observations are known but for a factor that all share, which is fitted.
    ///
    /// # Errors
    ///
    /// As for [`with_sigmas`](Self::with_sigmas).
    pub fn with_relative_sigmas(self, sigmas: Vec<f64>) -> Result<Self, CalibrationError> {
        let mut calibration = self.with_sigmas(sigmas)?;
        calibration.0.knows_noise = false;
        Ok(calibration)
    }

    /// How to fit.
    ///
    /// # Errors
    ///
    /// [`CalibrationError::InvalidOption`].
    pub fn with_options(mut self, options: Options) -> Result<Self, CalibrationError> {
        options.check()?;
        self.0.options = options;
        Ok(self)
    }

    /// The parameters.
    pub fn parameters(&self) -> &[Parameter] {
        &self.0.parameters
    }

    /// The observations.
    pub fn observations(&self) -> &[f64] {
        &self.0.observations
    }

    /// What an earlier fit of the same parameters and observations learned of a coarser model: this one runs
    /// first where the answer of that fit rests, and learns what the coarser model misses.
    #[must_use]
    pub fn with_coarse(mut self, coarse: Emulator) -> Self {
        self.0.coarse = Some(Arc::new(coarse));
        self
    }

    /// Fits. The model runs a few times all over the range, then wherever the answer rests on it.
    ///
    /// ```
    /// use calibrate::{Calibration, ModelError, Parameter, Scale};
    ///
    /// let passes = [5.0, 10.0, 20.0, 40.0, 80.0];
    /// let model = |p: &[f64]| -> Result<Vec<f64>, ModelError> {
    ///     Ok(passes.iter().map(|n: &f64| p[0] * (1.0 - (-n / p[1]).exp())).collect())
    /// };
    /// let parameters = vec![
    ///     Parameter::new("saturated_force", 100.0, 2000.0, Scale::Logarithmic)?,
    ///     Parameter::new("passes", 1.0, 1000.0, Scale::Logarithmic)?,
    /// ];
    /// let calibration = Calibration::new(&model, parameters, vec![124.0, 214.0, 351.0, 472.0, 541.0])?;
    /// let fit = calibration.fit()?;
    /// assert!(fit.estimates[0].interval.contains(550.0));
    /// // What was learned spares runs where the model becomes finer.
    /// let again = calibration.with_coarse(fit.emulator.clone()).fit()?;
    /// assert!(again.evaluations < fit.evaluations);
    /// # Ok::<(), calibrate::CalibrationError>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`CalibrationError`] where there are too few observations, the model has no answer anywhere, the fit
    /// does not converge or needs more model runs than allowed.
    pub fn fit(&self) -> Result<Fit, CalibrationError> {
        self.0.check()?;
        let plain = Problem {
            discrepancy: None,
            ..self.0.clone()
        };
        let mut learner = Learner::new(&plain)?;
        let (mut solution, mut whitening) = learner.converge()?;
        if self.0.discrepancy.is_some() {
            // A model that may be wrong knows no more than one that may not.
            let least: Vec<_> = solution
                .estimates
                .iter()
                .map(|estimate| estimate.interval)
                .collect();
            learner.problem = &self.0;
            (solution, whitening) = learner.converge()?;
            for (estimate, least) in solution.estimates.iter_mut().zip(least) {
                estimate.interval = estimate.interval.with(&least);
                estimate.identifiable = estimate.interval.is_closed();
            }
        }
        Ok(Fit::new(learner, solution, whitening))
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
