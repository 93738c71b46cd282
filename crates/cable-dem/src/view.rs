//! A look at the cable while the vehicle passes.

use crate::{CableState, Mesh};

/// The cable at one vehicle position.
#[derive(Clone, Copy)]
pub struct StepView<'a> {
    /// Position of the vehicle's origin along the duct \[m\].
    pub(crate) vehicle_position: f64,
    pub(crate) mesh: &'a Mesh,
    /// Friction limit \[N/m\].
    pub(crate) limit: f64,
    /// Puts the state together: no solver keeps it in this form.
    pub(crate) state: &'a dyn Fn() -> CableState,
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
        self.vehicle_position
    }

    /// Displacement and friction of every node, whose forces [`CableState`] reads.
    pub fn state(&self) -> CableState {
        (self.state)()
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
