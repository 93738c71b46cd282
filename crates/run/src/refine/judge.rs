//! What the error of a run means: an answer that is refused, or warned of with a way to a smaller
//! error.

use cable_dem::Mesh;

use crate::answer::differences::{Scale, Shares};
use crate::answer::error_estimate::{ErrorParts, is_doubtful};
use crate::passes::Passes;
use creepage_plan::{
    Error, ErrorSource, MAX_PASSES, Plan,
    shown::{exact_percent, percent},
};
use creepage_scene::four_digits;

/// Friction on this share of the duct's depth holds a force whose error does not matter, as a rule a
/// few newtons: if nothing creeps only ends slip, on less cable than any mesh resolves.
const SLIGHT: f64 = 0.1;

/// The force that an error may have whatever share of the forces it is \[N\].
fn slight_force(plan: &Plan<'_>) -> f64 {
    SLIGHT * plan.scene.duct.depth * plan.scene.friction_limit()
}

/// The largest force of `passes`, if that counts \[N\].
fn largest(plan: &Plan<'_>, passes: &Passes) -> f64 {
    passes.largest_force(Scale::new(plan.scene, &plan.ground.motions).force)
}

/// Whether these `passes` with this `error` of the forces are no answer.
pub fn is_refused(error: &ErrorParts, plan: &Plan<'_>, passes: &Passes) -> bool {
    let share = error.total().force;
    let is_slight = || share * largest(plan, passes) <= slight_force(plan);
    is_doubtful(share, plan.scene.solver.tolerance) && !is_slight()
}

/// Refuses `passes` that are no answer, and warns of those that are not as good as asked.
pub fn judge(
    error: &ErrorParts,
    plan: &Plan<'_>,
    passes: &Passes,
    warnings: &mut Vec<String>,
) -> Result<(), Error> {
    let (scene, total) = (plan.scene, error.total());
    let tolerance = scene.solver.tolerance;
    if is_refused(error, plan, passes) {
        return Err(error.refusal(tolerance));
    }
    if is_doubtful(total.force, tolerance) {
        let [wrong, slight] = [total.force * largest(plan, passes), slight_force(plan)].map(four_digits);
        warnings.push(format!(
            "the forces are so small that their error, {wrong} N, is below the {slight} N that friction holds on a tenth of the duct's depth"
        ));
    }
    let exceeds = [(total.force, ""), (total.movement, " of the movement")].into_iter();
    let exceeds = exceeds.filter(|(share, _)| *share > tolerance);
    let exceeds = exceeds.map(|(share, of)| format!("the estimated error{of} is {}", percent(share)));
    let exceeds = exceeds.collect::<Vec<_>>().join(" and ");
    if !exceeds.is_empty() {
        let cause = error.largest(|_| true, Shares::worse);
        let has_remedy = match cause {
            ErrorSource::Inertia => scene.warming().is_none(),
            _ => !cause.is_skipping() || scene.traffic.passes <= MAX_PASSES,
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
