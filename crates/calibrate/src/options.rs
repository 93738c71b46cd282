//! How to fit.

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
    /// Largest number of model runs.
    pub max_evaluations: usize,
    /// Noise of the model's predictions as a share of them: rounding, or the ripple of a mesh.
    pub relative_noise: f64,
    /// Probability that an interval holds the true value.
    pub confidence: f64,
    /// What the intervals are.
    pub profiles: Profiles,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            loss: Loss::Squares,
            max_evaluations: 2000,
            relative_noise: 1e-9,
            confidence: 0.95,
            profiles: Profiles::All,
        }
    }
}

impl Options {
    pub(crate) fn check(&self) -> Result<(), CalibrationError> {
        let invalid = |name: &str, value, allowed| {
            Err(CalibrationError::invalid(
                format!("option {name}"),
                value,
                allowed,
            ))
        };
        if !(0.5..=0.9999).contains(&self.confidence) {
            return invalid("confidence", self.confidence, "between 0.5 and 0.9999");
        }
        if !(0.0..=0.1).contains(&self.relative_noise) {
            return invalid("relative_noise", self.relative_noise, "between 0 and 0.1");
        }
        if let Loss::Tukey { threshold } = self.loss
            && !(threshold.is_finite() && threshold >= 0.5)
        {
            return invalid("threshold of the loss", threshold, "finite and at least 0.5");
        }
        if self.max_evaluations == 0 {
            return invalid("max_evaluations", 0.0, "at least 1");
        }
        Ok(())
    }
}
