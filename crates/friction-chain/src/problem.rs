//! The problem of one step: a double obstacle.
//!
//! Unknown are the displacements r of the nodes of one stretch. With K the chain's stiffness, S that of the springs to the ground, p the
//! loads and w_i the length of cable at node i, the step minimises the convex energy
//!
//! ½ rᵀ(K + S) r − pᵀr + Σ w_i Φ_i(r_i),
//!
//! where −Φ′ = g = clamp((anchor − r)/γ, −q − A, q − A) is the friction: q its limit, A the adhesion, γ the compliance of the contact.
//! Each node is in one of three [`Contact`] states, and once these are known r follows from a linear system. An answer is right exactly
//! when every stuck node's friction lies within its bounds and every slipping node has slipped the way its friction points.

use crate::stretch::Stretch;

/// State of the contact between one node and the duct.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Contact {
    /// Friction within its bounds, slip elastic.
    Stuck,
    /// The duct slips forward past the node: friction at its upper bound.
    Forward,
    /// The duct slips backward past the node: friction at its lower bound.
    Backward,
}

/// What a step is given: a value for every node of the chain in each slice.
#[derive(Debug, Clone, Copy)]
pub struct Load<'a> {
    /// Adhesion A \[N/m\], friction that is not the step's: it shifts both bounds by −A.
    pub adhesion: &'a [f64],
    /// Loads p \[N\].
    pub support: &'a [f64],
    /// Where the duct holds the node \[m\]: r + γ g before the step, and how far the duct has moved since.
    pub anchor: &'a [f64],
}

/// A trial answer: a value for every node of the chain in each. Nodes outside the stretch that is solved are held at their `r`.
#[derive(Debug, Clone)]
pub struct Trial {
    /// Displacement \[m\].
    pub r: Vec<f64>,
    /// Friction \[N/m\].
    pub g: Vec<f64>,
    /// Contact states; before a solve, the guess with which it begins.
    pub contact: Vec<Contact>,
}

impl Load<'_> {
    /// On the nodes of one stretch alone.
    #[inline]
    pub(crate) fn on(&self, stretch: Stretch) -> Self {
        Self {
            adhesion: stretch.of(self.adhesion),
            support: stretch.of(self.support),
            anchor: stretch.of(self.anchor),
        }
    }
}

impl Trial {
    /// At rest and stuck.
    pub(crate) fn new(nodes: usize) -> Self {
        Self {
            r: vec![0.0; nodes],
            g: vec![0.0; nodes],
            contact: vec![Contact::Stuck; nodes],
        }
    }
}
