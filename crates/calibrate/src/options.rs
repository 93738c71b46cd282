//! How to fit.

use crate::Loss;

/// How to fit.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Options {
    /// How much residuals count.
    pub loss: Loss,
    /// Largest number of model runs, those included that the fit begins with; at least 1.
    pub max_evaluations: usize,
    /// Noise of the model's predictions as a share of them, 0 to 0.1: rounding, or the ripple of a mesh.
    pub relative_noise: f64,
    /// Whether profiles are computed; without them all intervals stay open, and a fit takes fewer runs.
    pub profiles: bool,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            loss: Loss::Squares,
            max_evaluations: 2000,
            relative_noise: 1e-9,
            profiles: true,
        }
    }
}
