//! The cable of a scene, and the vehicles that pass over it.

use cable_dem::{CableError, DuctedCable, Friction, Order, Traffic};

use creepage_scene::Scene;

/// Standard acceleration of gravity \[m/s²\], which makes a weight of a mass.
const GRAVITY: f64 = 9.80665;

/// A scene's cable: friction by its law with the limit q = μ_d N′, ends and clamps, and the
/// sections of the duct.
pub fn cable(scene: &Scene) -> Result<DuctedCable, CableError> {
    let friction = Friction::new(scene.friction.law(), scene.friction_limit())?;
    DuctedCable::new(scene.duct.length, scene.cable.axial_stiffness, friction)?
        .with_ends(scene.ends.upstream, scene.ends.downstream)?
        .with_restraints(scene.restraints.clone())?
        .with_sections(&scene.sections())
}

/// Mass per metre \[kg/m\]: that of the cable's own weight, whatever presses it down.
pub fn mass(scene: &Scene) -> f64 {
    scene.cable.weight / GRAVITY
}

/// Vehicles that are looked at for the order of traffic at most: a tenth of a second.
const LONGEST_ORDER: u64 = 20_000_000;

/// Passes up to which it is known which vehicle drives where traffic does not repeat itself.
pub fn known_order(scene: &Scene) -> u64 {
    LONGEST_ORDER / scene.vehicles.len() as u64
}

/// A scene's vehicles one after the other in `order`, by their place in the scene.
pub fn traffic(scene: &Scene, order: Order) -> Result<Traffic, CableError> {
    Traffic::new(&scene.shares(), order)
}
