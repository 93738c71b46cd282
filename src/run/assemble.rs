//! Puts the answer of a run together, by whatever way it was found.

use cycle_jump::Record;

use super::passes::{Passes, Task, force_profile};
use super::refine::Solved;
use super::underway::CutShort;
use crate::answer::{
    Cost, DuctMotionSummary, ErrorEstimate, ErrorShares, PassRecord, PlanSummary, RestraintRecord, Run,
    Stage, balance, saturation, simulated,
};
use crate::plan::Plan;
use crate::{Error, Progress};

/// A friction law that loses more than this share of the stored force in one pass gives no answer.
const LARGEST_LEAK: f64 = 0.9;

/// What every answer holds, however it was found.
pub struct RunBuilder<'a> {
    plan: &'a Plan<'a>,
    summary: PlanSummary,
    pub warnings: Vec<String>,
}

impl<'a> RunBuilder<'a> {
    pub fn new(plan: &'a Plan<'a>) -> Self {
        Self {
            summary: PlanSummary {
                ground: plan.ground.name.into(),
                cable: plan.choice.method.name().into(),
                node_spacing_m: 0.0,
                vehicle_step_m: 0.0,
                reasons: plan.reasons(&plan.choice.reason),
            },
            warnings: plan.warnings.clone(),
            plan,
        }
    }

    /// What there is to say if the run is stopped, but its passes.
    pub fn cut_short(&self) -> CutShort {
        CutShort {
            title: self.plan.scene.title.clone(),
            cut_short: true,
            plan: self.summary.clone(),
            duct_motion: self.duct_motion(),
            passes: Vec::new(),
            saturation: None,
            error_estimate: None,
            warnings: self.warnings.clone(),
        }
    }

    /// Every pass is simulated after all.
    pub fn gives_up_jumps(&mut self, error: &Error) {
        self.summary.cable = self.plan.choice.method.cable_method().name().into();
        self.summary.reasons.push(format!(
            "jumps gave no answer here ({error}): every pass was simulated after all"
        ));
    }

    fn duct_motion(&self) -> DuctMotionSummary {
        let first = &self.plan.ground.motions[0];
        DuctMotionSummary {
            peak_longitudinal_m: first.peak_longitudinal(),
            peak_vertical_m: first.peak_vertical(),
        }
    }

    pub fn by_simulation(mut self, solved: &Solved) -> Result<Run, Error> {
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
        let shown = shown(self.plan, &solved.passes);
        let restraints = restraints(&solved.passes, &shown)?;
        let traffic = &self.plan.scene.traffic;
        let passes: Vec<PassRecord> = shown
            .into_iter()
            .map(|record| PassRecord::new(record, traffic))
            .collect();
        balance::of_records(self.plan.scene, &passes, &restraints)?;
        let first = passes.iter().find(|record| record.interpolated);
        if let Some(first) = first.filter(|_| solved.heat.is_none()) {
            let (simulated, passes) = (solved.passes.simulated, self.plan.scene.traffic.passes);
            let of = if simulated < passes {
                format!("{simulated} of {passes} passes were simulated")
            } else {
                format!("{simulated} passes were simulated, some beyond the {passes} of the traffic")
            };
            summary.reasons.push(format!(
                "{of}; between them the answer follows jumps, from pass {} on",
                first.pass
            ));
        }
        let total = solved.error.total();
        let beyond = solved.passes.beyond.as_ref();
        let (days, heat) = solved.heat.clone().unzip();
        let (saturation, range) = if heat.is_some() {
            (None, None)
        } else {
            let period = self.plan.period.len();
            saturation(self.plan.scene, period, &solved.passes.records, beyond)
        };
        Ok(Run {
            title: self.plan.scene.title.clone(),
            duct_motion: self.duct_motion(),
            plan: self.summary,
            saturation,
            range,
            random: solved.random,
            passes,
            days: days.unwrap_or_default(),
            heat,
            force_profile: force_profile(&solved.passes.cable, &solved.passes.state)?,
            restraints,
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
                    passes: solved.error.passes.force,
                    temperature: solved.error.temperature.force,
                    law: solved.error.passes.force,
                    movement: total.movement,
                },
            },
            cost: Cost::new(solved.passes.simulated, &solved.statistics),
            warnings: self.warnings,
        })
    }

    /// Without friction every pass leaves the cable as the first one did: where it was laid.
    pub fn without_friction(mut self, stages: &[u64]) -> Result<Run, Error> {
        let Plan {
            choice,
            levels,
            ground,
            ..
        } = self.plan;
        let method = choice.method.cable_method();
        let mesh = levels.mesh(levels.first())?;
        let mut scene = self.plan.scene.clone();
        scene.traffic.passes = 1;
        let task = Task {
            scene: &scene,
            method,
            motions: &ground.motions,
            mesh,
            stages: &[],
            progress: Progress::default(),
            seen: None,
        };
        let first = task.every_pass()?;
        let profile = force_profile(&first.cable, &first.state)?;
        let traffic = &self.plan.scene.traffic;
        let count = traffic.passes;
        let summary = &mut self.summary;
        summary.cable = method.name().into();
        (summary.node_spacing_m, summary.vehicle_step_m) = (mesh.spacing(), mesh.vehicle_step());
        summary
            .reasons
            .push("without friction nothing drags the cable: every pass is like the first".into());
        let stages = stages.iter().filter(|pass| (1..=count).contains(*pass));
        let all: Vec<Record> = simulated(traffic)
            .into_iter()
            .map(|pass| Record {
                pass,
                ..first.records[0].clone()
            })
            .collect();
        Ok(Run {
            title: self.plan.scene.title.clone(),
            duct_motion: self.duct_motion(),
            plan: self.summary,
            passes: all
                .iter()
                .map(|record| PassRecord::new(record, traffic))
                .collect(),
            saturation: None,
            range: None,
            random: None,
            days: Vec::new(),
            heat: None,
            restraints: restraints(&first, &all.iter().collect::<Vec<_>>())?,
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
            cost: Cost::new(1, &first.statistics),
            warnings: self.warnings,
        })
    }
}

fn restraints(passes: &Passes, records: &[&Record]) -> Result<Vec<RestraintRecord>, Error> {
    let Passes { state, cable, .. } = passes;
    let forces = state.restraint_forces(cable)?;
    let restraints = cable.restraints().iter().zip(forces).enumerate();
    Ok(restraints
        .map(|(i, (restraint, force_n))| RestraintRecord {
            position_m: restraint.position,
            stiffness_n_per_m: restraint.stiffness,
            force_n,
            after_passes_n: records
                .iter()
                .map(|record| record.outcome.restraints[i])
                .collect(),
        })
        .collect())
}

/// The passes that are listed.
fn shown<'p>(plan: &Plan<'_>, passes: &'p Passes) -> Vec<&'p Record> {
    let listed = simulated(&plan.scene.traffic);
    let is_listed = |record: &&Record| listed.binary_search(&record.pass).is_ok();
    passes.records.iter().filter(is_listed).collect()
}
