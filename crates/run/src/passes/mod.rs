//! The passes of a plan on one mesh: every one simulated, or few with jumps between them.

mod listing;
mod simulation;
mod solver;
mod task;

pub use listing::mean;
pub use simulation::{Passes, Simulation};
pub use solver::PassSolver;
pub use task::{Jumping, RunOptions, Task};
