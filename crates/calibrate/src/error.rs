//! What can go wrong in a calibration.

use crate::ModelError;

/// Error of a calibration.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CalibrationError {
    /// A parameter is not well defined.
    #[error("parameter {name}: {quantity} is {value}; allowed: {allowed}")]
    InvalidParameter {
        /// The parameter's name.
        name: String,
        /// What of it.
        quantity: &'static str,
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
    /// An option is out of its range.
    #[error("option {name} is {value}; allowed: {allowed}")]
    InvalidOption {
        /// The option.
        name: &'static str,
        /// What was found.
        value: f64,
        /// What is allowed.
        allowed: &'static str,
    },
    /// An observation is not a number, or its sigma is not positive.
    #[error("observation {index}: {quantity} is {value}; allowed: {allowed}")]
    InvalidObservation {
        /// Its index, from 0.
        index: usize,
        /// What of it.
        quantity: &'static str,
        /// What was found.
        value: f64,
        /// What is allowed.
        allowed: &'static str,
    },
    /// Sigmas and observations differ in number.
    #[error("there are {sigmas} sigmas for {observations} observations")]
    SigmaCount {
        /// Number of sigmas.
        sigmas: usize,
        /// Number of observations.
        observations: usize,
    },
    /// The observations cannot determine the parameters.
    #[error(
        "{observations} observations cannot determine {parameters} parameters; needed: {needed} (one more than parameters without prior \
         knowledge if the noise is to be estimated as well)"
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
    #[error("the fit did not converge: the model jumps, or is noisier than stated (relative_noise)")]
    NotConverged,
    /// The model runs that were allowed are spent.
    #[error("{limit} model runs are not enough")]
    EvaluationLimit {
        /// Largest number of model runs.
        limit: usize,
    },
    /// The optimiser failed for a reason of its own.
    #[error("the optimiser failed")]
    Optimiser {
        /// Why.
        source: Box<dyn std::error::Error + Send + Sync>,
    },
}

impl CalibrationError {
    /// Whether the input is at fault, not the computation.
    pub fn is_bad_input(&self) -> bool {
        matches!(
            self,
            Self::InvalidParameter { .. }
                | Self::DuplicateParameter { .. }
                | Self::InvalidOption { .. }
                | Self::InvalidObservation { .. }
                | Self::SigmaCount { .. }
                | Self::TooFewObservations { .. }
                | Self::PredictionLength { .. }
        )
    }
}
