//! All days of a scene with heat on one mesh, and what two such runs differ in.

use cable_dem::{CableState, Mesh};
use cycle_jump::days::{DailyHeat, Day, Days, DaysRequest, Extremes, evolve_days};
use cycle_jump::{Guide, Jumps, Next, Record};

use super::listing::listed_passes;
use super::locked_law::locked_law;
use super::passes::{Passes, Simulation, Task, force_profile, seldom_passes};
use crate::answer::error_estimate::{Scale, Shares};
use crate::answer::{DayExtremes, DayPoint, HeatRecord, listed};
use crate::cable::{cable, traffic};
use crate::ground::peak;
use crate::plan::{Period, Plan};
use crate::scene::{DAYS_PER_YEAR, Heat, Scene};
use crate::shown::words_if;
use crate::{Error, Progress};

/// Share of the tolerance that jumps over days may take, and the most that they take: slow two-way creep adds up what larger ones miss.
const JUMPS_SHARE: f64 = 0.5;
const MOST: f64 = 5e-3;
/// Up to so many passes a day all are simulated on a day with real ones; and where a day has no whole sequence.
const FEW: u64 = 100;
/// Days simulated after the first one, before any is jumped over.
const FIRST_DAYS: u64 = 3;
/// Days simulated after which no more are jumped over, and after which the run gives up.
const MOST_DAYS: (u64, u64) = (150, 1000);
const SECONDS_A_DAY: f64 = 86_400.0;

/// Passes and days on one mesh.
#[derive(Clone)]
pub struct Lived {
    pub passes: Passes,
    pub days: Days,
}

/// How days are jumped over.
#[derive(Clone, Copy)]
pub struct Jumping<'a> {
    /// Real periods a day.
    pub knots: u64,
    /// With a quarter of the error and a first jump half as long, which shows the error of the others.
    pub finer: bool,
    /// As another run did, if its jumps are no longer than their errors allow.
    pub guide: Guide<'a>,
}

impl<'a> Jumping<'a> {
    /// With so many real periods a day.
    pub fn with(knots: u64) -> Self {
        let (finer, guide) = (false, Guide::Free);
        Self { knots, finer, guide }
    }

    /// The same jumps as `other` took, as far as their errors allow it.
    pub fn as_in(self, other: &'a Lived) -> Self {
        let guide = Guide::Follow(&other.days.schedule);
        Self { guide, ..self }
    }
}

/// How the days of a plan are lived.
#[derive(Clone, Copy)]
pub struct Living<'a> {
    pub plan: &'a Plan<'a>,
    /// The plan's, or one to compare it with.
    pub period: &'a Period,
    pub heat: &'a Heat,
    pub progress: Progress<'a>,
    pub every_pass: bool,
    /// Place in the period of the traffic with which days begin.
    pub begin: usize,
}

impl<'a> Living<'a> {
    /// The days of `plan`, whose scene has `heat`.
    pub fn new(plan: &'a Plan<'a>, heat: &'a Heat, every_pass: bool, progress: Progress<'a>) -> Self {
        Self {
            plan,
            period: &plan.period,
            heat,
            progress,
            every_pass,
            begin: 0,
        }
    }

    /// Force that a kelvin makes in a cable which cannot move \[N/K\].
    fn per_kelvin(&self) -> f64 {
        self.plan.scene.cable.axial_stiffness * self.heat.expansion
    }

    /// A day of the plan with `knots` real periods.
    pub fn day(&self, knots: u64) -> Result<Day, Error> {
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
        let knots = if few { passes } else { knots };
        Ok(Day::new(passes, self.sequence_of_a_day(), heat, knots)?)
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

    /// Vehicles of the sequence that a day leaves over: where the next day goes on in it, and every day here begins anew.
    fn left_over(&self) -> usize {
        (a_day(self.plan.scene) % self.period.len() as u64) as usize
    }

    /// Whether days that follow from each other all begin with the same vehicle, and the traffic's sequence does not.
    pub fn breaks_sequence(&self) -> bool {
        let traffic = &self.plan.scene.traffic;
        let several = traffic.passes > a_day(self.plan.scene);
        several && !self.every_pass && !self.period.reordered && self.left_over() > 0
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
            begin: self.left_over(),
            ..*self
        }
    }

    /// All days on `level`.
    pub fn live(&self, level: usize, jumping: Jumping<'_>, progress: Progress<'_>) -> Result<Lived, Error> {
        self.live_in(self.plan.scene, level, jumping, progress)
    }

    /// One more pass of each vehicle that is too seldom for the period, after the last one.
    pub fn seldom(&self, mesh: Mesh, state: &CableState) -> Result<Vec<(usize, Record)>, Error> {
        let task = Task {
            scene: self.plan.scene,
            method: self.plan.choice.method.cable_method(),
            motions: &self.plan.ground.motions,
            mesh,
            stages: &[],
            progress: Progress::default(),
        };
        seldom_passes(&task, &self.period.absent, state)
    }

    pub fn live_in(
        &self,
        scene: &Scene,
        level: usize,
        jumping: Jumping<'_>,
        progress: Progress<'_>,
    ) -> Result<Lived, Error> {
        let Plan { ground, levels, .. } = self.plan;
        let period = self.period;
        let mesh = levels.mesh(level)?;
        let task = Task {
            scene,
            method: self.plan.choice.method.cable_method(),
            motions: &ground.motions,
            mesh,
            stages: &[],
            progress,
        };
        let mut simulation = Simulation::new(&task)?;
        let day = self.day(jumping.knots)?;
        let (law, of_law) = locked_law(&task, period, self.sequence_of_a_day())?;
        let count = scene.traffic.passes;
        let scale = Scale::new(scene.friction_limit(), peak(&ground.motions));
        let tolerance = (JUMPS_SHARE * scene.solver.tolerance).min(MOST);
        let (finer, first_jump) = if jumping.finer { (0.25, 0.25) } else { (1.0, 0.5) };
        let least = (scale.force, scale.movement);
        let jumps = Jumps::new(finer * tolerance, levels.length_scale(), least)?
            .with_start(FIRST_DAYS, first_jump)?
            .with_most_passes(MOST_DAYS.0, MOST_DAYS.1);
        let request = DaysRequest {
            passes: count,
            wanted: &listed_passes(scene, self.period),
            wanted_days: &listed(count.div_ceil(day.passes())),
            every_day: self.every_pass,
            guide: jumping.guide,
        };
        let vehicles = &period.vehicles;
        // Where every pass is simulated the vehicles come in their own order.
        let mut order = traffic(scene, scene.order())?;
        let cable = cable(scene)?;
        let lived = evolve_days(
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
        let mut passes = simulation.passes(lived.records.clone(), lived.state.clone(), lived.simulated);
        passes.peaks.clone_from(&lived.peaks);
        passes.statistics += of_law;
        passes.statistics.sweeps += lived.sweeps as usize;
        passes.statistics.node_updates += lived.sweeps as usize * mesh.nodes();
        Ok(Lived { passes, days: lived })
    }

    /// Largest difference on any listed day or pass: of a force as a share of the largest that day, of a movement as a share of the day's range or,
    /// where that is larger, of the movement since laying.
    pub fn difference(&self, one: &Lived, other: &Lived) -> Shares {
        let scale = Scale::new(self.plan.scene.friction_limit(), peak(&self.plan.ground.motions));
        let largest = one.days.extremes.largest_force().max(scale.force);
        let mut worst = self.difference_of_days(one, other);
        for (a, b) in one.passes.records.iter().zip(&other.passes.records) {
            let (a, b) = (a.outcome.force, b.outcome.force);
            let apart = (a.upstream - b.upstream)
                .abs()
                .max((a.downstream - b.downstream).abs());
            worst.force = worst.force.max(apart / largest);
        }
        worst
    }

    /// The same of days alone.
    pub fn difference_of_days(&self, one: &Lived, other: &Lived) -> Shares {
        let scale = Scale::new(self.plan.scene.friction_limit(), peak(&self.plan.ground.motions));
        let of_day = |((_, a), (_, b)): (&(u64, Extremes), &(u64, Extremes))| {
            let places = a.displacement.as_flattened();
            let moved = places
                .iter()
                .fold(scale.movement, |most, place| most.max(place.abs()));
            let (force, movement) = a.difference(b, (scale.force, moved));
            Shares { force, movement }
        };
        let days = one.days.days.iter().zip(&other.days.days);
        days.map(of_day).fold(Shares::default(), Shares::max)
    }

    pub fn reason(&self, lived: &Lived, knots: u64) -> Result<String, Error> {
        let day = self.day(knots)?;
        let Days {
            simulated_days,
            periodic_from,
            ..
        } = lived.days;
        let days = self.plan.scene.traffic.passes.div_ceil(day.passes());
        let real = if day.is_simulated() {
            "all passes".to_owned()
        } else {
            format!("{knots} periods of the traffic")
        };
        let lasting = periodic_from.map_or_else(String::new, |day| {
            format!("; from day {day} on every day is like the one before")
        });
        let others = words_if(simulated_days < days, ", the others follow from them");
        Ok(format!(
            "days: {simulated_days} of {days} were simulated with {real} each{others}{lasting}"
        ))
    }

    pub fn record(&self, lived: &Lived) -> Result<(Vec<DayExtremes>, HeatRecord), Error> {
        let Days {
            days,
            extremes,
            drift,
            periodic_from,
            hot,
            cold,
            ..
        } = &lived.days;
        let passes_per_day = a_day(self.plan.scene);
        let count = self.plan.scene.traffic.passes.div_ceil(passes_per_day);
        let days = days
            .iter()
            .map(|(day, extremes)| DayExtremes::new(*day, extremes))
            .collect();
        let per_kelvin = self.per_kelvin();
        let cycle = lived.days.last_day.iter().map(|row| {
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
            hot_profile: force_profile(&lived.passes.cable, hot)?,
            cold_profile: force_profile(&lived.passes.cable, cold)?,
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
