//! What a pass with inertia reports.

use super::{EnergyBalance, Lumped, MovingDuct, Settler, SigmoidLeak};
use crate::outcome::Recorder;
use crate::{CableError, CableState, EndForces, PassOutcome};

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
    /// Energies of the pass, between its two steps from rest and to it.
    pub energy: EnergyBalance,
    /// Force on each end \[N\] at the last instant of the pass, before ground and cable came to rest.
    pub force_before_rest: EndForces,
    /// What a law without memory loses; `None` for the others.
    pub leak: Option<SigmoidLeak>,
}

impl TransientOutcome {
    /// Of a pass that touched nothing.
    pub(crate) fn untouched(lumped: &Lumped, state: &CableState, time_step: f64) -> Self {
        let force = lumped.end_forces(&state.displacement, &state.friction);
        Self {
            pass: Recorder::new(force).outcome(&lumped.cable, state, force),
            time_step,
            energy: EnergyBalance::default(),
            force_before_rest: force,
            leak: None,
        }
    }
}

/// A pass whose vehicle has left, the cable still moving.
#[derive(Debug)]
pub(crate) struct Departed<'a> {
    pub duct: &'a MovingDuct,
    pub time_step: f64,
    pub energy: EnergyBalance,
    /// Heat of slip as the ground moved to the vehicle's first position \[J\].
    pub arrival_heat: f64,
    /// The cable at the last instant.
    pub moving: CableState,
    pub recorder: Recorder,
}

impl Departed<'_> {
    /// Brings ground and cable to rest and reports: the state it is left in, and the outcome.
    pub fn close(
        self,
        lumped: &Lumped,
        settler: &mut Settler,
    ) -> Result<(CableState, TransientOutcome), CableError> {
        let Self {
            duct,
            time_step,
            energy,
            arrival_heat,
            moving: mut state,
            mut recorder,
        } = self;
        let force_before_rest = lumped.end_forces(&state.displacement, &state.friction);
        let departure_heat = settler.leave(lumped, duct, &mut state, &mut recorder.statistics)?;
        recorder.dissipated = arrival_heat + energy.dissipated + departure_heat;
        let force = lumped.end_forces(&state.displacement, &state.friction);
        let outcome = TransientOutcome {
            pass: recorder.outcome(&lumped.cable, &state, force),
            time_step,
            energy,
            force_before_rest,
            leak: SigmoidLeak::new(&lumped.cable, time_step, duct),
        };
        Ok((state, outcome))
    }
}
