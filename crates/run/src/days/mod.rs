//! Traffic and daily heat: how many simulated periods a day, on which mesh, and what both leave
//! wrong.
//!
//! Every pass finds the cable at the temperature of its hour, so that the cable never comes to rest
//! as it does without heat: days are jumped over, not passes ([`cycle_jump::days`]). The number of
//! simulated periods a day is doubled on a coarse mesh until twice as many change little; then
//! meshes are refined as for every run.

mod day_simulator;
mod locked_law;
mod record;

use cable_dem::CableError;

use crate::Progress;
use crate::answer::differences::Shares;
use crate::answer::error_estimate::ErrorParts;
use crate::passes::{Passes, RunOptions};
use crate::refine::{MeshLoop, OnMeshes, Solved, Work, on_coarse_level};
use crate::tuning::days::{CAUTION, COARSER, FIRST_PERIODS, FULL_DAYS, HOPELESS, SHARE, STALLED, TYPICAL};
use crate::tuning::meshes::{FINDING, REFINEMENT_COST};
use creepage_plan::tuning::meshes::MAX_NODE_UPDATES;
use creepage_plan::{Error, Plan};
use creepage_scene::{Heat, SolverMethod};
use day_simulator::{DaySimulator, a_day};

/// Carries `plan`, whose scene has `heat`, out, where `error` has what no mesh makes smaller.
pub fn solve(
    plan: &Plan<'_>,
    heat: &Heat,
    method: SolverMethod,
    options: &RunOptions<'_>,
    mut error: ErrorParts,
) -> Result<Solved, Error> {
    let work = Work::default();
    let mut days = DaySimulator {
        plan,
        vehicles: &plan.period.vehicles,
        heat,
        every_pass: method != SolverMethod::PassLaw,
        begin: 0,
        gives_up_early: false,
        periods_a_day: FIRST_PERIODS,
        finer: false,
        work: &work,
    };
    let first = first_level(plan);
    let progress = options.progress.part(0.0, FINDING);
    error.days = find_periods(&mut days, first, progress)?;
    let meshes = MeshLoop {
        plan,
        options,
        simulation: &days,
        below: 1,
        known_error: None,
    };
    let mut solved = meshes.refine(first, options.progress.part(FINDING, 1.0), error)?;
    let progress = options.progress.part(1.0, 1.0);
    solved.error.days = error.days + error_of_days(&days, solved.level, &solved.passes, progress)?;
    solved.statistics = *work.borrow();
    let broken = days.broken_sequence();
    solved.warnings.extend(broken.map(|(_, warning)| warning));
    let known = solved.passes.days.as_ref().ok_or(Error::NoPass)?;
    solved.reasons.push(days.reason(known)?);
    solved.heat = Some(days.record(solved.mesh, known)?);
    Ok(solved)
}

/// The level to begin with: the first whose typical error leaves room for the other parts.
fn first_level(plan: &Plan<'_>) -> usize {
    if plan.levels.named {
        return plan.levels.first;
    }
    let allowed = (1.0 - SHARE) * plan.scene.solver.tolerance;
    let fine = TYPICAL.iter().position(|&error| error <= allowed);
    fine.unwrap_or(TYPICAL.len()).max(1)
}

/// The days on a level that is coarse relative to `level`, if there is one, and that level.
fn coarse(days: &DaySimulator<'_>, level: usize, progress: Progress<'_>) -> Result<(usize, Passes), Error> {
    on_coarse_level(&days.plan.levels, level, COARSER, |level| {
        days.simulate(days.plan.scene, level, None, progress, false)
    })
}

/// Gives `days` as many simulated periods as are enough for `level`, found on a coarser one; and
/// the error that they leave. Where steps between them find no balance or lead nowhere, as under
/// traffic that hardly takes friction's hold away, all passes of a day are simulated.
fn find_periods(days: &mut DaySimulator<'_>, level: usize, progress: Progress<'_>) -> Result<Shares, Error> {
    let allowed = Shares::both(SHARE * days.plan.scene.solver.tolerance);
    let may_simulate_all = FULL_DAYS * a_day(days.plan.scene) <= days.plan.levels.affordable_passes(level);
    let mut search = DaySimulator {
        gives_up_early: may_simulate_all,
        ..*days
    };
    let found = few_periods(&mut search, level, allowed, progress);
    let leads_nowhere = match &found {
        Ok(error) => error.worse() > HOPELESS && !error.is_within(allowed),
        Err(error) => matches!(
            error,
            Error::Jumps(_) | Error::Cable(CableError::NoConvergence { .. })
        ),
    };
    if leads_nowhere && may_simulate_all {
        days.periods_a_day = u64::MAX;
        return Ok(Shares::default());
    }
    days.periods_a_day = search.periods_a_day;
    found
}

/// Doubles the simulated periods of a day until their error is `allowed`, does not fall, or would
/// cost too much to make smaller.
fn few_periods(
    days: &mut DaySimulator<'_>,
    level: usize,
    allowed: Shares,
    mut progress: Progress<'_>,
) -> Result<Shares, Error> {
    if days.day()?.is_simulated() {
        return Ok(Shares::default());
    }
    let (level, mut fewer) = coarse(days, level, progress.next(0.5))?;
    let mut before = f64::INFINITY;
    loop {
        days.periods_a_day *= 2;
        if days.day()?.is_simulated() {
            return Ok(Shares::default());
        }
        let more = days.simulate(days.plan.scene, level, Some(&fewer), progress.next(0.5), false)?;
        let error = days.difference(&more, &fewer).times(CAUTION);
        let next = REFINEMENT_COST.saturating_mul(more.statistics.work());
        let stalls = error.worse() > HOPELESS && error.worse() > STALLED * before;
        if error.is_within(allowed) || stalls || 4 * next > MAX_NODE_UPDATES {
            return Ok(error);
        }
        (fewer, before) = (more, error.worse());
    }
}

/// What jumps over days leave wrong in those of `finest`, another beginning of the sequence, and a
/// period that stands in for the traffic: what they change in days on a mesh that is coarse
/// relative to `level`.
fn error_of_days(
    days: &DaySimulator<'_>,
    level: usize,
    finest: &Passes,
    progress: Progress<'_>,
) -> Result<Shares, Error> {
    let others = days.plan.period.others.iter().filter(|_| !days.every_pass);
    let others = others.map(|(vehicles, share)| (DaySimulator { vehicles, ..*days }, *share));
    let mut others: Vec<(DaySimulator<'_>, f64)> = others.collect();
    // Where the sequence goes on the next day; nor does the traffic keep the hours at which the
    // seldom vehicles of stand-ins come.
    let half = (!others.is_empty()).then_some(days.vehicles.len() / 2);
    let broken = days.broken_sequence();
    let begun_later = broken.map(|(left, _)| left).or(half);
    others.extend(begun_later.map(|begin| (DaySimulator { begin, ..*days }, 1.0)));
    let are_jumped = finest.schedule.iter().any(|length| *length > 0);
    if !are_jumped && others.is_empty() {
        return Ok(Shares::default());
    }
    let (level, own) = coarse(days, level, progress)?;
    let simulate = |days: &DaySimulator<'_>, like: Option<&Passes>| {
        days.simulate(days.plan.scene, level, like, progress, false)
    };
    let mut error = Shares::default();
    if are_jumped {
        let finer = DaySimulator { finer: true, ..*days };
        error = days.difference(&simulate(&finer, None)?, &own);
    }
    for (other, share) in &others {
        let other = simulate(other, Some(&own))?;
        error = error + days.difference_of_days(&own, &other).times(*share);
    }
    Ok(error)
}
