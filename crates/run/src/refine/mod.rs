//! One loop over meshes, whatever is simulated on them; what a finer mesh may cost; what an error
//! means.

mod budget;
mod judge;
mod mesh_loop;

pub use judge::{judge, mesh_reason};
pub use mesh_loop::{MeshLoop, OnMeshes, Refined};
