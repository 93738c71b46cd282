//! Traffic and daily heat: how many real periods a day, on which mesh, and what both leave wrong.
//!
//! Every pass finds the cable at the temperature of its hour, so that the cable never comes to rest as it does without heat: jumps over
//! passes are not for it, and crate `cycle-jump` lives its days otherwise ([`cycle_jump::days`]). The number of real periods a day is
//! doubled on a coarse mesh until twice as many change little; then meshes are refined as for every run.

use cable_dem::{CableError, CableState, Statistics};
use cycle_jump::Next;
use cycle_jump::days::{Day, Days, DaysRequest, live};

use super::day;
use super::locked_law::locked_law;
use super::outlook::Work;
use super::passes::{Passes, Simulation, Task, force_profile};
use super::refine::{MAX_NODE_UPDATES, REFINEMENT_COST, Solved, both, judge, mesh_reason};
use crate::answer::error_estimate::{ErrorParts, Scale, Shares, VERIFIED};
use crate::answer::{DayExtremes, DayPoint, HeatRecord, listed, simulated};
use crate::cable::{cable, traffic};
use crate::ground::peak;
use crate::plan::{PassMethod, Plan};
use crate::scene::Heat;
use crate::{Error, Progress};

/// Real periods a day to begin with.
const FIRST_KNOTS: u64 = 24;
/// They are looked for so many levels below the first, where a pass costs a sixteenth.
const COARSER: usize = 2;
/// What twice as many real periods a day change, times this, is the error of as many: it halves, or falls faster.
const CAUTION: f64 = 2.0;
/// Share of the tolerance that days with few real periods may take, and that of days without any.
const SHARE: f64 = 0.5;
const FROZEN_SHARE: f64 = 0.5;
/// Typical errors of the forces on the levels of a mesh, below which none is stated, and what is left of the difference to the level
/// below: measured on nine scenes up to level 3. From level 2 on, 12 nodes a depth, differences fall by a factor of 4 to 14.
const TYPICAL: [f64; 4] = [5e-2, 1.2e-2, 1.5e-3, 4e-4];
const RESOLVED: usize = 2;
const LEFT: f64 = 0.4;
const LEFT_UNRESOLVED: f64 = 2.0;

/// Passes and days on one mesh.
struct Lived {
    passes: Passes,
    days: Days,
}

/// How the days of a plan are lived.
struct Living<'a> {
    plan: &'a Plan<'a>,
    heat: &'a Heat,
    progress: Progress<'a>,
    every_pass: bool,
}

/// Carries `plan`, whose scene has `heat`, out.
pub fn solve(
    plan: &Plan<'_>,
    heat: &Heat,
    method: PassMethod,
    progress: Progress<'_>,
    verify: bool,
    warnings: &mut Vec<String>,
) -> Result<Solved, Error> {
    let living = Living {
        plan,
        heat,
        progress,
        every_pass: matches!(method, PassMethod::EveryPass(_)),
    };
    living.solve(verify, warnings)
}

/// Work that a run of `plan` is expected to take, and the level that it ends on: one run on a coarse mesh tells.
pub fn outlook(plan: &Plan<'_>, heat: &Heat, method: PassMethod) -> Result<(Work, usize), Error> {
    let living = Living {
        plan,
        heat,
        progress: Progress::default(),
        every_pass: false,
    };
    let level = living.first_level();
    let (coarse, lived) = living.coarse(level, FIRST_KNOTS)?;
    let periods = lived.passes.simulated as f64;
    let nodes = plan.levels.mesh(coarse)?.nodes();
    let work = Work::new(&lived.passes.statistics, nodes, periods);
    // That level and the one below; before them, with as many real periods a day and with twice as many, the coarse one.
    let meshes = |work: Work| match (level - coarse).checked_sub(1) {
        Some(below) => work.refined(below) + work.refined(below + 1),
        None => work.refined(level - coarse),
    };
    let all = match method {
        PassMethod::EveryPass(_) => meshes(work.times(plan.scene.traffic.passes as f64 / periods)),
        PassMethod::Jumps(_) => meshes(work) + work.times(3.0),
    };
    Ok((all, level))
}

impl Living<'_> {
    fn solve(&self, verify: bool, warnings: &mut Vec<String>) -> Result<Solved, Error> {
        let Plan {
            scene,
            ground,
            choice,
            levels,
            ..
        } = self.plan;
        let tolerance = scene.solver.tolerance;
        let mut error = ErrorParts::new(ground.accuracy, choice.inertia);
        let mut statistics = Statistics::default();
        let mut level = self.first_level();
        let (knots, left) = self.knots(level, &mut statistics)?;
        error.temperature = left;
        let (mut below, mut finest) = both(
            || {
                level
                    .checked_sub(1)
                    .map_or(Ok(None), |below| self.on_coarse(below, knots))
            },
            || self.live(level, knots, true),
        )?;
        loop {
            statistics += finest.passes.statistics;
            if let Some(coarse) = &below {
                statistics += coarse.passes.statistics;
                let share = if level < RESOLVED { LEFT_UNRESOLVED } else { LEFT };
                let typical = Shares::both(TYPICAL[level.min(TYPICAL.len() - 1)]);
                error.mesh = self.difference(&finest, coarse).times(share).max(typical);
            }
            let costly =
                REFINEMENT_COST.saturating_mul(finest.passes.statistics.node_updates) > MAX_NODE_UPDATES;
            let within = error.total().is_within(Shares::both(tolerance));
            if costly || level >= levels.finest() || below.is_some() && within {
                break;
            }
            level += 1;
            let finer = self.live(level, knots, true)?;
            below = Some(std::mem::replace(&mut finest, finer));
        }
        if below.is_none() || verify {
            let finer = self.live(level + 1, knots, true)?;
            statistics += finer.passes.statistics;
            error.mesh = self.difference(&finest, &finer).times(VERIFIED);
            error.measured = true;
        }
        error.temperature = error.temperature
            + Shares {
                force: finest.days.surprise.0,
                movement: finest.days.surprise.1,
            };
        judge(&error, scene, warnings)?;
        if !self.every_pass {
            warnings.extend(day::broken_sequence(self.plan));
        }
        let mesh = levels.mesh(level)?;
        Ok(Solved {
            reasons: vec![mesh_reason(self.plan, &mesh), self.reason(&finest, knots)],
            heat: Some(self.record(&finest)?),
            mesh,
            passes: finest.passes,
            error,
            statistics,
            random: None,
        })
    }

    /// The level to begin with: the first whose typical error leaves room for the other parts.
    fn first_level(&self) -> usize {
        let levels = &self.plan.levels;
        if levels.named() {
            return levels.first();
        }
        let allowed = (1.0 - SHARE) * self.plan.scene.solver.tolerance;
        let fine = TYPICAL.iter().position(|&error| error <= allowed);
        fine.unwrap_or(TYPICAL.len()).max(1)
    }

    /// The same on a level that may be too coarse for the duct or its motion.
    fn on_coarse(&self, level: usize, knots: u64) -> Result<Option<Lived>, Error> {
        if self.plan.levels.mesh(level).is_err() {
            return Ok(None);
        }
        match self.live(level, knots, false) {
            Err(Error::Cable(CableError::CoarseMesh { .. })) => Ok(None),
            lived => lived.map(Some),
        }
    }

    /// The same on a level that is coarse beside `level`, where there is one, and that level.
    fn coarse(&self, level: usize, knots: u64) -> Result<(usize, Lived), Error> {
        for coarser in level.saturating_sub(COARSER)..level {
            if let Some(lived) = self.on_coarse(coarser, knots)? {
                return Ok((coarser, lived));
            }
        }
        Ok((level, self.live(level, knots, false)?))
    }

    /// Real periods a day that are enough for `level`, found on a coarser one, and what they leave wrong.
    fn knots(&self, level: usize, statistics: &mut Statistics) -> Result<(u64, Shares), Error> {
        let all = self.day(u64::MAX).periods();
        if self.every_pass || self.day(FIRST_KNOTS).is_simulated() {
            return Ok((all, Shares::default()));
        }
        let allowed = Shares::both(SHARE * self.plan.scene.solver.tolerance);
        let mut knots = FIRST_KNOTS;
        let (level, mut fewer) = self.coarse(level, knots)?;
        *statistics += fewer.passes.statistics;
        loop {
            let more = self.live(level, 2 * knots, false)?;
            *statistics += more.passes.statistics;
            let difference = self.difference(&more, &fewer);
            if difference.times(CAUTION).is_within(allowed) {
                return Ok((knots, difference.times(CAUTION)));
            }
            knots *= 2;
            if self.day(knots).is_simulated() {
                return Ok((knots, Shares::default()));
            }
            let costly =
                4 * REFINEMENT_COST.saturating_mul(more.passes.statistics.node_updates) > MAX_NODE_UPDATES;
            if difference.is_within(allowed) || costly {
                return Ok((knots, difference));
            }
            fewer = more;
        }
    }

    /// A day of the plan with `knots` real periods.
    fn day(&self, knots: u64) -> Day {
        day::of(self.plan, self.heat, knots, self.every_pass)
    }

    /// All days on `level`, of which `knots` periods are real on some.
    fn live(&self, level: usize, knots: u64, shown: bool) -> Result<Lived, Error> {
        let Plan {
            scene,
            ground,
            period,
            levels,
            ..
        } = self.plan;
        let mesh = levels.mesh(level)?;
        let task = Task {
            scene,
            method: self.plan.choice.method.cable_method(),
            motions: &ground.motions,
            mesh,
            stages: &[],
            progress: if shown { self.progress } else { Progress::default() },
        };
        let mut simulation = Simulation::new(&task)?;
        let day = self.day(knots);
        let law = locked_law(&task, period, day.period)?;
        let count = scene.traffic.passes;
        let scale = Scale::new(scene.friction_limit(), peak(&ground.motions));
        let days = count.div_ceil(day.passes);
        let request = DaysRequest {
            passes: count,
            wanted: &simulated(&scene.traffic),
            wanted_days: &listed(days),
            tolerance: FROZEN_SHARE * scene.solver.tolerance,
            least: (scale.force, scale.movement),
            every_day: self.every_pass,
        };
        let vehicles = &period.vehicles;
        // Where every pass is simulated the vehicles come in their own order.
        let mut order = traffic(scene, scene.traffic.order.clone())?;
        let cable = cable(scene)?;
        let lived = live(
            &cable,
            &mesh,
            &day,
            law,
            &request,
            |next: Next, state: &mut CableState| {
                let own = if self.every_pass { order.next() } else { None };
                let of_day = next
                    .number
                    .map_or(next.phase as u64, |number| (number - 1) % day.passes);
                let vehicle = own.unwrap_or(vehicles[(of_day % vehicles.len() as u64) as usize]);
                simulation.pass(vehicle, next.number, state)
            },
        )?;
        let mut passes = simulation.passes(lived.records.clone(), lived.state.clone(), lived.simulated);
        passes.statistics.sweeps += lived.sweeps as usize;
        passes.statistics.node_updates += lived.sweeps as usize * mesh.nodes();
        Ok(Lived { passes, days: lived })
    }

    /// Largest difference on any listed day or pass: of a force as a share of the largest that day, of a movement as a share of the day's range or,
    /// where that is larger, of the movement since laying.
    fn difference(&self, one: &Lived, other: &Lived) -> Shares {
        let scale = Scale::new(self.plan.scene.friction_limit(), peak(&self.plan.ground.motions));
        let mut worst = Shares::default();
        for (a, b) in one.days.days.iter().zip(&other.days.days) {
            let places = a.extremes.forward.into_iter().chain(a.extremes.backward);
            let moved = places.fold(scale.movement, |most, place| most.max(place.abs()));
            let (force, movement) = a.extremes.difference(&b.extremes, (scale.force, moved));
            worst = worst.max(Shares { force, movement });
        }
        let largest = one.days.extremes.largest_force().max(scale.force);
        for (a, b) in one.passes.records.iter().zip(&other.passes.records) {
            let (a, b) = (a.outcome.force, b.outcome.force);
            let apart = (a.upstream - b.upstream)
                .abs()
                .max((a.downstream - b.downstream).abs());
            worst.force = worst.force.max(apart / largest);
        }
        worst
    }

    fn reason(&self, lived: &Lived, knots: u64) -> String {
        let day = self.day(knots);
        let Days {
            corrected,
            periodic_from,
            ..
        } = lived.days;
        let days = self.plan.scene.traffic.passes.div_ceil(day.passes);
        let real = if day.is_simulated() {
            "all passes".to_owned()
        } else {
            format!("{knots} periods of the traffic")
        };
        let lasting = periodic_from.map_or_else(String::new, |day| {
            format!("; from day {day} on every day is like the one before")
        });
        format!(
            "days: {corrected} of {days} were simulated with {real} each, the others follow from them{lasting}"
        )
    }

    fn record(&self, lived: &Lived) -> Result<(Vec<DayExtremes>, HeatRecord), Error> {
        let Days {
            days,
            extremes,
            drift,
            periodic_from,
            hot,
            cold,
            ..
        } = &lived.days;
        let count = self.plan.scene.traffic.passes.div_ceil(self.day(1).passes);
        let days = days
            .iter()
            .map(|record| DayExtremes::new(record.day, &record.extremes))
            .collect();
        let day = self.day(1);
        let per_kelvin = self.plan.scene.cable.axial_stiffness * self.heat.expansion;
        let cycle = lived.days.last_day.iter().filter(|row| !row.heat).map(|row| {
            let outcome = &row.outcome;
            DayPoint {
                hour: 24.0 * (row.passes - 0.5) / day.passes as f64,
                warming_k: row.thermal_force / per_kelvin,
                upstream_force_n: outcome.force.upstream,
                downstream_force_n: outcome.force.downstream,
                upstream_displacement_m: outcome.upstream_displacement,
                downstream_displacement_m: outcome.downstream_displacement,
            }
        });
        let record = HeatRecord {
            cycle: cycle.collect(),
            passes_per_day: day.passes,
            all_days: DayExtremes::new(count, extremes),
            periodic_from_day: *periodic_from,
            drift_per_day_m: periodic_from.map(|_| *drift),
            hot_profile: force_profile(&lived.passes.cable, hot)?,
            cold_profile: force_profile(&lived.passes.cable, cold)?,
        };
        Ok((days, record))
    }
}
