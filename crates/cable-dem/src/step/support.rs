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
    /// Whether a clamp that slips is on the node.
    pub slips: bool,
}

impl Support {
    /// The supports of `cable`, both ends always among them, ascending by node. A clamp between two nodes is shared
    /// between them by the lever rule.
    pub fn of(cable: &DuctedCable, mesh: &Mesh) -> Vec<Self> {
        let ends = [(0, cable.upstream()), (mesh.elements(), cable.downstream())];
        let supports = ends.map(|(node, end)| Self {
            node,
            stiffness: end.stiffness(),
            slips: false,
        });
        let mut supports = supports.to_vec();
        let clamps = cable.restraints().iter();
        let springs =
            clamps.flat_map(|clamp| clamp.by_node(mesh).map(|spring| (spring, clamp.holds.is_some())));
        for ((node, stiffness), slips) in springs.filter(|((_, stiffness), _)| *stiffness > 0.0) {
            match supports.iter_mut().find(|support| support.node == node) {
                Some(support) => {
                    support.stiffness = support.stiffness.map(|already| already + stiffness);
                    support.slips |= slips;
                }
                None => supports.push(Self {
                    node,
                    stiffness: Some(stiffness),
                    slips,
                }),
            }
        }
        supports.sort_by_key(|support| support.node);
        supports
    }
}
