//! One implicit step on a stretch of the chain: the problem.
//!
//! Unknown are the displacements r (in the adherent frame, see `quasi_static::passage`) of the nodes of one stretch. With K
//! the chain's stiffness, s the supports' and p their loads, the step minimises the strictly convex energy
//!
//! ½ rᵀ(K + s) r − pᵀr + Σ w_i Φ_i(r_i),
//!
//! where −Φ′ = g = clamp((anchor − r)/γ, lower, upper) is the friction. Each node is in one of three [`Contact`] states,
//! and once these are known r follows from a linear system. An answer is right exactly when every stuck node's friction
//! lies within its bounds and every slipping node has slipped the way its friction points.

use super::grip::Grip;
use crate::section::{self, Section, limit_of};
use crate::tridiagonal::{self, Row};
use crate::{DuctedCable, End, Mesh};

/// State of the contact between one node and the duct.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Contact {
    /// Friction within its bounds, slip elastic.
    Stuck,
    /// The duct slips forward past the cable: friction at its upper bound.
    Forward,
    /// The duct slips backward past the cable: friction at its lower bound.
    Backward,
}

/// The constant part: one cable on one mesh.
#[derive(Debug, Clone)]
pub(crate) struct Chain {
    /// k = EA/h \[N/m\], and 1/k.
    pub stiffness: f64,
    pub per_stiffness: f64,
    pub nodes: Vec<Node>,
    /// Shear compliance γ \[m²/N\]; 0 for Coulomb's law.
    pub compliance: f64,
    /// The smallest friction limit of all nodes of a cable without force \[N/m\].
    pub least_limit: f64,
    /// Nodes whose friction limit grows with the force in the cable, and the sections they lie on.
    pub(super) bends: Vec<(usize, Vec<(f64, Section)>)>,
    /// Clamps; their springs are among the nodes' while they stick.
    pub grips: Vec<Grip>,
    /// The unknown nodes: all but fixed ends.
    pub free: Stretch,
    /// Whether a fixed end, a spring or a clamp holds the cable.
    pub is_held: bool,
    /// Rounding error of a node's force per metre \[N/m\], for each metre of displacement.
    pub rounding: f64,
}

/// What belongs to one node.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Node {
    /// Diagonal of K + s in units of k.
    pub diagonal: f64,
    /// Tributary length w \[m\], and 1/w.
    pub tributary: f64,
    pub per_tributary: f64,
    /// Friction limit q \[N/m\].
    pub limit: f64,
    /// Shares of each neighbour and of the anchor in the row of a stuck node: s/(1 + s · diagonal) and 1/(1 + s · diagonal) with the
    /// contact's softness s = γ k/w relative to the chain's.
    stuck: (f64, f64),
    /// The share of each neighbour in the row of a slipping node, 1/diagonal.
    slipping: f64,
}

/// A stretch lo..=hi of unknown nodes between neighbours that are held.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Stretch {
    pub lo: usize,
    pub hi: usize,
}

/// What the step is given, as slices over all nodes.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Load<'a> {
    /// Adhesion A \[N/m\], which shifts the friction bounds.
    pub adhesion: &'a [f64],
    /// Loads p of the supports in the adherent frame \[N\]; zero away from them.
    pub support: &'a [f64],
    /// r + γ g before the step: where the duct holds the sheath \[m\].
    pub anchor: &'a [f64],
}

/// A trial answer, over all nodes; outside the stretch being solved `r` holds the neighbours' values.
#[derive(Debug, Clone)]
pub(crate) struct Trial {
    /// Displacement in the adherent frame \[m\].
    pub r: Vec<f64>,
    /// Friction in the adherent frame \[N/m\].
    pub g: Vec<f64>,
    /// Contact states.
    pub contact: Vec<Contact>,
}

impl Stretch {
    pub fn nodes(self) -> std::ops::RangeInclusive<usize> {
        self.lo..=self.hi
    }

    pub fn overlaps(self, other: Self) -> bool {
        self.lo <= other.hi && other.lo <= self.hi
    }

    pub fn hull(self, other: Self) -> Self {
        Self {
            lo: self.lo.min(other.lo),
            hi: self.hi.max(other.hi),
        }
    }

    pub fn len(self) -> usize {
        self.hi + 1 - self.lo
    }

    /// The displacements of its neighbours before and after it, as far as there are any.
    pub fn neighbours(self, r: &[f64]) -> [Option<f64>; 2] {
        [
            self.lo.checked_sub(1).map(|before| r[before]),
            r.get(self.hi + 1).copied(),
        ]
    }
}

impl Load<'_> {
    /// On the nodes of one stretch alone.
    pub fn on(&self, stretch: Stretch) -> Self {
        Self {
            adhesion: &self.adhesion[stretch.nodes()],
            support: &self.support[stretch.nodes()],
            anchor: &self.anchor[stretch.nodes()],
        }
    }
}

impl Trial {
    /// At rest and stuck.
    pub fn new(nodes: usize) -> Self {
        Self {
            r: vec![0.0; nodes],
            g: vec![0.0; nodes],
            contact: vec![Contact::Stuck; nodes],
        }
    }
}

impl Node {
    /// One on a chain of `stiffness` k \[N/m\] whose contact has the `compliance` γ \[m²/N\].
    pub fn new(diagonal: f64, tributary: f64, limit: f64, stiffness: f64, compliance: f64) -> Self {
        let softness = compliance * stiffness / tributary;
        let share = 1.0 / (1.0 + softness * diagonal);
        Self {
            diagonal,
            tributary,
            per_tributary: 1.0 / tributary,
            limit,
            stuck: (softness * share, share),
            slipping: 1.0 / diagonal,
        }
    }

    /// Its row in the linear system of given contact states: a stuck node reads r + γ g = anchor, a slipping one equilibrium with g at
    /// its bound. `support` is its support's load over k \[m\].
    #[inline]
    pub fn row(&self, contact: Contact, support: f64, adhesion: f64, anchor: f64, per_stiffness: f64) -> Row {
        match contact {
            Contact::Stuck => {
                let (share, of_anchor) = self.stuck;
                Row {
                    share,
                    value: of_anchor * anchor + share * support,
                }
            }
            slipping => {
                let bound = self.bound(slipping, adhesion);
                Row {
                    share: self.slipping,
                    value: self.slipping * (self.tributary * bound * per_stiffness + support),
                }
            }
        }
    }

    /// Bound of the friction g in the slipping state `contact` \[N/m\].
    #[inline]
    pub fn bound(&self, contact: Contact, adhesion: f64) -> f64 {
        match contact {
            Contact::Forward => self.limit - adhesion,
            Contact::Backward => -self.limit - adhesion,
            Contact::Stuck => 0.0,
        }
    }
}

impl Chain {
    /// `cable` on `mesh`.
    pub fn new(cable: &DuctedCable, mesh: &Mesh) -> Self {
        let last = mesh.elements();
        let stiffness = cable.axial_stiffness() / mesh.spacing();
        let compliance = cable.friction().compliance();
        let mut diagonal = vec![2.0; last + 1];
        let mut free = Stretch { lo: 0, hi: last };
        for (node, end) in [(0, cable.upstream()), (last, cable.downstream())] {
            diagonal[node] = 1.0 + end.stiffness().unwrap_or(0.0) / stiffness;
        }
        free.lo += usize::from(cable.upstream() == End::Fixed);
        free.hi -= usize::from(cable.downstream() == End::Fixed);
        let mut grips = Grip::of(cable, mesh);
        for grip in &mut grips {
            grip.diagonal = diagonal[grip.node];
        }
        for grip in &grips {
            diagonal[grip.node] += grip.stiffness / stiffness;
        }
        let mut bends = Vec::new();
        let node = |(i, &diagonal): (usize, &f64)| {
            let shares = || section::shares(cable.sections(), mesh, i);
            if shares().any(|(_, section)| section.bend > 0.0) {
                bends.push((i, shares().map(|(share, section)| (share, *section)).collect()));
            }
            let limit = limit_of(shares(), 0.0);
            Node::new(diagonal, mesh.tributary_length(i), limit, stiffness, compliance)
        };
        let nodes = diagonal.iter().enumerate().map(node).collect();
        let mut chain = Self {
            rounding: 0.0,
            stiffness,
            per_stiffness: 1.0 / stiffness,
            nodes,
            compliance,
            least_limit: cable.least_limit(),
            bends,
            free,
            grips,
            is_held: false,
        };
        let springs = free
            .nodes()
            .map(|i| rounding(chain.spring(i), chain.nodes[i].tributary));
        chain.rounding = rounding(stiffness, mesh.spacing()) + springs.fold(0.0, f64::max);
        chain.is_held = chain.holds();
        chain
    }

    /// Whether something holds the cable; a spring that rounding loses holds nothing.
    fn holds(&self) -> bool {
        let last = self.nodes.len() - 1;
        let mut springs = [0, last]
            .into_iter()
            .chain(self.grips.iter().map(|grip| grip.node));
        self.free.len() <= last || springs.any(|i| self.spring(i) > 0.0)
    }

    /// Leaves the node of a clamp those springs that stick.
    fn hang(&mut self, index: usize) {
        let Grip { node, diagonal, .. } = self.grips[index];
        let sticks = |grip: &&Grip| grip.node == node && grip.is_stuck();
        let springs: f64 = self.grips.iter().filter(sticks).map(|grip| grip.stiffness).sum();
        let Node { tributary, limit, .. } = self.nodes[node];
        let diagonal = diagonal + springs / self.stiffness;
        self.nodes[node] = Node::new(diagonal, tributary, limit, self.stiffness, self.compliance);
        self.is_held = self.holds();
    }

    /// Lets all clamps stick that have slipped by these `slips` before and after each \[m\].
    pub fn grip(&mut self, slips: &[[f64; 2]]) {
        for index in 0..self.grips.len() {
            let was_stuck = self.grips[index].is_stuck();
            self.grips[index].start(slips);
            if !was_stuck {
                self.hang(index);
            }
        }
    }

    /// Takes away the springs of clamps that have slid from `before` to `after`, and no others.
    pub fn release(&mut self, before: &[[f64; 2]], after: &[[f64; 2]]) {
        self.grip(after);
        for index in 0..self.grips.len() {
            if self.grips[index].slide(before) {
                self.hang(index);
            }
        }
    }

    /// Lets the clamps on `stretch` stick or slide as displacements `u` \[m\] demand. Returned: whether one of them does so otherwise
    /// than was assumed.
    pub fn correct_grips(&mut self, stretch: Stretch, u: impl Fn(usize) -> f64) -> bool {
        let mut corrected = false;
        for index in 0..self.grips.len() {
            let grip = &mut self.grips[index];
            if stretch.nodes().contains(&grip.node) && grip.correct(u(grip.node)) {
                self.hang(index);
                corrected = true;
            }
        }
        corrected
    }

    /// Adds what clamps do beside their springs to the `load` of every node \[N\], in a frame that has moved by `frame` \[m\] there.
    pub fn add_grip_loads(&self, load: &mut [f64], frame: impl Fn(usize) -> f64) {
        for grip in &self.grips {
            load[grip.node] += grip.load(frame(grip.node));
        }
    }

    /// Leaves the clamps to the caller.
    pub fn take_grips(&mut self) -> Vec<Grip> {
        for index in 0..self.grips.len() {
            self.grips[index].let_go();
            self.hang(index);
        }
        std::mem::take(&mut self.grips)
    }

    /// Whether a part of the duct bends.
    pub fn bends(&self) -> bool {
        !self.bends.is_empty()
    }

    /// Lets the cable press on the bends with the force that displacements `u` \[m\] and the thermal force \[N\] make. Returned: the
    /// largest change of a friction limit, as a share of it.
    pub fn press(&mut self, u: impl Fn(usize) -> f64, thermal_force: f64) -> f64 {
        let last = self.nodes.len() - 1;
        let mut change = 0.0_f64;
        for (i, shares) in &self.bends {
            let (before, after) = (i.saturating_sub(1), (i + 1).min(last));
            let stretch = (u(after) - u(before)) / (after - before) as f64;
            let shares = shares.iter().map(|(share, section)| (*share, section));
            let limit = limit_of(shares, thermal_force - self.stiffness * stretch);
            let before = std::mem::replace(&mut self.nodes[*i].limit, limit);
            change = change.max((limit - before).abs() / limit);
        }
        change
    }

    /// Neighbours of node i: one at an end, else two.
    pub fn neighbours(&self, i: usize) -> f64 {
        if i == 0 || i + 1 == self.nodes.len() {
            1.0
        } else {
            2.0
        }
    }

    /// Spring to the ground on node i \[N/m\].
    pub fn spring(&self, i: usize) -> f64 {
        self.stiffness * (self.nodes[i].diagonal - self.neighbours(i))
    }

    /// Unknowns of all nodes that solve the `row` of each that is free; zero at fixed ends.
    pub fn solve(&self, row: impl Fn(usize) -> Row) -> Vec<f64> {
        let Stretch { lo, hi } = self.free;
        let (mut x, mut factors) = (vec![0.0; self.nodes.len()], vec![0.0; self.free.len()]);
        tridiagonal::solve([0.0; 2], |k| row(lo + k), &mut factors, &mut x[lo..=hi]);
        x
    }

    /// Friction per metre \[N/m\] that balances node i: (K r + s r − p)/w.
    #[inline]
    pub fn balancing_friction(&self, r: &[f64], support: &[f64], i: usize) -> f64 {
        let left = if i > 0 { r[i - 1] } else { 0.0 };
        let right = r.get(i + 1).copied().unwrap_or(0.0);
        let node = &self.nodes[i];
        (self.stiffness * (node.diagonal * r[i] - left - right) - support[i]) * node.per_tributary
    }
}

/// Rounding error of a force per metre of node \[N/m\] for each metre of displacement, where springs of `stiffness` \[N/m\] act on a node
/// of length `tributary` \[m\].
pub(super) fn rounding(stiffness: f64, tributary: f64) -> f64 {
    4.0 * f64::EPSILON * stiffness / tributary
}
