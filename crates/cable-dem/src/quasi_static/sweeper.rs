//! One pass, forward: the cable's state, its supports, and the steps of the vehicle.

use super::active_set::Elimination;
use super::chain::{Chain, Contact, Stretch, Tolerance, Trial};
use super::memory::PassMemory;
use super::passage::{Passage, Snapshot};
use super::support::{Forcing, Support};
use super::window::{NEGLIGIBLE, Window};
use crate::ends::{Balance, EndReader};
use crate::held::HeldNode;
use crate::outcome::Recorder;
use crate::{CableError, CableState, DuctedCable, EndForces, Mesh};

/// Accuracy of friction and equilibrium inside the windows, as a share of the friction limit.
const FRICTION_ACCURACY: f64 = 1e-9;
/// Accuracy of slip, as a share of the largest displacement. What a slipping node may slip the wrong way adds up over
/// thousands of steps: it has to be far below the slip of one step.
const SLIP_ACCURACY: f64 = 1e-12;
/// Most nodes that a disturbed window grows by at once on each side.
pub(super) const MAX_GROWTH: usize = 256;

/// Rounding error of a node's elastic force per metre \[N/m\] when displacements reach `largest` \[m\].
pub(super) fn rounding(cable: &DuctedCable, mesh: &Mesh, largest: f64) -> f64 {
    4.0 * f64::EPSILON * cable.axial_stiffness() / (mesh.spacing() * mesh.spacing()) * largest
}

/// Everything one pass needs, allocated once.
#[derive(Debug, Clone)]
pub(super) struct Sweeper {
    pub(super) cable: DuctedCable,
    pub(super) mesh: Mesh,
    ends: EndReader,
    held: HeldNode,
    pub(super) chain: Chain,
    pub(super) supports: Vec<SupportWindow>,
    /// Unknown nodes: all but fixed ends.
    pub(super) free: Stretch,
    /// Nodes over which a stuck cable's response fades to a hundredth.
    pub(super) margin: usize,
    pub(super) elimination: Elimination,
    /// Whether every window is solved by the exact step at once.
    pub(super) without_iteration: bool,
    pub(super) r: Vec<f64>,
    pub(super) g: Vec<f64>,
    pub(super) trial: Trial,
    pub(super) anchor: Vec<f64>,
    pub(super) support_load: Vec<f64>,
    /// Contact states by node, as last solved.
    pub(super) by_node: Vec<Contact>,
    /// Contact states in the vehicle's frame, as last solved: the next node to stand there will most likely share them.
    pub(super) by_xi: Vec<Contact>,
    pub(super) windows: Vec<Window>,
    /// Work turned into heat by slip in this pass so far \[J\].
    pub(super) dissipated: f64,
    /// The last pass of each passage, and the one that is being written.
    pub(super) memories: Vec<(u64, PassMemory)>,
    pub(super) writing: PassMemory,
}

/// A support, the window around it, and the forcing for which it was last solved.
#[derive(Debug, Clone)]
pub(super) struct SupportWindow {
    pub(super) support: Support,
    pub(super) stretch: Stretch,
    pub(super) solved: Forcing,
    /// Whether the forcing has changed since.
    pub(super) due: bool,
    /// Forcing up to which a fixed node's own friction has followed.
    pub(super) followed: Forcing,
    /// Force on the cable per displacement of the duct \[N/m\].
    pub(super) grip: f64,
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
                followed: Forcing::default(),
                grip: support
                    .stiffness
                    .map_or(held_stiffness, |s| 1.0 / (1.0 / s + 1.0 / sheath_stiffness)),
                support,
            })
            .collect();
        Self {
            cable: cable.clone(),
            mesh: *mesh,
            ends: EndReader::new(cable, mesh),
            held: HeldNode::new(cable, mesh),
            chain,
            supports,
            free,
            margin,
            elimination: Elimination::new(nodes),
            without_iteration: false,
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
        self.dissipated = 0.0;
        self.by_node.fill(Contact::Stuck);
        self.by_xi.resize(passage.lattice_len(), Contact::Stuck);
        let largest = self
            .r
            .iter()
            .fold(passage.peak(), |largest, u| largest.max(u.abs()));
        let friction = (FRICTION_ACCURACY * self.chain.limit)
            .max(16.0 * (rounding(&self.cable, &self.mesh, largest) + self.support_rounding(largest)));
        let tolerance = Tolerance {
            friction,
            slip: SLIP_ACCURACY * largest + self.chain.compliance * friction,
        };

        let mut recorder = Recorder::new(state.ends(&self.cable));
        let memory = self.recall(passage.id());
        self.rest();
        let mut travelling: Option<Stretch> = None;
        for (step, &position) in passage.positions().iter().enumerate() {
            let snapshot = passage.snapshot(position, last + 1);
            if step == 0 {
                self.step_whole(&snapshot, passage, tolerance, &mut recorder)?;
                observe(self, snapshot);
                continue;
            }
            recorder.statistics.steps += 1;
            self.update_supports(&snapshot, false);
            travelling = self.disturbed(&snapshot, passage.reach(), travelling);
            let remembered = memory.recall(step - 1);
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

        // The ground comes to rest. What the windows left out of account is settled by the same step.
        let still = passage.still(last + 1);
        self.step_whole(&still, passage, tolerance, &mut recorder)?;
        state.displacement.copy_from_slice(&self.r);
        state.friction.copy_from_slice(&self.g);
        recorder.dissipated = self.dissipated;
        Ok(recorder)
    }

    /// One step of the whole cable: from rest to the vehicle's first position, or from its last one to rest.
    fn step_whole(
        &mut self,
        snapshot: &Snapshot<'_>,
        passage: &Passage,
        tolerance: Tolerance,
        recorder: &mut Recorder,
    ) -> Result<(), CableError> {
        recorder.statistics.steps += 1;
        self.update_supports(snapshot, true);
        let whole = Window {
            stretch: self.free,
            travels: false,
        };
        self.predict(whole, snapshot, passage, None);
        let solved = self.solve(whole.stretch, snapshot, tolerance, recorder)?;
        self.commit(solved, snapshot, passage);
        recorder.record(self.end_forces(snapshot));
        Ok(())
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

    /// Rounding error of the stiffest support's force, per metre of its node \[N/m\], when displacements reach `largest` \[m\].
    fn support_rounding(&self, largest: f64) -> f64 {
        self.supports
            .iter()
            .filter_map(|SupportWindow { support, .. }| {
                Some(4.0 * f64::EPSILON * support.stiffness? * largest / self.chain.tributary[support.node])
            })
            .fold(0.0, f64::max)
    }

    /// The supports with the ground at rest, where the adherent frame is that of the ground.
    fn rest(&mut self) {
        self.trial.r.copy_from_slice(&self.r);
        self.support_load.fill(0.0);
        for support in &mut self.supports {
            support.solved = Forcing::default();
            support.followed = Forcing::default();
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
                let followed = *followed;
                self.drag(node, followed, forcing);
                self.supports[index].followed = forcing;
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

    /// Friction on a fixed node as the duct moves on past it from the forcing that it has followed so far.
    fn drag(&mut self, node: usize, followed: Forcing, forcing: Forcing) {
        let compliance = self.chain.compliance;
        let before = self.g[node] + followed.adhesion;
        // D = a + γ A.
        let slip = forcing.adherent - followed.adherent + compliance * (forcing.adhesion - followed.adhesion);
        let after = self.held.after_slip(before, slip);
        self.dissipated += self.chain.tributary[node] * after * (slip - compliance * (after - before));
        self.g[node] = after - forcing.adhesion;
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
        self.ends.read(
            Balance::AtRest,
            |node| self.displacement(node, snapshot),
            |node| self.friction(node, snapshot),
        )
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
