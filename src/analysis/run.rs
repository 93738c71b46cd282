//! Carrying a plan out: ground, motion, passes, and what the answer holds.

use cable_dem::PassOutcome;
use ground_field::GroundField;

use super::cable::{CableMethod, PassMethod};
use super::law::LawRun;
use super::levels::{Ladder, Solved};
use super::passes::{Passes, force_profile};
use super::result::{
    Cost, DuctMotionSummary, ErrorEstimate, ErrorShares, PassRecord, PlanSummary, RestraintRecord, Run,
};
use super::saturation::saturation;
use super::law;
use crate::planner::{Plan, plan, plan_on};
use crate::scene::End;
use crate::{Error, Scene};

/// A law that loses more than this share of the stored force in one pass gives no answer.
const LARGEST_LEAK: f64 = 0.9;
/// Most passes that are computed one by one.
const MAX_PASSES: u64 = 1_000_000;
/// Passes up to which every one is listed.
const ALL_LISTED: u64 = 10_000;

/// How to run.
#[derive(Default)]
pub struct RunOptions<'a> {
    /// Measure the error by a run one rung finer instead of estimating it.
    pub verify: bool,
    /// Hears of the share of the work done so far, in \[0, 1\]; begins again where a finer mesh proves needed.
    pub progress: Option<&'a (dyn Fn(f64) + Sync)>,
    /// A ground model of one's own, in place of the scene's.
    pub ground: Option<&'a dyn GroundField>,
    /// Passes at which to look at the cable, for [`Run::stages`]; those beyond the scene's are left out.
    pub stages: &'a [u64],
}

/// Computes all passes of `scene`.
///
/// # Errors
///
/// [`Error`] when the scene asks for what does not fit together, or the computation fails.
pub fn run(scene: &Scene) -> Result<Run, Error> {
    run_with(scene, &RunOptions::default())
}

/// Computes all passes of `scene` with options.
///
/// # Errors
///
/// As for [`run`].
pub fn run_with(scene: &Scene, options: &RunOptions<'_>) -> Result<Run, Error> {
    plan_on(scene, options.ground)?.run_with(options)
}

/// Checks that the parts of `scene` fit together, without computing any pass.
///
/// # Errors
///
/// As for [`run`].
pub fn check(scene: &Scene) -> Result<(), Error> {
    plan(scene).map(|_| ())
}

/// Passes are computed one by one, and all are kept.
pub fn check_passes(scene: &Scene) -> Result<(), Error> {
    if scene.traffic.passes > MAX_PASSES {
        return Err(Error::Unfit {
            key: "traffic.passes",
            found: "more than a million passes",
            reason: "one by one they would take days, and the pass law does not apply here".into(),
        });
    }
    Ok(())
}

/// Carries `plan` out.
pub fn carry_out(plan: &Plan<'_>, options: &RunOptions<'_>) -> Result<Run, Error> {
    let scene = plan.scene;
    let motions = plan.ground.motions(scene)?;
    let exact = plan.ground.exact().unwrap_or(&motions);
    let duct_motion = DuctMotionSummary {
        peak_longitudinal_m: exact[0].peak_longitudinal(),
        peak_vertical_m: exact[0].peak_vertical(),
    };
    let mut summary = PlanSummary {
        ground: plan.ground.name.into(),
        cable: plan.method.method.name().into(),
        node_spacing_m: 0.0,
        vehicle_step_m: 0.0,
        reasons: plan.reasons(),
    };
    let mut warnings = plan.warnings.clone();
    let title = scene.title.clone();
    let method = match plan.method.method {
        PassMethod::EveryPass(method) => method,
        PassMethod::Law => {
            // Its time does not depend on the motion: nothing is gained by leaving anything out.
            let law = law::run(scene, exact, options.stages)?;
            if law.error.relative <= scene.solver.tolerance || !plan.method.one_by_one {
                summary.ground = plan.ground.exact_name.into();
                (summary.node_spacing_m, summary.vehicle_step_m) = (law.node_spacing, law.vehicle_step);
                return Ok(by_law(title, summary, duct_motion, law, warnings));
            }
            summary.cable = CableMethod::QuasiStatic.name().into();
            summary.reasons.push(format!(
                "the pass law is {:.1} % off the first passes here: they were computed one by one after all",
                100.0 * law.error.relative
            ));
            CableMethod::QuasiStatic
        }
    };
    let ladder = Ladder {
        scene,
        method,
        levels: plan.levels,
        motions: &motions,
        exact: plan.ground.exact(),
        motion_error: plan.ground.error,
        method_error: plan.method.inertia,
        progress: options.progress,
        stages: options.stages,
    };
    let solved = ladder.climb(options.verify, &mut warnings)?;
    for leak in solved.passes.leaks.iter().filter(|leak| leak.matters()) {
        if leak.loss_per_pass > LARGEST_LEAK {
            return Err(Error::Unfit {
                key: "friction.law",
                found: "sigmoid",
                reason: leak.to_string().into(),
            });
        }
        warnings.push(leak.to_string());
    }
    (summary.node_spacing_m, summary.vehicle_step_m) = (solved.mesh.spacing(), solved.mesh.vehicle_step());
    summary.reasons.extend(solved.reasons.iter().cloned());
    summary.reasons.extend(solved.passes.step_limits.clone());
    if solved.ground_is_exact && plan.ground.exact().is_some() {
        summary.ground = plan.ground.exact_name.into();
    }
    let passes = &solved.passes.outcomes;
    let (series, scale) = force_series(scene, passes);
    Ok(Run {
        title,
        plan: summary,
        duct_motion,
        passes: listed(passes),
        saturation: saturation(&series, scale),
        force_profile: force_profile(&solved.passes.cable, &solved.mesh, &solved.passes.state)?,
        restraints: restraints(&solved)?,
        slip_lengths: solved.passes.slip,
        stages: solved.passes.stages.clone(),
        error_estimate: ErrorEstimate {
            relative: solved.error.total(),
            method: solved.error.to_string(),
            parts: ErrorShares {
                mesh: solved.error.mesh.unwrap_or(1.0),
                ground: solved.error.ground,
                inertia: solved.error.inertia,
                law: 0.0,
            },
        },
        cost: Cost::new(&solved.statistics),
        warnings,
    })
}

/// The law's answer.
fn by_law(
    title: String,
    plan: PlanSummary,
    duct_motion: DuctMotionSummary,
    law: LawRun,
    mut warnings: Vec<String>,
) -> Run {
    warnings.extend(law.warnings);
    Run {
        title,
        plan,
        duct_motion,
        passes: law.passes,
        saturation: law.saturation,
        force_profile: law.force_profile,
        restraints: law.restraints,
        stages: law.stages,
        slip_lengths: None,
        error_estimate: law.error,
        cost: law.cost,
        warnings,
    }
}

/// The force that a load cell would show: at the end that is held, the larger one of two, and inside the cable where none
/// is; and its largest value while vehicles pass.
fn force_series(scene: &Scene, outcomes: &[PassOutcome]) -> (Vec<f64>, f64) {
    let pick = |force: fn(&PassOutcome) -> f64, peak: fn(&PassOutcome) -> f64| {
        let scale = outcomes
            .iter()
            .map(peak)
            .fold(0.0, |largest: f64, p| largest.max(p.abs()));
        (outcomes.iter().map(force).collect::<Vec<_>>(), scale)
    };
    let upstream = || {
        pick(
            |o| o.force.upstream,
            |o| o.peak.upstream.abs().max(o.lowest.upstream.abs()),
        )
    };
    let downstream = || {
        pick(
            |o| o.force.downstream,
            |o| o.peak.downstream.abs().max(o.lowest.downstream.abs()),
        )
    };
    match (scene.ends.upstream, scene.ends.downstream) {
        (End::Free, End::Free) => pick(|o| o.max_compression, |o| o.max_compression),
        (_, End::Free) => upstream(),
        (End::Free, _) => downstream(),
        _ => {
            let last = outcomes
                .last()
                .map_or((0.0, 0.0), |o| (o.force.upstream, o.force.downstream));
            if last.0.abs() > last.1.abs() {
                upstream()
            } else {
                downstream()
            }
        }
    }
}

fn restraints(solved: &Solved) -> Result<Vec<RestraintRecord>, Error> {
    let Passes { state, cable, .. } = &solved.passes;
    let forces = state.restraint_forces(cable, &solved.mesh)?;
    let restraints = cable.restraints().iter().zip(forces);
    Ok(restraints
        .map(|(restraint, force_n)| RestraintRecord {
            position_m: restraint.position,
            stiffness_n_per_m: restraint.stiffness,
            force_n,
        })
        .collect())
}

/// All passes, or of very many the first ones and then evenly growing numbers, the last among them.
fn listed(outcomes: &[PassOutcome]) -> Vec<PassRecord> {
    let count = outcomes.len() as u64;
    let mut records = Vec::new();
    let mut next = 1;
    for (index, outcome) in outcomes.iter().enumerate() {
        let pass = index as u64 + 1;
        if count <= ALL_LISTED || pass == next || pass == count {
            records.push(PassRecord::new(pass, outcome));
            next = (pass + 1).max(pass * 101 / 100);
        }
    }
    records
}
