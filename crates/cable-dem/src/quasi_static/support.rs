//! Ends and clamps: where the ground holds the cable otherwise than by friction.

use super::passage::Snapshot;
use crate::{DuctedCable, Mesh};

/// A node at which the passing vehicle acts otherwise than through the friction bounds.
#[derive(Debug, Clone)]
pub(crate) struct Support {
    pub node: usize,
    /// Spring to the ground \[N/m\]; `None` holds the node.
    pub stiffness: Option<f64>,
}

/// What a support feels of the vehicle in the adherent frame.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Forcing {
    /// Force of the adherent motion on a cable that is cut at an end \[N\]; zero elsewhere.
    pub cut: f64,
    /// Adherent displacement \[m\], against which the ground holds the node.
    pub adherent: f64,
    /// Adhesion \[N/m\], which a held node's friction has beside its own.
    pub adhesion: f64,
}

impl Support {
    /// The supports of `cable`, both ends always among them, ascending by node. A clamp between two nodes is shared
    /// between them by the lever rule.
    pub fn of(cable: &DuctedCable, mesh: &Mesh) -> Vec<Self> {
        let last = mesh.elements();
        let mut supports = vec![
            Self {
                node: 0,
                stiffness: cable.upstream().stiffness(),
            },
            Self {
                node: last,
                stiffness: cable.downstream().stiffness(),
            },
        ];
        for restraint in cable.restraints() {
            for (node, stiffness) in restraint.by_node(mesh) {
                if stiffness == 0.0 {
                    continue;
                }
                match supports.iter_mut().find(|support| support.node == node) {
                    Some(support) => {
                        support.stiffness = support.stiffness.map(|already| already + stiffness);
                    }
                    None => supports.push(Self {
                        node,
                        stiffness: Some(stiffness),
                    }),
                }
            }
        }
        supports.sort_by_key(|support| support.node);
        supports
    }

    /// Forcing at one vehicle position; `stiffness` is the chain's k = EA/h, `last` the last node.
    ///
    /// Beyond an end the adherent motion would go on; cutting the chain there leaves ±(k/2)(a_{+1} − a_{−1}), the force of
    /// the missing half.
    pub(super) fn forcing(&self, snapshot: &Snapshot<'_>, stiffness: f64, last: usize) -> Forcing {
        let index = self.node + 1;
        let strain = 0.5 * stiffness * (snapshot.adherent[index + 1] - snapshot.adherent[index - 1]);
        Forcing {
            cut: match self.node {
                0 => strain,
                node if node == last => -strain,
                _ => 0.0,
            },
            adherent: snapshot.adherent[index],
            adhesion: snapshot.adhesion[index],
        }
    }

    /// Load on the node \[N\] in the adherent frame.
    pub(super) fn load(&self, forcing: Forcing) -> f64 {
        forcing.cut - self.stiffness.unwrap_or(0.0) * forcing.adherent
    }
}
