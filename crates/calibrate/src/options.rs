//! How to fit.

use crate::observer::Observer;
use crate::{CalibrationError, Loss};

/// What the intervals are.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[non_exhaustive]
pub enum Profiles {
    /// Profiles of the likelihood.
    #[default]
    All,
    /// Symmetric in each parameter's coordinate: a rough answer for few model runs.
    None,
}

/// How to fit.
///
/// ```
/// use calibrate::{Loss, Options};
///
/// let mut options = Options::default();
/// options.loss = Loss::TUKEY;
/// options.confidence = 0.9;
/// ```
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Options {
    /// How much residuals count.
    pub loss: Loss,
    /// Values to try first.
    pub start: Option<Vec<f64>>,
    /// Points all over the range that are tried beside the start; `None` takes eight a parameter and eight more.
    pub scan: Option<usize>,
    /// Largest number of model runs.
    pub max_evaluations: usize,
    /// Noise of the model's predictions as a share of them: rounding, or the ripple of a mesh. It sets the step of derivatives.
    pub relative_noise: f64,
    /// Distance to the minimum, in standard errors, at which a fit has converged.
    pub tolerance: f64,
    /// Probability that an interval holds the true value.
    pub confidence: f64,
    /// What the intervals are.
    pub profiles: Profiles,
    /// Called after each iteration.
    pub observer: Option<Observer>,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            loss: Loss::Squares,
            start: None,
            scan: None,
            max_evaluations: 2000,
            relative_noise: 1e-9,
            tolerance: 0.02,
            confidence: 0.95,
            profiles: Profiles::All,
            observer: None,
        }
    }
}

impl Options {
    pub(crate) fn check(&self, parameters: usize) -> Result<(), CalibrationError> {
        let check = |name, value: f64, allowed, good: bool| {
            if good {
                Ok(())
            } else {
                Err(CalibrationError::InvalidOption { name, value, allowed })
            }
        };
        let (confidence, noise) = (self.confidence, self.relative_noise);
        let allowed = "between 0.5 and 0.9999";
        check(
            "confidence",
            confidence,
            allowed,
            (0.5..=0.9999).contains(&confidence),
        )?;
        let tolerance = self.tolerance;
        let allowed = "above 0, at most 0.5";
        check(
            "tolerance",
            tolerance,
            allowed,
            tolerance > 0.0 && tolerance <= 0.5,
        )?;
        let allowed = "between 0 and 0.1";
        check("relative_noise", noise, allowed, (0.0..=0.1).contains(&noise))?;
        if let Some(threshold) = self.loss.threshold() {
            let good = threshold.is_finite() && threshold >= 0.5;
            check(
                "threshold of the loss",
                threshold,
                "finite and at least 0.5",
                good,
            )?;
        }
        if let Some(start) = &self.start {
            let found = start.len();
            let allowed = "one value a parameter";
            check(
                "number of start values",
                found as f64,
                allowed,
                found == parameters,
            )?;
            for &value in start {
                check("start value", value, "finite", value.is_finite())?;
            }
        }
        let runs = self.max_evaluations;
        check("max_evaluations", runs as f64, "at least 1", runs > 0)
    }
}
