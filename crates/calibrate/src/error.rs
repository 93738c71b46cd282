//! What can go wrong in a calibration.

use std::borrow::Cow;

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
        allowed: Cow<'static, str>,
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
}

impl CalibrationError {
    pub(crate) fn invalid(
        what: impl Into<String>,
        value: f64,
        allowed: impl Into<Cow<'static, str>>,
    ) -> Self {
        let (what, allowed) = (what.into(), allowed.into());
        Self::Invalid { what, value, allowed }
    }

    /// Refuses another number of things than of observations.
    pub(crate) fn check_count(what: &str, found: usize, observations: usize) -> Result<(), Self> {
        if found == observations {
            return Ok(());
        }
        let (what, allowed) = (format!("number of {what}"), "one for each observation");
        Err(Self::invalid(what, found as f64, allowed))
    }

    /// Whether the input is at fault, not the computation.
    pub fn is_bad_input(&self) -> bool {
        matches!(self, Self::Invalid { .. })
    }
}
