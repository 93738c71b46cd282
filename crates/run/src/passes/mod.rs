//! The passes of a plan on one mesh: every one simulated, or few with jumps between them.

mod draws;
mod jump_search;
mod listing;
mod on_meshes;
mod options;
mod own_order;
mod random_spread;
mod simulation;
mod solved;
mod solver;
mod task;

pub use listing::listed_passes;
pub use on_meshes::solve;
pub use options::{FixedMesh, RunOptions};
pub use simulation::{Jumping, Passes, Simulation, force_profile, seldom_passes};
pub use solved::Solved;
pub use task::Task;
