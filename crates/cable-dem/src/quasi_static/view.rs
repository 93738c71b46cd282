//! A look at the cable while the vehicle passes.

use super::passage::Snapshot;
use super::sweeper::Sweeper;

/// The cable at one vehicle position.
#[derive(Debug, Clone, Copy)]
pub struct StepView<'a> {
    pub(super) sweeper: &'a Sweeper,
    pub(super) snapshot: Snapshot<'a>,
    /// Reverse traffic is computed in the mirror.
    pub(super) mirrored: bool,
}

/// Lengths of cable over which the duct slips past it (Kashiro et al., Figure 7).
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct SlipLengths {
    /// Friction at its limit toward growing x \[m\].
    pub forward: f64,
    /// Friction at its limit toward falling x \[m\].
    pub backward: f64,
}

/// Friction within this share of its limit counts as slipping.
const AT_LIMIT: f64 = 1e-6;

impl StepView<'_> {
    /// Position of the vehicle's origin along the duct \[m\].
    pub fn vehicle_position(&self) -> f64 {
        let mesh = self.sweeper.mesh();
        let position = mesh.lattice_step() * self.snapshot.position as f64;
        if self.mirrored {
            mesh.spacing() * mesh.elements() as f64 - position
        } else {
            position
        }
    }

    /// Displacement of a node \[m\]; past the last one, of the last.
    pub fn displacement(&self, node: usize) -> f64 {
        let (node, sign) = self.place(node);
        sign * self.sweeper.displacement(node, &self.snapshot)
    }

    /// Friction on the cable at a node \[N/m\]; past the last one, of the last.
    pub fn friction(&self, node: usize) -> f64 {
        let (node, sign) = self.place(node);
        sign * self.sweeper.friction(node, &self.snapshot)
    }

    /// Force in the element between `node` and the next \[N\], compression positive; past the last element, nothing.
    pub fn element_force(&self, node: usize) -> f64 {
        self.sweeper.stiffness() * (self.displacement(node) - self.displacement(node.saturating_add(1)))
    }

    /// Lengths of the slipping cable.
    pub fn slip_lengths(&self) -> SlipLengths {
        let mesh = self.sweeper.mesh();
        let limit = (1.0 - AT_LIMIT) * self.sweeper.limit();
        let mut lengths = SlipLengths::default();
        for node in 0..mesh.nodes() {
            let friction = self.friction(node);
            if friction >= limit {
                lengths.forward += mesh.tributary_length(node);
            } else if friction <= -limit {
                lengths.backward += mesh.tributary_length(node);
            }
        }
        lengths
    }

    fn place(&self, node: usize) -> (usize, f64) {
        let last = self.sweeper.mesh().elements();
        let node = node.min(last);
        if self.mirrored {
            (last - node, -1.0)
        } else {
            (node, 1.0)
        }
    }
}
