//! How wrong the forces of a run may be, and where that comes from.

use serde::{Deserialize, Serialize};

use crate::error_source::ErrorSource;

/// How wrong the forces may be: how well the equations are solved, not how well they describe a
/// duct.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ErrorEstimate {
    /// Largest error of a force, after a pass and during it, on an end, inside the cable or on a
    /// clamp: as a share of the largest at its place, or of a tenth of the largest force of the run
    /// if that is more.
    pub relative: f64,
    /// How that was found.
    pub method: String,
    /// Its parts: `relative` is the sum of these without `law` and `movement`.
    pub parts: ErrorShares,
}

/// Error by its causes, each as a share of the force but the movement's own.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct ErrorShares {
    /// Node spacing and vehicle step.
    pub mesh: f64,
    /// What the ground model leaves out.
    pub ground: f64,
    /// Inertia of the cable, where it is left out: a bound.
    pub inertia: f64,
    /// Road beyond where vehicles are followed.
    pub road: f64,
    /// Passes that were not simulated.
    pub passes: f64,
    /// Heat and traffic of days of which few passes were simulated, or none.
    #[serde(default)]
    pub temperature: f64,
    /// The same as `passes`, by its older name.
    pub law: f64,
    /// Largest error of an end's movement from all causes, as a share of the largest movement.
    pub movement: f64,
}

impl ErrorShares {
    /// The part that comes from `source`: those of all sources sum to the whole error of the
    /// forces.
    pub fn of(&self, source: ErrorSource) -> f64 {
        let Self {
            mesh,
            ground,
            inertia,
            road,
            passes,
            temperature,
            ..
        } = *self;
        [mesh, ground, inertia, road, passes, temperature][source as usize]
    }
}
