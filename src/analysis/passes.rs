//! All passes of a scene on one mesh.

use cable_dem::{
    CableState, DuctedCable, Friction, Mesh, PassOutcome, Passage, QuasiStatic, Statistics, Traffic,
};
use ground_field::DuctMotion;

use super::motion::approach;
use crate::Error;
use crate::scene::Scene;

/// Every pass's outcome, and what they cost together.
pub struct Passes {
    pub outcomes: Vec<PassOutcome>,
    pub statistics: Statistics,
}

/// Friction of a scene's cable: the law with its limit q = μ_d N′.
pub fn cable(scene: &Scene) -> Result<DuctedCable, Error> {
    let limit = scene.friction.dynamic_coefficient * scene.cable.normal_load();
    let friction = Friction::new(scene.friction.law, limit)?;
    Ok(
        DuctedCable::new(scene.duct.length, scene.cable.axial_stiffness, friction)?
            .with_ends(scene.ends.upstream, scene.ends.downstream)?
            .with_restraints(scene.restraints.clone())?,
    )
}

/// Lets the scene's traffic pass over a cable meshed by `mesh`; `passed` hears of every pass.
pub fn simulate(
    scene: &Scene,
    motions: &[DuctMotion],
    mesh: Mesh,
    mut passed: impl FnMut(),
) -> Result<Passes, Error> {
    let cable = cable(scene)?;
    let passages = motions
        .iter()
        .map(|motion| Passage::new(&cable, &mesh, motion, approach(scene)))
        .collect::<Result<Vec<_>, _>>()?;
    let shares: Vec<f64> = scene.vehicles.iter().map(|vehicle| vehicle.share).collect();
    let traffic = Traffic::new(&shares, scene.traffic.order.clone())?;
    let mut solver = QuasiStatic::new(cable, mesh)?;
    let mut state = CableState::at_rest(&mesh);
    let mut statistics = Statistics::default();
    let mut outcomes = Vec::new();
    for vehicle in traffic.take(usize::try_from(scene.traffic.passes).unwrap_or(usize::MAX)) {
        let outcome = solver.pass(&passages[vehicle], &mut state)?;
        statistics += outcome.statistics;
        outcomes.push(outcome);
        passed();
    }
    Ok(Passes { outcomes, statistics })
}
