//! A scene's solver of the cable, and how it lets one vehicle pass.

use cable_dem::{
    CableError, CableState, Explicit, ExplicitOptions, Mesh, PassOutcome, QuasiStatic, SigmoidLeak, Solver,
    SolverPassage,
};
use ground_field::DuctMotion;

use crate::Error;
use crate::answer::FrictionProfile;
use crate::cable::{cable, mass};
use crate::ground::road::approach;
use crate::plan::CableMethod;
use crate::scene::Scene;

/// A solver with the scene's vehicles, ready to let them pass.
pub struct PassSolver {
    solver: Solver,
    passages: Vec<SolverPassage>,
}

impl PassSolver {
    pub fn new(
        scene: &Scene,
        method: CableMethod,
        motions: &[DuctMotion],
        mesh: Mesh,
    ) -> Result<Self, Error> {
        let cable = cable(scene)?;
        let approach = approach(scene, motions)?;
        let solver: Solver = match method {
            CableMethod::QuasiStatic => QuasiStatic::new(cable, mesh)?.into(),
            CableMethod::Explicit => {
                let options = ExplicitOptions {
                    time_step: scene.solver.time_step,
                    ..ExplicitOptions::default()
                };
                Explicit::new(cable, mesh, mass(scene), options)?.into()
            }
        };
        let passages = motions
            .iter()
            .map(|motion| solver.passage(motion, approach))
            .collect::<Result<_, _>>()?;
        Ok(Self { solver, passages })
    }

    /// The cable as laid.
    pub fn at_rest(&self) -> CableState {
        self.solver.at_rest()
    }

    /// Lets `vehicle` pass.
    pub fn pass(&mut self, vehicle: usize, state: &mut CableState) -> Result<PassOutcome, CableError> {
        self.solver.pass(&self.passages[vehicle], state)
    }

    /// As [`PassSolver::pass`], and looks at the friction with the vehicle nearest to `position` \[m\], where the solver can be
    /// looked at.
    pub fn pass_and_look(
        &mut self,
        vehicle: usize,
        state: &mut CableState,
        position: f64,
    ) -> Result<(PassOutcome, Option<FrictionProfile>), CableError> {
        let mut nearest = f64::INFINITY;
        let mut seen = None;
        let nodes = self.solver.mesh().nodes();
        let (spacing, step) = (self.solver.mesh().spacing(), self.solver.mesh().vehicle_step());
        let outcome = self
            .solver
            .pass_observed(&self.passages[vehicle], state, |view| {
                let distance = (view.vehicle_position() - position).abs();
                // A look at all nodes in every step would cost more than a pass of a long duct.
                if distance <= step && distance < nearest {
                    nearest = distance;
                    seen = Some(FrictionProfile {
                        vehicle,
                        vehicle_position_m: view.vehicle_position(),
                        positions_m: (0..nodes).map(|node| spacing * node as f64).collect(),
                        friction_n_per_m: view.state().friction().to_vec(),
                        slip_lengths: view.slip_lengths().into(),
                    });
                }
            })?;
        Ok((outcome, seen))
    }

    /// The time step of an explicit solver and what limits it.
    pub fn step_limits(&self) -> Option<String> {
        let limits = self.solver.limits()?;
        let step = self
            .passages
            .first()
            .and_then(|passage| self.solver.time_step(passage))
            .unwrap_or_else(|| limits.advised());
        Some(format!(
            "time step {step:.3e} s, a margin of {:.2} to the limit: {limits}",
            limits.margin(step)
        ))
    }

    /// What a law without memory loses in each vehicle's pass.
    pub fn leaks(&self) -> Vec<SigmoidLeak> {
        let leaks = self.passages.iter().map(|passage| self.solver.leak(passage));
        leaks.flatten().collect()
    }
}
