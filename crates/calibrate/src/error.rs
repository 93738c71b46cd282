//! What can go wrong in a calibration.

use crate::ModelError;

/// Error of a calibration.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CalibrationError {
    /// Something that was given is out of its range.
    #[error("{what} is {value}; allowed: {allowed}")]
    Invalid {
        /// What was given.
        what: String,
        /// What was found.
        value: f64,
        /// What is allowed.
        allowed: &'static str,
    },
    /// Two parameters have one name.
    #[error("two parameters are called {name}")]
    DuplicateParameter {
        /// The name.
        name: String,
    },
    /// The observations cannot determine the parameters.
    #[error(
        "{observations} observations cannot determine {parameters} parameters; needed: {needed} (one more than \
         parameters without prior knowledge if the noise is to be estimated as well)"
    )]
    TooFewObservations {
        /// Number of observations.
        observations: usize,
        /// Number of parameters.
        parameters: usize,
        /// Fewest observations that would do.
        needed: usize,
    },
    /// The model predicts another number of observations than there are.
    #[error("the model predicts {found} observations; there are {expected}")]
    PredictionLength {
        /// Number of observations.
        expected: usize,
        /// Number of predictions.
        found: usize,
    },
    /// The model failed wherever it ran first.
    #[error("the model has no answer at any of {places} places all over the range")]
    NoAnswer {
        /// Number of places.
        places: usize,
        /// Why the last one failed.
        source: ModelError,
    },
    /// The fit did not converge.
    #[error(
        "the fit did not converge: the model jumps, or its predictions are noisier than they are said to be"
    )]
    NotConverged,
    /// The model runs that were allowed are spent.
    #[error("{limit} model runs are not enough")]
    EvaluationLimit {
        /// Largest number of model runs.
        limit: usize,
    },
}

impl CalibrationError {
    pub(crate) fn invalid(what: impl Into<String>, value: f64, allowed: &'static str) -> Self {
        let what = what.into();
        Self::Invalid { what, value, allowed }
    }

    /// Whether the input is at fault, not the computation.
    pub fn is_bad_input(&self) -> bool {
        !matches!(
            self,
            Self::NoAnswer { .. } | Self::NotConverged | Self::EvaluationLimit { .. }
        )
    }
}
