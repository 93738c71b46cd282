//! What a run with daily heat will take.

use cable_dem::Statistics;

use super::days::{COARSER, FIRST_KNOTS, Found, MOST_KNOTS, MOST_LOOKED_FOR};
use super::lived::Living;
use super::outlook::Outlook;
use super::work::Work;
use super::worth::{REFINEMENT_COST, worth};
use crate::answer::error_estimate::{Shares, is_doubtful};
use crate::plan::{PassMethod, Plan};
use crate::scene::Heat;
use crate::{Error, Progress};

/// What an outlook may take \[s\].
const AFFORDABLE: f64 = 2.0;
/// Days of more node updates than this are not computed a second time; those that balance more nodes between real periods are not computed
/// to their end; and days of more than the other are not computed once.
const LOOKED_AT: usize = 200_000_000;
const MOST_UPDATES: f64 = 5e9;
/// Days with real periods after which days mostly repeat.
const DAYS: u64 = 30;

/// What is to be expected of a run of `plan`: its real periods a day are looked for as the run does, and two coarse meshes tell which one is
/// fine enough.
pub fn outlook(plan: &Plan<'_>, heat: &Heat, method: PassMethod) -> Result<Outlook, Error> {
    let living = Living {
        most_balanced: LOOKED_AT,
        ..Living::new(plan, heat, false, Progress::default())
    };
    let first = living.first_level();
    let looked_at = rough(&living, first.saturating_sub(COARSER), FIRST_KNOTS);
    if looked_at.work.0[0] > MOST_UPDATES {
        return Ok(rough(&living, first, FIRST_KNOTS));
    }
    match seen(&living, method, first) {
        // The run tries more real periods a day.
        Err(Error::Jumps(_)) => Ok(rough(&living, first, MOST_KNOTS)),
        outlook => outlook,
    }
}

/// What coarse meshes tell of a run that begins on the level `first`.
fn seen(living: &Living<'_>, method: PassMethod, first: usize) -> Result<Outlook, Error> {
    let plan = living.plan;
    let levels = &plan.levels;
    let mut search = Statistics::default();
    let found = living.knots(first, Some(LOOKED_AT), &mut search)?;
    let Found { knots, left, .. } = found;
    let (knots, (coarse, lived)) = match found.coarse {
        Some(known) => (knots, known),
        None => living.settling(knots, MOST_LOOKED_FOR, |knots| living.coarse(first, knots))?,
    };
    let periods = lived.passes.simulated as f64;
    let nodes = plan.levels.mesh(coarse)?.nodes();
    let work = Work::new(&lived.passes.statistics, nodes, periods, 0.0);
    let cable = method.cable_method();
    let spent = work + Work::new(&search, nodes, 0.0, 0.0);
    let mut level = first;
    if coarse < first && (spent + work.refined(1)).seconds(cable) < AFFORDABLE {
        let (more, finer) = living.settling(knots, MOST_LOOKED_FOR, |knots| {
            living.live(coarse + 1, knots, Progress::default())
        })?;
        if more == knots {
            let worth = worth(plan.scene.solver.tolerance) as f64 / REFINEMENT_COST as f64;
            let is_costly = |level: usize| work.refined(level - coarse).0[0] > worth;
            let is_fine = living.is_fine(coarse + 1, living.difference(&finer, &lived), left);
            level = (first..levels.finest())
                .find(|&level| is_fine(level) || is_costly(level))
                .unwrap_or(levels.finest());
        }
    }
    // Every level from that below the first on.
    let begin = first.saturating_sub(1).max(coarse);
    let meshes =
        |work: Work| (begin..=level).fold(Work::default(), |all, one| all + work.refined(one - coarse));
    let every_pass = meshes(work.times(plan.scene.traffic.passes as f64 / periods));
    let few = meshes(work) + Work::new(&search, nodes, 0.0, 0.0);
    let work = match method {
        PassMethod::EveryPass(_) => every_pass,
        // Where days in another sequence differ too much, every pass is simulated after all.
        PassMethod::Jumps(_)
            if plan.choice.may_simulate && (spent + work + work).seconds(cable) < AFFORDABLE =>
        {
            let sequence = living.sequence_error(first, knots, &mut search)?;
            let is_none = is_doubtful((left + sequence).force, plan.scene.solver.tolerance);
            if is_none { few + every_pass } else { few }
        }
        PassMethod::Jumps(_) => few,
    };
    Ok(Outlook {
        level,
        work,
        mean: work,
        every_pass,
        passes: Shares::default(),
        certain: true,
    })
}

/// What days with so many real periods each take at most on `level` as a rule, before any is computed: heat moves the whole cable.
fn rough(living: &Living<'_>, level: usize, knots: u64) -> Outlook {
    let Plan { scene, levels, .. } = living.plan;
    let day = living.day(knots);
    let days = scene.traffic.passes.div_ceil(day.passes);
    // Two numbers of real periods a day are tried.
    let simulated = 3 * days.min(DAYS) * day.knots * day.period as u64;
    let of = |passes: u64| {
        let mut work = Work::default();
        work.0[0] = levels.whole_cable_updates(level, passes.min(scene.traffic.passes));
        work
    };
    Outlook {
        level,
        work: of(simulated),
        mean: of(simulated),
        every_pass: of(scene.traffic.passes),
        passes: Shares::default(),
        certain: false,
    }
}
