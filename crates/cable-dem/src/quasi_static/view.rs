//! A look at the cable while the vehicle passes.

use super::passage::Snapshot;
use crate::{CableState, Mesh};

/// The cable at one vehicle position.
#[derive(Debug, Clone, Copy)]
pub struct StepView<'a> {
    pub(super) mesh: &'a Mesh,
    /// Friction limit \[N/m\].
    pub(super) limit: f64,
    /// The state in the adherent frame: r \[m\] and g \[N/m\].
    pub(super) r: &'a [f64],
    pub(super) g: &'a [f64],
    pub(super) snapshot: Snapshot<'a>,
    /// Reverse traffic is computed in the mirror.
    pub(super) mirrored: bool,
}

/// Lengths of cable over which the duct slips past it (Kashiro et al., Figure 7).
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[non_exhaustive]
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
        let position = self.mesh.lattice_step() * self.snapshot.position as f64;
        if self.mirrored {
            self.mesh.length() - position
        } else {
            position
        }
    }

    /// Displacement and friction of every node, whose forces [`CableState`] reads.
    pub fn state(&self) -> CableState {
        let mut state = CableState::at_rest(self.mesh);
        for node in 0..self.mesh.nodes() {
            state.displacement[node] = self.r[node] + self.snapshot.adherent_at(node);
            state.friction[node] = self.g[node] + self.snapshot.adhesion[node];
        }
        if self.mirrored {
            state.mirror();
        }
        state
    }

    /// Lengths of the slipping cable.
    pub fn slip_lengths(&self) -> SlipLengths {
        let limit = (1.0 - AT_LIMIT) * self.limit;
        let mut lengths = SlipLengths::default();
        for (node, &friction) in self.state().friction().iter().enumerate() {
            if friction >= limit {
                lengths.forward += self.mesh.tributary_length(node);
            } else if friction <= -limit {
                lengths.backward += self.mesh.tributary_length(node);
            }
        }
        lengths
    }
}
