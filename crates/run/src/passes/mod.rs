//! The passes of a plan on one mesh: every one simulated, or few with jumps between them.

mod listing;
mod options;
mod simulation;
mod solver;
mod task;

pub use listing::{listed_passes, mean, record_of};
pub use options::{FixedMesh, JumpSize, Jumping, KnownJumps, RunOptions};
pub use simulation::{Passes, Simulation};
pub use solver::PassSolver;
pub use task::Task;
