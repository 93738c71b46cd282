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
    let (scene, total) = (plan.scene, error.total());
    let tolerance = scene.solver.tolerance;
    error_estimate::judge(error, tolerance)?;
    let exceeds = [(total.force, ""), (total.movement, " of the movement")].into_iter();
    let exceeds = exceeds.filter(|(share, _)| *share > tolerance);
    let exceeds = exceeds.map(|(share, of)| format!("the estimated error{of} is {}", percent(share)));
    let exceeds = exceeds.collect::<Vec<_>>().join(" and ");
    if !exceeds.is_empty() {
        let cause = error.largest(|_| true, Shares::worse);
        let has_remedy = match cause {
            ErrorSource::Inertia => scene.warming().is_none(),
            _ => !cause.is_skipping() || scene.traffic.passes <= MOST_PASSES,
        };
        let none = "no finer mesh makes it much smaller";
        let remedy = if has_remedy { cause.remedy() } else { none };
        let tolerance = exact_percent(tolerance);
        warnings.push(format!("{exceeds}, above the tolerance of {tolerance}: {remedy}"));
    }
    if !scene.friction.law().has_memory() {
        let why = "the error is of the node spacing alone: the sigmoid law's result depends on the time step";
        warnings.push(why.to_owned());
    }
    Ok(())
}

/// Why this mesh.
pub fn mesh_reason(plan: &Plan<'_>, mesh: &Mesh) -> String {
    let Plan { scene, levels, .. } = plan;
    let (scale, tolerance) = (levels.length_scale, exact_percent(scene.solver.tolerance));
    let (asked, needed) = (
        "as the scene asks".to_owned(),
        format!("for a tolerance of {tolerance}"),
    );
    let why = if levels.named { asked } else { needed };
    let of_scale = format!("per {scale:.1} m, over which the duct's motion changes");
    let of_depth = "per duct depth".to_owned();
    let of = if scale > scene.duct.depth {
        of_scale
    } else {
        of_depth
    };
    let nodes = scale / mesh.spacing();
    format!("node spacing and vehicle step: {nodes:.0} nodes {of}, {why}")
}
