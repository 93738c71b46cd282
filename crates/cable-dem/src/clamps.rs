//! What load cells at clamps read: the force of each spring, at most what the clamp holds.

use crate::{DuctedCable, Mesh, Restraint};

/// Reads the forces on clamps.
#[derive(Debug, Clone)]
pub(crate) struct ClampReader {
    /// Every clamp as springs \[N/m\] on the nodes around it, and what it holds \[N\].
    clamps: Vec<([(usize, f64); 2], f64)>,
}

impl ClampReader {
    pub fn new(cable: &DuctedCable, mesh: &Mesh) -> Self {
        let clamp = |clamp: &Restraint| (clamp.by_node(mesh), clamp.holds.unwrap_or(f64::INFINITY));
        Self {
            clamps: cable.restraints().iter().map(clamp).collect(),
        }
    }

    pub fn is_empty(&self) -> bool {
        self.clamps.is_empty()
    }

    /// Force of the cable on each clamp \[N\], positive toward growing x, from how far they have slipped \[m\] and the displacement \[m\]
    /// of any node.
    pub fn read(&self, slips: &[[f64; 2]], displacement: impl Fn(usize) -> f64) -> impl Iterator<Item = f64> {
        self.clamps
            .iter()
            .enumerate()
            .map(move |(clamp, (springs, holds))| {
                let slips = slips.get(clamp).copied().unwrap_or_default();
                let springs = springs.iter().zip(slips);
                let force = springs.map(|((node, stiffness), slip)| stiffness * (displacement(*node) - slip));
                force.sum::<f64>().clamp(-holds, *holds)
            })
    }
}
