//! What the error of a run means: an answer that is refused, or warned of with a way to a smaller
//! error.

use cable_dem::Mesh;

use crate::answer::differences::Shares;
use crate::answer::error_estimate::{self, ErrorParts};
use creepage_plan::{
    Error, ErrorSource, MOST_PASSES, Plan,
    shown::{exact_percent, percent},
};

/// Refuses an answer that is none, and warns of one that is not as good as asked.
pub fn judge(error: &ErrorParts, plan: &Plan<'_>, warnings: &mut Vec<String>) -> Result<(), Error> {
    let scene = plan.scene;
    let tolerance = scene.solver.tolerance;
    let total = error.total();
    error_estimate::judge(error, tolerance)?;
    let exceeds = [(total.force, ""), (total.movement, " of the movement")]
        .into_iter()
        .filter(|(share, _)| *share > tolerance)
        .map(|(share, of)| format!("the estimated error{of} is {}", percent(share)));
    let exceeds: Vec<String> = exceeds.collect();
    if !exceeds.is_empty() {
        let cause = error.largest(|_| true, Shares::worse);
        let has_remedy = match cause {
            ErrorSource::Inertia => scene.warming().is_none(),
            _ => !cause.is_skipping() || scene.traffic.passes <= MOST_PASSES,
        };
        warnings.push(format!(
            "{}, above the tolerance of {}: {}",
            exceeds.join(" and "),
            exact_percent(tolerance),
            if has_remedy {
                cause.remedy()
            } else {
                "no finer mesh makes it much smaller"
            }
        ));
    }
    if !scene.friction.law().has_memory() {
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
    let (depth, scale) = (scene.duct.depth, levels.length_scale);
    let why = if levels.named {
        "as the scene asks".to_owned()
    } else {
        format!("for a tolerance of {}", exact_percent(scene.solver.tolerance))
    };
    let of = if scale > depth {
        format!("per {scale:.1} m, over which the duct's motion changes")
    } else {
        "per duct depth".to_owned()
    };
    let nodes = scale / mesh.spacing();
    format!("node spacing and vehicle step: {nodes:.0} nodes {of}, {why}")
}
