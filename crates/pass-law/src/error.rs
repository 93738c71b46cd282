//! What can go wrong in the law of many passes.

use cable_dem::CableError;

/// Error of the law or of its evolution.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum LawError {
    /// A parameter is outside its range, or not a number.
    #[error("{name} = {value}: must be {allowed}")]
    InvalidParameter {
        /// The parameter's name.
        name: &'static str,
        /// What was given.
        value: f64,
        /// The allowed range, in words.
        allowed: &'static str,
    },
    /// The cable solver failed in a cell or in a run at an end.
    #[error(transparent)]
    Cable(#[from] CableError),
    /// The advance of a cell has not settled along its length: the vehicle's effect reaches too far.
    #[error(
        "at a locked friction of {share:.3} of the limit the advance still changes by {change:.1e} m along a cell of {length:.0} m"
    )]
    CellUnsettled {
        /// Locked friction as a share of the limit q.
        share: f64,
        /// Estimated error of the advance \[m\].
        change: f64,
        /// Length of the cell \[m\].
        length: f64,
    },
    /// Friction is so small that a vehicle's effect reaches farther than cells are made for.
    #[error(
        "friction is so small that a vehicle's effect reaches {length:.1} m along the cable; the pass law needs less than {most:.1} m"
    )]
    FarReaching {
        /// √(EA D_l/q) \[m\].
        length: f64,
        /// Longest one allowed \[m\].
        most: f64,
    },
    /// The run at an end did not become steady.
    #[error("the run near an end still changes by {change:.1e} N a pass after {passes} passes")]
    EndUnsettled {
        /// Change of the end's force per pass \[N\].
        change: f64,
        /// Passes made.
        passes: usize,
    },
    /// The evolution found no answer even with the smallest step.
    #[error("no convergence at pass {pass:.0} with a step of {step:.1e} passes")]
    NoConvergence {
        /// Passes so far.
        pass: f64,
        /// Step \[passes\].
        step: f64,
    },
}

/// `value` if it is a number for which `holds`, or the error that says what is allowed.
pub(crate) fn checked(
    name: &'static str,
    value: f64,
    allowed: &'static str,
    holds: impl Fn(f64) -> bool,
) -> Result<f64, LawError> {
    if value.is_finite() && holds(value) {
        Ok(value)
    } else {
        Err(LawError::InvalidParameter { name, value, allowed })
    }
}
