//! Passes under way on one mesh, and what they have come to.

use cable_dem::{CableState, DuctedCable, PassOutcome, Statistics};
use cycle_jump::days::Days;
use cycle_jump::{Beyond, Record};

use super::solver::PassSolver;
use super::task::Task;
use crate::Error;
use crate::answer::{ForceProfile, SlipRecord, Stage, balance};

/// What the passes did, how the cable is left, and what they cost together.
#[derive(Clone)]
pub struct Passes {
    /// What the passes did: all, or of very long traffic those that are listed.
    pub records: Vec<Record>,
    pub state: CableState,
    /// With the vehicle over the duct's middle in the last pass, where the solver can be looked at.
    pub slip: Option<SlipRecord>,
    /// The cable at the passes that were asked for.
    pub stages: Vec<Stage>,
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

/// Passes under way.
pub struct Simulation<'a> {
    task: &'a Task<'a>,
    pub solver: PassSolver,
    pub cable: DuctedCable,
    slip: Option<SlipRecord>,
    stages: Vec<Stage>,
    /// The work so far.
    pub statistics: Statistics,
    /// Whether passes come in leaps.
    pub jumps: bool,
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
        let count = self.task.scene.traffic.passes;
        let stage = number.filter(|pass| self.task.stages.contains(pass));
        let outcome = if stage.is_some() || number == Some(count) {
            let (outcome, friction) = self.solver.pass_and_look(vehicle, state)?;
            if number == Some(count) {
                self.slip = friction.as_ref().map(|friction| friction.slip_lengths);
            }
            if let Some(pass) = stage {
                self.stages.push(Stage {
                    pass,
                    force_profile: ForceProfile::new(&self.cable, state)?,
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

    pub fn passes(mut self, records: Vec<Record>, state: CableState, simulated: u64) -> Passes {
        // Those within a jump are looked at after the passes at its end.
        self.stages.sort_by_key(|stage| stage.pass);
        Passes {
            records,
            state,
            slip: self.slip,
            stages: self.stages,
            statistics: self.statistics,
            simulated,
            schedule: Vec::new(),
            beyond: None,
            peaks: Vec::new(),
            days: None,
        }
    }
}
