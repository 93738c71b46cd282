//! The ground at rest: how a pass with inertia begins and ends.
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
//! the vehicle was gone is [`crate::TransientOutcome::force_before_rest`].

use super::implicit::Implicit;
use super::lumped::Lumped;
use super::moving_duct::MovingDuct;
use crate::step::largest;
use crate::{CableError, CableState, Statistics};

/// One step of the cable after the ground, which moves by `sign` times the duct's displacement at `time` \[s\], by a `solver` without
/// inertia. Returns the heat of the slip \[J\].
pub(super) fn follow(
    (time, sign): (f64, f64),
    solver: &mut Implicit,
    lumped: &Lumped,
    duct: &MovingDuct,
    state: &mut CableState,
    statistics: &mut Statistics,
) -> Result<f64, CableError> {
    let (mut increment, mut friction) = (vec![0.0; lumped.mesh.nodes()], state.friction.clone());
    duct.displacement(time, &mut increment);
    for increment in &mut increment {
        *increment *= sign;
    }
    solver.start(largest(&state.displacement, duct.peak()));
    solver.load_elastic(lumped, &state.displacement);
    let moved = solver.solve(lumped, &increment, &mut friction);
    let moved = moved.map_err(|violation| CableError::NoConvergence {
        vehicle_position: duct.vehicle_position(time),
        violation,
    })?;
    let compliance = lumped.elastic_compliance();
    let heat = lumped.weighted(|i| {
        friction[i] * (increment[i] - moved[i] - compliance * (friction[i] - state.friction[i]))
    });
    for (u, r) in state.displacement.iter_mut().zip(moved) {
        *u += r;
    }
    state.friction = friction;
    *statistics += solver.statistics();
    Ok(heat)
}
