//! A pass with inertia, from rest to rest.
//!
//! Before the vehicle comes and after it has left the duct stands at D = 0. One step without inertia takes it from there to
//! the vehicle's first position, one more from the last position back; the cable follows by its friction law, at rest
//! before and after.
//!
//! The step back also ends the cable's vibration. Stuck nodes of an elastic contact would swing on it undamped. The state
//! that a vibrating cable comes to, however weakly it is damped, is the equilibrium with the same anchors u + γ f: it moves
//! the cable by less than its vibration and leaves the mean where it was.
//!
//! For the `sigmoid` law, which has no memory, both are single steps of its own law: f = q tanh(b Δs/2) with Δs the slip
//! within the step. So long a step as the return of the duct's whole tail may then rub at the limit: what the law had left when
//! the vehicle was gone is [`ExplicitOutcome::force_before_rest`].

use super::energy::EnergyBalance;
use super::leak::SigmoidLeak;
use super::moving_duct::MovingDuct;
use crate::lumped::{Lumped, WholeStep};
use crate::outcome::Recorder;
use crate::step::{check_precision, largest};
use crate::{CableError, CableState, EndForces, PassOutcome, Statistics};

/// What one pass with inertia did.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct ExplicitOutcome {
    /// Forces, peaks and displacements as a quasi-static pass reports them. Peaks include vibration.
    ///
    /// In its statistics `steps` counts time steps, `node_updates` nodes advanced in time.
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
) -> Result<ExplicitOutcome, CableError> {
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
        return Ok(ExplicitOutcome {
            pass: recorder.outcome(&lumped.cable, state, force),
            time_step,
            energy: EnergyBalance::default(),
            force_before_rest: force,
            leak: None,
        });
    }
    check_precision(&lumped.cable, &lumped.mesh, &state.displacement, duct.peak())?;
    let mut moving = state.clone();
    let mut step = WholeStep::new(lumped);
    let mut follow = |time: f64, sign: f64, state: &mut CableState, statistics: &mut Statistics| {
        let mut increment = vec![0.0; lumped.mesh.nodes()];
        duct.displacement(time, &mut increment);
        for increment in &mut increment {
            *increment *= sign;
        }
        let largest = largest(&state.displacement, duct.peak());
        let heat = step.follow(&increment, largest, state, statistics);
        heat.map_err(|violation| CableError::NoConvergence {
            vehicle_position: duct.vehicle_position(time),
            violation,
        })
    };
    // From rest to the vehicle's first position, and from its last one back to rest.
    let arrival_heat = follow(0.0, 1.0, &mut moving, &mut recorder.statistics)?;
    let energy = run(&mut moving, &mut recorder)?;
    let force_before_rest = forces(&moving);
    let departure_heat = follow(duct.duration(), -1.0, &mut moving, &mut recorder.statistics)?;
    recorder.dissipated = arrival_heat + energy.dissipated + departure_heat;
    *state = moving;
    Ok(ExplicitOutcome {
        pass: recorder.outcome(&lumped.cable, state, forces(state)),
        time_step,
        energy,
        force_before_rest,
        leak: SigmoidLeak::new(&lumped.cable, time_step, duct),
    })
}
