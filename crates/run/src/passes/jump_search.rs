//! Jumps that are good enough: how large they may be, and what they leave wrong.
//!
//! Two runs that differ in the error of a single jump and in the length of the first one differ by
//! about the error of either. Where only early passes are off, every one of them is simulated in
//! the next run; else jumps are smaller there. Each is compared with the one before.

use std::cell::RefCell;

use cable_dem::{CableError, Statistics};
use cycle_jump::{Guide, Record};

use super::draws::{Draw, Draws};
use super::simulation::{Jumping, Passes};
use crate::answer::differences::{Scale, Shares, difference, differences, extremes_difference};
use crate::plan::{Period, Plan};
use crate::tuning::jumps::{
    COST_OF_FINER, FEWEST_DRAWS, FEWEST_FIRST_PERIODS, FINER, FINEST, FIRST, FIRST_LONG_PERIODS,
    FIRST_PASSES, FIRST_PERIODS, LARGEST, LEAST_SHARE, LONG, MANY, MAX_DRAWN_UPDATES, MAX_NODE_UPDATES,
    MOST_DRAWS, MOST_FIRST_PASSES, MOST_FIRST_PERIODS, SHARE, SHORT,
};
use crate::tuning::meshes::REFINEMENT_COST;
use crate::{Error, Progress};

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
    /// The same with half the error of a jump and a first jump half as long.
    fn finer(self) -> Self {
        Self {
            tolerance: FINER * self.tolerance,
            first_jump: FINER * self.first_jump,
            ..self
        }
    }

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

/// Finds jumps for `plan` that take at most their share of its tolerance, or the best that are
/// affordable. `carry_out` simulates all passes on a level and reports how far it is. Returned with
/// them: the work of all runs.
pub fn find<'a>(
    plan: &Plan<'_>,
    scale: Scale,
    progress: Progress<'a>,
    carry_out: impl Fn(usize, &Jumping<'_>, Progress<'a>) -> Result<Passes, Error>,
) -> Result<(Found, Statistics), Error> {
    // How many runs it takes is not known: each is half of what is left.
    let parts = RefCell::new(progress.halving());
    let carry_out = |level, jumping: &Jumping<'_>| {
        let part = parts.borrow_mut()();
        carry_out(level, jumping, part)
    };
    let mut search = Search {
        plan,
        scale,
        allowed: Shares::both(share(plan) * plan.scene.solver.tolerance),
        carry_out: &carry_out,
        statistics: Statistics::default(),
    };
    let mut found = search.jumps()?;
    found.known.error = found.known.error + search.mix_error(&found)?;
    if !plan.period.drawn.is_empty() {
        let draws = search.draws(&found)?;
        found.known.error = found.known.error + draws.error;
        found.draws = Some(draws);
    }
    Ok((found, search.statistics))
}

/// Share of the tolerance that the jumps of `plan` may take: larger ones than the first mesh leaves
/// room for would only make a finer one necessary.
fn share(plan: &Plan<'_>) -> f64 {
    let mesh = plan.levels.expected_error(plan.levels.first()).unwrap_or(0.0);
    let others = mesh + plan.ground.accuracy + plan.choice.inertia;
    (1.0 - others / plan.scene.solver.tolerance).clamp(LEAST_SHARE, SHARE)
}

/// The largest jumps over the passes of `plan` that are tried.
fn largest(plan: &Plan<'_>) -> KnownJumps {
    let length = plan.period.len();
    let first_periods = if length < LONG {
        FIRST_PERIODS
    } else {
        (FIRST_PASSES.div_ceil(length) as u64).clamp(FEWEST_FIRST_PERIODS, FIRST_LONG_PERIODS)
    };
    KnownJumps {
        error: Shares::default(),
        tolerance: (FIRST.0 * plan.scene.solver.tolerance).min(LARGEST),
        first_periods,
        first_jump: FIRST.1,
    }
}

/// The first passes of a random order, which are those of a draw that no mix foretells: two
/// periods, or half of the traffic if that is less.
fn first_drawn(plan: &Plan<'_>) -> u64 {
    let first = (2 * plan.period.len() as u64).min(plan.scene.traffic.passes / 2);
    if plan.period.drawn.is_empty() { 0 } else { first }
}

/// Runs with jumps of one plan, each compared with others.
struct Search<'a> {
    plan: &'a Plan<'a>,
    scale: Scale,
    /// Error that jumps may leave.
    allowed: Shares,
    carry_out: &'a dyn Fn(usize, &Jumping<'_>) -> Result<Passes, Error>,
    /// Work of all runs.
    statistics: Statistics,
}

impl Search<'_> {
    fn simulate(&mut self, level: usize, jumping: &Jumping<'_>) -> Result<Passes, Error> {
        let passes = (self.carry_out)(level, jumping)?;
        self.statistics += passes.statistics;
        Ok(passes)
    }

    /// The passes by `jumps` on the coarsest level on which they are looked for, and that level.
    fn coarsest(&mut self, jumps: KnownJumps) -> Result<(usize, Passes), Error> {
        let Plan {
            scene,
            period,
            levels,
            ..
        } = self.plan;
        let first = levels.first();
        let is_long = scene.duct.length > SHORT * scene.duct.depth;
        let below = match period.len() > MANY {
            true if period.others.is_empty() => 2,
            is_many => usize::from(is_long || is_many),
        };
        for level in first.saturating_sub(below)..first {
            if levels.mesh(level).is_err() {
                continue;
            }
            match self.simulate(level, &jumps.jumping(period)) {
                Err(Error::Cable(CableError::CoarseMesh { .. })) => {}
                passes => return Ok((level, passes?)),
            }
        }
        Ok((first, self.simulate(first, &jumps.jumping(period))?))
    }

    /// The largest jumps whose error is allowed: each is compared with others half as large, or
    /// with the same after more periods of which every pass is simulated if only early passes are
    /// off.
    fn jumps(&mut self) -> Result<Found, Error> {
        let period = &self.plan.period;
        let length = period.len() as u64;
        let mut jumps = largest(self.plan);
        let (level, mut coarse) = self.coarsest(jumps)?;
        let finer = COST_OF_FINER * REFINEMENT_COST.pow((self.plan.levels.first() - level) as u32);
        let mut best = None;
        let mut early = None;
        for _ in 0..FINEST {
            jumps = match early {
                Some(first_periods) => KnownJumps {
                    first_periods,
                    ..jumps
                },
                None => jumps.finer(),
            };
            let fine = match self.simulate(level, &jumps.jumping(period)) {
                Err(Error::Jumps(_)) if best.is_some() => break,
                fine => fine?,
            };
            let start = jumps.first_periods * length;
            let jumped = fine.records.partition_point(|record| record.pass <= start);
            let errors = &differences(&fine.records, &coarse.records, self.scale)[jumped..];
            let bad = errors.iter().rposition(|error| !error.is_within(self.allowed));
            let last_bad = bad.map_or(0, |bad| fine.records[jumped + bad].pass);
            let periods = last_bad / length + 1;
            early = (periods <= MOST_FIRST_PERIODS && last_bad <= MOST_FIRST_PASSES).then_some(periods);
            let next = finer * fine.statistics.node_updates;
            coarse = fine.clone();
            let error = errors.iter().copied().collect();
            best = Some(Found {
                level,
                known: KnownJumps { error, ..jumps },
                passes: fine,
                draws: None,
            });
            if bad.is_none() || early.is_none() && next > MAX_NODE_UPDATES {
                break;
            }
        }
        let mut found = best.expect("the first pair of runs is an answer");
        let is_jumped = found.passes.schedule.iter().any(|&length| length > 0);
        if found.known.error == Shares::default() && is_jumped {
            // Both runs took the same jumps: one that takes others shows their error.
            let first_periods = 2 * found.known.first_periods;
            let others = KnownJumps {
                first_periods,
                ..found.known.finer()
            };
            let others = self.simulate(level, &others.jumping(period))?;
            found.known.error = difference(&found.passes.records, &others.records, self.scale);
        }
        Ok(found)
    }

    /// The passes of `vehicles` in place of the period of the plan, by jumps as good as those that
    /// were found.
    fn in_place(&mut self, found: &Found, vehicles: Vec<usize>) -> Result<Passes, Error> {
        let period = Period {
            vehicles,
            ..self.plan.period.clone()
        };
        let first = found.known.first_periods * self.plan.period.len() as u64;
        let jumping = Jumping {
            guide: Guide::Free,
            first_periods: first.div_ceil(period.len() as u64).max(FEWEST_FIRST_PERIODS),
            ..found.jumping(&period)
        };
        self.simulate(found.level, &jumping)
    }

    /// What random orders of the period leave in the mean, from as many draws as the tolerance
    /// needs or as are affordable.
    fn draws(&mut self, found: &Found) -> Result<Draws, Error> {
        let mut all = Vec::new();
        let mut work = 0;
        loop {
            let vehicles = self.plan.period.draw(all.len() as u64);
            let passes = self.in_place(found, vehicles.clone())?;
            work += passes.statistics.node_updates;
            all.push(Draw { vehicles, passes });
            if all.len() >= FEWEST_DRAWS {
                let draws = Draws::new(&found.passes, &all, first_drawn(self.plan), self.scale);
                let is_enough = work > MAX_DRAWN_UPDATES || all.len() >= MOST_DRAWS;
                if is_enough || draws.error.is_within(self.allowed) {
                    return Ok(draws);
                }
            }
        }
    }

    /// What a period that stands in for the traffic changes: its share of what each other one does,
    /// forces and movements on the passes that both show, and the largest of all.
    fn mix_error(&mut self, found: &Found) -> Result<Shares, Error> {
        let Plan { period, .. } = self.plan;
        let first = first_drawn(self.plan);
        let later = |passes: &Passes| -> Vec<Record> {
            let is_shown = |record: &&Record| {
                record.pass > first && passes.doubtful.binary_search(&record.pass).is_err()
            };
            passes.records.iter().filter(is_shown).cloned().collect()
        };
        let all = |passes: &Passes| -> Vec<Record> { [&later(passes)[..], &passes.peaks].concat() };
        let mut error = Shares::default();
        for (vehicles, share) in &period.others {
            let other = self.in_place(found, vehicles.clone())?;
            let rows = difference(&later(&found.passes), &later(&other), self.scale);
            let extremes = extremes_difference(&all(&found.passes), &all(&other), self.scale);
            // The largest of all passes are not between those of two mixes; of absent vehicles
            // single passes show them.
            let is_absent = vehicles.iter().any(|vehicle| period.absent.contains(vehicle));
            let weight = if is_absent { *share } else { 1.0 };
            error = error + rows.times(*share).max(extremes.times(weight));
        }
        Ok(error)
    }
}

#[cfg(test)]
mod tests {
    use crate::{Scene, run};

    /// A short duct between springs, whose cable lies still after ten passes: the first jump goes
    /// to the end, whatever error is asked for.
    const SETTLED: &str = "
[duct]
length = 12.6
depth = 1.13
[[ground.layers]]
young_modulus = 1.5e8
poisson_ratio = 0.42
[cable]
weight = 168
axial_stiffness = 1.35e7
[friction]
dynamic_coefficient = 0.305
shape_factor = 1.28e6
[ends]
upstream = { spring = 1e5 }
downstream = { spring = 5.35e6 }
[[vehicles]]
speed = 7
load = 1.6e5
[traffic]
passes = 120
";

    #[test]
    fn two_runs_that_take_the_same_jumps_do_not_make_them_exact() {
        let jumped = run(&Scene::from_toml("scene", SETTLED).unwrap()).unwrap();
        let stated = jumped.error_estimate.parts.passes;
        assert!(jumped.cost.simulated_passes < 20 && stated > 0.0, "{stated}");
        let every = SETTLED.to_owned() + "[solver]\nmethod = \"quasi-static\"";
        let every = run(&Scene::from_toml("scene", &every).unwrap()).unwrap();
        for (jumped, every) in jumped.passes.iter().zip(&every.passes) {
            let (force, exact) = (jumped.downstream_peak_n, every.downstream_peak_n);
            assert!((force - exact).abs() <= 0.01 * exact, "{force} {exact}");
        }
    }
}
