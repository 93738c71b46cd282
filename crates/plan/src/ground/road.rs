//! How far out on the road a vehicle is followed; [`cable_dem::approach`] says why.

use cable_dem::CableError;
use ground_field::DuctMotion;

use crate::tuning::ground::{
    BEYOND_THE_TURN, FARTHEST, FARTHEST_DISTANCES, FARTHEST_THICKNESSES, LAW_LENGTH,
};
use creepage_scene::Scene;

/// How far the road is looked at \[m\], measured from a vehicle's origin.
pub fn farthest(scene: &Scene) -> f64 {
    let wheels = scene.vehicles.iter().flat_map(|traffic| {
        let offset = scene.offset_from(traffic).abs();
        let wheels = traffic.wheels().into_iter();
        wheels.map(move |wheel| [wheel.x.abs(), wheel.y.abs() + offset])
    });
    let [ahead, aside] = wheels.fold([0.0, 0.0], |[a, b], [x, y]| [x.max(a), y.max(b)]);
    let thickness = scene.ground.thickness();
    let far = (FARTHEST_DISTANCES * scene.duct.depth.hypot(aside)).max(FARTHEST_THICKNESSES * thickness);
    ahead + far.min(FARTHEST)
}

/// How far from a vehicle's origin its motion of the duct has to be known \[m\].
pub fn reach(scene: &Scene) -> f64 {
    let followed = BEYOND_THE_TURN * farthest(scene);
    let measured = scene.warming().map_or(0.0, |_| LAW_LENGTH * scene.duct.depth);
    scene.duct.length.max(measured) + scene.solver.approach.unwrap_or(0.0).max(followed)
}

/// How far beyond the duct's ends vehicles are followed \[m\]: as the scene says, or as far as they
/// have to be.
pub fn approach(scene: &Scene, motions: &[DuctMotion]) -> Result<f64, CableError> {
    scene.solver.approach.map_or_else(|| needed(scene, motions), Ok)
}

/// How far beyond the duct's ends vehicles have to be followed \[m\].
pub fn needed(scene: &Scene, motions: &[DuctMotion]) -> Result<f64, CableError> {
    cable_dem::approach(motions, scene.duct.depth, farthest(scene))
}
