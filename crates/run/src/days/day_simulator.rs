//! All days of a scene with heat on one mesh, and what two such runs differ in.

use cable_dem::{CableState, EndForces};
use cycle_jump::days::{DailyHeat, Day, DaysRequest, Extremes, evolve_days};
use cycle_jump::{Guide, Jumps, Next, Record};

use super::locked_law::locked_law;
use crate::Progress;
use crate::answer::differences::{Scale, Shares};
use crate::answer::{listed, listed_passes};
use crate::passes::{Passes, Simulation, Task};
use crate::refine::{OnMeshes, Work};
use crate::tuning::days::{FEW, MAX_JUMP_ERROR, RESOLVED, SHARE, TYPICAL, WEIGHT, WEIGHT_UNRESOLVED};
use creepage_plan::{Error, Plan, cable::traffic};
use creepage_scene::{Heat, Scene};

/// Days simulated after the first one, before any is jumped over.
const FIRST_DAYS: u64 = 3;
/// Days simulated after which no more are jumped over, and after which the run gives up.
const MAX_DAYS: (u64, u64) = (150, 1000);

const SECONDS_A_DAY: f64 = 86_400.0;

/// Simulates the days of a plan.
#[derive(Clone, Copy)]
pub struct DaySimulator<'a> {
    pub plan: &'a Plan<'a>,
    /// Of the plan's period, or others to compare them with.
    pub vehicles: &'a [usize],
    pub heat: &'a Heat,
    pub every_pass: bool,
    /// Place in the period of the traffic with which days begin.
    pub begin: usize,
    /// Simulated periods a day.
    pub periods_a_day: u64,
    /// Whether it gives up once no more days are jumped over: all passes of a day may be simulated
    /// instead.
    pub gives_up_early: bool,
    /// Whether days are jumped over with a quarter of the error and a first jump half as long,
    /// which shows the error of the others.
    pub finer: bool,
    /// What all days have cost.
    pub work: &'a Work,
}

impl DaySimulator<'_> {
    /// Force that a kelvin makes in a cable which cannot move \[N/K\].
    pub fn per_kelvin(&self) -> f64 {
        self.plan.scene.cable.axial_stiffness * self.heat.expansion
    }

    /// A day of the plan.
    pub fn day(&self) -> Result<Day, Error> {
        let passes = a_day(self.plan.scene);
        let force = |kelvin: f64| self.per_kelvin() * (self.heat.offset + kelvin);
        let point = |(seconds, kelvin): &(f64, f64)| (seconds / SECONDS_A_DAY, force(*kelvin));
        let heat = match &self.heat.profile {
            Some(points) => DailyHeat::Profile(points.iter().map(point).collect()),
            None => DailyHeat::Cosine {
                lowest: force(0.0),
                highest: force(self.heat.daily_swing.unwrap_or(0.0)),
            },
        };
        let few = passes <= FEW.max(self.vehicles.len() as u64) || self.every_pass;
        let periods = if few { passes } else { self.periods_a_day };
        Ok(Day::new(passes, self.sequence_of_a_day(), heat, periods)?)
    }

    /// Vehicles after which the traffic of a day repeats.
    fn sequence_of_a_day(&self) -> usize {
        // What only measures drives the vehicles of the sequence too.
        let most = if self.every_pass { 1 } else { self.vehicles.len() };
        most.min(a_day(self.plan.scene) as usize)
    }

    /// Where the next day goes on in the sequence of the traffic, if days do not begin with the same
    /// vehicle as every day here does; and the warning of that.
    pub fn broken_sequence(&self) -> Option<(usize, String)> {
        let (passes, period) = (a_day(self.plan.scene), self.vehicles.len() as u64);
        let (left, several) = (passes % period, self.plan.scene.traffic.passes > passes);
        let whole = (passes / period * period).max(period);
        let goes_on = !self.every_pass && !self.plan.period.reordered;
        (several && goes_on && left > 0).then(|| {
            let warning = format!(
                "{passes} vehicles a day are no whole number of times the {period} of the sequence: each day is computed as if it \
                 began the sequence anew, and the error has what another beginning changes; a `traffic.per_day` of {whole} has none of \
                 that"
            );
            (left as usize, warning)
        })
    }

    /// Forces and movements that are too small to count.
    fn scale(&self) -> Scale {
        Scale::new(self.plan.scene, &self.plan.ground.motions)
    }

    /// The jumps of cycle-jump.
    fn jumps(&self) -> Result<Jumps, Error> {
        let (scale, levels) = (self.scale(), &self.plan.levels);
        let tolerance = (SHARE * self.plan.scene.solver.tolerance).min(MAX_JUMP_ERROR);
        let (finer, first_jump) = if self.finer { (0.25, 0.25) } else { (1.0, 0.5) };
        let least = (scale.force, scale.movement);
        let jumps =
            Jumps::new(finer * tolerance, levels.length_scale, least)?.with_start(FIRST_DAYS, first_jump)?;
        let (jumping, all) = MAX_DAYS;
        let most = if self.gives_up_early { jumping } else { all };
        Ok(jumps.with_max_passes(jumping, most))
    }

    /// Largest difference on any listed day.
    pub fn difference_of_days(&self, one: &Passes, other: &Passes) -> Shares {
        let scale = self.scale();
        let days = one.days.iter().zip(&other.days);
        let days = days.flat_map(|(one, other)| one.days.iter().zip(&other.days));
        let of_day = |((_, a), (_, b)): (&(u64, Extremes), &(u64, Extremes))| {
            let moved = a.displacement.as_flattened().iter();
            let moved = moved.fold(scale.movement, |most, place| most.max(place.abs()));
            let (force, movement) = a.difference(b, (scale.force, moved));
            Shares { force, movement }
        };
        days.map(of_day).collect()
    }
}

impl OnMeshes for DaySimulator<'_> {
    /// All days of `scene`, that of the plan or one like it, on `level`; over days as `other` has
    /// jumped, as far as errors allow it.
    fn simulate(
        &self,
        scene: &Scene,
        level: usize,
        other: Option<&Passes>,
        progress: Progress<'_>,
        _: bool,
    ) -> Result<Passes, Error> {
        let Self { plan, vehicles, .. } = *self;
        let mesh = plan.levels.mesh(level)?;
        let mut task = Task::of(plan, scene, mesh);
        task.progress = progress;
        let mut simulation = Simulation::new(&task)?;
        let day = self.day()?;
        let (law, of_law) = locked_law(&task, vehicles, self.sequence_of_a_day())?;
        let count = scene.traffic.passes;
        let (cable, start) = (simulation.cable.clone(), simulation.passes.state.clone());
        let schedule = other.and_then(|other| other.days.as_ref());
        let request = DaysRequest {
            passes: count,
            wanted: &listed_passes(scene, &plan.period),
            wanted_days: &listed(count.div_ceil(day.passes())),
            every_day: self.every_pass,
            start: Some(&start),
            guide: schedule.map_or(Guide::Free, |days| Guide::Follow(&days.schedule)),
        };
        // Where every pass is simulated the vehicles come in their own order.
        let mut order = traffic(scene, scene.order())?;
        let pass = |next: Next, state: &mut CableState| {
            let own = if self.every_pass { order.next() } else { None };
            let of_day = next
                .number
                .map_or(next.phase as u64, |number| (number - 1) % day.passes());
            let place = (of_day + self.begin as u64) % vehicles.len() as u64;
            simulation.pass(own.unwrap_or(vehicles[place as usize]), next.number, state)
        };
        let days = evolve_days(&cable, &mesh, (&day, law), &self.jumps()?, &request, pass)?;
        let mut statistics = simulation.passes.statistics;
        statistics += of_law;
        statistics.sweeps += days.sweeps as usize;
        statistics.node_updates += days.sweeps as usize * mesh.nodes();
        *self.work.borrow_mut() += statistics;
        Ok(Passes {
            records: days.records.clone(),
            state: days.state.clone(),
            statistics,
            simulated: days.simulated,
            schedule: days.schedule.clone(),
            peaks: days.peaks.clone(),
            days: Some(days),
            ..simulation.passes
        })
    }

    /// Largest difference on any listed day or pass: of a force as a share of the largest of all
    /// days, of a movement as a share of the day's range or, where that is larger, of the movement
    /// since laying.
    fn difference(&self, one: &Passes, other: &Passes) -> Shares {
        let of_all = one.days.iter().map(|days| days.extremes.largest_force());
        let of_all = of_all.fold(self.scale().force, f64::max);
        let apart = |a: EndForces, b: EndForces| {
            let upstream = (a.upstream - b.upstream).abs();
            upstream.max((a.downstream - b.downstream).abs())
        };
        let of_pass = |(one, other): (&Record, &Record)| {
            let (a, b) = (&one.outcome, &other.outcome);
            let after = apart(a.force, b.force);
            // Passes between simulated ones have the peaks of others.
            let has_peaks = !one.interpolated && !other.interpolated;
            let during = || apart(a.peak, b.peak).max(apart(a.lowest, b.lowest));
            if has_peaks { after.max(during()) } else { after }
        };
        let worst = one.records.iter().zip(&other.records).map(of_pass);
        let days = self.difference_of_days(one, other);
        Shares {
            force: days.force.max(worst.fold(0.0, f64::max) / of_all),
            ..days
        }
    }

    fn mesh_error(&self, level: usize, meshes: &[Passes]) -> Shares {
        let [.., coarse, fine] = meshes else {
            return Shares::default();
        };
        // Place of the mesh among those with typical errors.
        let fineness = self.plan.levels.fineness(level).min(TYPICAL.len() - 1);
        let is_resolved = fineness >= RESOLVED;
        let weight = if is_resolved { WEIGHT } else { WEIGHT_UNRESOLVED };
        let typical = Shares::both(TYPICAL[fineness]);
        self.difference(fine, coarse).times(weight).max(typical)
    }
}

/// Whole passes of a day.
pub fn a_day(scene: &Scene) -> u64 {
    scene.traffic.per_day.unwrap_or(1.0).round().max(1.0) as u64
}
