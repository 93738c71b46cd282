//! One pass, forward: the cable in the vehicle's adherent frame, step by step.

use super::passage::{Passage, SLIPPING_SHARE, Snapshot};
use super::supports::Supports;
use super::window::{self, WindowBounds};
use crate::ends::EndReader;
use crate::outcome::Recorder;
use crate::step::{Chain, Grip, Load, Prediction, StepSolver, Stretch, largest};
use crate::tuning::{QUIET_SHARE, UNBALANCED_SHARE};
use crate::{CableError, CableState, DuctedCable, Mesh};

/// Solves at most in which clamps change between sticking and sliding: a few are right at once.
const MAX_CORRECTIONS: usize = 100;

/// Drives vehicles forward over one cable; allocated once.
#[derive(Debug, Clone)]
pub(super) struct ForwardSolver {
    pub step: StepSolver,
    cable: DuctedCable,
    ends: EndReader,
    supports: Supports,
    bounds: WindowBounds,
    /// A node moves if it does so by more than this in a step \[m\].
    quiet: f64,
    /// State in the adherent frame: r \[m\] and g \[N/m\].
    r: Vec<f64>,
    g: Vec<f64>,
    /// Where the duct held every node before the step, r + γ g \[m\].
    anchor: Vec<f64>,
    /// Of the cable in the current pass \[N\].
    thermal_force: f64,
    windows: Vec<Stretch>,
    /// What moved in the last step.
    moving: Vec<Stretch>,
    /// Of the current pass alone, so that a pass is a function of the state and the passage.
    prediction: Prediction,
    /// What the current pass gathers.
    recorder: Recorder,
    mesh: Mesh,
}

impl ForwardSolver {
    pub fn new(cable: DuctedCable, mesh: &Mesh) -> Self {
        let nodes = mesh.nodes();
        let chain = Chain::new(&cable, mesh);
        let screening = chain.compliance * chain.stiffness / mesh.spacing();
        let bounds = WindowBounds::new(chain.free, screening);
        Self {
            supports: Supports::new(&cable, mesh, &chain, bounds),
            ends: EndReader::new(&cable, mesh),
            bounds,
            quiet: QUIET_SHARE * UNBALANCED_SHARE * chain.least_limit * mesh.spacing() / chain.stiffness,
            cable,
            step: StepSolver::new(chain),
            r: vec![0.0; nodes],
            g: vec![0.0; nodes],
            anchor: vec![0.0; nodes],
            thermal_force: 0.0,
            windows: Vec::new(),
            moving: Vec::new(),
            prediction: Prediction::default(),
            recorder: Recorder::default(),
            mesh: *mesh,
        }
    }

    /// Drives the vehicle over the cable in `state`, which is changed only on success; `observe` sees r, g, clamps that slip and the
    /// vehicle at every step.
    pub fn pass(
        &mut self,
        passage: &Passage,
        state: &mut CableState,
        mut observe: impl FnMut(&[f64], &[f64], &[Grip], Snapshot<'_>),
    ) -> Result<Recorder, CableError> {
        self.r.copy_from_slice(&state.displacement);
        self.g.copy_from_slice(&state.friction);
        self.step.start(largest(&self.r, passage.peak));
        for (anchor, (r, g)) in self.anchor.iter_mut().zip(self.r.iter().zip(&self.g)) {
            *anchor = r + self.step.chain.compliance * g;
        }
        self.step.trial.r.copy_from_slice(&self.r);
        self.step.chain.grip(&state.clamp_slips);
        self.supports
            .rest(self.cable.loads(&self.mesh, state.thermal_force));
        self.thermal_force = state.thermal_force;
        let (points, phases) = passage.lattice();
        self.prediction = Prediction::new(points, phases);
        self.recorder = Recorder::new(&self.cable, state)?;

        let mut behind = self.bounds.free.lo;
        let mut last = passage.still();
        for (step, &position) in passage.positions.iter().enumerate() {
            self.press(&last);
            let snapshot = passage.snapshot(position);
            last = snapshot;
            let under = self.bounds.under(snapshot.node, passage.reach);
            // A node is looked at once more where adhesion no longer reaches it, and all of them where the friction limit changes.
            let watched = if self.step.chain.bends() {
                self.bounds.free
            } else {
                Stretch { lo: behind, ..under }
            };
            behind = under.lo;
            if step == 0 {
                self.step_whole(&snapshot)?;
            } else {
                let first = passage.first_point(&snapshot);
                self.step_windows(&snapshot, watched, first)?;
            }
            observe(&self.r, &self.g, &self.step.chain.grips, snapshot);
        }

        // The ground comes to rest. What the windows left out of account is settled by the same step.
        self.press(&last);
        self.step_whole(&passage.still())?;
        state.displacement.copy_from_slice(&self.r);
        state.friction.copy_from_slice(&self.g);
        for grip in &self.step.chain.grips {
            grip.store(&mut state.clamp_slips);
        }
        self.recorder.statistics += self.step.statistics;
        Ok(std::mem::take(&mut self.recorder))
    }

    /// Lets the cable press on the bends of the duct with the force that it has under `snapshot`.
    fn press(&mut self, snapshot: &Snapshot<'_>) {
        let r = &self.r;
        let u = |node: usize| r[node] + snapshot.adherent_at(node);
        self.step.chain.press(u, self.thermal_force);
    }

    /// One step of the whole cable: from rest to the vehicle's first position, or from its last one to rest.
    fn step_whole(&mut self, snapshot: &Snapshot<'_>) -> Result<(), CableError> {
        self.hold(snapshot);
        self.solve(self.bounds.free, snapshot)?;
        self.anchor(self.bounds.free);
        self.moving.clear();
        self.record_ends(snapshot);
        self.record_clamps(snapshot);
        Ok(())
    }

    /// One step of the vehicle: solves the windows where the cable moves. It may begin to slip in `watched`; node 0 stands at the point
    /// `first` of the lattice.
    fn step_windows(
        &mut self,
        snapshot: &Snapshot<'_>,
        watched: Stretch,
        first: usize,
    ) -> Result<(), CableError> {
        self.hold(snapshot);
        let mut windows = std::mem::take(&mut self.windows);
        self.collect(&mut windows, snapshot, watched);
        let travelling = windows.clone();
        windows.extend(&self.supports.windows);
        window::join(&mut windows);
        self.moving.clear();
        for window in &mut windows {
            let (begun, before) = (*window, self.moving.len());
            let travels = travelling.iter().any(|part| part.overlaps(begun));
            if travels {
                self.prediction.read(first, begun, &mut self.step.trial.contact);
            }
            *window = self.solve(begun, snapshot)?;
            if travels {
                self.prediction.write(first, *window, &self.step.trial.contact);
            } else {
                // Around a support nothing travels.
                self.moving.truncate(before);
            }
            let widest = &mut self.recorder.statistics.widest_window;
            *widest = window.len().max(*widest);
        }
        for window in &windows {
            self.anchor(*window);
        }
        self.record_ends(snapshot);
        self.record_clamps(snapshot);
        self.windows = windows;
        Ok(())
    }

    /// Lists the windows of a step beside those around supports: what moved in the last one, and
    /// what of `watched` begins to slip.
    fn collect(&mut self, windows: &mut Vec<Stretch>, snapshot: &Snapshot<'_>, watched: Stretch) {
        let bounds = self.bounds;
        windows.clear();
        // The node beside one that moved is disturbed if the window travels on.
        windows.extend(self.moving.iter().map(|&part| bounds.widened(part, 1)));
        window::join(windows);
        // Between them and beyond.
        let known = windows.len();
        let near = watched.lo..watched.hi + 1;
        let chain = &self.step.chain;
        let slips_above = |limit: f64| limit * (1.0 + SLIPPING_SHARE);
        let (least, limit) = (slips_above(chain.least_limit), |i: usize| {
            slips_above(chain.nodes[i].limit)
        });
        let mut lo = near.start;
        for at in 0..=known {
            let (hi, next) = if at < known {
                let Stretch { lo, hi } = windows[at];
                (lo.min(near.end), hi + 1)
            } else {
                (near.end, near.end)
            };
            window::slipping(lo..hi, (&self.g, snapshot.adhesion), (least, limit), |slips| {
                windows.push(bounds.widened(slips, bounds.margin));
            });
            lo = lo.max(next);
        }
    }

    /// Brings loads and fixed ends to the vehicle's position.
    fn hold(&mut self, snapshot: &Snapshot<'_>) {
        self.recorder.statistics.steps += 1;
        let StepSolver { chain, trial, .. } = &mut self.step;
        self.supports.load(snapshot, chain);
        let state = (&mut *self.r, &mut *self.g);
        self.recorder.dissipated += self.supports.hold(snapshot, chain, state, trial);
    }

    /// Takes the anchors of the nodes in `stretch` along after a step; how far they have slipped makes its heat.
    fn anchor(&mut self, stretch: Stretch) {
        let (chain, nodes) = (&self.step.chain, stretch.nodes());
        let state = self.r[nodes.clone()].iter().zip(&self.g[nodes.clone()]);
        let anchors = self.anchor[nodes.clone()].iter_mut().zip(state);
        let slips = anchors.zip(&chain.nodes[nodes]).map(|((anchor, (r, g)), node)| {
            let now = r + chain.compliance * g;
            let slip = std::mem::replace(anchor, now) - now;
            node.tributary * node.limit * slip.abs()
        });
        self.recorder.dissipated += slips.sum::<f64>();
    }

    /// Solves a stretch, growing it until its edges are quiet, and makes the answer the state. Returned: what was solved; what of it still
    /// moves is appended to `moving`.
    fn solve(&mut self, mut stretch: Stretch, snapshot: &Snapshot<'_>) -> Result<Stretch, CableError> {
        let (mut growth, mut corrections) = (self.bounds.margin, 0);
        loop {
            self.recorder.statistics.windows += 1;
            let load = Load {
                adhesion: snapshot.adhesion,
                support: &self.supports.load,
                anchor: &self.anchor,
            };
            let solved = self.step.solve(&load, stretch);
            let solved = if corrections > MAX_CORRECTIONS {
                Err(f64::INFINITY)
            } else {
                solved
            };
            solved.map_err(|violation| CableError::NoConvergence {
                vehicle_position: self.mesh.lattice_step() * snapshot.position as f64,
                violation,
            })?;
            let StepSolver { chain, trial, .. } = &mut self.step;
            if chain.correct_grips(stretch, |i| trial.r[i] + snapshot.adherent_at(i)) {
                self.supports.load(snapshot, chain);
                corrections += 1;
                continue;
            }
            let (grown, next) = window::grow(self.bounds, stretch, growth, |i| self.edge_disturbed(i));
            if grown == stretch {
                break;
            }
            (stretch, growth) = (grown, next);
        }
        let StepSolver { chain, trial, .. } = &mut self.step;
        for grip in chain
            .grips
            .iter_mut()
            .filter(|grip| stretch.nodes().contains(&grip.node))
        {
            let u = trial.r[grip.node] + snapshot.adherent_at(grip.node);
            self.recorder.dissipated += grip.settle(u);
        }
        let moves = |node: usize| (trial.r[node] - self.r[node]).abs() > self.quiet;
        window::moving(stretch, moves, &mut self.moving);
        let nodes = stretch.nodes();
        self.r[nodes.clone()].copy_from_slice(&trial.r[nodes.clone()]);
        self.g[nodes.clone()].copy_from_slice(&trial.g[nodes]);
        Ok(stretch)
    }

    /// Whether the trial leaves the held node beside the window out of balance.
    fn edge_disturbed(&self, node: usize) -> bool {
        let chain = &self.step.chain;
        let balancing = chain.balancing_friction(&self.step.trial.r, &self.supports.load, node);
        (balancing - self.g[node]).abs() > UNBALANCED_SHARE * chain.nodes[node].limit
    }

    /// Records the force on each clamp with the vehicle at the snapshot's position.
    fn record_clamps(&mut self, snapshot: &Snapshot<'_>) {
        let grips = &self.step.chain.grips;
        if !grips.is_empty() {
            let u = |node| self.r[node] + snapshot.adherent_at(node);
            self.recorder
                .record_clamps(&Grip::forces(grips, self.cable.restraints(), u));
        }
    }

    /// Records the force on each end with the vehicle at the snapshot's position.
    fn record_ends(&mut self, snapshot: &Snapshot<'_>) {
        self.recorder.record(self.ends.read(
            self.thermal_force,
            |node| self.r[node] + snapshot.adherent_at(node),
            |node| self.g[node] + snapshot.adhesion[node],
        ));
    }
}
