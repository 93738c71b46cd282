//! What can go wrong.

/// Error of a chain or of a step on it.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ChainError {
    /// A property of the chain is outside its range, or not a number.
    #[error("{name} = {value:?}: must be {allowed}")]
    InvalidParameter {
        /// The property's name.
        name: &'static str,
        /// What was given.
        value: f64,
        /// The allowed range, in words.
        allowed: &'static str,
    },
    /// A step found no equilibrium within the friction bounds.
    #[error("no equilibrium: {violation:.1e} of the friction limit remains unbalanced")]
    NoEquilibrium {
        /// Largest violation of equilibrium or of the friction law, as a share of the friction limit.
        violation: f64,
    },
}
