//! All passes of a scene on one mesh.

use cable_dem::{CableState, DuctedCable, Mesh, PassOutcome, SigmoidLeak, SlipLengths, Statistics, Traffic};
use ground_field::DuctMotion;

use super::cable::{CableMethod, PassSolver, cable};
use crate::Error;
use crate::scene::Scene;

/// Every pass's outcome, how the cable is left, and what they cost together.
pub struct Passes {
    pub outcomes: Vec<PassOutcome>,
    pub cable: DuctedCable,
    pub state: CableState,
    /// With the vehicle over the duct's middle in the last pass, where the solver can be looked at.
    pub slip: Option<SlipLengths>,
    /// What a law without memory loses.
    pub leaks: Vec<SigmoidLeak>,
    /// The explicit solver's time step and what limits it.
    pub step_limits: Option<String>,
    pub statistics: Statistics,
}

/// Lets the scene's traffic pass over its cable meshed by `mesh`; `passed` hears of every pass.
pub fn simulate(
    scene: &Scene,
    method: CableMethod,
    motions: &[DuctMotion],
    mesh: Mesh,
    mut passed: impl FnMut(),
) -> Result<Passes, Error> {
    let mut solver = PassSolver::new(scene, method, motions, mesh)?;
    let shares: Vec<f64> = scene.vehicles.iter().map(|vehicle| vehicle.share).collect();
    let traffic = Traffic::new(&shares, scene.traffic.order.clone())?;
    let mut state = CableState::at_rest(&mesh);
    let mut statistics = Statistics::default();
    let mut outcomes = Vec::new();
    let count = usize::try_from(scene.traffic.passes).unwrap_or(usize::MAX);
    let mut slip = None;
    for (index, vehicle) in traffic.take(count).enumerate() {
        let outcome = if index + 1 == count {
            let (outcome, seen) = solver.pass_and_look(vehicle, &mut state, 0.5 * scene.duct.length)?;
            slip = seen;
            outcome
        } else {
            solver.pass(vehicle, &mut state)?
        };
        statistics += outcome.statistics;
        outcomes.push(outcome);
        passed();
    }
    Ok(Passes {
        outcomes,
        cable: cable(scene)?,
        state,
        slip,
        leaks: solver.leaks(),
        step_limits: solver.step_limits(),
        statistics,
    })
}
