//! One pass, forward: the windows in which the cable moves, solved step by step.

use super::active_set::{Elimination, Outcome};
use super::chain::{Chain, Contact, Load, Stretch, Tolerance, Trial};
use super::memory::PassMemory;
use super::passage::{Passage, Snapshot};
use super::support::{Forcing, Support};
use super::{Recorder, exact};
use crate::{CableError, CableState, DuctedCable, EndForces, Mesh};

/// Share of the friction limit by which friction and equilibrium may be off outside the windows while the vehicle passes.
/// Measured against whole-cable solves this moves the force by less than 1e-4.
pub(crate) const NEGLIGIBLE: f64 = 1e-3;
/// A window's edge is quiet when the force its last move put on the next node is below this share of [`NEGLIGIBLE`].
const QUIET: f64 = 0.25;
/// Accuracy of friction and equilibrium inside the windows, as a share of the friction limit.
const FRICTION_ACCURACY: f64 = 1e-6;
/// Accuracy of slip, as a share of the largest displacement.
const SLIP_ACCURACY: f64 = 1e-7;
/// Softnesses γ k/h through which a step is led that does not converge from its first guess: from the first down to the
/// real one, or to the last, which is as good as rigid.
const SOFTEST: f64 = 100.0;
const HARDEST: f64 = 1e-6;
const SOFTENING: f64 = 0.1;
/// Most nodes that a disturbed window grows by at once on each side.
const MAX_GROWTH: usize = 256;

/// Rounding error of a node's elastic force per metre \[N/m\] when displacements reach `largest` \[m\].
pub(super) fn rounding(cable: &DuctedCable, mesh: &Mesh, largest: f64) -> f64 {
    4.0 * f64::EPSILON * cable.axial_stiffness() / (mesh.spacing() * mesh.spacing()) * largest
}

/// Everything one pass needs, allocated once.
#[derive(Debug, Clone)]
pub(super) struct Sweeper {
    cable: DuctedCable,
    mesh: Mesh,
    chain: Chain,
    /// The same chain with a softer sheath.
    softened: Chain,
    soft_anchor: Vec<f64>,
    supports: Vec<SupportWindow>,
    /// Unknown nodes: all but fixed ends.
    free: Stretch,
    /// Nodes over which a stuck cable's response fades to a hundredth.
    margin: usize,
    elimination: Elimination,
    r: Vec<f64>,
    g: Vec<f64>,
    trial: Trial,
    anchor: Vec<f64>,
    support_load: Vec<f64>,
    /// Contact states by node, as last solved.
    by_node: Vec<Contact>,
    /// Contact states in the vehicle's frame, as last solved: the next node to stand there will most likely share them.
    by_xi: Vec<Contact>,
    windows: Vec<Window>,
    /// Work turned into heat by slip in this pass so far \[J\].
    dissipated: f64,
    /// The last pass of each passage, and the one that is being written.
    memories: Vec<(u64, PassMemory)>,
    writing: PassMemory,
}

/// A support, the window around it, and the forcing for which it was last solved.
#[derive(Debug, Clone)]
struct SupportWindow {
    support: Support,
    stretch: Stretch,
    solved: Forcing,
    /// Whether the forcing has changed since.
    due: bool,
    /// Adherent displacement up to which a fixed node's own friction has followed \[m\].
    followed: f64,
    /// Force on the cable per displacement of the duct \[N/m\].
    grip: f64,
}

/// A window to solve in this step.
#[derive(Debug, Clone, Copy)]
struct Window {
    stretch: Stretch,
    /// Whether it travels with the vehicle.
    travels: bool,
}

impl Sweeper {
    pub fn new(cable: &DuctedCable, mesh: &Mesh) -> Self {
        let nodes = mesh.nodes();
        let last = mesh.elements();
        let stiffness = cable.axial_stiffness() / mesh.spacing();
        let compliance = cable.friction().compliance();
        let supports = Support::of(cable, mesh);

        let mut diagonal = vec![2.0; nodes];
        (diagonal[0], diagonal[last]) = (1.0, 1.0);
        for support in &supports {
            diagonal[support.node] += support.stiffness.unwrap_or(0.0) / stiffness;
        }
        let tributary: Vec<f64> = (0..nodes).map(|i| mesh.tributary_length(i)).collect();
        let softness: Vec<f64> = tributary.iter().map(|w| compliance * stiffness / w).collect();
        let chain = Chain {
            stiffness,
            diagonal,
            tributary,
            softness,
            compliance,
            limit: cable.friction().limit(),
        };

        let fixed = |node: usize| supports.iter().any(|s| s.node == node && s.stiffness.is_none());
        let free = Stretch {
            lo: usize::from(fixed(0)),
            hi: last - usize::from(fixed(last)),
        };
        let screening = compliance * stiffness / mesh.spacing();
        let margin = fading_nodes(screening).min(MAX_GROWTH);
        // Over one screening length, and at least one element, a held node drags the cable along; where the sheath is
        // stiffer than that, what holds the node works against the sheath.
        let held_stiffness = stiffness / screening.sqrt().max(1.0);
        let sheath_stiffness = stiffness / screening.max(screening.sqrt());
        let supports = supports
            .into_iter()
            .map(|support| SupportWindow {
                stretch: Stretch {
                    lo: support.node.saturating_sub(margin).max(free.lo),
                    hi: (support.node + margin).min(free.hi),
                },
                solved: Forcing::default(),
                due: false,
                followed: 0.0,
                grip: support
                    .stiffness
                    .map_or(held_stiffness, |s| 1.0 / (1.0 / s + 1.0 / sheath_stiffness)),
                support,
            })
            .collect();
        Self {
            cable: cable.clone(),
            mesh: *mesh,
            softened: chain.clone(),
            soft_anchor: vec![0.0; nodes],
            chain,
            supports,
            free,
            margin,
            elimination: Elimination::new(nodes),
            r: vec![0.0; nodes],
            g: vec![0.0; nodes],
            trial: Trial {
                r: vec![0.0; nodes],
                g: vec![0.0; nodes],
                contact: vec![Contact::Stuck; nodes],
            },
            anchor: vec![0.0; nodes],
            support_load: vec![0.0; nodes],
            by_node: vec![Contact::Stuck; nodes],
            by_xi: Vec::new(),
            windows: Vec::new(),
            dissipated: 0.0,
            memories: Vec::new(),
            writing: PassMemory::default(),
        }
    }

    /// Drives the vehicle over the cable in `state`, which is changed only on success; `observe` sees every step.
    pub fn pass(
        &mut self,
        passage: &Passage,
        state: &mut CableState,
        mut observe: impl FnMut(&Self, Snapshot<'_>),
    ) -> Result<Recorder, CableError> {
        let last = self.mesh.elements();
        self.r.copy_from_slice(&state.displacement);
        self.g.copy_from_slice(&state.friction);
        self.support_load.fill(0.0);
        self.dissipated = 0.0;
        self.by_node.fill(Contact::Stuck);
        self.by_xi.resize(passage.lattice_len(), Contact::Stuck);
        let largest = self
            .r
            .iter()
            .fold(passage.peak(), |largest, u| largest.max(u.abs()));
        let friction =
            (FRICTION_ACCURACY * self.chain.limit).max(16.0 * rounding(&self.cable, &self.mesh, largest));
        let tolerance = Tolerance {
            friction,
            slip: SLIP_ACCURACY * largest + self.chain.compliance * friction,
        };

        let mut recorder = Recorder::new(state.end_forces(&self.cable, &self.mesh));
        let memory = self.recall(passage.id());
        let mut travelling: Option<Stretch> = None;
        let (&arrival, onward) = passage
            .positions()
            .split_first()
            .expect("a passage has positions");
        self.arrive(&passage.snapshot(arrival, last + 1));
        for (step, &position) in onward.iter().enumerate() {
            let snapshot = passage.snapshot(position, last + 1);
            recorder.statistics.steps += 1;
            self.update_supports(&snapshot, false);
            travelling = self.disturbed(&snapshot, passage.reach(), travelling);
            let remembered = memory.recall(step);
            self.collect_windows(travelling, remembered.map(|(window, _)| window));
            let mut next = None;
            for index in 0..self.windows.len() {
                let window = self.windows[index];
                self.predict(window, &snapshot, passage, remembered);
                let solved = self.solve(window.stretch, &snapshot, tolerance, &mut recorder)?;
                if window.travels {
                    next = self.shrink(solved);
                }
                recorder.statistics.widest_window =
                    recorder.statistics.widest_window.max(solved.hi - solved.lo + 1);
                self.commit(solved, &snapshot, passage);
            }
            self.writing.push(next, &self.trial.contact);
            travelling = next;
            if self.ends_touched() {
                recorder.record(self.end_forces(&snapshot));
            }
            observe(self, snapshot);
        }
        self.remember(passage.id(), memory);

        // Once more, the whole cable: what the windows left out of account is settled here.
        let &departure = passage.positions().last().expect("a passage has positions");
        let snapshot = passage.snapshot(departure, last + 1);
        self.update_supports(&snapshot, true);
        let whole = Window {
            stretch: self.free,
            travels: false,
        };
        self.predict(whole, &snapshot, passage, None);
        let solved = self.solve(whole.stretch, &snapshot, tolerance, &mut recorder)?;
        self.commit(solved, &snapshot, passage);
        for node in 0..=last {
            state.displacement[node] = self.displacement(node, &snapshot);
            state.friction[node] = self.friction(node, &snapshot);
        }
        recorder.dissipated = self.dissipated;
        Ok(recorder)
    }

    pub fn mesh(&self) -> &Mesh {
        &self.mesh
    }

    pub fn stiffness(&self) -> f64 {
        self.chain.stiffness
    }

    pub fn limit(&self) -> f64 {
        self.chain.limit
    }

    /// Displacement u of a node \[m\].
    pub fn displacement(&self, node: usize, snapshot: &Snapshot<'_>) -> f64 {
        self.r[node] + snapshot.adherent[node + 1]
    }

    /// Friction f on a node \[N/m\].
    pub fn friction(&self, node: usize, snapshot: &Snapshot<'_>) -> f64 {
        self.g[node] + snapshot.adhesion[node + 1]
    }

    /// Takes the state into the adherent frame of the vehicle's first position. The cable does not move by this.
    fn arrive(&mut self, snapshot: &Snapshot<'_>) {
        for node in 0..self.r.len() {
            self.r[node] -= snapshot.adherent[node + 1];
            self.g[node] -= snapshot.adhesion[node + 1];
        }
        self.trial.r.copy_from_slice(&self.r);
        let last = self.mesh.elements();
        for index in 0..self.supports.len() {
            let support = &self.supports[index].support;
            let forcing = support.forcing(snapshot, self.chain.stiffness, last);
            self.support_load[support.node] = support.load(forcing);
            self.supports[index].solved = forcing;
            self.supports[index].followed = forcing.adherent;
        }
    }

    /// Brings the supports' loads up to date where the vehicle's effect on them has changed, or everywhere if `all`.
    fn update_supports(&mut self, snapshot: &Snapshot<'_>, all: bool) {
        let last = self.mesh.elements();
        // A support is solved again when the vehicle's force on it has changed as much as a window's edge may.
        let threshold = NEGLIGIBLE * self.chain.limit * self.mesh.spacing();
        for index in 0..self.supports.len() {
            let SupportWindow {
                support,
                solved,
                grip,
                followed,
                ..
            } = &self.supports[index];
            let forcing = support.forcing(snapshot, self.chain.stiffness, last);
            let change = (forcing.cut - solved.cut).abs() + grip * (forcing.adherent - solved.adherent).abs();
            let due = all || change > threshold;
            let (node, fixed, load) = (support.node, support.stiffness.is_none(), support.load(forcing));
            if fixed {
                // Its friction turns at slips far smaller than those that matter to its neighbours.
                let slip = forcing.adherent - followed;
                self.drag(node, slip, snapshot.adhesion[node + 1]);
                self.supports[index].followed = forcing.adherent;
            }
            if due {
                if fixed {
                    self.r[node] = -forcing.adherent;
                    self.trial.r[node] = -forcing.adherent;
                } else {
                    self.support_load[node] = load;
                }
                self.supports[index].solved = forcing;
            }
            self.supports[index].due = due;
        }
    }

    /// Friction on a fixed node as the duct slips past it by `slip`.
    fn drag(&mut self, node: usize, slip: f64, adhesion: f64) {
        let g = if self.chain.compliance > 0.0 {
            self.g[node] + slip / self.chain.compliance
        } else if slip == 0.0 {
            self.g[node]
        } else {
            f64::INFINITY.copysign(slip)
        };
        let g = g.clamp(
            self.chain.bound(Contact::Backward, adhesion),
            self.chain.bound(Contact::Forward, adhesion),
        );
        let elastic = self.chain.compliance * (g - self.g[node]);
        self.dissipated += self.chain.tributary[node] * (g + adhesion) * (slip - elastic);
        self.g[node] = g;
    }

    /// The travelling window of this step: the last one, extended to every node near the vehicle that must slip.
    fn disturbed(
        &self,
        snapshot: &Snapshot<'_>,
        reach: usize,
        travelling: Option<Stretch>,
    ) -> Option<Stretch> {
        let node = snapshot.node;
        let clamp = |node: i64| node.clamp(self.free.lo as i64, self.free.hi as i64) as usize;
        let (from, to) = (clamp(node - reach as i64), clamp(node + reach as i64));
        let limit = self.chain.limit * (1.0 + NEGLIGIBLE);
        let slips = |i: &usize| (self.g[*i] + snapshot.adhesion[i + 1]).abs() > limit;
        let inside = travelling.unwrap_or(Stretch { lo: to + 1, hi: to });
        let first = (from..inside.lo.min(to + 1)).find(slips);
        let last = (inside
            .hi
            .max(from)
            .saturating_add(usize::from(travelling.is_some()))..=to)
            .rev()
            .find(slips);
        let widened = |stretch: Stretch| Stretch {
            lo: first.map_or(stretch.lo, |i| i.saturating_sub(self.margin).max(self.free.lo)),
            hi: last.map_or(stretch.hi, |i| (i + self.margin).min(self.free.hi)),
        };
        match (travelling, first, last) {
            (Some(stretch), _, _) => Some(widened(stretch)),
            (None, Some(first), last) => Some(widened(Stretch {
                lo: first,
                hi: last.unwrap_or(first),
            })),
            (None, None, _) => None,
        }
    }

    /// Takes out the memory of a passage's last pass; empty for its first.
    fn recall(&mut self, id: u64) -> PassMemory {
        self.writing.clear();
        match self.memories.iter_mut().find(|(known, _)| *known == id) {
            Some((_, memory)) => std::mem::take(memory),
            None => PassMemory::default(),
        }
    }

    /// Puts the pass just written in its place; `old` becomes the storage of the next one.
    fn remember(&mut self, id: u64, old: PassMemory) {
        let written = std::mem::replace(&mut self.writing, old);
        match self.memories.iter_mut().find(|(known, _)| *known == id) {
            Some((_, memory)) => *memory = written,
            None => self.memories.push((id, written)),
        }
    }

    /// Lists this step's windows, from left to right; those that touch become one. The travelling window is at least as
    /// wide as it was in the last pass, which spares it growing again.
    fn collect_windows(&mut self, travelling: Option<Stretch>, remembered: Option<Stretch>) {
        self.windows.clear();
        let travelling = match (travelling, remembered) {
            (Some(a), Some(b)) if a.lo <= b.hi && b.lo <= a.hi => Some(Stretch {
                lo: a.lo.min(b.lo),
                hi: a.hi.max(b.hi),
            }),
            (travelling, _) => travelling,
        };
        self.windows.extend(travelling.map(|stretch| Window {
            stretch,
            travels: true,
        }));
        self.windows.extend(
            self.supports
                .iter()
                .filter(|support| support.due)
                .map(|support| Window {
                    stretch: support.stretch,
                    travels: false,
                }),
        );
        self.windows.sort_by_key(|window| window.stretch.lo);
        let mut merged = 0;
        for index in 1..self.windows.len() {
            let next = self.windows[index];
            let window = &mut self.windows[merged];
            if next.stretch.lo <= window.stretch.hi + 2 {
                window.stretch.hi = window.stretch.hi.max(next.stretch.hi);
                window.travels |= next.travels;
            } else {
                merged += 1;
                self.windows[merged] = next;
            }
        }
        self.windows.truncate(merged + 1);
    }

    /// Sets anchors and guesses the contact states of a window's nodes: those of the last pass at this vehicle position,
    /// in the first pass those that a node had where this one now stands relative to the vehicle, and elsewhere those
    /// that the node itself had.
    fn predict(
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

    /// Anchors and last contact states of the nodes in `stretch`.
    fn anchor_from(&mut self, stretch: Stretch) {
        for i in stretch.lo..=stretch.hi {
            self.anchor[i] = self.r[i] + self.chain.compliance * self.g[i];
        }
        let range = stretch.lo..=stretch.hi;
        self.trial.contact[range.clone()].copy_from_slice(&self.by_node[range]);
    }

    /// Solves a stretch, growing it until its edges are quiet. The answer is in the trial until it is committed.
    fn solve(
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
        let mut attempt = |chain: &Chain, load: &Load<'_>, trial: &mut Trial| {
            let (outcome, sweeps) = self.elimination.iterate(chain, load, stretch, tolerance, trial);
            recorder.statistics.sweeps += sweeps;
            recorder.statistics.node_updates += sweeps * (stretch.hi - stretch.lo + 1);
            outcome
        };
        if attempt(&self.chain, &load, &mut self.trial) == Outcome::Solved {
            return Ok(());
        }
        // A softer sheath has a smoother energy: its contact states lead to those of the real one.
        let mut softness = SOFTEST;
        let real = self.chain.compliance * self.chain.stiffness / self.mesh.spacing();
        self.trial.contact[stretch.lo..=stretch.hi].fill(Contact::Stuck);
        while softness > real.max(HARDEST) {
            self.softened
                .soften(softness * self.mesh.spacing() / self.chain.stiffness);
            for i in stretch.lo..=stretch.hi {
                self.soft_anchor[i] = self.r[i] + self.softened.compliance * self.g[i];
            }
            let soft_load = Load {
                anchor: &self.soft_anchor,
                ..load
            };
            attempt(&self.softened, &soft_load, &mut self.trial);
            softness *= SOFTENING;
        }
        if attempt(&self.chain, &load, &mut self.trial) == Outcome::Solved {
            return Ok(());
        }
        exact::contacts(&self.chain, &load, stretch, &mut self.trial);
        recorder.statistics.exact_steps += 1;
        match attempt(&self.chain, &load, &mut self.trial) {
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

    /// The part of a solved window that still moves; `None` if nothing does.
    fn shrink(&self, solved: Stretch) -> Option<Stretch> {
        let Stretch { mut lo, mut hi } = solved;
        let quiet = |edge: usize, inner: usize| {
            let moved = (self.trial.r[inner] - self.r[inner]).abs();
            self.chain.stiffness * moved <= QUIET * NEGLIGIBLE * self.chain.limit * self.chain.tributary[edge]
        };
        while lo < hi && quiet(lo, lo + 1) {
            lo += 1;
        }
        while hi > lo && quiet(hi, hi - 1) {
            hi -= 1;
        }
        (lo < hi).then_some(Stretch { lo, hi })
    }

    /// Whether this step may have changed the force on an end.
    fn ends_touched(&self) -> bool {
        self.supports.iter().any(|support| support.due)
            || self.windows.iter().any(|window| {
                window.stretch.lo <= self.free.lo + self.margin
                    || window.stretch.hi + self.margin >= self.free.hi
            })
    }

    /// Makes the trial the state.
    fn commit(&mut self, stretch: Stretch, snapshot: &Snapshot<'_>, passage: &Passage) {
        let range = stretch.lo..=stretch.hi;
        for i in range.clone() {
            if self.trial.contact[i] != Contact::Stuck {
                let slip = self.anchor[i] - self.trial.r[i] - self.chain.compliance * self.trial.g[i];
                self.dissipated += self.chain.tributary[i] * self.chain.limit * slip.abs();
            }
        }
        self.r[range.clone()].copy_from_slice(&self.trial.r[range.clone()]);
        self.g[range.clone()].copy_from_slice(&self.trial.g[range.clone()]);
        self.by_node[range.clone()].copy_from_slice(&self.trial.contact[range.clone()]);
        for i in range {
            self.by_xi[passage.lattice_index(snapshot.position, i)] = self.trial.contact[i];
        }
    }

    /// Force on each end \[N\] with the vehicle at the snapshot's position, compression positive.
    fn end_forces(&self, snapshot: &Snapshot<'_>) -> EndForces {
        let last = self.mesh.elements();
        let u = |i: usize| self.displacement(i, snapshot);
        let force = |node: usize, inner: usize, outward: f64, end: crate::End| match end {
            crate::End::Free => 0.0,
            crate::End::Spring(stiffness) => outward * stiffness * u(node),
            crate::End::Fixed => {
                let friction = self.friction(node, snapshot);
                outward
                    * (self.chain.stiffness * (u(inner) - u(node)) + self.chain.tributary[node] * friction)
            }
        };
        EndForces {
            upstream: force(0, 1, -1.0, self.cable.upstream()),
            downstream: force(last, last - 1, 1.0, self.cable.downstream()),
        }
    }
}

/// Nodes over which the response of a stuck chain fades to a hundredth; `screening` is (λ/h)².
fn fading_nodes(screening: f64) -> usize {
    if screening <= 0.0 {
        return 2;
    }
    // Decay ratio of the difference equation (1 + 2 s) r_i = s (r_{i−1} + r_{i+1}).
    let half = 0.5 / screening;
    let ratio = 1.0 + half - (half * (half + 2.0)).sqrt();
    ((100.0_f64.ln() / -ratio.ln()).ceil() as usize).max(2)
}
