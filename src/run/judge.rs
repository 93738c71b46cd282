//! Whether an answer is as good as asked, in words.

use cable_dem::Mesh;

use crate::answer::error_estimate::{self, ErrorParts};
use crate::plan::Plan;
use crate::shown::{exact_percent, percent};
use crate::{Error, Scene};

/// Refuses an answer that is none, and warns of one that is not as good as asked.
pub fn judge(error: &ErrorParts, scene: &Scene, warnings: &mut Vec<String>) -> Result<(), Error> {
    let tolerance = scene.solver.tolerance;
    let total = error.total();
    error_estimate::judge(total.force, tolerance)?;
    for (share, of) in [(total.force, ""), (total.movement, " of the movement")] {
        if share > tolerance {
            let (share, tolerance) = (percent(share), percent(tolerance));
            warnings.push(format!(
                "the estimated error{of} of {share} exceeds the tolerance of {tolerance}"
            ));
        }
    }
    if !scene.friction.law.has_memory() {
        warnings.push(
            "the error is of the node spacing alone: the sigmoid law's result depends on the time step"
                .into(),
        );
    }
    Ok(())
}

/// Why this mesh.
pub fn mesh_reason(plan: &Plan<'_>, mesh: &Mesh) -> String {
    let Plan { scene, levels, .. } = plan;
    let nodes = scene.duct.depth / mesh.spacing();
    let why = if levels.named() {
        "as the scene asks".to_owned()
    } else {
        format!("for the requested {}", exact_percent(scene.solver.tolerance))
    };
    format!("node spacing and vehicle step: {nodes:.0} nodes per duct depth, {why}")
}
