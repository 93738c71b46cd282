//! How exactly a step must hold.

use crate::chain::Chain;

/// Accuracy of friction and equilibrium, as a share of the friction limit.
const FRICTION_ACCURACY: f64 = 1e-9;
/// Accuracy of slip, as a share of the largest displacement. What a slipping node may slip the wrong way adds up over thousands of steps:
/// it has to be far below the slip of one step.
const SLIP_ACCURACY: f64 = 1e-12;

/// How exactly a step's answer must hold.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Tolerance {
    /// On friction and equilibrium \[N/m\].
    pub friction: f64,
    /// On slip \[m\].
    pub slip: f64,
}

impl Tolerance {
    /// For steps of `chain` in which displacements reach `largest` \[m\].
    pub fn new(chain: &Chain, largest: f64) -> Self {
        let friction = (FRICTION_ACCURACY * chain.least_limit).max(16.0 * chain.rounding * largest);
        let slip = SLIP_ACCURACY * largest + chain.compliance * friction;
        Self { friction, slip }
    }
}
