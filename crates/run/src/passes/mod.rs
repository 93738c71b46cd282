//! The passes of a plan on one mesh: every one simulated, or few with jumps between them.

mod listing;
mod options;
mod simulation;
mod solver;
mod task;

pub use crate::answer::{FixedMesh, JumpSize, KnownJumps};
pub use listing::{listed_passes, mean, record_of};
pub use options::{Jumping, RunOptions};
pub use simulation::{Passes, Simulation};
pub use solver::PassSolver;
pub use task::Task;
