//! What can go wrong in jumps.

use cable_dem::CableError;

/// Error of a run with jumps.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum JumpError {
    /// The cable could not be computed.
    #[error(transparent)]
    Cable(#[from] CableError),
    /// A value that has no meaning.
    #[error("{name} must be {allowed}")]
    InvalidParameter {
        /// What it is.
        name: &'static str,
        /// What it may be.
        allowed: &'static str,
    },
    /// No day repeats the one before.
    #[error(
        "after {days} days of heat and traffic they still differ from day to day; later days cannot be predicted"
    )]
    NeverPeriodic {
        /// Days done.
        days: u64,
    },
    /// Jumps make no progress.
    #[error(
        "jumps make no progress: {simulated} passes simulated for {periods} of {wanted} periods of traffic"
    )]
    Stuck {
        /// Periods done.
        periods: u64,
        /// Periods wanted.
        wanted: u64,
        /// Passes simulated.
        simulated: u64,
    },
}

/// The cable's error as that of a caller.
pub(crate) fn wrap<E: From<JumpError>>(error: CableError) -> E {
    JumpError::from(error).into()
}

/// # Errors
///
/// [`JumpError::InvalidParameter`] unless `is_valid`.
pub(crate) fn check(name: &'static str, is_valid: bool, allowed: &'static str) -> Result<(), JumpError> {
    let error = JumpError::InvalidParameter { name, allowed };
    if is_valid { Ok(()) } else { Err(error) }
}
