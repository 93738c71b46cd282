//! Collects a cable's clamps and end springs: where the ground holds it otherwise than by friction.
//! They enter the matrix in [`super::problem`]; when the cable around one is solved again is
//! decided in `quasi_static/supports.rs`.

use crate::{DuctedCable, Mesh};

/// A node at which the ground holds the cable.
#[derive(Debug, Clone)]
pub(crate) struct Support {
    pub node: usize,
    /// Spring to the ground \[N/m\]; `None` holds the node.
    pub stiffness: Option<f64>,
}

impl Support {
    /// The supports of `cable`, both ends always among them, ascending by node. A clamp between two nodes is shared
    /// between them by the lever rule.
    pub fn of(cable: &DuctedCable, mesh: &Mesh) -> Vec<Self> {
        let ends = [(0, cable.upstream()), (mesh.elements(), cable.downstream())];
        let supports = ends.map(|(node, end)| Self {
            node,
            stiffness: end.stiffness(),
        });
        let mut supports = supports.to_vec();
        for (node, stiffness) in cable.restraints().iter().flat_map(|clamp| clamp.by_node(mesh)) {
            if stiffness == 0.0 {
                continue;
            }
            match supports.iter_mut().find(|support| support.node == node) {
                Some(support) => support.stiffness = support.stiffness.map(|already| already + stiffness),
                None => supports.push(Self {
                    node,
                    stiffness: Some(stiffness),
                }),
            }
        }
        supports.sort_by_key(|support| support.node);
        supports
    }
}
