//! How to fit.

use crate::{CalibrationError, Loss};

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
    /// Whether intervals are those of the profile likelihood; without, they are symmetric in each
    /// parameter's coordinate: a rough answer for few model runs.
    pub profiles: bool,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            loss: Loss::Squares,
            max_evaluations: 2000,
            relative_noise: 1e-9,
            confidence: 0.95,
            profiles: true,
        }
    }
}

impl Options {
    pub(crate) fn check(&self) -> Result<(), CalibrationError> {
        let invalid = |what: &str, value, allowed| Err(CalibrationError::invalid(what, value, allowed));
        if !(0.5..=0.9999).contains(&self.confidence) {
            return invalid(
                "confidence of the intervals",
                self.confidence,
                "between 0.5 and 0.9999",
            );
        }
        if !(0.0..=0.1).contains(&self.relative_noise) {
            return invalid(
                "relative noise of the model",
                self.relative_noise,
                "between 0 and 0.1",
            );
        }
        if let Loss::Tukey { threshold } = self.loss
            && !(threshold.is_finite() && threshold >= 0.5)
        {
            return invalid("threshold of the loss", threshold, "finite and at least 0.5");
        }
        if self.max_evaluations == 0 {
            return invalid("largest number of model runs", 0.0, "at least 1");
        }
        Ok(())
    }
}
