//! What is fitted: a map from parameters to predicted observations.

use std::fmt;

/// Why a model could not predict.
pub type ModelError = Box<dyn std::error::Error + Send + Sync>;

/// A model with parameters, such as a cable in a duct with an unknown friction coefficient.
///
/// Every function `Fn(&[f64]) -> Result<Vec<f64>, ModelError>` is one. Several series are fitted jointly
/// by one model that predicts them all, one after the other.
pub trait Model: Sync {
    /// Predicted observations, in the order of the observations, for `parameters` in their physical units
    /// and in the order in which they were given to the calibration.
    ///
    /// # Errors
    ///
    /// Where the model has no answer. A fit avoids such corners; it fails only if there is no answer at
    /// any of its first places.
    fn predict(&self, parameters: &[f64]) -> Result<Vec<f64>, ModelError>;

    /// Which parameters act on which predictions; nothing if all may act on all. Where each of several
    /// series has parameters of its own, the emulator follows each by itself, and takes fewer runs.
    fn parts(&self) -> Vec<Part> {
        Vec::new()
    }
}

impl fmt::Debug for dyn Model + '_ {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Model({:?})", self.parts())
    }
}

/// Predictions that follow one another, and what acts on them.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Part {
    /// How many predictions there are.
    pub predictions: usize,
    /// Indices of the parameters that act on them.
    pub parameters: Vec<usize>,
}

impl<F> Model for F
where
    F: Fn(&[f64]) -> Result<Vec<f64>, ModelError> + Sync,
{
    fn predict(&self, parameters: &[f64]) -> Result<Vec<f64>, ModelError> {
        self(parameters)
    }
}
