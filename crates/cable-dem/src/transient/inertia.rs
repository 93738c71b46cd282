//! Whether inertia matters.
//!
//! A pattern that travels with the vehicle, u(x − v t), has ü = v² u″, so that m′ü = EA u″ + f becomes
//!
//! EA (1 − v²/c²) u″ + f = 0,  c = √(EA/m′):
//!
//! near the vehicle inertia does nothing but soften the cable by the share v²/c². The force that creepage builds up
//! then changes by about (v²/c²) · ∂ln F/∂ln EA; the derivative is of order one unless the cable nearly follows its duct.
//! What does not travel with the vehicle, waves from the ends and from the first slip, runs at c ≫ v and is damped by
//! friction before it adds anything of the same order.

use crate::DuctedCable;
use crate::error::checked;

/// Inertia ratio v²/c² = m′ v²/EA of `cable` with `mass_per_metre` m′ \[kg/m\] under a vehicle at `speed` v \[m/s\]: the
/// relative change of stiffness that inertia amounts to, and the size of the relative error of leaving it out.
///
/// # Errors
///
/// [`crate::CableError::InvalidParameter`] unless mass and speed are finite and positive.
pub fn inertia_ratio(cable: &DuctedCable, mass_per_metre: f64, speed: f64) -> Result<f64, crate::CableError> {
    checked("mass_per_metre", mass_per_metre, "finite and positive", |v| v > 0.0)?;
    checked("speed", speed, "finite and positive", |v| v > 0.0)?;
    Ok(mass_per_metre * speed * speed / cable.axial_stiffness())
}
