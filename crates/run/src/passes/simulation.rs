//! All passes of a scene on one mesh: every one simulated, or few with jumps between them.

use cable_dem::{CableError, CableState, DuctedCable, PassOutcome, SigmoidLeak, Statistics};
use cycle_jump::{Beyond, Guide, Jumps, Next, Record, Request, evolve};

use super::listing::{Listing, listed_passes};
use super::solver::PassSolver;
use super::task::Task;
use crate::Error;
use crate::answer::differences::Scale;
use crate::answer::{ForceProfile, SlipRecord, Stage, balance, beyond};
use crate::cable::{cable, traffic};
use crate::ground::length_scale;
use crate::plan::Period;
use crate::tuning::jumps::{DOUBTFUL, FEW, PATIENCE, PATIENCE_WITH_MANY};

/// How jumps are taken.
#[derive(Debug, Clone, Copy)]
pub struct Jumping<'a> {
    pub period: &'a Period,
    /// Error of a jump.
    pub tolerance: f64,
    /// Periods simulated at the start, and length of the first jump beside them.
    pub first_periods: u64,
    pub first_jump: f64,
    /// Passes after which it is given up.
    pub most_passes: u64,
    pub guide: Guide<'a>,
    /// About how many passes they leave to be simulated, where that is known.
    pub simulated: Option<u64>,
    /// Whether it is followed where the forces lead.
    pub beyond: bool,
}

/// What the passes did, how the cable is left, and what they cost together.
#[derive(Clone)]
pub struct Passes {
    /// What the passes did: all, or of very long traffic those that are listed.
    pub records: Vec<Record>,
    pub cable: DuctedCable,
    pub state: CableState,
    /// With the vehicle over the duct's middle in the last pass, where the solver can be looked at.
    pub slip: Option<SlipRecord>,
    /// The cable at the passes that were asked for.
    pub stages: Vec<Stage>,
    /// What a law without memory loses.
    pub leaks: Vec<SigmoidLeak>,
    /// The explicit solver's time step and what limits it.
    pub step_limits: Option<String>,
    pub statistics: Statistics,
    /// Passes simulated.
    pub simulated: u64,
    /// The jumps that were taken; empty where every pass was simulated.
    pub schedule: Vec<u64>,
    /// Where jumps lead.
    pub beyond: Option<Beyond>,
    /// Passes of the records that are not shown: other vehicles before them than those of the
    /// period would leave other forces.
    pub doubtful: Vec<u64>,
    /// Passes of the period beside them that show more.
    pub peaks: Vec<Record>,
}

/// Force along the cable as it is left in `state`.
pub fn force_profile(cable: &DuctedCable, state: &CableState) -> Result<ForceProfile, Error> {
    let force_n: Vec<f64> = state.element_forces(cable)?.collect();
    Ok(ForceProfile {
        positions_m: (0..force_n.len())
            .map(|i| state.node_spacing() * (i as f64 + 0.5))
            .collect(),
        force_n,
    })
}

impl Task<'_> {
    /// The cable, held where the passes begin.
    pub fn cable(&self) -> Result<DuctedCable, CableError> {
        self.start
            .map_or_else(|| cable(self.scene), |start| start.cable(self.scene))
    }

    /// The cable before the first pass, if not as laid.
    pub fn begin(&self) -> Result<Option<CableState>, CableError> {
        self.start
            .map(|start| start.on(self.scene, &self.mesh))
            .transpose()
    }

    /// Simulates every pass, or few where there is a `way` to jump over the others.
    pub fn carry_out(&self, way: Option<&Jumping<'_>>) -> Result<Passes, Error> {
        match way {
            Some(way) => self.with_jumps(way, &listed_passes(self.scene, way.period)),
            None => self.every_pass(),
        }
    }

    /// Simulates every pass.
    pub fn every_pass(&self) -> Result<Passes, Error> {
        let mut simulation = Simulation::new(self)?;
        let traffic = traffic(self.scene, self.scene.order())?;
        let count = self.scene.traffic.passes;
        let mut state = self.begin()?.unwrap_or_else(|| simulation.solver.at_rest());
        let mut records = Vec::new();
        for (vehicle, pass) in traffic.zip(1..=count) {
            let outcome = simulation.pass(vehicle, Some(pass), &mut state)?;
            let record = Record {
                pass,
                outcome,
                interpolated: false,
            };
            records.push(record);
        }
        Ok(simulation.passes(records, state, count))
    }

    /// The jumps of cycle-jump.
    fn jumps(&self, jumping: &Jumping<'_>) -> Result<Jumps, Error> {
        let scale = Scale::new(self.scene, self.motions);
        let length = jumping.period.len() as u64;
        let patience = (PATIENCE * length.min(FEW)).max(PATIENCE_WITH_MANY * length);
        let length_scale = length_scale(self.motions, self.scene.duct.depth);
        let jumps = Jumps::new(jumping.tolerance, length_scale, (scale.force, scale.movement))?
            .with_start(jumping.first_periods, jumping.first_jump)?;
        Ok(jumps.with_most_passes(patience, jumping.most_passes.max(patience)))
    }

    /// Simulates few passes, with jumps between them; the passes `listed` and the stages are
    /// recorded.
    pub fn with_jumps(&self, jumping: &Jumping<'_>, listed: &[u64]) -> Result<Passes, Error> {
        let Self { scene, mesh, .. } = self;
        let mut simulation = Simulation::new(self)?;
        simulation.jumps = true;
        simulation.foreseen = jumping.simulated;
        let jumps = self.jumps(jumping)?;
        let count = scene.traffic.passes;
        // The row of a stage may be shown by another pass: the stage itself is wanted too.
        let with_stages = |mut passes: Vec<u64>| {
            passes.extend(self.stages.iter().filter(|stage| (1..=count).contains(*stage)));
            passes.sort_unstable();
            passes.dedup();
            passes
        };
        let listing = Listing::new(
            scene,
            jumping.period,
            jumping.first_periods,
            &with_stages(listed.to_vec()),
        )?;
        let wanted = with_stages(listing.wanted());
        let beyond = if jumping.beyond { beyond(count) } else { Vec::new() };
        let (first, last) = listing.one_by_one;
        // Jumps end before the last passes, in which the scene's own vehicles drive.
        let mut request = Request::new(count - last, &jumping.period.vehicles)?;
        (request.wanted, request.beyond) = (&wanted, &beyond);
        (request.looked_at, request.first_passes) = (self.stages, first);
        request.guide = jumping.guide;
        let begin = self.begin()?;
        request.start = begin.as_ref();
        let cable = simulation.cable.clone();
        let mut evolution = evolve(&cable, mesh, &jumps, &request, |Next { phase, number }, state| {
            let vehicle = listing.vehicle(jumping.period, phase, number);
            simulation.pass(vehicle, number, state)
        })?;
        for pass in count - last + 1..=count {
            let vehicle = listing.vehicle(jumping.period, 0, Some(pass));
            let outcome = simulation.pass(vehicle, Some(pass), &mut evolution.state)?;
            evolution.simulated += 1;
            evolution.records.push(Record {
                pass,
                outcome: outcome.moved(evolution.offset),
                interpolated: false,
            });
        }
        let records = listing.records(&evolution);
        let doubtful = listing.doubtful(&evolution, &records, DOUBTFUL * scene.solver.tolerance);
        let is_shown = |record: &&Record| doubtful.binary_search(&record.pass).is_err();
        let shown: Vec<Record> = records.iter().filter(is_shown).cloned().collect();
        let peaks = listing.peaks(&evolution, &shown);
        let mut passes = simulation.passes(records, evolution.state, evolution.simulated);
        passes.schedule = evolution.schedule;
        passes.beyond = evolution.beyond;
        passes.doubtful = doubtful;
        passes.peaks = peaks;
        Ok(passes)
    }
}

/// One pass of each of these `vehicles`, each as the next one over the cable in `state`.
pub fn seldom_passes(
    task: &Task<'_>,
    vehicles: &[usize],
    state: &CableState,
) -> Result<Vec<(usize, Record)>, Error> {
    let mut simulation = Simulation::new(task)?;
    let pass = |&vehicle: &usize| {
        let outcome = simulation.pass(vehicle, None, &mut state.clone())?;
        let record = Record {
            pass: task.scene.traffic.passes + 1,
            outcome,
            interpolated: true,
        };
        Ok((vehicle, record))
    };
    vehicles.iter().map(pass).collect()
}

/// Passes under way.
pub struct Simulation<'a> {
    task: &'a Task<'a>,
    solver: PassSolver,
    cable: DuctedCable,
    slip: Option<SlipRecord>,
    stages: Vec<Stage>,
    statistics: Statistics,
    /// Whether passes come in leaps; then about how many are simulated, where that is known.
    jumps: bool,
    foreseen: Option<u64>,
    /// The farthest pass so far, and how many are simulated.
    reached: u64,
    simulated: u64,
}

impl<'a> Simulation<'a> {
    pub fn new(task: &'a Task<'a>) -> Result<Self, Error> {
        Ok(Self {
            solver: PassSolver::new(task)?,
            cable: task.cable()?,
            task,
            slip: None,
            stages: Vec::new(),
            statistics: Statistics::default(),
            jumps: false,
            foreseen: None,
            reached: 0,
            simulated: 0,
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
        let Task {
            scene,
            stages,
            progress,
            ..
        } = self.task;
        let count = scene.traffic.passes;
        let stage = number.filter(|pass| stages.contains(pass));
        let outcome = if stage.is_some() || number == Some(count) {
            let (outcome, friction) = self
                .solver
                .pass_and_look(vehicle, state, 0.5 * scene.duct.length)?;
            if number == Some(count) {
                self.slip = friction.as_ref().map(|friction| friction.slip_lengths);
            }
            if let Some(pass) = stage {
                self.stages.push(Stage {
                    pass,
                    force_profile: force_profile(&self.cable, state)?,
                    friction,
                });
            }
            outcome
        } else {
            self.solver.pass(vehicle, state)?
        };
        balance::of_state(&self.cable, state, number.unwrap_or(0))?;
        self.statistics += outcome.statistics;
        self.simulated += 1;
        self.reached = self.reached.max(number.unwrap_or(0).min(count));
        progress.report(self.share())?;
        Ok(outcome)
    }

    /// The work so far.
    pub fn statistics(&self) -> Statistics {
        self.statistics
    }

    /// The share of the work done.
    fn share(&self) -> f64 {
        let (pass, count) = (self.reached as f64, self.task.scene.traffic.passes as f64);
        match self.foreseen {
            Some(all) => (self.simulated as f64 / all as f64).min(1.0),
            None if self.jumps => pass.ln_1p() / count.ln_1p(),
            None => pass / count,
        }
    }

    pub fn passes(mut self, records: Vec<Record>, state: CableState, simulated: u64) -> Passes {
        // Those within a jump are looked at after the passes at its end.
        self.stages.sort_by_key(|stage| stage.pass);
        Passes {
            records,
            state,
            slip: self.slip,
            stages: self.stages,
            leaks: self.solver.leaks(),
            step_limits: self.solver.step_limits(),
            cable: self.cable,
            statistics: self.statistics,
            simulated,
            schedule: Vec::new(),
            beyond: None,
            doubtful: Vec::new(),
            peaks: Vec::new(),
        }
    }
}
