//! All passes of a scene on one mesh.

use cable_dem::{CableState, DuctedCable, Mesh, PassOutcome, SigmoidLeak, Statistics, Traffic};
use ground_field::DuctMotion;

use super::solver::PassSolver;
use crate::answer::{ForceProfile, SlipRecord, Stage, balance};
use crate::cable::cable;
use crate::plan::CableMethod;
use crate::scene::Scene;
use crate::{Error, Progress};

/// Every pass's outcome, how the cable is left, and what they cost together.
pub struct Passes {
    pub outcomes: Vec<PassOutcome>,
    pub cable: DuctedCable,
    pub state: CableState,
    /// With the vehicle over the duct's middle in the last pass, where the solver can be looked at.
    pub slip: Option<SlipRecord>,
    /// The cable at the passes that were asked for.
    pub stages: Vec<Stage>,
    /// What a law without memory loses.
    pub leaks: Vec<SigmoidLeak>,
    /// The explicit solver's time step and what limits it.
    pub step_limits: Option<String>,
    pub statistics: Statistics,
}

/// Force along the cable as it is left in `state`.
pub fn force_profile(cable: &DuctedCable, state: &CableState) -> Result<ForceProfile, Error> {
    let force_n: Vec<f64> = state.element_forces(cable)?.collect();
    Ok(ForceProfile {
        positions_m: (0..force_n.len())
            .map(|i| state.node_spacing() * (i as f64 + 0.5))
            .collect(),
        force_n,
    })
}

/// Lets the scene's traffic pass over its cable meshed by `mesh`, and looks at the cable at the passes `stages`; `progress` is
/// called after each pass.
pub fn simulate(
    scene: &Scene,
    method: CableMethod,
    motions: &[DuctMotion],
    mesh: Mesh,
    stages: &[u64],
    progress: Progress<'_>,
) -> Result<Passes, Error> {
    let mut solver = PassSolver::new(scene, method, motions, mesh)?;
    let shares: Vec<f64> = scene.vehicles.iter().map(|vehicle| vehicle.share).collect();
    let traffic = Traffic::new(&shares, scene.traffic.order.clone())?;
    let mut state = solver.at_rest();
    let mut statistics = Statistics::default();
    let mut outcomes = Vec::new();
    let count = usize::try_from(scene.traffic.passes).unwrap_or(usize::MAX);
    let cable = cable(scene)?;
    let mut slip = None;
    let mut seen_stages = Vec::new();
    for (index, vehicle) in traffic.take(count).enumerate() {
        let pass = index as u64 + 1;
        let wanted = stages.contains(&pass);
        let outcome = if wanted || index + 1 == count {
            let (outcome, friction) = solver.pass_and_look(vehicle, &mut state, 0.5 * scene.duct.length)?;
            slip = friction.as_ref().map(|friction| friction.slip_lengths);
            if wanted {
                seen_stages.push(Stage {
                    pass,
                    force_profile: force_profile(&cable, &state)?,
                    friction,
                });
            }
            outcome
        } else {
            solver.pass(vehicle, &mut state)?
        };
        balance::of_state(&cable, &state, pass)?;
        statistics += outcome.statistics;
        outcomes.push(outcome);
        progress.report(pass as f64 / count as f64)?;
    }
    Ok(Passes {
        outcomes,
        cable,
        state,
        slip,
        stages: seen_stages,
        leaks: solver.leaks(),
        step_limits: solver.step_limits(),
        statistics,
    })
}
