//! One pass: the cable in the vehicle's adherent frame, step by step.

use std::ops::Range;

use friction_chain::{ChainError, Clamp, Contact, ImplicitStep, Load, Stretch};

use super::QuasiStatic;
use super::passage::{Passage, SLIPPING_SHARE, Snapshot};
use super::window::{self, Window};
use crate::chain::{MAX_ROUNDING, MAX_ROUNDS, PRESSED};
use crate::tuning::{GROWN, UNBALANCED_SHARE, UNBALANCED_SUPPORT};
use crate::{CableError, CableState, PassOutcome};

/// Solves at most in which clamps change between sticking and sliding: a few are right at once.
const MAX_CORRECTIONS: usize = 100;

/// Share of the friction limit by which a node that sticks may exceed it: many are at the limit, and rounding is not to decide of them.
const ROUNDED: f64 = 1e-6;

impl QuasiStatic {
    /// Drives the vehicle over the cable in `state`, which is changed only on success; `observe` is called as in
    /// [`QuasiStatic::pass_observed`].
    pub(super) fn drive(
        &mut self,
        passage: &Passage,
        state: &mut CableState,
        mut observe: impl FnMut(f64, &dyn Fn() -> CableState),
    ) -> Result<PassOutcome, CableError> {
        self.begin(passage, state);
        let mut last = passage.still();
        let mut watched = self.bounds.free;
        for (step, &position) in passage.positions.iter().enumerate() {
            let snapshot = passage.snapshot(position);
            let under = self.bounds.under(snapshot.node, passage.reach);
            // A node is looked at once more where adhesion no longer reaches it.
            let near = watched.hull(under);
            if step == 0 {
                self.move_duct(&last, &snapshot, Some(self.bounds.free));
                self.step_whole(&snapshot)?;
            } else {
                self.move_duct(&last, &snapshot, self.strained(&snapshot, near));
                self.step_windows(&snapshot, near, passage.first_point(&snapshot))?;
            }
            (last, watched) = (snapshot, under);
            let vehicle = self.mesh.lattice_step() * position as f64;
            observe(vehicle, &|| self.shown(&snapshot, state));
        }

        let still = passage.still();
        self.come_to_rest(&last, &still)?;
        self.outcome.statistics.steps = passage.positions.len() + 1;
        *state = self.shown(&still, state);
        let (work, statistics) = (self.step.work, &mut self.outcome.statistics);
        (statistics.sweeps, statistics.cycles) = (work.solves, work.cycles);
        statistics.node_updates = work.node_updates;
        std::mem::take(&mut self.outcome).ended(&self.cable, state)
    }

    /// Begins a pass over the cable in `state`.
    fn begin(&mut self, passage: &Passage, state: &CableState) {
        self.r.copy_from_slice(&state.displacement);
        self.g.copy_from_slice(&state.friction);
        self.step.begin(&self.r, passage.peak);
        let compliance = self.cable.friction().compliance();
        for (anchor, (r, g)) in self.anchor.iter_mut().zip(self.r.iter().zip(&self.g)) {
            *anchor = r + compliance * g;
        }
        let clamps = self.clamps.stuck(&state.clamp_slips);
        self.step.chain.set_clamps(&clamps);
        self.supports
            .rest(self.cable.loads(&self.mesh, state.thermal_force));
        self.thermal_force = state.thermal_force;
        self.predicted.clear();
        self.predicted.resize(passage.points(), Contact::Stuck);
        let (u, f) = (|i: usize| state.displacement[i], |i: usize| state.friction[i]);
        let forces = self.clamps.forces(&clamps, self.cable.restraints(), u);
        self.outcome = PassOutcome::of_forces(self.ends.read(self.thermal_force, u, f), forces);
    }

    /// The cable under `snapshot`; clamps that never slip keep what they had in `before`.
    fn shown(&self, snapshot: &Snapshot<'_>, before: &CableState) -> CableState {
        let mut state = before.clone();
        for node in 0..self.mesh.nodes() {
            state.displacement[node] = self.r[node] + snapshot.adherent_at(node);
            state.friction[node] = self.g[node] + snapshot.adhesion[node];
        }
        self.clamps
            .store(self.step.chain.clamps(), &mut state.clamp_slips);
        state
    }

    /// The part of a duct with bends, `near` the vehicle, that windows may take in of what begins to slip: around the first and the last
    /// node whose friction exceeds the least limit.
    fn strained(&self, snapshot: &Snapshot<'_>, near: Stretch) -> Option<Stretch> {
        if self.bends.is_empty() {
            return None;
        }
        let least = (1.0 + SLIPPING_SHARE) * self.cable.least_limit();
        let exceeds = |&node: &usize| (self.g[node] + snapshot.adhesion[node]).abs() > least;
        let mut nodes = near.nodes();
        let lo = nodes.find(exceeds)?;
        let hi = nodes.rfind(exceeds).unwrap_or(lo);
        Some(
            self.bounds
                .widened(Stretch { lo, hi }, self.bounds.margin + GROWN),
        )
    }

    /// Brings loads, fixed ends and friction limits from the snapshot `last` to the next one. The cable presses on the bends with the
    /// force that it had, where it moved, at supports and in a `part`. Returned: the largest change of a friction limit there, as a share of it.
    fn move_duct(&mut self, last: &Snapshot<'_>, snapshot: &Snapshot<'_>, part: Option<Stretch>) -> f64 {
        let ImplicitStep { chain, trial, .. } = &mut self.step;
        let r = &self.r;
        let u = |node| r[node] + last.adherent_at(node);
        let moved = self.moving.iter().map(|window| window.stretch);
        let held = self.supports.each.iter().map(|support| support.window);
        let pressed = moved
            .chain(held)
            .chain(part)
            .map(|part| self.bends.press_within(chain, part, u, self.thermal_force));
        let change = pressed.fold(0.0, f64::max);
        self.supports.load(snapshot, chain);
        let state = (&mut *self.r, &mut *self.g);
        self.outcome.dissipated += self.supports.hold([last, snapshot], chain, state, trial);
        change
    }

    /// One step of the whole cable: from rest to the vehicle's first position, or from its last one to rest.
    fn step_whole(&mut self, snapshot: &Snapshot<'_>) -> Result<(), CableError> {
        self.solve(Window::travelling(self.bounds.free), snapshot)?;
        self.settle(self.bounds.free, snapshot);
        self.moving.clear();
        self.record(snapshot);
        Ok(())
    }

    /// The ground comes to rest. What the windows left out of account is settled by the same step, and in bends by further ones, until the cable
    /// presses on them with the force that it has, to rounding.
    fn come_to_rest(&mut self, last: &Snapshot<'_>, still: &Snapshot<'_>) -> Result<(), CableError> {
        self.move_duct(last, still, Some(self.bounds.free));
        let mut change = f64::INFINITY;
        for _ in 0..MAX_ROUNDS {
            self.step_whole(still)?;
            if self.bends.is_empty() {
                return Ok(());
            }
            let before = change;
            change = self.move_duct(still, still, Some(self.bounds.free));
            if change <= PRESSED || change <= MAX_ROUNDING && change >= before {
                return Ok(());
            }
        }
        let error = ChainError::NoEquilibrium { violation: change };
        Err(CableError::of_step(error, f64::INFINITY))
    }

    /// One step of the vehicle: solves the windows where the cable moves. It may begin to slip in `watched`; node 0 stands at the point
    /// `first` of the lattice.
    fn step_windows(
        &mut self,
        snapshot: &Snapshot<'_>,
        watched: Stretch,
        first: usize,
    ) -> Result<(), CableError> {
        let mut windows = std::mem::take(&mut self.windows);
        self.begin_windows(snapshot, watched, &mut windows);
        self.outcome.statistics.watched += watched.count();
        self.moving.clear();
        loop {
            for window in &mut windows {
                window.stretch = self.solve_guessed(*window, snapshot, first)?;
            }
            // Windows that have grown into each other are solved as one: which was solved first is not to matter.
            if !windows.windows(2).any(|pair| pair[0].touches(pair[1])) {
                break;
            }
            window::join(&mut windows);
        }
        for window in &windows {
            self.settle(window.stretch, snapshot);
        }
        self.windows = windows;
        // The node beside one that moved is disturbed if the window travels on.
        for part in &mut self.moving {
            part.stretch = self.bounds.widened(part.stretch, 1);
        }
        window::join(&mut self.moving);
        self.record(snapshot);
        Ok(())
    }

    /// Solves a window, one that travels from the contacts that the lattice shows at node 0 standing at its point `first`. Returned: what was
    /// solved.
    fn solve_guessed(
        &mut self,
        window: Window,
        snapshot: &Snapshot<'_>,
        first: usize,
    ) -> Result<Stretch, CableError> {
        let begun = window.stretch;
        if window.travels {
            let guess = &self.predicted[first + begun.lo..][..begun.count()];
            self.step.trial.contact[begun.nodes()].copy_from_slice(guess);
        }
        let solved = self.solve(window, snapshot)?;
        if window.travels {
            let contact = &self.step.trial.contact[solved.nodes()];
            self.predicted[first + solved.lo..][..solved.count()].copy_from_slice(contact);
        }
        let widest = &mut self.outcome.statistics.widest_window;
        *widest = solved.count().max(*widest);
        Ok(solved)
    }

    /// Finds the `windows` of a step: around what moved in the last one, what of `watched` begins to slip, and supports that are due.
    fn begin_windows(&self, snapshot: &Snapshot<'_>, watched: Stretch, windows: &mut Vec<Window>) {
        let (bounds, chain) = (self.bounds, &self.step.chain);
        let above = |limit: f64| (1.0 + SLIPPING_SHARE) * limit;
        let slips =
            |&node: &usize| (self.g[node] + snapshot.adhesion[node]).abs() > above(chain.nodes()[node].limit);
        // Without a branch several nodes are looked at at once: a third of the time of a pass in which few slip.
        let least = above(self.cable.least_limit());
        let may_slip = |block: Range<usize>| {
            let pairs = self.g[block.clone()].iter().zip(&snapshot.adhesion[block]);
            pairs.fold(false, |any, (g, adhesion)| any | ((g + adhesion).abs() > least))
        };
        windows.clone_from(&self.moving);
        let (mut from, end) = (watched.lo, watched.hi + 1);
        let known = self.moving.iter().map(|part| (part.stretch.lo, part.stretch.hi));
        for (lo, hi) in known.chain([(end, end)]) {
            window::slipping(from..lo.min(end), may_slip, slips, |begun| {
                windows.push(Window::travelling(bounds.widened(begun, bounds.margin)));
            });
            from = from.max(hi + 1);
        }
        let due = self
            .supports
            .each
            .iter()
            .filter(|support| self.is_due(support.node));
        windows.extend(due.map(|support| Window::resting(support.window)));
        window::join(windows);
    }

    /// Takes the anchors of the nodes in `stretch` and clamps that slide along after a step; how far they have slipped makes its heat.
    fn settle(&mut self, stretch: Stretch, snapshot: &Snapshot<'_>) {
        let (ImplicitStep { chain, trial, .. }, nodes) = (&mut self.step, stretch.nodes());
        let u = |node: usize| self.r[node] + snapshot.adherent_at(node);
        chain.settle_clamps(stretch, u, &mut self.outcome.dissipated);
        let compliance = self.cable.friction().compliance();
        let state = self.r[nodes.clone()].iter().zip(&self.g[nodes.clone()]);
        let anchors = self.anchor[nodes.clone()].iter_mut().zip(state);
        let contacts = chain.nodes()[nodes.clone()].iter().zip(&trial.contact[nodes]);
        let mut heat = 0.0;
        for ((anchor, (r, g)), (node, contact)) in anchors.zip(contacts) {
            // Stuck nodes keep theirs.
            if *contact != Contact::Stuck {
                let now = r + compliance * g;
                let slip = std::mem::replace(anchor, now) - now;
                heat += node.tributary * node.limit * slip.abs();
            }
        }
        self.outcome.dissipated += heat;
    }

    /// Solves a window, growing it until its edges are quiet, and makes the answer the state. Returned: what was solved; what of it still
    /// moves is appended to `moving` if it travels: around a support nothing does.
    fn solve(&mut self, window: Window, snapshot: &Snapshot<'_>) -> Result<Stretch, CableError> {
        let Window { mut stretch, travels } = window;
        let (mut growth, mut corrections, mut rests) = (self.bounds.margin, 0, !travels);
        loop {
            self.outcome.statistics.windows += 1;
            let solved = if std::mem::take(&mut rests) && self.respond(stretch, snapshot.adhesion) {
                Ok(())
            } else if corrections > MAX_CORRECTIONS {
                Err(ChainError::NoEquilibrium {
                    violation: f64::INFINITY,
                })
            } else {
                let load = Load {
                    adhesion: snapshot.adhesion,
                    support: &self.supports.load,
                    anchor: &self.anchor,
                };
                self.step.solve(&load, stretch)
            };
            let position = self.mesh.lattice_step() * snapshot.position as f64;
            solved.map_err(|error| CableError::of_step(error, position))?;
            let ImplicitStep { chain, trial, .. } = &mut self.step;
            if chain.correct_clamps(stretch, |i| trial.r[i] + snapshot.adherent_at(i)) {
                self.supports.load(snapshot, chain);
                corrections += 1;
                continue;
            }
            let grown = window::grow(self.bounds, stretch, growth, |i| self.edge_disturbed(i));
            if grown == stretch {
                break;
            }
            (stretch, growth) = (grown, 2 * growth);
        }
        let trial = &self.step.trial;
        let moves = |&node: &usize| (trial.r[node] - self.r[node]).abs() > self.quiet;
        if travels {
            window::moving(stretch, moves, &mut self.moving);
        }
        let nodes = stretch.nodes();
        self.r[nodes.clone()].copy_from_slice(&trial.r[nodes.clone()]);
        self.g[nodes.clone()].copy_from_slice(&trial.g[nodes]);
        Ok(stretch)
    }

    /// Brings the supports in a `window` into balance if it sticks, with the `adhesion` on it, and is the least one of them all; false if
    /// not.
    fn respond(&mut self, window: Stretch, adhesion: &[f64]) -> bool {
        let (step, load) = (&mut self.step, &self.supports.load);
        let limit = (1.0 + ROUNDED) * self.cable.least_limit();
        let mut supports = self.supports.within(window);
        let responds = supports.clone().all(|support| support.window == window)
            && step.chain.clamps().iter().all(Clamp::is_stuck)
            && supports.all(|support| support.respond(step, load, adhesion, limit));
        if responds {
            step.work.node_updates += window.count();
        }
        responds
    }

    /// Whether the trial leaves the held node beside the window out of balance.
    fn edge_disturbed(&self, node: usize) -> bool {
        self.imbalance(node) > UNBALANCED_SHARE * self.step.chain.nodes()[node].limit
    }

    /// By how much the friction of a node is off what balances it \[N/m\].
    fn imbalance(&self, node: usize) -> f64 {
        let (r, load) = (&self.step.trial.r, &self.supports.load);
        (self.step.chain.balancing_friction(r, load, node) - self.g[node]).abs()
    }

    /// Whether the support at `node` is no longer in balance with the cable, or slides.
    fn is_due(&self, node: usize) -> bool {
        let slides = |clamp: &Clamp| clamp.node == node && !clamp.is_stuck();
        let node_there = &self.step.chain.nodes()[node];
        self.imbalance(node) > UNBALANCED_SUPPORT * node_there.limit
            || self.step.chain.clamps().iter().any(slides)
    }

    /// Records the forces on ends and clamps with the vehicle at the snapshot's position.
    fn record(&mut self, snapshot: &Snapshot<'_>) {
        let u = |node| self.r[node] + snapshot.adherent_at(node);
        let friction = |node| self.g[node] + snapshot.adhesion[node];
        self.outcome.see(self.ends.read(self.thermal_force, u, friction));
        let clamps = self.step.chain.clamps();
        if !clamps.is_empty() {
            let forces = self.clamps.forces(clamps, self.cable.restraints(), u);
            self.outcome.see_clamps(&forces);
        }
    }
}
