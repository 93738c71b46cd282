//! One node of the chain, and its row in the linear system.

use crate::problem::Contact;
use crate::tridiagonal::Row;

/// What belongs to one node.
#[derive(Debug, Clone, Copy)]
pub struct Node {
    /// Diagonal of K + S, in units of the chain's stiffness k.
    pub diagonal: f64,
    /// Length of cable w \[m\] whose friction acts here.
    pub tributary: f64,
    /// 1/w \[1/m\].
    pub per_tributary: f64,
    /// Friction limit q \[N/m\].
    pub limit: f64,
    /// Shares of each neighbour and of the anchor in the row of a stuck node: s/(1 + s · diagonal) and 1/(1 + s · diagonal) with the
    /// contact's softness s = γ k/w relative to the chain's.
    stuck: [f64; 2],
    /// The share of each neighbour in the row of a slipping node, 1/diagonal.
    slipping: f64,
}

impl Node {
    /// One on a chain of `stiffness` k \[N/m\] whose contact has the `compliance` γ \[m²/N\].
    pub(crate) fn new(diagonal: f64, tributary: f64, limit: f64, stiffness: f64, compliance: f64) -> Self {
        let softness = compliance * stiffness / tributary;
        let share = 1.0 / (1.0 + softness * diagonal);
        Self {
            diagonal,
            tributary,
            per_tributary: 1.0 / tributary,
            limit,
            stuck: [softness * share, share],
            slipping: 1.0 / diagonal,
        }
    }

    /// Its row for a given contact state: a stuck node reads r + γ g = anchor, a slipping one equilibrium with g at its bound. Of the load
    /// p/k \[m\], the adhesion \[N/m\] and the anchor \[m\] are given.
    #[inline]
    pub(crate) fn row(&self, contact: Contact, load: [f64; 3], per_stiffness: f64) -> Row {
        let [load, adhesion, anchor] = load;
        if contact == Contact::Stuck {
            let [share, of_anchor] = self.stuck;
            let value = of_anchor * anchor + share * load;
            return Row { share, value };
        }
        let friction = self.tributary * self.bound(contact, adhesion) * per_stiffness;
        let (share, value) = (self.slipping, self.slipping * (friction + load));
        Row { share, value }
    }

    /// Bound of the friction g in the slipping state `contact` \[N/m\].
    #[inline]
    pub(crate) fn bound(&self, contact: Contact, adhesion: f64) -> f64 {
        match contact {
            Contact::Forward => self.limit - adhesion,
            Contact::Backward => -self.limit - adhesion,
            Contact::Stuck => 0.0,
        }
    }
}

/// Rounding error of a force per metre of node \[N/m\] for each metre of displacement, where springs of `stiffness` \[N/m\] act on a node
/// with the length `tributary` \[m\].
pub fn rounding(stiffness: f64, tributary: f64) -> f64 {
    4.0 * f64::EPSILON * stiffness / tributary
}
