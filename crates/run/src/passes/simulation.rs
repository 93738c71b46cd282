//! All passes of a scene on one mesh: every one simulated, or few with jumps between them.

use cable_dem::{CableError, CableState, DuctedCable, PassOutcome, SigmoidLeak, Statistics};
use cycle_jump::days::Days;
use cycle_jump::{Beyond, Guide, Jumps, Next, Record, Request, evolve, peaks};

use super::listing::{Listing, listed_passes};
use super::solver::PassSolver;
use super::task::Task;
use crate::Error;
use crate::answer::differences::Scale;
use crate::answer::{ForceProfile, SlipRecord, Stage, balance, beyond};
use crate::cable::{cable, traffic};
use crate::ground::length_scale;
use crate::plan::Period;
use crate::tuning::jumps::PATIENCE;

/// How large jumps are.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct JumpSize {
    /// Error of a single jump.
    pub tolerance: f64,
    /// Periods simulated at the start, and length of the first jump beside them.
    pub first_periods: u64,
    pub first_jump: f64,
}

/// How jumps are taken.
#[derive(Debug, Clone, Copy)]
pub struct Jumping<'a> {
    pub period: &'a Period,
    pub size: JumpSize,
    /// Passes after which it is given up.
    pub most_passes: u64,
    pub guide: Guide<'a>,
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
    /// Passes of the period beside the records that show more.
    pub peaks: Vec<Record>,
    /// The days, of a cable that is heated every day.
    pub days: Option<Days>,
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
            records.push(Record {
                pass,
                outcome,
                interpolated: false,
            });
        }
        Ok(simulation.passes(records, state, count))
    }

    /// The jumps of cycle-jump.
    fn jumps(&self, jumping: &Jumping<'_>) -> Result<Jumps, Error> {
        let scale = Scale::new(self.scene, self.motions);
        let length = jumping.period.len() as u64;
        let (passes, fewest, most) = PATIENCE;
        let patience = length * (passes / length).clamp(fewest, most);
        let length_scale = length_scale(self.motions, self.scene.duct.depth);
        let size = jumping.size;
        let jumps = Jumps::new(size.tolerance, length_scale, (scale.force, scale.movement))?
            .with_start(size.first_periods, size.first_jump)?;
        Ok(jumps.with_most_passes(patience, jumping.most_passes.max(patience)))
    }

    /// Simulates few passes, with jumps between them; the passes `listed` and the stages are
    /// recorded.
    pub fn with_jumps(&self, jumping: &Jumping<'_>, listed: &[u64]) -> Result<Passes, Error> {
        let mut simulation = Simulation::new(self)?;
        simulation.jumps = true;
        let jumps = self.jumps(jumping)?;
        let (period, count) = (jumping.period, self.scene.traffic.passes);
        // The row of a stage may be shown by other passes: the stage itself is wanted too.
        let stages = self.stages.iter().filter(|stage| (1..=count).contains(*stage));
        let ascending = |passes: &mut dyn Iterator<Item = u64>| -> Vec<u64> {
            let passes: std::collections::BTreeSet<u64> = passes.collect();
            passes.into_iter().collect()
        };
        let listed = ascending(&mut listed.iter().chain(stages.clone()).copied());
        let listing = Listing::new(period, &listed, count);
        let wanted = ascending(&mut listing.wanted().chain(stages.copied()));
        let beyond = if jumping.beyond { beyond(count) } else { Vec::new() };
        let begin = self.begin()?;
        let mut request = Request::new(count, &period.vehicles)?;
        (request.wanted, request.beyond) = (&wanted, &beyond);
        (request.looked_at, request.guide) = (self.stages, jumping.guide);
        request.start = begin.as_ref();
        request.first_passes = period.first.len() as u64;
        let cable = simulation.cable.clone();
        let pass = |Next { phase, number }, state: &mut CableState| {
            let first = number.and_then(|pass| period.first.get(pass as usize - 1));
            let vehicle = *first.unwrap_or(&period.vehicles[phase]);
            simulation.pass(vehicle, number, state)
        };
        let evolution = evolve(&cable, &self.mesh, &jumps, &request, pass)?;
        let records = listing.records(&evolution.records);
        let peaks = peaks(&records, evolution.records);
        let mut passes = simulation.passes(records, evolution.state, evolution.simulated);
        passes.schedule = evolution.schedule;
        passes.beyond = evolution.beyond;
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
    /// Whether passes come in leaps.
    jumps: bool,
    /// The farthest pass so far.
    reached: u64,
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
        let Task { scene, stages, .. } = self.task;
        let count = scene.traffic.passes;
        let stage = number.filter(|pass| stages.contains(pass));
        let outcome = if stage.is_some() || number == Some(count) {
            let middle = 0.5 * scene.duct.length;
            let (outcome, friction) = self.solver.pass_and_look(vehicle, state, middle)?;
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
        self.reached = self.reached.max(number.unwrap_or(0).min(count));
        let (pass, count) = (self.reached as f64, count as f64);
        let share = if self.jumps {
            pass.ln_1p() / count.ln_1p()
        } else {
            pass / count
        };
        self.task.progress.report(share)?;
        Ok(outcome)
    }

    /// The work so far.
    pub fn statistics(&self) -> Statistics {
        self.statistics
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
            peaks: Vec::new(),
            days: None,
        }
    }
}
