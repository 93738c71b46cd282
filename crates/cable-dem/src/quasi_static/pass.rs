//! One pass, forward: the cable in the vehicle's adherent frame, step by step.

use std::collections::HashMap;

use super::memory::PassMemory;
use super::passage::UNBALANCED_SHARE;
use super::passage::{Passage, Snapshot};
use super::supports::Supports;
use super::window::{self, Needed, Room, Window};
use crate::ends::{Balance, EndReader};
use crate::outcome::Recorder;
use crate::step::{Chain, Contact, Load, Prediction, StepSolver, Stretch, count_different, largest};
use crate::{CableError, CableState, DuctedCable, EndForces, Mesh};

/// A window's edge is quiet when the force its last move put on the next node is below this share of [`UNBALANCED_SHARE`].
const QUIET: f64 = 0.25;

/// A stretch that was solved.
struct Solution {
    solved: Stretch,
    /// The part of it that still moves.
    moves: Option<Stretch>,
    /// Nodes whose contact states those at the same distance from the vehicle did not foretell.
    surprises: usize,
}

/// Drives vehicles forward over one cable; allocated once.
#[derive(Debug, Clone)]
pub(super) struct ForwardSolver {
    pub step: StepSolver,
    cable: DuctedCable,
    ends: EndReader,
    supports: Supports,
    room: Room,
    /// State in the adherent frame: r \[m\] and g \[N/m\].
    r: Vec<f64>,
    g: Vec<f64>,
    anchor: Vec<f64>,
    /// Of the cable in the current pass \[N\].
    thermal_force: f64,
    windows: Vec<Window>,
    prediction: Prediction,
    /// Whether the last pass foretold the last step better than `prediction` did.
    recurs: bool,
    /// The last pass of each passage: its windows and contact states. They and `prediction` outlive a pass, so that an answer
    /// depends on earlier passes, by up to 1e-4 of the largest force.
    memories: HashMap<u64, PassMemory>,
    /// What the current pass gathers.
    recorder: Recorder,
    lattice_step: f64,
}

impl ForwardSolver {
    pub fn new(cable: DuctedCable, mesh: &Mesh) -> Self {
        let nodes = mesh.nodes();
        let chain = Chain::new(&cable, mesh, 0.0);
        let screening = chain.compliance * chain.stiffness / mesh.spacing();
        let room = Room::new(chain.free, screening);
        Self {
            supports: Supports::new(&cable, mesh, &chain, room, screening),
            ends: EndReader::new(&cable, mesh),
            room,
            cable,
            step: StepSolver::new(chain),
            r: vec![0.0; nodes],
            g: vec![0.0; nodes],
            anchor: vec![0.0; nodes],
            thermal_force: 0.0,
            windows: Vec::new(),
            prediction: Prediction::default(),
            recurs: true,
            memories: HashMap::new(),
            recorder: Recorder::new(EndForces::default()),
            lattice_step: mesh.lattice_step(),
        }
    }

    /// Drives the vehicle over the cable in `state`, which is changed only on success; `observe` sees r, g and the vehicle at every
    /// step.
    pub fn pass(
        &mut self,
        passage: &Passage,
        state: &mut CableState,
        mut observe: impl FnMut(&[f64], &[f64], Snapshot<'_>),
    ) -> Result<Recorder, CableError> {
        self.r.copy_from_slice(&state.displacement);
        self.g.copy_from_slice(&state.friction);
        self.step.start(largest(&self.r, passage.peak));
        self.step.trial.r.copy_from_slice(&self.r);
        self.supports.rest(state.thermal_force);
        self.thermal_force = state.thermal_force;
        let (points, phases) = passage.lattice();
        self.prediction.fit(points, phases);
        self.recorder = Recorder::new(state.ends(&self.cable));
        let last_pass = self.memories.remove(&passage.id).unwrap_or_default();
        let mut this_pass = PassMemory::default();
        self.recurs = true;

        let mut travelling = None;
        for (step, &position) in passage.positions.iter().enumerate() {
            let snapshot = passage.snapshot(position);
            if step == 0 {
                self.step_whole(&snapshot, passage)?;
            } else {
                let remembered = last_pass.recall(step - 1);
                travelling = self.step_windows(&snapshot, passage, travelling, remembered)?;
                this_pass.push(travelling, &self.step.trial.contact);
            }
            observe(&self.r, &self.g, snapshot);
        }
        self.memories.insert(passage.id, this_pass);

        // The ground comes to rest. What the windows left out of account is settled by the same step.
        self.step_whole(&passage.still(), passage)?;
        state.displacement.copy_from_slice(&self.r);
        state.friction.copy_from_slice(&self.g);
        self.recorder.statistics += self.step.statistics;
        Ok(self.recorder)
    }

    /// One step of the whole cable: from rest to the vehicle's first position, or from its last one to rest.
    fn step_whole(&mut self, snapshot: &Snapshot<'_>, passage: &Passage) -> Result<(), CableError> {
        self.update_supports(snapshot, true);
        self.anchor(self.room.free);
        self.solve(self.room.free, snapshot, passage)?;
        self.record_ends(snapshot);
        Ok(())
    }

    /// One step of the vehicle: solves the windows where the cable moves. Returns the travelling window, shrunk to what still moves.
    fn step_windows(
        &mut self,
        snapshot: &Snapshot<'_>,
        passage: &Passage,
        travelling: Option<Stretch>,
        remembered: Option<(Stretch, &[Contact])>,
    ) -> Result<Option<Stretch>, CableError> {
        self.update_supports(snapshot, false);
        let limit = self.step.chain.limit * (1.0 + UNBALANCED_SHARE);
        let near = self.room.under(snapshot.node, passage.reach);
        let needed = Needed {
            friction: &self.g,
            adhesion: snapshot.adhesion,
            limit,
        };
        let travelling = window::travelling(self.room, near, travelling, &needed);
        let mut windows = std::mem::take(&mut self.windows);
        let known = remembered.map(|(window, _)| window);
        window::collect(&mut windows, travelling, known, self.supports.due());
        let mut moving = None;
        for window in &windows {
            self.anchor(window.stretch);
            if window.travels {
                self.predict(window.stretch, passage.first_point(snapshot), remembered);
            }
            let Solution {
                solved,
                moves,
                surprises,
            } = self.solve(window.stretch, snapshot, passage)?;
            if window.travels {
                moving = moves;
                self.recurs = remembered.is_none_or(|last_pass| self.misses(last_pass) <= surprises);
            }
            let around_supports = if window.travels { None } else { moves };
            self.supports.remember(window.stretch, around_supports);
            let widest = &mut self.recorder.statistics.widest_window;
            *widest = solved.len().max(*widest);
        }
        let touched = windows.iter().any(|window| self.room.near_an_end(window.stretch));
        if touched || self.supports.due().next().is_some() {
            self.record_ends(snapshot);
        }
        self.windows = windows;
        Ok(moving)
    }

    fn update_supports(&mut self, snapshot: &Snapshot<'_>, all: bool) {
        self.recorder.statistics.steps += 1;
        let StepSolver { chain, trial, .. } = &mut self.step;
        let state = (&mut *self.r, &mut *self.g);
        self.recorder.dissipated += self.supports.update(snapshot, all, chain, state, trial);
    }

    /// Anchors of the nodes in `stretch`; their contact states stay those last solved.
    fn anchor(&mut self, stretch: Stretch) {
        let nodes = stretch.nodes();
        let state = self.r[nodes.clone()].iter().zip(&self.g[nodes.clone()]);
        for (anchor, (r, g)) in self.anchor[nodes].iter_mut().zip(state) {
            *anchor = r + self.step.chain.compliance * g;
        }
    }

    /// Guesses the contact states of the travelling window: those of the last pass at this vehicle position, or those that a node had
    /// where this one now stands relative to the vehicle; whichever was right at more nodes in the last step.
    fn predict(&mut self, window: Stretch, first: usize, remembered: Option<(Stretch, &[Contact])>) {
        let contacts = &mut self.step.trial.contact;
        match remembered {
            Some((known, states)) if self.recurs && window.lo <= known.lo && known.hi <= window.hi => {
                contacts[known.nodes()].copy_from_slice(states);
            }
            _ => self.prediction.read(first, window, contacts),
        }
    }

    /// At how many nodes the contact states of the last pass differ from those just solved.
    fn misses(&self, (known, states): (Stretch, &[Contact])) -> usize {
        count_different(&self.step.trial.contact[known.nodes()], states)
    }

    /// Solves a stretch, growing it until its edges are quiet, and makes the answer the state.
    fn solve(
        &mut self,
        mut stretch: Stretch,
        snapshot: &Snapshot<'_>,
        passage: &Passage,
    ) -> Result<Solution, CableError> {
        let mut growth = self.room.margin;
        let slip = loop {
            self.recorder.statistics.windows += 1;
            let load = Load {
                adhesion: snapshot.adhesion,
                support: &self.supports.load,
                anchor: &self.anchor,
                friction: &self.g,
            };
            let solved = self.step.solve(&load, stretch);
            let slip = solved.map_err(|violation| CableError::NoConvergence {
                vehicle_position: self.lattice_step * snapshot.position as f64,
                violation,
            })?;
            let (grown, next) = window::grow(self.room, stretch, growth, |i| self.edge_disturbed(i));
            if grown == stretch {
                break slip;
            }
            if grown.lo < stretch.lo {
                self.anchor(Stretch {
                    lo: grown.lo,
                    hi: stretch.lo - 1,
                });
            }
            if grown.hi > stretch.hi {
                self.anchor(Stretch {
                    lo: stretch.hi + 1,
                    hi: grown.hi,
                });
            }
            (stretch, growth) = (grown, next);
        };
        let StepSolver { chain, trial, .. } = &self.step;
        let moves = window::shrink(stretch, |edge, inner| {
            let moved = (trial.r[inner] - self.r[inner]).abs();
            chain.stiffness * moved <= QUIET * UNBALANCED_SHARE * chain.limit * chain.nodes[edge].tributary
        });
        let nodes = stretch.nodes();
        let (r, g) = (&trial.r[nodes.clone()], &trial.g[nodes.clone()]);
        self.recorder.dissipated += chain.limit * slip;
        self.r[nodes.clone()].copy_from_slice(r);
        self.g[nodes].copy_from_slice(g);
        let first = passage.first_point(snapshot);
        Ok(Solution {
            solved: stretch,
            moves,
            surprises: self.prediction.write(first, stretch, &trial.contact),
        })
    }

    /// Whether the trial leaves the held node beside the window out of balance.
    fn edge_disturbed(&self, node: usize) -> bool {
        let chain = &self.step.chain;
        let balancing = chain.balancing_friction(&self.step.trial.r, &self.supports.load, node);
        (balancing - self.g[node]).abs() > UNBALANCED_SHARE * chain.limit
    }

    /// Records the force on each end with the vehicle at the snapshot's position.
    fn record_ends(&mut self, snapshot: &Snapshot<'_>) {
        self.recorder.record(self.ends.read(
            Balance::AtRest,
            self.thermal_force,
            |node| self.r[node] + snapshot.adherent_at(node),
            |node| self.g[node] + snapshot.adhesion[node],
        ));
    }
}
