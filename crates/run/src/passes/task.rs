//! What is to be simulated on one mesh, and how: every pass, or few with jumps between them.

use std::collections::BTreeSet;

use cable_dem::{CableError, CableState, DuctedCable, Mesh};
use cycle_jump::{Jumps, Next, Record, Request, evolve, peaks};
use ground_field::DuctMotion;

use super::listing::{Listing, listed_passes};
use super::options::Jumping;
use super::simulation::{Passes, Simulation};
use crate::answer::beyond;
use crate::answer::differences::Scale;
use crate::cable::{cable, traffic};
use crate::ground::length_scale;
use crate::plan::Plan;
use crate::scene::{Scene, SolverMethod};
use crate::tuning::jumps::PATIENCE;
use crate::{Error, Progress, SavedState};

/// The passes of a scene on one mesh.
#[derive(Clone, Copy)]
pub struct Task<'a> {
    pub scene: &'a Scene,
    pub method: SolverMethod,
    pub motions: &'a [DuctMotion],
    pub mesh: Mesh,
    /// The state that the passes begin with, if not as laid.
    pub start: Option<&'a SavedState>,
    /// Passes at which the cable is looked at.
    pub stages: &'a [u64],
    pub progress: Progress<'a>,
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
        let record = |(vehicle, pass)| {
            Ok(Record {
                pass,
                outcome: simulation.pass(vehicle, Some(pass), &mut state)?,
                interpolated: false,
            })
        };
        let records = traffic.zip(1..=count).map(record);
        let records = records.collect::<Result<_, Error>>()?;
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
        let stages = self.stages.iter().filter(|stage| (1..=count).contains(*stage));
        // The row of a stage may be shown by other passes: the stage itself is wanted too.
        let listed: BTreeSet<u64> = listed.iter().chain(stages.clone()).copied().collect();
        let listing = Listing::new(period, listed, count);
        let wanted: BTreeSet<u64> = listing.wanted().chain(stages.copied()).collect();
        let wanted: Vec<u64> = wanted.into_iter().collect();
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
        Ok(Passes {
            peaks: peaks(&records, evolution.records),
            schedule: evolution.schedule,
            beyond: evolution.beyond,
            ..simulation.passes(records, evolution.state, evolution.simulated)
        })
    }
}

impl Plan<'_> {
    /// All passes of `scene`, whose ground is that of the plan, on `mesh`, without stages and
    /// progress.
    pub fn task<'a>(&'a self, scene: &'a Scene, mesh: Mesh) -> Task<'a> {
        Task {
            scene,
            method: self.method,
            motions: &self.ground.motions,
            mesh,
            start: self.start,
            stages: &[],
            progress: Progress::default(),
        }
    }
}
