//! One loop over meshes, whatever is simulated on them; what a finer mesh may cost; what an error means.

mod budget;
mod judge;
mod mesh_loop;

pub use budget::{MAX_NODE_UPDATES, REFINEMENT_COST};
pub use judge::{judge, mesh_reason};
pub use mesh_loop::{FINDING, MeshLoop, OnMeshes, Refined};
