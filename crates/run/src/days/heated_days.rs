//! All days of a scene with heat on one mesh, and what two such runs differ in.

use cable_dem::{CableState, EndForces, Mesh};
use cycle_jump::days::{DailyHeat, Day, Days, DaysRequest, Extremes, evolve_days};
use cycle_jump::{Guide, Jumps, Next, Record};

use super::locked_law::locked_law;
use crate::answer::differences::{Scale, Shares, largest_force};
use crate::answer::{DayExtremes, DayPoint, HeatRecord, listed};
use crate::cable::traffic;
use crate::passes::{Passes, Simulation, Task, force_profile, listed_passes, seldom_passes};
use crate::plan::{Period, Plan};
use crate::scene::{DAYS_PER_YEAR, Heat, Scene};
use crate::shown::words_if;
use crate::tuning::days::{FEW, FIRST_DAYS, JUMPS_SHARE, MOST, MOST_DAYS};
use crate::{Error, Progress};

const SECONDS_A_DAY: f64 = 86_400.0;

/// Passes and days on one mesh.
#[derive(Clone)]
pub struct DaysOnMesh {
    pub passes: Passes,
    pub days: Days,
}

/// How days are jumped over.
#[derive(Clone, Copy)]
pub struct DayJumps<'a> {
    /// Simulated periods a day.
    pub periods: u64,
    /// With a quarter of the error and a first jump half as long, which shows the error of the
    /// others.
    pub finer: bool,
    /// As another run did, if its jumps are no longer than their errors allow.
    pub guide: Guide<'a>,
}

impl<'a> DayJumps<'a> {
    /// With so many simulated periods a day.
    pub fn with(periods: u64) -> Self {
        let (finer, guide) = (false, Guide::Free);
        Self {
            periods,
            finer,
            guide,
        }
    }

    /// The same jumps as `other` took, as far as their errors allow it.
    pub fn as_in(self, other: &'a DaysOnMesh) -> Self {
        let guide = Guide::Follow(&other.days.schedule);
        Self { guide, ..self }
    }
}

/// Simulates the days of a plan.
#[derive(Clone, Copy)]
pub struct DaySimulator<'a> {
    pub plan: &'a Plan<'a>,
    /// The plan's, or one to compare it with.
    pub period: &'a Period,
    pub heat: &'a Heat,
    pub every_pass: bool,
    /// Place in the period of the traffic with which days begin.
    pub begin: usize,
}

impl<'a> DaySimulator<'a> {
    /// The days of `plan`, whose scene has `heat`.
    pub fn new(plan: &'a Plan<'a>, heat: &'a Heat, every_pass: bool) -> Self {
        Self {
            plan,
            period: &plan.period,
            heat,
            every_pass,
            begin: 0,
        }
    }

    /// Force that a kelvin makes in a cable which cannot move \[N/K\].
    fn per_kelvin(&self) -> f64 {
        self.plan.scene.cable.axial_stiffness * self.heat.expansion
    }

    /// A day of the plan with `periods` simulated periods.
    pub fn day(&self, periods: u64) -> Result<Day, Error> {
        let scene = self.plan.scene;
        let passes = a_day(scene);
        let per_kelvin = self.per_kelvin();
        let force = |kelvin: f64| per_kelvin * (self.heat.offset + kelvin);
        let heat = if let Some(points) = &self.heat.profile {
            let point = |(seconds, kelvin): &(f64, f64)| (seconds / SECONDS_A_DAY, force(*kelvin));
            DailyHeat::Profile(points.iter().map(point).collect())
        } else {
            let (lowest, highest) = (force(0.0), force(self.heat.daily_swing.unwrap_or(0.0)));
            DailyHeat::Cosine { lowest, highest }
        };
        let sequence = self.period.len();
        let few = passes <= FEW.max(sequence as u64) || self.every_pass;
        let periods = if few { passes } else { periods };
        Ok(Day::new(passes, self.sequence_of_a_day(), heat, periods)?)
    }

    /// Vehicles after which the traffic of a day repeats.
    fn sequence_of_a_day(&self) -> usize {
        // What only measures drives the vehicles of the sequence too.
        if self.every_pass {
            1
        } else {
            self.period.len().min(a_day(self.plan.scene) as usize)
        }
    }

    /// Vehicles of the sequence that a day leaves over: where the next day goes on in it, and every
    /// day here begins anew.
    fn leftover_vehicles(&self) -> usize {
        (a_day(self.plan.scene) % self.period.len() as u64) as usize
    }

    /// Whether days that follow from each other all begin with the same vehicle, and the traffic's
    /// sequence does not.
    pub fn breaks_sequence(&self) -> bool {
        let traffic = &self.plan.scene.traffic;
        let several = traffic.passes > a_day(self.plan.scene);
        several && !self.every_pass && !self.period.reordered && self.leftover_vehicles() > 0
    }

    /// The warning of that.
    pub fn broken_sequence(&self) -> Option<String> {
        let (passes, period) = (a_day(self.plan.scene), self.period.len() as u64);
        self.breaks_sequence().then(|| {
            format!(
                "{passes} vehicles a day are no whole number of times the {period} of the sequence: each day is computed as if it \
                 began the sequence anew, and the error has what another beginning changes; a `traffic.per_day` of {} has none of that",
                (passes / period * period).max(period)
            )
        })
    }

    /// The same days, which begin in the sequence where the first day has left it.
    pub fn begun_later(&self) -> Self {
        Self {
            begin: self.leftover_vehicles(),
            ..*self
        }
    }

    /// All days on `level`.
    pub fn simulate(
        &self,
        level: usize,
        jumping: DayJumps<'_>,
        progress: Progress<'_>,
    ) -> Result<DaysOnMesh, Error> {
        self.simulate_scene(self.plan.scene, level, jumping, progress)
    }

    /// One more pass of each vehicle that is too seldom for the period, after the last one.
    pub fn seldom(&self, mesh: Mesh, state: &CableState) -> Result<Vec<(usize, Record)>, Error> {
        if self.every_pass {
            return Ok(Vec::new());
        }
        let task = self.plan.task(self.plan.scene, mesh);
        seldom_passes(&task, &self.period.absent, state)
    }

    /// Forces and movements that are too small to count.
    fn scale(&self) -> Scale {
        Scale::new(self.plan.scene, &self.plan.ground.motions)
    }

    /// The jumps of cycle-jump, or finer ones.
    fn jumps(&self, finer: bool) -> Result<Jumps, Error> {
        let (scale, levels) = (self.scale(), &self.plan.levels);
        let tolerance = (JUMPS_SHARE * self.plan.scene.solver.tolerance).min(MOST);
        let (finer, first_jump) = if finer { (0.25, 0.25) } else { (1.0, 0.5) };
        let least = (scale.force, scale.movement);
        let jumps = Jumps::new(finer * tolerance, levels.length_scale(), least)?
            .with_start(FIRST_DAYS, first_jump)?;
        Ok(jumps.with_most_passes(MOST_DAYS.0, MOST_DAYS.1))
    }

    /// All days on `level`, as if `scene` were that of the plan.
    pub fn simulate_scene(
        &self,
        scene: &Scene,
        level: usize,
        jumping: DayJumps<'_>,
        progress: Progress<'_>,
    ) -> Result<DaysOnMesh, Error> {
        let period = self.period;
        let mesh = self.plan.levels.mesh(level)?;
        let task = Task {
            progress,
            ..self.plan.task(scene, mesh)
        };
        let mut simulation = Simulation::new(&task)?;
        let day = self.day(jumping.periods)?;
        let (law, of_law) = locked_law(&task, period, self.sequence_of_a_day())?;
        let count = scene.traffic.passes;
        let jumps = self.jumps(jumping.finer)?;
        let (cable, start) = (task.cable()?, task.begin()?);
        let request = DaysRequest {
            passes: count,
            wanted: &listed_passes(scene, self.period),
            wanted_days: &listed(count.div_ceil(day.passes())),
            every_day: self.every_pass,
            start: start.as_ref(),
            guide: jumping.guide,
        };
        let vehicles = &period.vehicles;
        // Where every pass is simulated the vehicles come in their own order.
        let mut order = traffic(scene, scene.order())?;
        let days = evolve_days(
            &cable,
            &mesh,
            (&day, law),
            &jumps,
            &request,
            |next: Next, state: &mut CableState| {
                let own = if self.every_pass { order.next() } else { None };
                let of_day = next
                    .number
                    .map_or(next.phase as u64, |number| (number - 1) % day.passes());
                let place = (of_day + self.begin as u64) % vehicles.len() as u64;
                let vehicle = own.unwrap_or(vehicles[place as usize]);
                simulation.pass(vehicle, next.number, state)
            },
        )?;
        let mut passes = simulation.passes(days.records.clone(), days.state.clone(), days.simulated);
        passes.peaks.clone_from(&days.peaks);
        passes.statistics += of_law;
        passes.statistics.sweeps += days.sweeps as usize;
        passes.statistics.node_updates += days.sweeps as usize * mesh.nodes();
        Ok(DaysOnMesh { passes, days })
    }

    /// Largest difference on any listed day or pass: of a force after a pass or on a day as a share
    /// of the largest that day, of one during a simulated pass as a share of the largest in any
    /// pass, of a movement as a share of the day's range or, where that is larger, of the movement
    /// since laying.
    pub fn difference(&self, one: &DaysOnMesh, other: &DaysOnMesh) -> Shares {
        let scale = self.scale();
        let largest = one.days.extremes.largest_force().max(scale.force);
        let mut worst = self.difference_of_days(one, other);
        let apart = |a: EndForces, b: EndForces| {
            let apart = [a.upstream - b.upstream, a.downstream - b.downstream];
            apart[0].abs().max(apart[1].abs())
        };
        let records = || one.passes.records.iter().zip(&other.passes.records);
        // Passes between simulated ones have the peaks of others.
        let simulated = || records().filter(|(a, b)| !a.interpolated && !b.interpolated);
        let largest_peak = simulated()
            .map(|(a, _)| largest_force(&a.outcome))
            .fold(largest, f64::max);
        for (a, b) in records() {
            worst.force = worst.force.max(apart(a.outcome.force, b.outcome.force) / largest);
        }
        for (Record { outcome: a, .. }, Record { outcome: b, .. }) in simulated() {
            let during = apart(a.peak, b.peak).max(apart(a.lowest, b.lowest));
            worst.force = worst.force.max(during / largest_peak);
        }
        worst
    }

    /// The same of days alone.
    pub fn difference_of_days(&self, one: &DaysOnMesh, other: &DaysOnMesh) -> Shares {
        let scale = self.scale();
        let of_day = |((_, a), (_, b)): (&(u64, Extremes), &(u64, Extremes))| {
            let places = a.displacement.as_flattened();
            let moved = places
                .iter()
                .fold(scale.movement, |most, place| most.max(place.abs()));
            let (force, movement) = a.difference(b, (scale.force, moved));
            Shares { force, movement }
        };
        let days = one.days.days.iter().zip(&other.days.days);
        days.map(of_day).collect()
    }

    pub fn reason(&self, simulated: &DaysOnMesh, periods: u64) -> Result<String, Error> {
        let day = self.day(periods)?;
        let Days {
            simulated_days,
            periodic_from,
            ..
        } = simulated.days;
        let days = self.plan.scene.traffic.passes.div_ceil(day.passes());
        let real = if day.is_simulated() {
            "all passes".to_owned()
        } else {
            format!("{periods} periods of the traffic")
        };
        let lasting = periodic_from.map_or_else(String::new, |day| {
            format!("; from day {day} on every day is like the one before")
        });
        let others = words_if(simulated_days < days, ", the others follow from them");
        Ok(format!(
            "days: {simulated_days} of {days} were simulated with {real} each{others}{lasting}"
        ))
    }

    pub fn record(&self, simulated: &DaysOnMesh) -> Result<(Vec<DayExtremes>, HeatRecord), Error> {
        let Days {
            days,
            extremes,
            drift,
            periodic_from,
            hot,
            cold,
            ..
        } = &simulated.days;
        let passes_per_day = a_day(self.plan.scene);
        let count = self.plan.scene.traffic.passes.div_ceil(passes_per_day);
        let days = days
            .iter()
            .map(|(day, extremes)| DayExtremes::new(*day, extremes))
            .collect();
        let per_kelvin = self.per_kelvin();
        let cycle = simulated.days.last_day.iter().map(|row| {
            let outcome = &row.outcome;
            DayPoint {
                hour: 24.0 * (row.passes as f64 - 0.5) / passes_per_day as f64,
                warming_k: row.thermal_force / per_kelvin,
                upstream_force_n: outcome.force.upstream,
                downstream_force_n: outcome.force.downstream,
                upstream_displacement_m: outcome.upstream_displacement,
                downstream_displacement_m: outcome.downstream_displacement,
            }
        });
        let record = HeatRecord {
            cycle: cycle.collect(),
            passes_per_day,
            all_days: DayExtremes::new(count, extremes),
            periodic_from_day: *periodic_from,
            drift_per_day_m: periodic_from.map(|_| *drift),
            drift_per_year_m: periodic_from.map(|_| DAYS_PER_YEAR * drift),
            hot_profile: force_profile(&simulated.passes.cable, hot)?,
            cold_profile: force_profile(&simulated.passes.cable, cold)?,
        };
        Ok((days, record))
    }
}

/// Whole passes of a day.
fn a_day(scene: &Scene) -> u64 {
    scene
        .traffic
        .per_day
        .map_or(1, |per_day| per_day.round().max(1.0) as u64)
}
