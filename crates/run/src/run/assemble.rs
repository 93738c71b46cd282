//! Puts the answer of a run together, by whatever way it was found.

use cable_dem::{CableState, DuctedCable, Restraint};
use cycle_jump::{Record, peaks};

use crate::answer::error_estimate::ErrorParts;
use crate::answer::{
    Cost, DayExtremes, DuctMotionSummary, ExtremePass, ForceProfile, PassRecord, PlanSummary,
    RestraintRecord, Run, Stage, Start, balance, larger, listed, listed_passes, saturation,
};
use crate::passes::{Passes, Simulation, Task};
use crate::refine::Solved;
use creepage_plan::{Error, PastPass, Plan, SavedState};
use creepage_scene::{CableEnd, End, Scene, SolverMethod};

/// The answer from passes that were simulated by `method`, for a `reason`.
pub fn assemble(plan: &Plan<'_>, method: SolverMethod, reason: &str, solved: Solved) -> Result<Run, Error> {
    let Plan { scene, ground, .. } = plan;
    let found = &solved.passes;
    let cable = Task::of(plan, scene, solved.mesh).cable()?;
    let shown = shown(plan, found);
    let restraints = restraints(plan, &cable, &found.state, &shown)?;
    let passes = shown.iter().map(|record| PassRecord::new(record, &scene.traffic));
    let passes: Vec<PassRecord> = passes.collect();
    balance::of_records(scene, &shown)?;
    let (saturation, range) = match solved.heat {
        Some(_) => (None, None),
        None => saturation(scene, &plan.period, &found.records, found.beyond.as_ref()),
    };
    let past = past(scene, &passes);
    let days = found.days.iter().flat_map(|days| &days.days);
    let first = &ground.motions[0];
    // A free end is a spring of no stiffness.
    let spring = |end: End| end.stiffness().filter(|stiffness| *stiffness > 0.0);
    let mut run = Run {
        title: scene.title.clone(),
        duct_motion: DuctMotionSummary {
            peak_longitudinal_m: first.peak_longitudinal(),
            peak_vertical_m: first.peak_vertical(),
        },
        plan: PlanSummary {
            ground: ground.name.into(),
            cable: method.to_string(),
            node_spacing_m: solved.mesh.spacing(),
            vehicle_step_m: solved.mesh.vehicle_step(),
            reasons: reasons(plan, reason, &solved, &passes),
        },
        saturation,
        range,
        random: solved.random,
        state: Some(SavedState::new(scene, &cable, &found.state, plan.start, past)),
        passes,
        extremes: extremes(plan, method, &solved)?,
        upstream_spring_n_per_m: spring(scene.ends.upstream),
        downstream_spring_n_per_m: spring(scene.ends.downstream),
        force_profile: ForceProfile::new(&cable, &found.state)?,
        restraints,
        slip_lengths: found.slip,
        error_estimate: solved.error.estimate(),
        start: plan.start.map(|start| Start {
            passes: start.passes(),
        }),
        shown: solved.shown,
        cost: Cost {
            simulated_passes: found.simulated,
            steps: solved.statistics.steps as u64,
            sweeps: solved.statistics.sweeps as u64,
            node_updates: solved.statistics.node_updates as u64,
        },
        warnings: [plan.warnings.clone(), solved.warnings].concat(),
        days: days
            .map(|(day, extremes)| DayExtremes::new(*day, extremes))
            .collect(),
        heat: solved.heat,
        stages: found.stages.clone(),
    };
    run.warn_where_it_leaves(scene);
    run.warn_where_it_creeps_back(scene);
    Ok(run)
}

/// What a state keeps of the passes: those that a long run lists.
fn past(scene: &Scene, passes: &[PassRecord]) -> Vec<PastPass> {
    let kept = listed(scene.traffic.passes);
    let is_kept = |record: &&PassRecord| kept.binary_search(&record.pass).is_ok();
    let past = |record: &PassRecord| PastPass {
        pass: record.pass,
        days: scene.traffic.per_day.map(|a_day| record.pass as f64 / a_day),
        force_n: CableEnd::ALL.map(|end| record.force_after(end)),
        displacement_m: CableEnd::ALL.map(|end| record.displacement(end)),
    };
    passes.iter().filter(is_kept).map(past).collect()
}

/// Why this ground, this method and this mesh, and from which pass on answers were not simulated.
fn reasons(plan: &Plan<'_>, reason: &str, solved: &Solved, passes: &[PassRecord]) -> Vec<String> {
    let mut reasons = plan.reasons(reason);
    reasons.extend(solved.reasons.iter().cloned());
    let interpolated = passes.iter().find(|record| record.interpolated);
    if let Some(first) = interpolated.filter(|_| solved.heat.is_none()) {
        let (simulated, passes) = (solved.passes.simulated, plan.scene.traffic.passes);
        let of = if simulated < passes {
            format!("{simulated} of {passes} passes were simulated")
        } else {
            format!("{simulated} passes were simulated, some beyond the {passes} of the traffic")
        };
        let why = format!(
            "from pass {} on, passes between these are interpolated",
            first.pass
        );
        reasons.push(format!("{of}; {why}"));
    }
    reasons
}

/// The passes of a period that stands in for the traffic which show the largest forces and
/// movements; and where there are jumps over it, one more of each vehicle that is too seldom for it,
/// as the next one over the cable as it is left.
fn extremes(plan: &Plan<'_>, method: SolverMethod, solved: &Solved) -> Result<Vec<ExtremePass>, Error> {
    let Plan { scene, period, .. } = plan;
    let extreme = |vehicle: usize, record: &Record| ExtremePass {
        vehicle: scene.vehicles[vehicle].name.clone(),
        after: PassRecord::new(record, &scene.traffic),
        restraints_n: record.outcome.restraints.clone(),
        restraint_peaks_n: record.outcome.restraint_ranges.iter().map(peak).collect(),
    };
    let mut extremes = Vec::new();
    if !period.is_own() {
        let a_day = solved.heat.as_ref().map_or(u64::MAX, |heat| heat.passes_per_day);
        extremes.extend(solved.passes.peaks.iter().map(|record| {
            let place = ((record.pass - 1) % a_day) as usize % period.len();
            extreme(period.vehicles[place], record)
        }));
    }
    if method == SolverMethod::PassLaw && !period.absent.is_empty() {
        let task = Task::of(plan, scene, solved.mesh);
        let mut simulation = Simulation::new(&task)?;
        for &vehicle in &period.absent {
            let record = Record {
                pass: scene.traffic.passes + 1,
                outcome: simulation.pass(vehicle, None, &mut solved.passes.state.clone())?,
                interpolated: true,
            };
            extremes.push(extreme(vehicle, &record));
        }
    }
    Ok(extremes)
}

/// Without friction every pass leaves the cable as the first one did: where it was laid.
pub fn without_friction(plan: &Plan<'_>, stages: &[u64]) -> Result<Solved, Error> {
    let (level, mut scene) = (plan.levels.first, plan.scene.clone());
    scene.traffic.passes = 1;
    let mesh = plan.levels.mesh(level)?;
    let task = Task::of(plan, &scene, mesh);
    let mut passes = task.every_pass()?;
    passes.slip = None;
    let force_profile = ForceProfile::new(&task.cable()?, &passes.state)?;
    let stage = |&pass: &u64| Stage {
        pass,
        force_profile: force_profile.clone(),
        friction: None,
    };
    let all = 1..=plan.scene.traffic.passes;
    let looked_at = stages.iter().filter(|pass| all.contains(pass));
    passes.stages = looked_at.map(stage).collect();
    let first = passes.records.pop().ok_or(Error::NoPass)?;
    for pass in listed_passes(plan.scene, &plan.period) {
        passes.records.push(Record {
            pass,
            ..first.clone()
        });
    }
    let reason = "without friction nothing drags the cable: every pass is like the first";
    let error = ErrorParts::new(0.0, 0.0);
    Ok(Solved::new(level, mesh, passes, error, reason.into()))
}

/// The largest in size of a range.
fn peak([least, most]: &[f64; 2]) -> f64 {
    larger(*most, *least)
}

fn restraints(
    plan: &Plan<'_>,
    cable: &DuctedCable,
    state: &CableState,
    records: &[Record],
) -> Result<Vec<RestraintRecord>, Error> {
    let forces = state.restraint_forces(cable)?;
    let slips = state.clamp_slips(cable);
    let of_clamp = |(i, clamp): (usize, &Restraint)| {
        let outcomes = || records.iter().map(|record| &record.outcome);
        let slips_at_all = plan.scene.restraints[i].holds.is_some();
        // One may have been put on later, where the cable had moved.
        let put_on = plan.start.map_or(0.0, |start| start.put_on(clamp));
        let slipped = outcomes().filter(|_| slips_at_all);
        RestraintRecord {
            position_m: clamp.position,
            stiffness_n_per_m: clamp.stiffness,
            force_n: forces[i],
            after_passes_n: outcomes().map(|outcome| outcome.restraints[i]).collect(),
            during_passes_n: outcomes()
                .map(|outcome| peak(&outcome.restraint_ranges[i]))
                .collect(),
            slipped_after_passes_m: slipped
                .map(|outcome| outcome.restraint_slips[i] - put_on)
                .collect(),
            slipped_m: slips_at_all.then(|| slips[i] - put_on),
        }
    };
    Ok(cable.restraints().iter().enumerate().map(of_clamp).collect())
}

/// The passes that are listed; where they are the traffic's own, the others of the period that show more
/// too.
fn shown(plan: &Plan<'_>, passes: &Passes) -> Vec<Record> {
    let listed = listed_passes(plan.scene, &plan.period);
    let is_listed = |record: &Record| listed.binary_search(&record.pass).is_ok();
    let (mut shown, mut others): (Vec<_>, Vec<_>) = passes.records.iter().cloned().partition(is_listed);
    if plan.period.is_own() {
        others.extend(passes.peaks.iter().cloned());
    }
    // On days of heat passes between simulated ones have the peaks of others.
    let simulated = |record: &&Record| plan.scene.warming().is_none() || !record.interpolated;
    let simulated: Vec<Record> = shown.iter().filter(simulated).cloned().collect();
    shown.extend(peaks(&simulated, others));
    shown.sort_by_key(|record| record.pass);
    shown
}
