//! How far out on the road a vehicle is followed; [`cable_dem::approach`] says why.

use cable_dem::CableError;
use ground_field::DuctMotion;

use crate::scene::{Scene, TrafficVehicle};

/// The road is looked at over a hundred times the distance from wheel to duct, and ten times the thickness of the layers.
const FARTHEST_DISTANCES: f64 = 100.0;
const FARTHEST_THICKNESSES: f64 = 10.0;
/// But no farther than this \[m\].
const FARTHEST: f64 = 3000.0;

/// How far the road is looked at \[m\], measured from a vehicle's origin.
pub fn farthest(scene: &Scene) -> f64 {
    let wheels = || scene.vehicles.iter().flat_map(TrafficVehicle::wheels);
    let ahead = wheels().map(|wheel| wheel.x.abs()).fold(0.0, f64::max);
    let aside = scene.vehicles.iter().flat_map(|traffic| {
        let offset = scene.offset_from(traffic).abs();
        let wheels = traffic.wheels().into_iter();
        wheels.map(move |wheel| wheel.y.abs() + offset)
    });
    let aside = aside.fold(0.0, f64::max);
    let thickness = scene.ground.thickness();
    let far = (FARTHEST_DISTANCES * scene.duct.depth.hypot(aside)).max(FARTHEST_THICKNESSES * thickness);
    ahead + far.min(FARTHEST)
}

/// Vehicles are followed so many times as far as the farthest place where the motion turns.
const BEYOND_THE_TURN: f64 = 1.5;

/// Length of the cable on which the advance against locked friction is measured where heat makes that necessary, as a multiple of that over which the
/// duct's motion changes.
pub const LAW_LENGTH: f64 = 24.0;

/// How far from a vehicle's origin its motion of the duct has to be known \[m\].
pub fn reach(scene: &Scene) -> f64 {
    let followed = BEYOND_THE_TURN * farthest(scene);
    let measured = if scene.warming().is_some() {
        LAW_LENGTH * scene.duct.depth
    } else {
        0.0
    };
    scene.duct.length.max(measured) + scene.solver.approach.unwrap_or(0.0).max(followed)
}

/// How far beyond the duct's ends vehicles are followed \[m\]: as the scene says, or as far as they have to be.
pub fn approach(scene: &Scene, motions: &[DuctMotion]) -> Result<f64, CableError> {
    match scene.solver.approach {
        Some(approach) => Ok(approach),
        None => needed(scene, motions),
    }
}

/// How far beyond the duct's ends vehicles have to be followed \[m\].
pub fn needed(scene: &Scene, motions: &[DuctMotion]) -> Result<f64, CableError> {
    cable_dem::approach(motions, scene.duct.depth, farthest(scene))
}
