//! All passes of a scene on one mesh.

use cable_dem::{
    CableState, DuctedCable, Friction, Mesh, PassOutcome, Passage, QuasiStatic, SlipLengths, Statistics,
    Traffic,
};
use ground_field::DuctMotion;

use super::motion::approach;
use crate::Error;
use crate::scene::Scene;

/// Every pass's outcome, how the cable is left, and what they cost together.
pub struct Passes {
    pub outcomes: Vec<PassOutcome>,
    pub cable: DuctedCable,
    pub state: CableState,
    /// With the vehicle over the duct's middle in the last pass.
    pub slip: SlipLengths,
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
    let count = usize::try_from(scene.traffic.passes).unwrap_or(usize::MAX);
    let mut slip = SlipLengths::default();
    for (index, vehicle) in traffic.take(count).enumerate() {
        let outcome = if index + 1 == count {
            let mut nearest = f64::INFINITY;
            solver.pass_observed(&passages[vehicle], &mut state, |view| {
                let distance = (view.vehicle_position() - 0.5 * scene.duct.length).abs();
                if distance < nearest {
                    nearest = distance;
                    slip = view.slip_lengths();
                }
            })?
        } else {
            solver.pass(&passages[vehicle], &mut state)?
        };
        statistics += outcome.statistics;
        outcomes.push(outcome);
        passed();
    }
    Ok(Passes {
        outcomes,
        cable: solver.cable().clone(),
        state,
        slip,
        statistics,
    })
}
