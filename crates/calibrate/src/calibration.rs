//! What is given: a model, its parameters, and the observations that they are fitted to.

use std::iter::zip;

use crate::{CalibrationError, Emulator, Loss, Model, Parameter, Prior};

/// Bounds of a coefficient of the discrepancy, in its standard deviations.
const FARTHEST: f64 = 10.0;
/// Minimum noise of the model itself, as a share of its predictions: what an emulator resolves.
const RESOLUTION: f64 = 1e-7;

/// A model to be fitted to observations.
#[derive(Debug, Clone)]
pub struct Calibration<'a> {
    pub(crate) model: &'a dyn Model,
    /// Those asked for, and while a discrepancy is fitted its coefficients.
    pub(crate) parameters: Vec<Parameter>,
    /// How many are asked for.
    pub(crate) asked: usize,
    pub(crate) observations: Vec<f64>,
    /// 1 where the noise is to be estimated.
    pub(crate) sigmas: Vec<f64>,
    pub(crate) knows_noise: bool,
    pub(crate) loss: Loss,
    pub(crate) relative_noise: f64,
    pub(crate) has_profiles: bool,
    /// What is known of the model beforehand.
    pub(crate) emulator: Option<Emulator>,
    /// Coefficients of the functions by which the model may be off.
    pub(crate) discrepancy: Vec<Parameter>,
}

impl<'a> Calibration<'a> {
    /// Fits `parameters` of `model` to `observations`, whose noise is the same for all and is estimated
    /// from the residuals.
    ///
    /// # Errors
    ///
    /// [`CalibrationError::Invalid`] for an observation that is no number, a column of another length, and
    /// two parameters of one name.
    pub fn new(
        model: &'a dyn Model,
        parameters: Vec<Parameter>,
        observations: Vec<f64>,
    ) -> Result<Self, CalibrationError> {
        for parameter in &parameters {
            let name = parameter.name();
            let count = parameters.iter().filter(|other| other.name() == name).count();
            if count > 1 {
                let what = format!("number of parameters called {name}");
                return Err(CalibrationError::invalid(what, count as f64, "one"));
            }
            if let Some(column) = parameter.column() {
                let what = format!("entries in the column of {name}");
                CalibrationError::check_count(&what, column.len(), observations.len())?;
            }
        }
        check_each("value", &observations, "finite", f64::is_finite)?;
        Ok(Self {
            model,
            asked: parameters.len(),
            parameters,
            sigmas: vec![1.0; observations.len()],
            observations,
            knows_noise: false,
            loss: Loss::Squares,
            relative_noise: 1e-9,
            has_profiles: true,
            emulator: None,
            discrepancy: Vec::new(),
        })
    }

    /// The model may be off by a sum of these functions of the observations, in their unit, each times a
    /// coefficient of its own that is normally distributed about 0 with variance 1: by a Gaussian process
    /// whose covariance is Σ f fᵀ, such as that of [`smooth_functions`](crate::smooth_functions) (M. C.
    /// Kennedy, A. O'Hagan, "Bayesian calibration of computer models", Journal of the Royal Statistical
    /// Society B 63, 2001). Its size is given, not fitted: few independent values of a smooth error are seen
    /// in a series, so that observations hardly tell it. No interval becomes narrower by it.
    ///
    /// # Errors
    ///
    /// [`CalibrationError::Invalid`] unless each function has a finite value for each observation.
    pub fn with_discrepancy(mut self, functions: &[Vec<f64>]) -> Result<Self, CalibrationError> {
        let prior = Prior {
            value: 0.0,
            sigma: 1.0,
        };
        self.discrepancy.clear();
        for function in functions {
            let count = self.observations.len();
            CalibrationError::check_count("values of a function", function.len(), count)?;
            let term = Parameter::term("discrepancy", -FARTHEST, FARTHEST, function)?;
            self.discrepancy.push(term.with_prior(prior)?);
        }
        Ok(self)
    }

    /// The standard deviation of each observation is known.
    ///
    /// # Errors
    ///
    /// [`CalibrationError::Invalid`] unless there is a finite and positive one for each observation.
    pub fn with_sigmas(mut self, sigmas: Vec<f64>) -> Result<Self, CalibrationError> {
        CalibrationError::check_count("sigmas", sigmas.len(), self.observations.len())?;
        let is_sigma = |sigma: f64| sigma.is_finite() && sigma > 0.0;
        check_each("sigma", &sigmas, "finite and positive", is_sigma)?;
        (self.sigmas, self.knows_noise) = (sigmas, true);
        Ok(self)
    }

    /// The standard deviations of the observations are known but for a factor that all share, which is
    /// fitted.
    ///
    /// # Errors
    ///
    /// As for [`with_sigmas`](Self::with_sigmas).
    pub fn with_relative_sigmas(self, sigmas: Vec<f64>) -> Result<Self, CalibrationError> {
        let mut known = self.with_sigmas(sigmas)?;
        known.knows_noise = false;
        Ok(known)
    }

    /// How much residuals count; least squares if left out.
    #[must_use]
    pub fn with_loss(self, loss: Loss) -> Self {
        Self { loss, ..self }
    }

    /// Noise of the model's predictions as a share of them: rounding, or the ripple of a mesh; 1e-9 if left
    /// out.
    ///
    /// # Errors
    ///
    /// [`CalibrationError::Invalid`] unless it is between 0 and 0.1.
    pub fn with_relative_noise(self, relative_noise: f64) -> Result<Self, CalibrationError> {
        if !(0.0..=0.1).contains(&relative_noise) {
            let (what, allowed) = ("relative noise of the model", "between 0 and 0.1");
            return Err(CalibrationError::invalid(what, relative_noise, allowed));
        }
        Ok(Self {
            relative_noise,
            ..self
        })
    }

    /// The same without profiles: all intervals stay open, and a fit takes fewer runs.
    #[must_use]
    pub fn without_profiles(self) -> Self {
        Self {
            has_profiles: false,
            ..self
        }
    }

    /// What an earlier fit of the same parameters learned of the same model, to other observations or with
    /// other terms: this one begins with its runs.
    #[must_use]
    pub fn with_emulator(mut self, emulator: Emulator) -> Self {
        self.emulator = Some(emulator);
        self
    }

    /// Refuses too few observations: priors count as one; noise to be estimated needs one more, and at least
    /// two of the data.
    pub(crate) fn check(&self) -> Result<(), CalibrationError> {
        let (observations, parameters) = (self.observations.len(), self.parameters.len());
        let unknown = parameters - self.priors();
        let needed = if self.knows_noise {
            unknown.max(1)
        } else {
            (unknown + 1).max(2)
        };
        if parameters > 0 && observations >= needed {
            return Ok(());
        }
        let allowed = format!(
            "{needed} or more to determine {parameters} parameters: one more than parameters without prior knowledge \
             if the noise is to be estimated as well"
        );
        Err(CalibrationError::invalid(
            "number of observations",
            observations as f64,
            allowed,
        ))
    }

    /// The indices of the parameters that the model takes.
    pub(crate) fn of_model(&self) -> Vec<usize> {
        let of_model = |&k: &usize| self.parameters[k].column().is_none();
        (0..self.parameters.len()).filter(of_model).collect()
    }

    /// Number of parameters with prior knowledge.
    pub(crate) fn priors(&self) -> usize {
        self.parameters.iter().filter(|p| p.prior.is_some()).count()
    }

    /// Noise of each prediction of the model itself, in units of the sigmas.
    pub(crate) fn model_noise(&self) -> impl Iterator<Item = f64> {
        let share = self.relative_noise.max(RESOLUTION);
        zip(&self.observations, &self.sigmas).map(move |(value, sigma)| share * value.abs() / sigma)
    }
}

/// Refuses a value for an observation that does not hold.
fn check_each(
    quantity: &str,
    values: &[f64],
    allowed: &'static str,
    holds: impl Fn(f64) -> bool,
) -> Result<(), CalibrationError> {
    match values.iter().position(|&value| !holds(value)) {
        None => Ok(()),
        Some(index) => {
            let what = format!("{quantity} of observation {index}");
            Err(CalibrationError::invalid(what, values[index], allowed))
        }
    }
}
