//! The passes of a plan on ever finer meshes: every one simulated, or few with jumps that are good
//! enough.

mod draws;
mod jump_search;
mod passes_on_meshes;
mod random_spread;

pub use passes_on_meshes::solve;
