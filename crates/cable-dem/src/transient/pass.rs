//! A pass with inertia, from rest to rest.

use super::energy::EnergyBalance;
use super::implicit::Implicit;
use super::leak::SigmoidLeak;
use super::lumped::Lumped;
use super::moving_duct::MovingDuct;
use super::rest::follow;
use crate::outcome::Recorder;
use crate::step::check_precision;
use crate::{CableError, CableState, EndForces, PassOutcome};

/// What one pass with inertia did.
#[derive(Debug, Clone, PartialEq)]
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

/// Takes `state` through a pass of `duct` with steps of `time_step` \[s\]; when it fails, `state` is as it was. `run` moves the cable on
/// from the vehicle's first position to its last.
pub(crate) fn pass(
    lumped: &Lumped,
    duct: &MovingDuct,
    time_step: f64,
    state: &mut CableState,
    run: impl FnOnce(&mut CableState, &mut Recorder) -> Result<EnergyBalance, CableError>,
) -> Result<TransientOutcome, CableError> {
    state.check(&lumped.mesh)?;
    duct.check(&lumped.mesh)?;
    if state.thermal_force != 0.0 {
        return Err(CableError::Heated);
    }
    let forces = |state: &CableState| lumped.end_forces(&state.displacement, &state.friction);
    let mut recorder = Recorder::new(forces(state));
    if lumped.cable.friction().limit() == 0.0 {
        // Nothing drags the cable.
        let force = forces(state);
        return Ok(TransientOutcome {
            pass: recorder.outcome(&lumped.cable, state, force),
            time_step,
            energy: EnergyBalance::default(),
            force_before_rest: force,
            leak: None,
        });
    }
    check_precision(&lumped.cable, &lumped.mesh, &state.displacement, duct.peak())?;
    let mut moving = state.clone();
    let mut solver = Implicit::new(lumped, 0.0);
    let mut follow = |ground, state: &mut CableState, recorder: &mut Recorder| {
        follow(ground, &mut solver, lumped, duct, state, &mut recorder.statistics)
    };
    // From rest to the vehicle's first position, and from its last one back to rest.
    let arrival_heat = follow((0.0, 1.0), &mut moving, &mut recorder)?;
    let energy = run(&mut moving, &mut recorder)?;
    let force_before_rest = forces(&moving);
    let departure_heat = follow((duct.duration(), -1.0), &mut moving, &mut recorder)?;
    recorder.dissipated = arrival_heat + energy.dissipated + departure_heat;
    *state = moving;
    Ok(TransientOutcome {
        pass: recorder.outcome(&lumped.cable, state, forces(state)),
        time_step,
        energy,
        force_before_rest,
        leak: SigmoidLeak::new(&lumped.cable, time_step, duct),
    })
}
