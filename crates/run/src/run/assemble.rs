//! Puts the answer of a run together, by whatever way it was found.

use cycle_jump::{Record, peaks};

use crate::Error;
use crate::answer::error_estimate::ErrorParts;
use crate::answer::{
    Cost, DuctMotionSummary, ErrorEstimate, ErrorShares, ExtremePass, PassRecord, PlanSummary,
    RestraintRecord, Run, Stage, Start, balance, listed, saturation,
};
use crate::passes::{Passes, Solved, force_profile, listed_passes};
use crate::plan::Plan;
use crate::saved_state::{PastPass, SavedState};
use crate::scene::Scene;

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

    /// The answer from passes that were simulated.
    pub fn by_simulation(mut self, solved: &Solved) -> Result<Run, Error> {
        self.warn_of_leaks(&solved.passes);
        let scene = self.plan.scene;
        let shown = shown(self.plan, &solved.passes);
        let restraints = restraints(self.plan.scene, &solved.passes, &shown)?;
        let passes = shown.iter().map(|record| PassRecord::new(record, &scene.traffic));
        let passes: Vec<PassRecord> = passes.collect();
        balance::of_records(scene, &passes, &restraints)?;
        self.summarise(solved, passes.iter().find(|record| record.interpolated));
        let total = solved.error.total();
        let Passes { cable, state, .. } = &solved.passes;
        let kept = listed(scene.traffic.passes);
        let kept = passes
            .iter()
            .filter(|record| kept.binary_search(&record.pass).is_ok());
        let past = kept.map(|record| PastPass {
            pass: record.pass,
            days: scene.traffic.per_day.map(|a_day| record.pass as f64 / a_day),
            force_n: [record.upstream_force_n, record.downstream_force_n],
            displacement_m: [record.upstream_displacement_m, record.downstream_displacement_m],
        });
        let state = Some(SavedState::new(scene, cable, state, self.plan.start, past));
        let beyond = solved.passes.beyond.as_ref();
        let (days, heat) = solved.heat.clone().unzip();
        let (saturation, range) = if heat.is_some() {
            (None, None)
        } else {
            let period = self.plan.period.len();
            saturation(scene, period, &solved.passes.records, beyond)
        };
        let mut run = Run {
            title: scene.title.clone(),
            duct_motion: self.duct_motion(),
            plan: self.summary,
            saturation,
            range,
            random: solved.random,
            passes,
            extremes: Self::extremes(self.plan, solved),
            days: days.unwrap_or_default(),
            heat,
            force_profile: force_profile(&solved.passes.cable, &solved.passes.state)?,
            restraints,
            slip_lengths: solved.passes.slip,
            stages: solved.passes.stages.clone(),
            error_estimate: ErrorEstimate {
                relative: total.force,
                method: solved.error.to_string(),
                parts: solved.error.shares(),
            },
            start: self.plan.start.map(|start| Start {
                passes: start.passes(),
            }),
            state,
            cost: Cost::new(solved.passes.simulated, &solved.statistics),
            warnings: self.warnings,
        };
        run.warn_where_it_leaves(scene);
        Ok(run)
    }

    /// Warns of a friction law that loses some of the stored force.
    fn warn_of_leaks(&mut self, passes: &Passes) {
        let leaks = passes.leaks.iter().filter(|leak| leak.matters());
        self.warnings.extend(leaks.map(ToString::to_string));
    }

    /// Says on which mesh, and from which pass on answers were not simulated.
    fn summarise(&mut self, solved: &Solved, interpolated: Option<&PassRecord>) {
        let Solved {
            mesh,
            reasons,
            passes,
            heat,
            ..
        } = solved;
        let summary = &mut self.summary;
        (summary.node_spacing_m, summary.vehicle_step_m) = (mesh.spacing(), mesh.vehicle_step());
        summary.reasons.extend(reasons.iter().cloned());
        summary.reasons.extend(passes.step_limits.clone());
        if let Some(first) = interpolated.filter(|_| heat.is_none()) {
            let (simulated, passes) = (passes.simulated, self.plan.scene.traffic.passes);
            let of = if simulated < passes {
                format!("{simulated} of {passes} passes were simulated")
            } else {
                format!("{simulated} passes were simulated, some beyond the {passes} of the traffic")
            };
            let from = first.pass;
            summary.reasons.push(format!(
                "{of}; between them the answer follows jumps, from pass {from} on"
            ));
        }
    }

    /// The passes of a period that stands in for the traffic which show the largest forces and
    /// movements, and one more of each vehicle that is too seldom for it.
    fn extremes(plan: &Plan<'_>, solved: &Solved) -> Vec<ExtremePass> {
        let (scene, period) = (plan.scene, &plan.period);
        let a_day = solved
            .heat
            .as_ref()
            .map_or(u64::MAX, |(_, heat)| heat.passes_per_day);
        let place = |record: &Record| ((record.pass - 1) % a_day) as usize % period.len();
        let vehicle = |record: &Record| period.vehicles[place(record)];
        let of_period = solved.passes.peaks.iter().filter(|_| !period.is_own());
        let of_period = of_period.map(|record| (vehicle(record), record));
        let pass = |(vehicle, record): (usize, &Record)| ExtremePass {
            vehicle: scene.vehicles[vehicle].name.clone(),
            after: PassRecord::new(record, &scene.traffic),
            restraints_n: record.outcome.restraints.clone(),
            restraint_peaks_n: record
                .outcome
                .restraint_ranges
                .iter()
                .copied()
                .map(larger_of)
                .collect(),
        };
        let seldom = solved.seldom.iter().map(|(vehicle, record)| (*vehicle, record));
        of_period.chain(seldom).map(pass).collect()
    }

    /// Without friction every pass leaves the cable as the first one did: where it was laid.
    pub fn without_friction(mut self, stages: &[u64]) -> Result<Run, Error> {
        let Plan { choice, levels, .. } = self.plan;
        let method = choice.method.cable_method();
        let mesh = levels.mesh(levels.first())?;
        let mut scene = self.plan.scene.clone();
        scene.traffic.passes = 1;
        let task = self.plan.task(&scene, mesh);
        let mut first = task.every_pass()?;
        let force_profile = force_profile(&first.cable, &first.state)?;
        let stages = stages
            .iter()
            .filter(|pass| (1..=self.plan.scene.traffic.passes).contains(*pass));
        let stage = |&pass| Stage {
            pass,
            force_profile: force_profile.clone(),
            friction: None,
        };
        first.stages = stages.map(stage).collect();
        let listed = listed_passes(self.plan.scene, &self.plan.period).into_iter();
        let record = first.records[0].clone();
        first.records = listed
            .map(|pass| Record {
                pass,
                ..record.clone()
            })
            .collect();
        self.summary.cable = method.name().into();
        let solved = Solved {
            mesh,
            statistics: first.statistics,
            passes: Passes {
                slip: None,
                leaks: Vec::new(),
                ..first
            },
            error: ErrorParts::new(0.0, 0.0),
            reasons: vec!["without friction nothing drags the cable: every pass is like the first".into()],
            random: None,
            seldom: Vec::new(),
            shown: None,
            heat: None,
        };
        Ok(Run {
            saturation: None,
            range: None,
            error_estimate: ErrorEstimate {
                relative: 0.0,
                method: "exact: without friction the cable stays where it was laid".into(),
                parts: ErrorShares::default(),
            },
            ..self.by_simulation(&solved)?
        })
    }
}

/// The largest in size of a range.
fn larger_of([least, most]: [f64; 2]) -> f64 {
    if -least > most { least } else { most }
}

fn restraints(scene: &Scene, passes: &Passes, records: &[Record]) -> Result<Vec<RestraintRecord>, Error> {
    let Passes { state, cable, .. } = passes;
    let forces = state
        .restraint_forces(cable)?
        .into_iter()
        .zip(state.clamp_slips(cable));
    let restraints = cable.restraints().iter().zip(forces).enumerate();
    Ok(restraints
        .map(|(i, (restraint, (force_n, slip)))| RestraintRecord {
            // Those that never slip may have been put on later, where the cable had moved.
            slipped_m: scene.restraints[i].holds.map(|_| slip),
            position_m: restraint.position,
            stiffness_n_per_m: restraint.stiffness,
            force_n,
            after_passes_n: records
                .iter()
                .map(|record| record.outcome.restraints[i])
                .collect(),
            during_passes_n: records
                .iter()
                .map(|record| larger_of(record.outcome.restraint_ranges[i]))
                .collect(),
        })
        .collect())
}

/// The passes that are listed; where they are the traffic's own, those beside them that show more
/// too.
fn shown(plan: &Plan<'_>, passes: &Passes) -> Vec<Record> {
    let listed = listed_passes(plan.scene, &plan.period);
    let is_listed = |record: &Record| listed.binary_search(&record.pass).is_ok();
    let is_known = |record: &&Record| passes.doubtful.binary_search(&record.pass).is_err();
    let known = passes.records.iter().filter(is_known).cloned();
    let (mut shown, mut others): (Vec<_>, Vec<_>) = known.partition(is_listed);
    if plan.period.is_own() {
        others.extend(passes.peaks.iter().cloned());
    }
    // On days of heat passes between simulated ones have the peaks of others.
    let simulated = |record: &&Record| plan.scene.warming().is_none() || !record.interpolated;
    let simulated: Vec<Record> = shown.iter().filter(simulated).cloned().collect();
    let peaks = peaks(&simulated, others);
    shown.extend(peaks);
    shown.sort_by_key(|record| record.pass);
    shown
}
