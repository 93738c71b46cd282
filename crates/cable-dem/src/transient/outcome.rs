//! What a pass with inertia reports.

use super::{EnergyBalance, Lumped, SigmoidLeak};
use crate::{CableState, EndForces, PassOutcome, Statistics};

/// What one pass with inertia did.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TransientOutcome {
    /// Forces, peaks and displacements as a quasi-static pass reports them. Peaks include vibration.
    ///
    /// In its statistics `steps` counts time steps, `sweeps` linear solves of the whole cable (none when explicit),
    /// `node_updates` nodes advanced in time or eliminated.
    pub pass: PassOutcome,
    /// Duration of one step \[s\].
    pub time_step: f64,
    /// Energies of the pass.
    pub energy: EnergyBalance,
    /// Force on each end \[N\] at the last instant of the pass, before the cable came to rest.
    pub force_before_rest: EndForces,
    /// What a law without memory loses; `None` for the others.
    pub leak: Option<SigmoidLeak>,
}

impl TransientOutcome {
    /// Of a pass that touched nothing.
    pub(crate) fn untouched(pass: PassOutcome, time_step: f64) -> Self {
        Self {
            pass,
            time_step,
            energy: EnergyBalance::default(),
            force_before_rest: pass.force,
            leak: None,
        }
    }
}

/// End forces as the vehicle passes.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Record {
    pub peak: EndForces,
    pub lowest: EndForces,
    pub statistics: Statistics,
}

impl Record {
    pub fn new(start: EndForces) -> Self {
        Self {
            peak: start,
            lowest: start,
            statistics: Statistics::default(),
        }
    }

    pub fn add(&mut self, force: EndForces) {
        self.peak.upstream = self.peak.upstream.max(force.upstream);
        self.peak.downstream = self.peak.downstream.max(force.downstream);
        self.lowest.upstream = self.lowest.upstream.min(force.upstream);
        self.lowest.downstream = self.lowest.downstream.min(force.downstream);
    }

    /// The outcome of a pass that left the cable in `state`.
    pub fn outcome(mut self, lumped: &Lumped, state: &CableState) -> PassOutcome {
        let force = lumped.end_forces(state.displacement(), state.friction());
        self.add(force);
        PassOutcome {
            force,
            peak: self.peak,
            lowest: self.lowest,
            max_compression: state
                .element_forces(&lumped.cable, &lumped.mesh)
                .chain([force.upstream, force.downstream])
                .fold(f64::NEG_INFINITY, f64::max),
            upstream_displacement: state.displacement()[0],
            downstream_displacement: state.displacement()[lumped.mesh.elements()],
            dissipated: 0.0,
            statistics: self.statistics,
        }
    }
}
