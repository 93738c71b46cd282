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
    /// No day becomes like the one before.
    #[error(
        "after {days} days of heat and traffic they still differ from day to day: nothing can be said of later ones"
    )]
    NeverPeriodic {
        /// Days done.
        days: u64,
    },
    /// The jumps do not get on.
    #[error(
        "after {periods} of {wanted} periods of the traffic {simulated} passes are simulated, and jumps are no longer than at the start"
    )]
    Stuck {
        /// Periods done.
        periods: u64,
        /// Periods asked.
        wanted: u64,
        /// Passes simulated.
        simulated: u64,
    },
    /// A wanted pass lies on no day that was lived.
    #[error("pass {pass} follows from no pass that was simulated")]
    UnknownPass {
        /// Number of the pass.
        pass: u64,
    },
}

/// The cable's error as that of a caller.
pub(crate) fn wrap<E: From<JumpError>>(error: CableError) -> E {
    JumpError::from(error).into()
}
