//! Jumps that are good enough: how large they may be, and what they leave wrong.
//!
//! Two runs that differ in the error of a single jump and in the length of the first one differ by about the error of either. Where
//! only early passes are off, every one of them is simulated in the next run; else jumps are smaller there. Each is compared with the one before.

use std::cell::RefCell;

use cable_dem::{CableError, Statistics};
use cycle_jump::{Guide, Record};

use super::budget::REFINEMENT_COST;
use super::draws::{Draw, Draws};
use super::passes::{Jumping, Passes};
use crate::answer::error_estimate::{Scale, Shares, difference, differences, extremes_difference};
use crate::plan::{Period, Plan};
use crate::{Error, Progress};

/// Error of a single jump beside the tolerance to begin with, and length of the first jump beside the periods before it; the largest
/// such error.
const FIRST: (f64, f64) = (6.0, 0.8);
const LARGEST: f64 = 0.06;
/// What both are multiplied by, and how often at most. Cut to a third the errors of 237 random scenes are no smaller, and an eighth more passes are
/// simulated.
const FINER: (f64, f64) = (0.5, 0.5);
const FINEST: usize = 8;
/// Share of the tolerance that jumps may take, and at least where the mesh leaves less.
const SHARE: f64 = 0.5;
const LEAST_SHARE: f64 = 0.35;
/// Periods simulated at the start: of one or two vehicles, of more, and fewer of many, about so many passes in all.
const FIRST_PERIODS: u64 = 8;
const FIRST_LONG_PERIODS: u64 = 5;
const LONG: usize = 3;
const FEWEST_FIRST_PERIODS: u64 = 2;
const FIRST_PASSES: usize = 200;
/// And at most where only early jumps are off; and passes in them at most.
const MOST_FIRST_PERIODS: u64 = 48;
const MOST_FIRST_PASSES: u64 = 200;
/// Jumps are looked for on the level below the first, where they cost a fourth, unless the duct is so many depths short: that costs little,
/// and the few nodes that a coarser mesh gives it behave differently. Those over the traffic's own periods of more than so many vehicles are looked
/// for on the level below that one, which spares a sixth of the time of a million passes, and so are draws. What stand-ins change depends more on the mesh.
const SHORT: f64 = 20.0;
const MANY: usize = 48;
/// Finer jumps take about so many times the passes. No finer ones are looked for where they would take more nodes than this on the
/// first level: some ten seconds.
const COST_OF_FINER: usize = 2;
const MAX_NODE_UPDATES: usize = 1_000_000_000;

/// Draws of a random order at least, at most, and as long as they take no more nodes than this.
const FEWEST_DRAWS: usize = 4;
const MOST_DRAWS: usize = 24;
const MAX_DRAWN_UPDATES: usize = 500_000_000;

/// How jumps are taken that are good enough.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct KnownJumps {
    /// What they leave wrong.
    pub error: Shares,
    tolerance: f64,
    first_periods: u64,
    first_jump: f64,
}

impl KnownJumps {
    /// These jumps over `period`, for as long as their errors allow.
    pub fn jumping(self, period: &Period) -> Jumping<'_> {
        Jumping {
            period,
            tolerance: self.tolerance,
            first_periods: self.first_periods,
            first_jump: self.first_jump,
            most_passes: 0,
            guide: Guide::Free,
            simulated: None,
            beyond: false,
        }
    }
}

/// Jumps that are good enough, where they were found.
pub struct Found {
    /// The level they were found on, and its passes.
    pub level: usize,
    pub passes: Passes,
    pub known: KnownJumps,
    /// What a random order changes.
    pub draws: Option<Draws>,
}

impl Found {
    /// The same jumps over `period` again, as long as their errors allow it.
    pub fn jumping<'a>(&'a self, period: &'a Period) -> Jumping<'a> {
        Jumping {
            guide: Guide::Follow(&self.passes.schedule),
            simulated: Some(self.passes.simulated),
            ..self.known.jumping(period)
        }
    }
}

/// Share of the tolerance that the jumps of `plan` may take: larger ones than the first mesh leaves room for would only make a finer one
/// necessary.
fn share(plan: &Plan<'_>) -> f64 {
    let mesh = plan.levels.expected_error(plan.levels.first()).unwrap_or(0.0);
    let others = mesh + plan.ground.accuracy + plan.choice.inertia;
    (1.0 - others / plan.scene.solver.tolerance).clamp(LEAST_SHARE, SHARE)
}

/// Finds jumps for `plan` that take at most their share of its tolerance, or the best that are affordable. `carry_out` simulates all passes
/// on a level and reports how far it is. Returned with them: the work of all other runs.
pub fn find<'a>(
    plan: &Plan<'_>,
    scale: Scale,
    progress: Progress<'a>,
    carry_out: impl Fn(usize, &Jumping<'_>, Progress<'a>) -> Result<Passes, Error>,
) -> Result<(Found, Statistics), Error> {
    // How many runs it takes is not known: each is half of what is left.
    let parts = RefCell::new(progress.halving());
    let simulate = |level, jumping: &Jumping<'_>| {
        let part = parts.borrow_mut()();
        carry_out(level, jumping, part)
    };
    let length = plan.period.len() as u64;
    let allowed = Shares::both(share(plan) * plan.scene.solver.tolerance);
    let duct = plan.scene.duct;
    let first = plan.levels.first();
    let levels_below = if plan.period.len() > MANY && plan.period.others.is_empty() {
        2
    } else {
        usize::from(duct.length > SHORT * duct.depth || plan.period.len() > MANY)
    };
    let is_possible = |level: &usize| *level == first || plan.levels.mesh(*level).is_ok();
    let mut levels = (first.saturating_sub(levels_below)..=first).filter(is_possible);
    let mut level = levels.next().unwrap_or(first);
    let mut taken = largest(plan);
    let mut statistics = Statistics::default();
    let mut coarse = loop {
        match (simulate(level, &taken), levels.next()) {
            (Err(Error::Cable(CableError::CoarseMesh { .. })), Some(finer)) => level = finer,
            (coarse, _) => break coarse?,
        }
    };
    statistics += coarse.statistics;
    let mut best = None;
    // Periods of which every pass is to be simulated, where only those are off.
    let mut early = None;
    for _ in 0..FINEST {
        if let Some(periods) = early {
            taken.first_periods = periods;
        } else {
            taken.tolerance *= FINER.0;
            taken.first_jump *= FINER.1;
        }
        let fine = match simulate(level, &taken) {
            Err(Error::Jumps(_)) if best.is_some() => break,
            fine => fine?,
        };
        statistics += fine.statistics;
        let start = taken.first_periods * length;
        let jumped = fine.records.partition_point(|record| record.pass <= start);
        let errors = &differences(&fine.records, &coarse.records, scale)[jumped..];
        let bad = errors.iter().rposition(|error| !error.is_within(allowed));
        let last_bad = bad.map_or(0, |bad| fine.records[jumped + bad].pass);
        let periods = last_bad / length + 1;
        early = (periods <= MOST_FIRST_PERIODS && last_bad <= MOST_FIRST_PASSES).then_some(periods);
        let work = fine.statistics.node_updates;
        let next = COST_OF_FINER * REFINEMENT_COST.pow((first - level) as u32) * work;
        coarse = fine.clone();
        best = Some(Found {
            level,
            known: KnownJumps {
                error: errors.iter().copied().fold(Shares::default(), Shares::max),
                tolerance: taken.tolerance,
                first_periods: taken.first_periods,
                first_jump: taken.first_jump,
            },
            passes: fine,
            draws: None,
        });
        if bad.is_none() || early.is_none() && next > MAX_NODE_UPDATES {
            break;
        }
    }
    let mut found = best.expect("the first pair of runs is an answer");
    found.known.error = found.known.error + mix_error(plan, &found, scale, simulate, &mut statistics)?;
    if !plan.period.drawn.is_empty() {
        let draws = draws(plan, &found, scale, simulate, &mut statistics)?;
        found.known.error = found.known.error + draws.error;
        found.draws = Some(draws);
    }
    Ok((found, statistics))
}

/// The largest jumps over the passes of `plan` that are tried.
fn largest<'a>(plan: &'a Plan<'_>) -> Jumping<'a> {
    let first_periods = if plan.period.len() < LONG {
        FIRST_PERIODS
    } else {
        (FIRST_PASSES.div_ceil(plan.period.len()) as u64).clamp(FEWEST_FIRST_PERIODS, FIRST_LONG_PERIODS)
    };
    Jumping {
        period: &plan.period,
        tolerance: (FIRST.0 * plan.scene.solver.tolerance).min(LARGEST),
        first_periods,
        first_jump: FIRST.1,
        most_passes: 0,
        guide: Guide::Free,
        simulated: None,
        beyond: false,
    }
}

/// The passes of `vehicles` in place of the period of `plan`, by jumps as good as those that were found.
fn in_place(
    plan: &Plan<'_>,
    found: &Found,
    vehicles: Vec<usize>,
    simulate: impl Fn(usize, &Jumping<'_>) -> Result<Passes, Error>,
) -> Result<Passes, Error> {
    let period = Period {
        vehicles,
        ..plan.period.clone()
    };
    let first = found.known.first_periods * plan.period.len() as u64;
    let jumping = Jumping {
        guide: Guide::Free,
        first_periods: first.div_ceil(period.len() as u64).max(FEWEST_FIRST_PERIODS),
        ..found.jumping(&period)
    };
    simulate(found.level, &jumping)
}

/// The first passes of a random order, which are those of a draw that no mix foretells: two periods, or half of the traffic if that is less.
fn drawn(plan: &Plan<'_>) -> u64 {
    let first = (2 * plan.period.len() as u64).min(plan.scene.traffic.passes / 2);
    if plan.period.drawn.is_empty() { 0 } else { first }
}

/// What random orders of the period of `plan` leave in the mean, from as many draws as the tolerance needs or as are affordable.
fn draws(
    plan: &Plan<'_>,
    found: &Found,
    scale: Scale,
    simulate: impl Fn(usize, &Jumping<'_>) -> Result<Passes, Error>,
    statistics: &mut Statistics,
) -> Result<Draws, Error> {
    let allowed = Shares::both(share(plan) * plan.scene.solver.tolerance);
    let mut all = Vec::new();
    let mut work = 0;
    loop {
        let vehicles = plan.period.draw(all.len() as u64);
        let passes = in_place(plan, found, vehicles.clone(), &simulate)?;
        *statistics += passes.statistics;
        work += passes.statistics.node_updates;
        all.push(Draw { vehicles, passes });
        if all.len() >= FEWEST_DRAWS {
            let draws = Draws::new(&found.passes, &all, drawn(plan), scale);
            if draws.error.is_within(allowed) || work > MAX_DRAWN_UPDATES || all.len() >= MOST_DRAWS {
                return Ok(draws);
            }
        }
    }
}

/// What a period that stands in for the traffic changes: its share of what each other one does, forces and movements on the passes that both
/// show, and the largest of all.
fn mix_error(
    plan: &Plan<'_>,
    found: &Found,
    scale: Scale,
    simulate: impl Fn(usize, &Jumping<'_>) -> Result<Passes, Error>,
    statistics: &mut Statistics,
) -> Result<Shares, Error> {
    let mut error = Shares::default();
    let drawn = drawn(plan);
    let later = |passes: &Passes| -> Vec<Record> {
        let is_shown =
            |record: &&Record| record.pass > drawn && passes.doubtful.binary_search(&record.pass).is_err();
        passes.records.iter().filter(is_shown).cloned().collect()
    };
    for (vehicles, share) in &plan.period.others {
        let other = in_place(plan, found, vehicles.clone(), &simulate)?;
        *statistics += other.statistics;
        let rows = difference(&later(&found.passes), &later(&other), scale);
        let all = |passes: &'_ Passes| -> Vec<Record> { [&later(passes)[..], &passes.peaks].concat() };
        let (own, other) = (all(&found.passes), all(&other));
        let extremes = extremes_difference(&own, &other, scale);
        // The largest of all passes are not between those of two mixes; of absent vehicles single passes show them.
        let is_absent = |vehicle: &usize| plan.period.absent.contains(vehicle);
        let weight = if vehicles.iter().any(is_absent) {
            *share
        } else {
            1.0
        };
        error = error + rows.times(*share).max(extremes.times(weight));
    }
    Ok(error)
}
