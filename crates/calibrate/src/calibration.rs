//! What is given, and the front door: a calibration is put together, then fitted.

use crate::learning;
use crate::problem::Problem;
use crate::{CalibrationError, Emulator, Estimate, Fit, Model, Options, Parameter, Prior};

/// Bounds of a coefficient of the discrepancy, in its standard deviations.
const FARTHEST: f64 = 10.0;

/// A model to be fitted to observations.
#[derive(Debug, Clone)]
pub struct Calibration<'a> {
    problem: Problem<'a>,
    /// Coefficients of the functions by which the model may be off.
    discrepancy: Vec<Parameter>,
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
            problem: Problem {
                model,
                asked: parameters.len(),
                parameters,
                sigmas: vec![1.0; observations.len()],
                observations,
                knows_noise: false,
                options: Options::default(),
                emulator: None,
            },
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
            let count = self.problem.observations.len();
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
        CalibrationError::check_count("sigmas", sigmas.len(), self.problem.observations.len())?;
        let is_sigma = |sigma: f64| sigma.is_finite() && sigma > 0.0;
        check_each("sigma", &sigmas, "finite and positive", is_sigma)?;
        (self.problem.sigmas, self.problem.knows_noise) = (sigmas, true);
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
        known.problem.knows_noise = false;
        Ok(known)
    }

    /// How to fit.
    ///
    /// # Errors
    ///
    /// [`CalibrationError::Invalid`].
    pub fn with_options(mut self, options: Options) -> Result<Self, CalibrationError> {
        let (noise, runs) = (options.relative_noise, options.max_evaluations);
        let invalid = |what: &str, value, allowed| Err(CalibrationError::invalid(what, value, allowed));
        if !(0.0..=0.1).contains(&noise) {
            return invalid("relative noise of the model", noise, "between 0 and 0.1");
        }
        if runs == 0 {
            return invalid("largest number of model runs", 0.0, "at least 1");
        }
        self.problem.options = options;
        Ok(self)
    }

    /// What an earlier fit of the same parameters learned of the same model, to other observations or with
    /// other terms: this one begins with its runs.
    #[must_use]
    pub fn with_emulator(mut self, emulator: Emulator) -> Self {
        self.problem.emulator = Some(emulator);
        self
    }

    /// Fits. The model runs a few times all over the range, then wherever the answer rests on it. What was
    /// learned of it, [`Fit::emulator`], serves other fits.
    ///
    /// # Errors
    ///
    /// [`CalibrationError`] if there are too few observations, the model has no answer anywhere, the fit
    /// does not converge or needs more model runs than allowed.
    pub fn fit(&self) -> Result<Fit, CalibrationError> {
        let problem = &self.problem;
        problem.check()?;
        let mut emulator = learning::begin(problem)?;
        let solution = learning::converge(problem, &mut emulator)?;
        let mut estimates = solution.estimates(problem);
        if self.discrepancy.is_empty() {
            return Ok(Fit::new(problem, emulator, solution, estimates));
        }
        let mut wider = problem.clone();
        wider.parameters.extend_from_slice(&self.discrepancy);
        let solution = learning::converge(&wider, &mut emulator)?;
        for (plain, estimate) in estimates.iter_mut().zip(solution.estimates(&wider)) {
            // A model that may be wrong knows no more than one that may not.
            let interval = estimate.interval.with(&plain.interval);
            *plain = Estimate {
                identifiable: interval.is_closed(),
                interval,
                ..estimate
            };
        }
        Ok(Fit::new(&wider, emulator, solution, estimates))
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
