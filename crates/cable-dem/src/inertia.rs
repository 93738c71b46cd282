//! Whether inertia matters.

use crate::error::positive;
use crate::{CableError, DuctedCable};

/// Inertia ratio v²/c² = m′ v²/EA of `cable` with `mass_per_metre` m′ \[kg/m\] under a vehicle at `speed` v \[m/s\]: by this
/// share inertia softens the cable near the vehicle, and at most this share of the force is in error without it, on a converged mesh.
///
/// A pattern that travels with the vehicle, u(x − v t), has ü = v² u″, so that m′ü = EA u″ + f becomes
///
/// EA (1 − v²/c²) u″ + f = 0,  c = √(EA/m′):
///
/// near the vehicle inertia does nothing but soften the cable by the share v²/c². The force that creepage builds up is
/// smaller by a part of that share; on the 30 m scene (elastic-plastic, h = 0.1 m, 10 passes)
///
/// | km/h | v²/c² | change of force against quasi-static |
/// |---|---|---|
/// | 40 | 1.7e-4 | −0.01 % |
/// | 100 | 1.1e-3 | −0.04 % |
/// | 300 | 9.6e-3 | −0.29 % |
/// | 1000 | 1.1e-1 | −4.1 % |
///
/// a third to a half of the ratio, which so bounds the error of leaving inertia out. What does not travel with the vehicle,
/// waves from the ends and from the first slip, runs at c ≫ v and is damped by friction before it adds as much. Only
/// where there is hardly any friction (below 1e-3 N/m on that scene) does it ring on: peaks are then 10 % higher than
/// without inertia, while the force after the pass is the same.
///
/// # Errors
///
/// [`CableError::InvalidParameter`] unless mass and speed are finite and positive.
pub fn inertia_ratio(cable: &DuctedCable, mass_per_metre: f64, speed: f64) -> Result<f64, CableError> {
    positive("mass_per_metre", mass_per_metre)?;
    positive("speed", speed)?;
    Ok(mass_per_metre * speed * speed / cable.axial_stiffness())
}
