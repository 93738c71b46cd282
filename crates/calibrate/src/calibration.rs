//! The front door: a calibration is put together, then fitted.

use std::fmt;
use std::sync::Arc;

use crate::learning::Learner;
use crate::problem::Problem;
use crate::{CalibrationError, Discrepancy, Emulator, Fit, Model, Options, Parameter};

/// A model to be fitted to observations.
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
    /// Fits `parameters` of `model` to `observations`, whose noise is the same for all and is estimated
    /// from the residuals.
    ///
    /// # Errors
    ///
    /// [`CalibrationError::DuplicateParameter`], and [`CalibrationError::Invalid`] for an observation that is
    /// no number and a column of another length.
    pub fn new(
        model: &'a dyn Model,
        parameters: Vec<Parameter>,
        observations: Vec<f64>,
    ) -> Result<Self, CalibrationError> {
        for (index, parameter) in parameters.iter().enumerate() {
            let name = parameter.name().to_owned();
            if parameters[..index].iter().any(|other| other.name() == name) {
                return Err(CalibrationError::DuplicateParameter { name });
            }
            let entries = parameter.column().map_or(observations.len(), <[f64]>::len);
            if entries != observations.len() {
                let what = format!("length of its column of parameter {name}");
                let allowed = "an entry for each observation";
                return Err(CalibrationError::invalid(what, entries as f64, allowed));
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
    /// [`CalibrationError::Invalid`] for one of another number of observations.
    pub fn with_discrepancy(mut self, discrepancy: Discrepancy) -> Result<Self, CalibrationError> {
        if discrepancy.count() != self.0.observations.len() {
            let (what, count) = ("number of observations of the discrepancy", discrepancy.count());
            return Err(CalibrationError::invalid(
                what,
                count as f64,
                "as many as there are",
            ));
        }
        self.0.discrepancy = Some(discrepancy);
        Ok(self)
    }

    /// The standard deviation of each observation is known.
    ///
    /// # Errors
    ///
    /// [`CalibrationError::Invalid`] unless there is a finite and positive one for each observation.
    pub fn with_sigmas(mut self, sigmas: Vec<f64>) -> Result<Self, CalibrationError> {
        if sigmas.len() != self.0.observations.len() {
            let count = sigmas.len() as f64;
            return Err(CalibrationError::invalid(
                "number of sigmas",
                count,
                "one for each observation",
            ));
        }
        let positive = |s: f64| s.is_finite() && s > 0.0;
        check_each(&sigmas, "sigma", "finite and positive", positive)?;
        (self.0.sigmas, self.0.knows_noise) = (sigmas, true);
        Ok(self)
    }

    /// The standard deviations of the observations are known but for a factor that all share, which is
    /// fitted.
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
    /// [`CalibrationError::Invalid`].
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

    /// What an earlier fit of the same parameters and observations learned of a coarser model: this one
    /// runs first where the answer of that fit rests, and learns what the coarser model misses.
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
    quantity: &str,
    allowed: &'static str,
    holds: impl Fn(f64) -> bool,
) -> Result<(), CalibrationError> {
    let Some(index) = values.iter().position(|&value| !holds(value)) else {
        return Ok(());
    };
    let what = format!("{quantity} of observation {index}");
    Err(CalibrationError::invalid(what, values[index], allowed))
}
