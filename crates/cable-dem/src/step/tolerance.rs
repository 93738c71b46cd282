//! How exactly a step must hold, and when rounding forbids it.

use super::problem::{Chain, rounding};
use crate::{CableError, DuctedCable, Mesh};

/// Share of the friction limit up to which rounding may blur equilibrium.
const MAX_ROUNDING: f64 = 1e-3;
/// Accuracy of friction and equilibrium inside a step, as a share of the friction limit.
const FRICTION_ACCURACY: f64 = 1e-9;
/// Accuracy of slip, as a share of the largest displacement. What a slipping node may slip the wrong way adds up over
/// thousands of steps: it has to be far below the slip of one step.
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

/// Refuses a cable whose elastic forces rounding blurs when the displacements `u` \[m\], or those of the duct with their `peak`, act on it.
pub(crate) fn check_precision(
    cable: &DuctedCable,
    mesh: &Mesh,
    u: &[f64],
    peak: f64,
) -> Result<(), CableError> {
    let h = mesh.spacing();
    let share = rounding(cable.axial_stiffness() / h, h) * largest(u, peak) / cable.friction().limit();
    // Written so that NaN fails.
    if share <= MAX_ROUNDING {
        Ok(())
    } else {
        Err(CableError::Precision {
            share,
            axial_stiffness: cable.axial_stiffness(),
            spacing: h,
        })
    }
}

/// The largest of |u| and `peak`.
pub(crate) fn largest(u: &[f64], peak: f64) -> f64 {
    u.iter().fold(peak, |largest, u| largest.max(u.abs()))
}
