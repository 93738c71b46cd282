//! Carrying a plan out: ground, motion, passes, and what the answer holds.

use cable_dem::PassOutcome;
use ground_field::{DuctMotion, GroundField};

use super::cable::{CableMethod, PassMethod};
use super::error;
use super::law::LawRun;
use super::levels::{Ladder, Solved};
use super::passes::{Passes, force_profile, simulate};
use super::result::{
    Cost, DuctMotionSummary, ErrorEstimate, ErrorShares, PassRecord, PlanSummary, RestraintRecord, Run, Stage,
};
use super::saturation::{force_series, saturation};
use super::{balance, law};
use crate::planner::{Plan, plan, plan_on};
use crate::{Error, Scene, finite};

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
    if scene.traffic.passes > MAX_PASSES && !is_frictionless(scene) {
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
    let mut answer = Answer {
        scene,
        duct_motion: DuctMotionSummary {
            peak_longitudinal_m: exact[0].peak_longitudinal(),
            peak_vertical_m: exact[0].peak_vertical(),
        },
        summary: PlanSummary {
            ground: plan.ground.name.into(),
            cable: plan.method.method.name().into(),
            node_spacing_m: 0.0,
            vehicle_step_m: 0.0,
            reasons: plan.reasons(),
        },
        warnings: plan.warnings.clone(),
    };
    let run = if is_frictionless(scene) {
        answer.without_friction(plan, &motions, options)?
    } else {
        let simulated = match plan.method.method {
            PassMethod::EveryPass(method) => method,
            PassMethod::Law => {
                // Its time does not depend on the motion: nothing is gained by leaving anything out.
                let law = law::run(scene, exact, options.stages).and_then(|law| answer.trusted(law, plan));
                match law {
                    Ok(law) => {
                        answer.summary.ground = plan.ground.exact_name.into();
                        let run = answer.by_law(law);
                        finite::check(&run)?;
                        return Ok(run);
                    }
                    Err(error) if !plan.method.one_by_one => return Err(error),
                    Err(error) => {
                        answer.summary.cable = CableMethod::QuasiStatic.name().into();
                        answer.summary.reasons.push(format!(
                            "the pass law gave no answer here ({error}): every pass was computed after all"
                        ));
                        CableMethod::QuasiStatic
                    }
                }
            }
        };
        let ladder = Ladder {
            scene,
            method: simulated,
            levels: plan.levels,
            motions: &motions,
            exact: plan.ground.exact(),
            motion_error: plan.ground.error,
            method_error: plan.method.inertia,
            progress: options.progress,
            stages: options.stages,
        };
        let solved = ladder.climb(options.verify, &mut answer.warnings)?;
        if solved.ground_is_exact && plan.ground.exact().is_some() {
            answer.summary.ground = plan.ground.exact_name.into();
        }
        answer.by_simulation(&solved)?
    };
    finite::check(&run)?;
    Ok(run)
}

/// Whether nothing can drag the cable.
fn is_frictionless(scene: &Scene) -> bool {
    scene.friction_limit() == 0.0
}

/// What every answer holds, however it was found.
struct Answer<'a> {
    scene: &'a Scene,
    duct_motion: DuctMotionSummary,
    summary: PlanSummary,
    warnings: Vec<String>,
}

impl Answer<'_> {
    /// The law's answer, if it can be true and is as accurate as it has to be.
    fn trusted(&self, law: LawRun, plan: &Plan<'_>) -> Result<LawRun, Error> {
        let tolerance = self.scene.solver.tolerance;
        let relative = law.error.relative;
        error::judge(relative, tolerance)?;
        if plan.method.one_by_one && relative > tolerance {
            return Err(Error::Inaccurate {
                reached: relative,
                asked: tolerance,
            });
        }
        balance::of_records(self.scene, &law.passes, &law.restraints)?;
        Ok(law)
    }

    fn by_law(mut self, law: LawRun) -> Run {
        (self.summary.node_spacing_m, self.summary.vehicle_step_m) = (law.node_spacing, law.vehicle_step);
        self.warnings.extend(law.warnings);
        let saturation = law.saturation;
        Run {
            title: self.scene.title.clone(),
            plan: self.summary,
            duct_motion: self.duct_motion,
            saturation: saturation.and_then(|s| balance::of_saturation(self.scene, &law.passes, s)),
            passes: law.passes,
            force_profile: law.force_profile,
            restraints: law.restraints,
            stages: law.stages,
            slip_lengths: None,
            error_estimate: law.error,
            cost: law.cost,
            warnings: self.warnings,
        }
    }

    fn by_simulation(mut self, solved: &Solved) -> Result<Run, Error> {
        for leak in solved.passes.leaks.iter().filter(|leak| leak.matters()) {
            if leak.loss_per_pass > LARGEST_LEAK {
                return Err(Error::Unfit {
                    key: "friction.law",
                    found: "sigmoid",
                    reason: leak.to_string().into(),
                });
            }
            self.warnings.push(leak.to_string());
        }
        let summary = &mut self.summary;
        (summary.node_spacing_m, summary.vehicle_step_m) =
            (solved.mesh.spacing(), solved.mesh.vehicle_step());
        summary.reasons.extend(solved.reasons.iter().cloned());
        summary.reasons.extend(solved.passes.step_limits.clone());
        let outcomes = &solved.passes.outcomes;
        let (series, scale) = force_series(self.scene, outcomes);
        let passes = listed(outcomes);
        let total = solved.error.total();
        Ok(Run {
            title: self.scene.title.clone(),
            plan: self.summary,
            duct_motion: self.duct_motion,
            saturation: saturation(&series, scale)
                .and_then(|saturation| balance::of_saturation(self.scene, &passes, saturation)),
            passes,
            force_profile: force_profile(&solved.passes.cable, &solved.passes.state)?,
            restraints: restraints(&solved.passes)?,
            slip_lengths: solved.passes.slip,
            stages: solved.passes.stages.clone(),
            error_estimate: ErrorEstimate {
                relative: total.force,
                method: solved.error.to_string(),
                parts: ErrorShares {
                    mesh: solved.error.mesh.force,
                    ground: solved.error.ground.force,
                    inertia: solved.error.inertia,
                    road: solved.error.road.force,
                    movement: total.movement,
                    ..ErrorShares::default()
                },
            },
            cost: Cost::new(&solved.statistics),
            warnings: self.warnings,
        })
    }

    /// Without friction every pass leaves the cable as the first one did: where it was laid.
    fn without_friction(
        mut self,
        plan: &Plan<'_>,
        motions: &[DuctMotion],
        options: &RunOptions<'_>,
    ) -> Result<Run, Error> {
        let method = match plan.method.method {
            PassMethod::EveryPass(method) => method,
            PassMethod::Law => CableMethod::QuasiStatic,
        };
        let mesh = plan.levels.mesh(plan.levels.first())?;
        let mut scene = self.scene.clone();
        scene.traffic.passes = 1;
        let first = simulate(&scene, method, motions, mesh, &[], || {})?;
        let profile = force_profile(&first.cable, &first.state)?;
        let count = self.scene.traffic.passes;
        let summary = &mut self.summary;
        summary.cable = method.name().into();
        (summary.node_spacing_m, summary.vehicle_step_m) = (mesh.spacing(), mesh.vehicle_step());
        summary
            .reasons
            .push("without friction nothing drags the cable: every pass is like the first".into());
        let stages = options.stages.iter().filter(|pass| (1..=count).contains(*pass));
        Ok(Run {
            title: self.scene.title.clone(),
            plan: self.summary,
            duct_motion: self.duct_motion,
            passes: law::listed(count)
                .into_iter()
                .map(|pass| PassRecord::new(pass, &first.outcomes[0]))
                .collect(),
            saturation: None,
            restraints: restraints(&first)?,
            slip_lengths: None,
            stages: stages
                .map(|&pass| Stage {
                    pass,
                    force_profile: profile.clone(),
                    friction: None,
                })
                .collect(),
            force_profile: profile,
            error_estimate: ErrorEstimate {
                relative: 0.0,
                method: "exact: without friction the cable stays where it was laid".into(),
                parts: ErrorShares::default(),
            },
            cost: Cost::new(&first.statistics),
            warnings: self.warnings,
        })
    }
}

fn restraints(passes: &Passes) -> Result<Vec<RestraintRecord>, Error> {
    let Passes { state, cable, .. } = passes;
    let forces = state.restraint_forces(cable)?;
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
