//! What can go wrong in a design.

use creepage_run::Error;

/// Error of a design.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum DesignError {
    /// A run of the scene failed.
    #[error(transparent)]
    Analysis(#[from] Error),
    /// A limit or a position that has no meaning.
    #[error("{name}: found {found}; allowed: {allowed}")]
    Invalid {
        /// What it is.
        name: &'static str,
        /// Its value.
        found: f64,
        /// What is allowed.
        allowed: &'static str,
    },
    /// The limits are kept in so many ranges of stiffness, between which they are not.
    #[error(
        "the limits are kept in {0} ranges of stiffness, between which they are not: there is no single one"
    )]
    NotMonotone(usize),
}

impl DesignError {
    /// Whether the input is at fault, not the computation.
    pub fn is_bad_input(&self) -> bool {
        match self {
            Self::Analysis(error) => error.is_bad_input(),
            error => matches!(error, Self::Invalid { .. }),
        }
    }
}
