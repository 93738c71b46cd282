//! What can go wrong inside the finite element solver.

/// Error of the finite element solver itself; a [`ground_field::GroundError::Model`] carries it to the caller.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FemError {
    /// An element has no positive area: its nodes are out of order or on one line.
    #[error(
        "element {element} has a Jacobian determinant of {determinant:.3e}: its nodes must run round a convex quadrilateral"
    )]
    Degenerate {
        /// Index of the element.
        element: usize,
        /// The Jacobian determinant that was not positive.
        determinant: f64,
    },
    /// An element names a node that does not exist, or has the wrong number of nodes.
    #[error("element {element} does not fit the mesh: {problem}")]
    Connectivity {
        /// Index of the element.
        element: usize,
        /// What does not fit.
        problem: &'static str,
    },
    /// A vector does not have one entry per degree of freedom.
    #[error("{name} has {given} entries where {expected} are needed")]
    Length {
        /// What was given.
        name: &'static str,
        /// Its length.
        given: usize,
        /// The length it must have.
        expected: usize,
    },
    /// The mesh would need more unknowns than allowed.
    #[error("the mesh needs {needed} unknowns, {allowed} are allowed")]
    TooLarge {
        /// Unknowns of the mesh.
        needed: usize,
        /// Unknowns allowed.
        allowed: usize,
    },
    /// The stiffness matrix is not positive definite in floating-point arithmetic.
    #[error("the stiffness matrix with {unknowns} unknowns could not be factored: {reason}")]
    Factorisation {
        /// Unknowns of the system.
        unknowns: usize,
        /// What the factorisation reports.
        reason: &'static str,
    },
    /// The solution does not satisfy the equations: solving for what remains changes it.
    #[error(
        "solving for the residual changes the solution by {change:.1e} of itself where {allowed:.1e} is allowed"
    )]
    Inaccurate {
        /// Largest change over the largest displacement.
        change: f64,
        /// The largest accepted.
        allowed: f64,
    },
}
