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

use super::support::Support;
use crate::{DuctedCable, Mesh};

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
    /// k = EA/h \[N/m\].
    pub stiffness: f64,
    pub nodes: Vec<Node>,
    /// Shear compliance γ \[m²/N\]; 0 for Coulomb's law.
    pub compliance: f64,
    /// Friction limit q \[N/m\].
    pub limit: f64,
    /// The unknown nodes: all but fixed ends.
    pub free: Stretch,
    /// Rounding error of a node's force per metre \[N/m\], for each metre of displacement.
    pub rounding: f64,
}

/// What belongs to one node. Side by side, so that a row has one address: a run takes 5 % less time than with a list of each.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Node {
    /// Diagonal of K + s in units of k.
    pub diagonal: f64,
    /// 1/diagonal: the share of each neighbour in the row of a slipping node.
    pub per_diagonal: f64,
    /// Tributary length w \[m\].
    pub tributary: f64,
    /// 1/w \[1/m\].
    pub per_tributary: f64,
    /// Shares of each neighbour and of the anchor in the row of a stuck node: s/(1 + s · diagonal) and 1/(1 + s · diagonal) with the
    /// contact's softness s = γ k/w beside the chain's.
    pub stuck: (f64, f64),
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

/// A row once it is eliminated: r_i = value + factor · r of the neighbour towards the middle.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Eliminated {
    pub value: f64,
    pub factor: f64,
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
    /// Storage of the elimination.
    pub eliminated: Vec<Eliminated>,
}

impl Stretch {
    pub fn nodes(self) -> std::ops::RangeInclusive<usize> {
        self.lo..=self.hi
    }

    pub fn len(self) -> usize {
        self.hi + 1 - self.lo
    }
}

impl Trial {
    /// At rest and stuck.
    pub fn new(nodes: usize) -> Self {
        Self {
            r: vec![0.0; nodes],
            g: vec![0.0; nodes],
            contact: vec![Contact::Stuck; nodes],
            eliminated: vec![Eliminated::default(); nodes],
        }
    }
}

impl Node {
    /// Those of a chain of `stiffness` k \[N/m\] whose contact has the `compliance` γ \[m²/N\].
    pub fn of(diagonal: &[f64], tributary: &[f64], stiffness: f64, compliance: f64) -> Vec<Self> {
        let node = |(&diagonal, &tributary): (&f64, &f64)| {
            let softness = compliance * stiffness / tributary;
            let share = 1.0 / (1.0 + softness * diagonal);
            Self {
                diagonal,
                per_diagonal: 1.0 / diagonal,
                tributary,
                per_tributary: 1.0 / tributary,
                stuck: (softness * share, share),
            }
        };
        diagonal.iter().zip(tributary).map(node).collect()
    }
}

impl Chain {
    /// `cable` on `mesh`.
    pub fn new(cable: &DuctedCable, mesh: &Mesh) -> Self {
        let last = mesh.elements();
        let stiffness = cable.axial_stiffness() / mesh.spacing();
        let compliance = cable.friction().compliance();
        let tributary: Vec<f64> = (0..=last).map(|i| mesh.tributary_length(i)).collect();
        let mut diagonal = vec![2.0; last + 1];
        diagonal[0] -= 1.0;
        diagonal[last] -= 1.0;
        let mut free = Stretch { lo: 0, hi: last };
        let mut stiffest = 0.0_f64;
        for Support {
            node,
            stiffness: spring,
        } in Support::of(cable, mesh)
        {
            match spring {
                Some(spring) => {
                    diagonal[node] += spring / stiffness;
                    stiffest = stiffest.max(rounding(spring, tributary[node]));
                }
                None if node == 0 => free.lo = 1,
                None => free.hi = last - 1,
            }
        }
        Self {
            rounding: rounding(stiffness, mesh.spacing()) + stiffest,
            stiffness,
            nodes: Node::of(&diagonal, &tributary, stiffness, compliance),
            compliance,
            limit: cable.friction().limit(),
            free,
        }
    }

    /// Bound of the friction g in the slipping state `contact` \[N/m\].
    pub fn bound(&self, contact: Contact, adhesion: f64) -> f64 {
        match contact {
            Contact::Forward => self.limit - adhesion,
            Contact::Backward => -self.limit - adhesion,
            Contact::Stuck => 0.0,
        }
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
