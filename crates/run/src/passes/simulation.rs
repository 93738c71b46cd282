//! All passes of a scene on one mesh: every one simulated, or few with jumps between them.

use std::collections::BTreeSet;

use cable_dem::{CableState, DuctedCable, PassOutcome, SlipLengths, Statistics};
use cycle_jump::days::Days;
use cycle_jump::{Beyond, Jumps, Next, Record, Request, evolve, peaks};

use super::listing::Listing;
use super::solver::PassSolver;
use super::task::{Jumping, Task};
use crate::answer::differences::{Scale, largest_force};
use crate::answer::{ForceProfile, Stage, balance, passes_beyond};
use crate::tuning::jumps::PATIENCE;
use creepage_plan::{Error, cable::traffic, ground::length_scale};

/// What the passes did, how the cable is left, and what they cost together.
#[derive(Clone)]
pub struct Passes {
    /// What the passes did: all, or of very long traffic those that are listed.
    pub records: Vec<Record>,
    pub state: CableState,
    /// With the vehicle over the duct's middle in the last pass, where the solver can be looked at.
    pub slip: Option<SlipLengths>,
    /// The cable at the passes that were asked for.
    pub stages: Vec<Stage>,
    pub statistics: Statistics,
    /// Passes simulated.
    pub simulated: u64,
    /// The jumps that were taken; empty if every pass was simulated.
    pub schedule: Vec<u64>,
    /// Whether a jump was taken back, so that passes which follow the schedule are not these.
    pub has_rejected: bool,
    /// The most that a jump had missed before it was corrected, as a share of what is large.
    pub missed: f64,
    /// The most that a jump has changed of the forces, as a share of the largest.
    pub changed: f64,
    /// What each pass of the last whole period did; none if nothing was jumped.
    pub period: Vec<PassOutcome>,
    /// Where jumps lead.
    pub beyond: Option<Beyond>,
    /// Passes of the period that are not listed and show more than the records.
    pub peaks: Vec<Record>,
    /// The days, of a cable that is heated every day.
    pub days: Option<Days>,
}

impl Passes {
    /// The largest force on an end, in the cable or on a clamp, at least `least` \[N\].
    pub fn largest_force(&self, least: f64) -> f64 {
        let records = self.records.iter().chain(&self.peaks);
        let of_passes = records.flat_map(|Record { outcome, .. }| {
            let clamps = outcome.restraint_ranges.as_flattened().iter();
            clamps.map(|force| force.abs()).chain([largest_force(outcome)])
        });
        let of_days = self.days.iter().flat_map(|days| {
            let clamps = days.extremes.restraints.as_flattened().iter();
            clamps
                .map(|force| force.abs())
                .chain([days.extremes.largest_force()])
        });
        of_passes.chain(of_days).fold(least, f64::max)
    }
}

/// Passes under way.
pub struct Simulation<'a> {
    task: &'a Task<'a>,
    solver: PassSolver,
    pub cable: DuctedCable,
    /// What is known of them: as yet they begin in its state.
    pub passes: Passes,
    /// Whether passes come in leaps.
    jumps: bool,
    /// The farthest pass so far.
    reached: u64,
}

impl<'a> Simulation<'a> {
    pub fn new(task: &'a Task<'a>) -> Result<Self, Error> {
        let passes = Passes {
            records: Vec::new(),
            state: task.begin()?,
            slip: None,
            stages: Vec::new(),
            statistics: Statistics::default(),
            simulated: 0,
            schedule: Vec::new(),
            has_rejected: false,
            missed: 0.0,
            changed: 0.0,
            period: Vec::new(),
            beyond: None,
            peaks: Vec::new(),
            days: None,
        };
        Ok(Self {
            solver: PassSolver::new(task)?,
            cable: task.cable()?,
            task,
            passes,
            jumps: false,
            reached: 0,
        })
    }

    /// Lets `vehicle` pass: the pass `number`, if it has one. The last is looked at, and those that
    /// were asked for.
    pub fn pass(
        &mut self,
        vehicle: usize,
        number: Option<u64>,
        state: &mut CableState,
    ) -> Result<PassOutcome, Error> {
        let (task, count) = (self.task, self.task.scene.traffic.passes);
        let stage = number.filter(|pass| task.stages.contains(pass));
        let outcome = if stage.is_some() || number == Some(count) {
            let (outcome, friction) = self
                .solver
                .pass_and_look(vehicle, &self.cable, task.mesh, state)?;
            if number == Some(count) {
                self.passes.slip = friction.as_ref().map(|friction| friction.slip_lengths);
            }
            if let Some(pass) = stage {
                self.passes.stages.push(Stage {
                    pass,
                    force_profile: ForceProfile::new(&self.cable, state)?,
                    friction,
                });
            }
            outcome
        } else {
            self.solver.pass(vehicle, state)?
        };
        let number = number.unwrap_or(0);
        balance::of_state(&self.cable, state, number)?;
        self.passes.statistics += outcome.statistics;
        self.reached = self.reached.max(number.min(count));
        let work = |passes: f64| if self.jumps { passes.ln_1p() } else { passes };
        let share = work(self.reached as f64) / work(count as f64);
        task.progress.report(share)?;
        Ok(outcome)
    }
}

impl Task<'_> {
    /// Simulates every pass.
    pub fn every_pass(&self) -> Result<Passes, Error> {
        let mut simulation = Simulation::new(self)?;
        let traffic = traffic(self.scene, self.scene.order())?;
        let count = self.scene.traffic.passes;
        let mut state = simulation.passes.state.clone();
        for (vehicle, pass) in traffic.zip(1..=count) {
            let outcome = simulation.pass(vehicle, Some(pass), &mut state)?;
            simulation.passes.records.push(Record {
                pass,
                outcome,
                interpolated: false,
            });
        }
        (simulation.passes.state, simulation.passes.simulated) = (state, count);
        Ok(simulation.passes)
    }

    /// The jumps of cycle-jump.
    fn jumps(&self, jumping: &Jumping<'_>) -> Result<Jumps, Error> {
        let (scale, size) = (Scale::new(self.scene, self.motions), jumping.size);
        let length_scale = length_scale(self.motions, self.scene.duct.depth);
        let jumps = Jumps::new(size.tolerance, length_scale, (scale.force, scale.movement))?;
        let length = jumping.period.len() as u64;
        let (passes, fewest, most) = PATIENCE;
        let patience = length * (passes / length).clamp(fewest, most);
        let jumps = jumps.with_max_passes(patience, jumping.max_passes.max(patience));
        Ok(jumps.with_start(size.first_periods, size.first_jump)?)
    }

    /// Simulates few passes, with jumps between them; the passes `listed` and the stages are
    /// recorded.
    pub fn with_jumps(&self, jumping: &Jumping<'_>, listed: &[u64]) -> Result<Passes, Error> {
        let mut simulation = Simulation::new(self)?;
        simulation.jumps = true;
        let jumps = self.jumps(jumping)?;
        let (period, count) = (jumping.period, self.scene.traffic.passes);
        let stages = self.stages.iter().filter(|stage| (1..=count).contains(*stage));
        // The row of a stage may be shown by other passes: the stage itself is wanted too.
        let listed: BTreeSet<u64> = listed.iter().chain(stages.clone()).copied().collect();
        let listing = Listing::new(period, listed, count);
        let wanted: BTreeSet<u64> = listing.wanted().chain(stages.copied()).collect();
        let wanted = Vec::from_iter(wanted);
        let beyond = if jumping.beyond {
            passes_beyond(count)
        } else {
            Vec::new()
        };
        let begin = simulation.passes.state.clone();
        let mut request = Request::new(count, &period.vehicles)?;
        (request.wanted, request.beyond) = (&wanted, &beyond);
        (request.looked_at, request.guide) = (self.stages, jumping.guide);
        request.start = Some(&begin);
        request.first_passes = period.first.len() as u64;
        let cable = simulation.cable.clone();
        let pass = |Next { phase, number }, state: &mut CableState| {
            let first = number.and_then(|pass| period.first.get(pass as usize - 1));
            let vehicle = *first.unwrap_or(&period.vehicles[phase]);
            simulation.pass(vehicle, number, state)
        };
        let evolution = evolve(&cable, &self.mesh, &jumps, &request, pass)?;
        // Those within a jump were looked at after the passes at its end.
        simulation.passes.stages.sort_by_key(|stage| stage.pass);
        let records = listing.records(&evolution.records);
        Ok(Passes {
            peaks: peaks(&records, evolution.records),
            records,
            state: evolution.state,
            simulated: evolution.simulated,
            schedule: evolution.schedule,
            has_rejected: evolution.has_rejected,
            missed: evolution.missed,
            changed: evolution.changed,
            period: evolution.period,
            beyond: evolution.beyond,
            ..simulation.passes
        })
    }
}
