//! One loop over meshes, whatever is simulated on them, and what an error means.

mod judge;
mod mesh_loop;

pub use judge::judge;
pub use mesh_loop::{MeshLoop, OnMeshes, Solved, Work, on_coarse_level};
