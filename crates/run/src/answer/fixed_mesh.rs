//! What a run has shown of its mesh and its jumps.

use super::differences::Shares;

/// What a run has shown of its mesh, for others that differ from it little.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FixedMesh {
    /// Error of the mesh.
    pub error: Shares,
    /// Jumps that were good enough, and what they leave wrong.
    pub jumps: Option<(JumpSize, Shares)>,
}

/// How large jumps are.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct JumpSize {
    /// Error of a single jump.
    pub tolerance: f64,
    /// Periods simulated at the start, and length of the first jump relative to them.
    pub first_periods: u64,
    pub first_jump: f64,
}
