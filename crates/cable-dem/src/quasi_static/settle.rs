//! Solving one window: guess, iterate, and where that cycles, or nobody wants it, take the exact step.

use super::active_set::Outcome;
use super::chain::{Contact, Load, Stretch, Tolerance, Trial};
use super::exact;
use super::passage::{Passage, Snapshot};
use super::sweeper::{MAX_GROWTH, Sweeper};
use super::window::{NEGLIGIBLE, Window};
use crate::CableError;
use crate::outcome::{Recorder, Statistics};

impl Sweeper {
    /// Sets anchors and guesses the contact states of a window's nodes: those of the last pass at this vehicle position,
    /// in the first pass those that a node had where this one now stands relative to the vehicle, and elsewhere those
    /// that the node itself had.
    pub(super) fn predict(
        &mut self,
        window: Window,
        snapshot: &Snapshot<'_>,
        passage: &Passage,
        remembered: Option<(Stretch, &[Contact])>,
    ) {
        let Stretch { lo, hi } = window.stretch;
        self.anchor_from(window.stretch);
        if !window.travels {
            return;
        }
        match remembered {
            Some((known, contacts)) if lo <= known.lo && known.hi <= hi => {
                self.trial.contact[known.lo..=known.hi].copy_from_slice(contacts);
            }
            _ => {
                for i in lo..=hi {
                    self.trial.contact[i] = self.by_xi[passage.lattice_index(snapshot.position, i)];
                }
            }
        }
    }

    /// Solves a stretch, growing it until its edges are quiet. The answer is in the trial until it is committed.
    pub(super) fn solve(
        &mut self,
        mut stretch: Stretch,
        snapshot: &Snapshot<'_>,
        tolerance: Tolerance,
        recorder: &mut Recorder,
    ) -> Result<Stretch, CableError> {
        let mut growth = self.margin;
        loop {
            recorder.statistics.windows += 1;
            self.settle(stretch, snapshot, tolerance, recorder)?;
            let Stretch { lo, hi } = stretch;
            if lo > self.free.lo && self.edge_disturbed(lo - 1) {
                stretch.lo = lo.saturating_sub(growth).max(self.free.lo);
                self.anchor_from(Stretch {
                    lo: stretch.lo,
                    hi: lo - 1,
                });
            }
            if hi < self.free.hi && self.edge_disturbed(hi + 1) {
                stretch.hi = (hi + growth).min(self.free.hi);
                self.anchor_from(Stretch {
                    lo: hi + 1,
                    hi: stretch.hi,
                });
            }
            if stretch == (Stretch { lo, hi }) {
                return Ok(stretch);
            }
            growth = (2 * growth).min(MAX_GROWTH);
        }
    }

    /// Anchors and last contact states of the nodes in `stretch`.
    fn anchor_from(&mut self, stretch: Stretch) {
        for i in stretch.lo..=stretch.hi {
            self.anchor[i] = self.r[i] + self.chain.compliance * self.g[i];
        }
        let range = stretch.lo..=stretch.hi;
        self.trial.contact[range.clone()].copy_from_slice(&self.by_node[range]);
    }

    /// Solves one stretch as it is.
    fn settle(
        &mut self,
        stretch: Stretch,
        snapshot: &Snapshot<'_>,
        tolerance: Tolerance,
        recorder: &mut Recorder,
    ) -> Result<(), CableError> {
        let nodes = self.r.len();
        let load = Load {
            adhesion: &snapshot.adhesion[1..=nodes],
            support: &self.support_load,
            anchor: &self.anchor,
        };
        let mut attempt = |trial: &mut Trial, statistics: &mut Statistics| {
            let (outcome, sweeps) = self
                .elimination
                .iterate(&self.chain, &load, stretch, tolerance, trial);
            statistics.sweeps += sweeps;
            statistics.node_updates += sweeps * (stretch.hi - stretch.lo + 1);
            outcome
        };
        if !self.without_iteration && attempt(&mut self.trial, &mut recorder.statistics) == Outcome::Solved {
            return Ok(());
        }
        let touched = exact::contacts(&self.chain, &load, stretch, &mut self.trial);
        recorder.statistics.exact_steps += 1;
        recorder.statistics.corners += touched;
        match attempt(&mut self.trial, &mut recorder.statistics) {
            Outcome::Solved => Ok(()),
            Outcome::Violated(violation) => Err(CableError::NoConvergence {
                vehicle_position: self.mesh.lattice_step() * snapshot.position as f64,
                violation,
            }),
        }
    }

    /// Whether the trial leaves the held node beside the window out of balance.
    fn edge_disturbed(&self, node: usize) -> bool {
        let balancing = self
            .chain
            .balancing_friction(&self.trial.r, &self.support_load, node);
        (balancing - self.g[node]).abs() > NEGLIGIBLE * self.chain.limit
    }
}
