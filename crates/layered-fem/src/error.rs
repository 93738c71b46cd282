//! What can go wrong inside the finite element solver.

/// Error of the finite element solver itself; a [`ground_field::GroundError::Model`] carries it to the caller.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FemError {
    /// An element has no positive area: lines of the mesh coincide in rounding.
    #[error("an element of the mesh has no positive area")]
    Degenerate,
    /// The mesh would need more unknowns than allowed.
    #[error("the mesh needs {needed} unknowns, {allowed} are allowed")]
    TooLarge {
        /// Unknowns of the mesh.
        needed: usize,
        /// Unknowns allowed.
        allowed: usize,
    },
    /// The stiffness matrix is not positive definite in floating-point arithmetic.
    #[error("the stiffness matrix is not positive definite")]
    Factorisation,
    /// The solution does not satisfy the equations: solving for what remains changes it.
    #[error("the residual changes the solution by {change:.1e} of itself, {allowed:.1e} is allowed")]
    Inaccurate {
        /// Largest change over the largest displacement.
        change: f64,
        /// The largest accepted.
        allowed: f64,
    },
}
