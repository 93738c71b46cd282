//! A scene's solver of the cable, and how it lets one vehicle pass.

use cable_dem::{
    CableError, CableState, Dynamic, Explicit, ExplicitOptions, Mesh, MovingDuct, PassOutcome, Passage,
    QuasiStatic, SigmoidLeak,
};
use ground_field::DuctMotion;

use crate::Error;
use crate::answer::FrictionProfile;
use crate::cable::{cable, mass};
use crate::ground::road::approach;
use crate::plan::CableMethod;
use crate::scene::Scene;

/// A solver with the scene's vehicles, ready to let them pass.
pub enum PassSolver {
    QuasiStatic(Box<QuasiStatic>, Vec<Passage>),
    Dynamic(Box<Dynamic>, Vec<MovingDuct>),
    Explicit(Box<Explicit>, Vec<MovingDuct>),
}

impl PassSolver {
    pub fn new(
        scene: &Scene,
        method: CableMethod,
        motions: &[DuctMotion],
        mesh: Mesh,
    ) -> Result<Self, Error> {
        let cable = cable(scene)?;
        let approach = approach(scene, motions);
        let ducts = || {
            motions
                .iter()
                .map(|motion| MovingDuct::new(&cable, &mesh, motion, approach))
                .collect::<Result<Vec<_>, _>>()
        };
        Ok(match method {
            CableMethod::QuasiStatic => {
                let passages = motions
                    .iter()
                    .map(|motion| Passage::new(&cable, &mesh, motion, approach))
                    .collect::<Result<Vec<_>, _>>()?;
                Self::QuasiStatic(Box::new(QuasiStatic::new(cable, mesh)?), passages)
            }
            CableMethod::Dynamic => {
                let ducts = ducts()?;
                Self::Dynamic(Box::new(Dynamic::new(cable, mesh, mass(scene))?), ducts)
            }
            CableMethod::Explicit => {
                let ducts = ducts()?;
                let options = ExplicitOptions {
                    time_step: scene.solver.time_step,
                    ..ExplicitOptions::default()
                };
                Self::Explicit(Box::new(Explicit::new(cable, mesh, mass(scene), options)?), ducts)
            }
        })
    }

    /// Lets `vehicle` pass.
    pub fn pass(&mut self, vehicle: usize, state: &mut CableState) -> Result<PassOutcome, CableError> {
        match self {
            Self::QuasiStatic(solver, passages) => solver.pass(&passages[vehicle], state),
            Self::Dynamic(solver, ducts) => Ok(solver.pass(&ducts[vehicle], state)?.pass),
            Self::Explicit(solver, ducts) => Ok(solver.pass(&ducts[vehicle], state)?.pass),
        }
    }

    /// As [`PassSolver::pass`], and looks at the friction with the vehicle nearest to `position` \[m\], where the solver can be
    /// looked at.
    pub fn pass_and_look(
        &mut self,
        vehicle: usize,
        state: &mut CableState,
        position: f64,
    ) -> Result<(PassOutcome, Option<FrictionProfile>), CableError> {
        let Self::QuasiStatic(solver, passages) = self else {
            return Ok((self.pass(vehicle, state)?, None));
        };
        let mut nearest = f64::INFINITY;
        let mut seen = None;
        let nodes = solver.mesh().nodes();
        let spacing = solver.mesh().spacing();
        let outcome = solver.pass_observed(&passages[vehicle], state, |view| {
            let distance = (view.vehicle_position() - position).abs();
            if distance < nearest {
                nearest = distance;
                seen = Some(FrictionProfile {
                    vehicle,
                    vehicle_position_m: view.vehicle_position(),
                    positions_m: (0..nodes).map(|node| spacing * node as f64).collect(),
                    friction_n_per_m: (0..nodes).map(|node| view.friction(node)).collect(),
                    slip_lengths: view.slip_lengths().into(),
                });
            }
        })?;
        Ok((outcome, seen))
    }

    /// The time step of an explicit solver and what limits it.
    pub fn step_limits(&self) -> Option<String> {
        let Self::Explicit(solver, ducts) = self else {
            return None;
        };
        let limits = solver.limits();
        let step = ducts
            .first()
            .map_or(limits.advised(), |duct| solver.time_step(duct));
        Some(format!(
            "time step {step:.3e} s, a margin of {:.2} to the limit: {limits}",
            limits.margin(step)
        ))
    }

    /// What a law without memory loses in each vehicle's pass.
    pub fn leaks(&self) -> Vec<SigmoidLeak> {
        match self {
            Self::QuasiStatic(..) => Vec::new(),
            Self::Dynamic(solver, ducts) => ducts.iter().filter_map(|duct| solver.leak(duct)).collect(),
            Self::Explicit(solver, ducts) => ducts.iter().filter_map(|duct| solver.leak(duct)).collect(),
        }
    }
}
