//! What is given, and the front door: a calibration is put together, then fitted.

use std::fmt;
use std::sync::Arc;

use crate::learning;
use crate::{CalibrationError, Emulator, Fit, Model, Options, Parameter, Part, Prior};

/// Least noise of the model itself, as a share of its predictions: what an emulator resolves.
const RESOLUTION: f64 = 1e-7;
/// Bounds of a coefficient of the discrepancy, in its standard deviations.
const FARTHEST: f64 = 10.0;

/// A model to be fitted to observations.
#[derive(Clone)]
pub struct Calibration<'a> {
    pub(crate) model: &'a dyn Model,
    /// Those asked for, and in a fit with a discrepancy its coefficients.
    pub(crate) parameters: Vec<Parameter>,
    pub(crate) observations: Vec<f64>,
    /// 1 where the noise is to be estimated.
    pub(crate) sigmas: Vec<f64>,
    pub(crate) knows_noise: bool,
    pub(crate) options: Options,
    /// How many parameters are asked for.
    pub(crate) asked: usize,
    /// Coefficients of the functions by which the model may be off.
    discrepancy: Vec<Parameter>,
    pub(crate) coarse: Option<Arc<Emulator>>,
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
            check_count(
                &format!("entries in the column of {name}"),
                entries,
                observations.len(),
            )?;
        }
        check_each(&observations, "value", "finite", |_| true)?;
        Ok(Self {
            model,
            asked: parameters.len(),
            parameters,
            sigmas: vec![1.0; observations.len()],
            observations,
            knows_noise: false,
            options: Options::default(),
            discrepancy: Vec::new(),
            coarse: None,
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
            check_count("values of a function", function.len(), self.observations.len())?;
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
        check_count("sigmas", sigmas.len(), self.observations.len())?;
        check_each(&sigmas, "sigma", "finite and positive", |sigma| sigma > 0.0)?;
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
        let known = self.with_sigmas(sigmas)?;
        Ok(Self {
            knows_noise: false,
            ..known
        })
    }

    /// How to fit.
    ///
    /// # Errors
    ///
    /// [`CalibrationError::Invalid`].
    pub fn with_options(mut self, options: Options) -> Result<Self, CalibrationError> {
        options.check()?;
        self.options = options;
        Ok(self)
    }

    /// What an earlier fit of the same parameters and observations learned of a coarser model: this one
    /// runs first where the answer of that fit rests, and learns what the coarser model misses.
    #[must_use]
    pub fn with_coarse(mut self, coarse: Emulator) -> Self {
        self.coarse = Some(Arc::new(coarse));
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
    /// [`CalibrationError`] if there are too few observations, the model has no answer anywhere, the fit
    /// does not converge or needs more model runs than allowed.
    pub fn fit(&self) -> Result<Fit, CalibrationError> {
        self.check()?;
        let mut emulator = learning::begin(self)?;
        let mut solution = learning::converge(self, &mut emulator)?;
        if self.discrepancy.is_empty() {
            return Ok(Fit::new(self, emulator, solution));
        }
        let plain = solution.estimates;
        let mut wider = self.clone();
        wider.parameters.extend_from_slice(&self.discrepancy);
        solution = learning::converge(&wider, &mut emulator)?;
        for (estimate, plain) in solution.estimates.iter_mut().zip(&plain) {
            // A model that may be wrong knows no more than one that may not.
            estimate.interval = estimate.interval.with(&plain.interval);
            estimate.identifiable = estimate.interval.is_closed();
        }
        Ok(Fit::new(&wider, emulator, solution))
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
        let share = self.options.relative_noise.max(RESOLUTION);
        let sizes = self.observations.iter().zip(&self.sigmas);
        sizes.map(move |(value, sigma)| share * value.abs() / sigma)
    }

    /// What acts on which predictions: by default every parameter of the model on all.
    pub(crate) fn parts(&self) -> Result<Vec<Part>, CalibrationError> {
        let (observations, count) = (self.observations.len(), self.of_model().len());
        let mut parts = self.model.parts();
        if parts.is_empty() {
            parts.push(Part {
                predictions: observations,
                parameters: (0..count).collect(),
            });
        }
        let predictions = parts.iter().map(|part| part.predictions).sum();
        check_count("predictions of the model's parts", predictions, observations)?;
        let mut indices = parts.iter().flat_map(|part| &part.parameters);
        if let Some(&index) = indices.find(|&&index| index >= count) {
            let (what, allowed) = ("index of a parameter of a part", "below the number of parameters");
            return Err(CalibrationError::invalid(what, index as f64, allowed));
        }
        Ok(parts)
    }

    /// Priors count as observations; noise to be estimated needs one more, and at least two of the data.
    fn check(&self) -> Result<(), CalibrationError> {
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
        Ok(())
    }
}

fn check_count(what: &str, found: usize, wanted: usize) -> Result<(), CalibrationError> {
    if found == wanted {
        return Ok(());
    }
    let what = format!("number of {what}");
    Err(CalibrationError::invalid(
        what,
        found as f64,
        "one for each observation",
    ))
}

fn check_each(
    values: &[f64],
    quantity: &str,
    allowed: &'static str,
    holds: impl Fn(f64) -> bool,
) -> Result<(), CalibrationError> {
    let Some(index) = values
        .iter()
        .position(|&value| !(value.is_finite() && holds(value)))
    else {
        return Ok(());
    };
    let what = format!("{quantity} of observation {index}");
    Err(CalibrationError::invalid(what, values[index], allowed))
}
