//! What a pass with inertia reports.

use super::energy::EnergyBalance;
use super::leak::SigmoidLeak;
use crate::{EndForces, PassOutcome};

/// What one pass with inertia did.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct TransientOutcome {
    /// Forces, peaks and displacements as a quasi-static pass reports them. Peaks include vibration.
    ///
    /// In its statistics `steps` counts time steps, `sweeps` linear solves of the whole cable (none when explicit),
    /// `node_updates` nodes advanced in time or eliminated.
    pub pass: PassOutcome,
    /// Duration of one step \[s\].
    pub time_step: f64,
    /// Energies of the pass, between its two steps from rest and to it.
    pub energy: EnergyBalance,
    /// Force on each end \[N\] at the last instant of the pass, before ground and cable came to rest.
    pub force_before_rest: EndForces,
    /// What a law without memory loses; `None` for the others.
    pub leak: Option<SigmoidLeak>,
}
