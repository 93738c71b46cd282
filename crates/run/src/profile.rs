//! Motion of the duct under the first vehicle, along the duct.

use ground_field::GroundError;
use serde::Serialize;

use crate::answer::error_estimate::{self, ErrorParts};
use creepage_plan::{Error, finite, ground::Ground};
use creepage_scene::Scene;

/// Farthest position from the vehicle \[m\].
const FARTHEST: f64 = 1e6;

/// Displacement and velocity of the duct at positions ξ = x − x_v along it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Profile {
    /// Ground model.
    pub ground: String,
    /// ξ \[m\].
    pub positions_m: Vec<f64>,
    /// D_l \[m\], positive toward growing x.
    pub longitudinal_m: Vec<f64>,
    /// D_v \[m\], positive downward.
    pub vertical_m: Vec<f64>,
    /// V_l = −v dD_l/dξ \[m/s\] (Kashiro et al., Equation (1)).
    pub longitudinal_velocity_m_per_s: Vec<f64>,
}

/// The profile over eight depths to either side of the vehicle.
///
/// # Errors
///
/// [`Error`] when the ground model does not fit the scene or cannot be computed.
pub fn profile(scene: &Scene) -> Result<Profile, Error> {
    scene.validate()?;
    let wheels = scene.vehicles[0].wheels();
    let half = 8.0 * scene.duct.depth + wheels.iter().map(|wheel| wheel.x.abs()).fold(0.0, f64::max);
    let positions: Vec<f64> = (-80..=80).map(|k| half * f64::from(k) / 80.0).collect();
    profile_at(scene, &positions)
}

/// The profile at the given positions ξ \[m\].
///
/// # Errors
///
/// As for [`profile`]; also for a position that is farther than 1000 km from the vehicle, or not a
/// number.
pub fn profile_at(scene: &Scene, positions: &[f64]) -> Result<Profile, Error> {
    scene.validate()?;
    let far = positions.iter().find(|xi| !(-FARTHEST..=FARTHEST).contains(*xi));
    if let Some(&value) = far {
        let (name, allowed) = ("position", "from -1000 km to 1000 km");
        return Err(GroundError::InvalidParameter { name, value, allowed }.into());
    }
    let reach = positions
        .iter()
        .fold(scene.duct.depth, |reach, xi| reach.max(xi.abs()));
    profile_over(scene, &Ground::new(scene, None, reach)?, positions)
}

/// The profile over the `ground` of `scene`, which reaches as far as `positions`.
pub fn profile_over(scene: &Scene, ground: &Ground, positions: &[f64]) -> Result<Profile, Error> {
    error_estimate::judge(&ErrorParts::new(ground.accuracy, 0.0), scene.solver.tolerance)?;
    let first = &ground.motions[0];
    let all = |of: &dyn Fn(f64) -> f64| positions.iter().map(|&xi| of(xi)).collect();
    let profile = Profile {
        ground: ground.name.into(),
        positions_m: positions.to_vec(),
        longitudinal_m: all(&|xi| first.longitudinal(xi)),
        vertical_m: all(&|xi| first.vertical(xi)),
        longitudinal_velocity_m_per_s: all(&|xi| first.longitudinal_velocity(xi)),
    };
    finite::check(&profile)?;
    Ok(profile)
}
