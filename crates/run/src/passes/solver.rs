//! A scene's solver of the cable, and how it lets one vehicle pass.

use cable_dem::{
    CableError, CableState, Explicit, ExplicitOptions, MovingDuct, PassOutcome, Passage, QuasiStatic,
    SigmoidLeak,
};

use super::task::Task;
use crate::Error;
use crate::answer::FrictionProfile;
use crate::cable::mass;
use crate::ground::road::approach;
use crate::plan::CableMethod;

/// A solver with the scene's vehicles, ready to let them pass.
pub enum PassSolver {
    QuasiStatic(Box<QuasiStatic>, Vec<Passage>),
    Explicit(Box<Explicit>, Vec<MovingDuct>),
}

impl PassSolver {
    pub fn new(task: &Task<'_>) -> Result<Self, Error> {
        let Task {
            scene,
            method,
            motions,
            mesh,
            ..
        } = *task;
        let cable = task.cable()?;
        let approach = approach(scene, motions)?;
        let motions = motions.iter();
        Ok(match method {
            CableMethod::QuasiStatic => {
                let solver = QuasiStatic::new(cable, mesh)?;
                let passages = motions.map(|motion| solver.passage(motion, approach));
                let passages = passages.collect::<Result<_, _>>()?;
                Self::QuasiStatic(Box::new(solver), passages)
            }
            CableMethod::Explicit => {
                let options = ExplicitOptions {
                    time_step: scene.solver.time_step,
                    ..ExplicitOptions::default()
                };
                let solver = Explicit::new(cable, mesh, mass(scene), options)?;
                let ducts = motions.map(|motion| solver.passage(motion, approach));
                let ducts = ducts.collect::<Result<_, _>>()?;
                Self::Explicit(Box::new(solver), ducts)
            }
        })
    }

    /// The cable as laid.
    pub fn at_rest(&self) -> CableState {
        match self {
            Self::QuasiStatic(solver, _) => solver.at_rest(),
            Self::Explicit(solver, _) => solver.at_rest(),
        }
    }

    /// Lets `vehicle` pass; `observe` looks at the cable at every step.
    fn pass_observed(
        &mut self,
        vehicle: usize,
        state: &mut CableState,
        observe: impl FnMut(f64, &dyn Fn() -> CableState),
    ) -> Result<PassOutcome, CableError> {
        match self {
            Self::QuasiStatic(solver, passages) => solver.pass_observed(&passages[vehicle], state, observe),
            Self::Explicit(solver, ducts) => Ok(solver.pass_observed(&ducts[vehicle], state, observe)?.pass),
        }
    }

    /// Lets `vehicle` pass.
    pub fn pass(&mut self, vehicle: usize, state: &mut CableState) -> Result<PassOutcome, CableError> {
        // A pass with an observer is compiled with this crate, which is not optimised.
        match self {
            Self::QuasiStatic(solver, passages) => solver.pass(&passages[vehicle], state),
            Self::Explicit(solver, ducts) => Ok(solver.pass(&ducts[vehicle], state)?.pass),
        }
    }

    /// As [`PassSolver::pass`], and looks at the friction with the vehicle nearest to `position`
    /// \[m\], where the solver can be looked at.
    pub fn pass_and_look(
        &mut self,
        vehicle: usize,
        state: &mut CableState,
        position: f64,
    ) -> Result<(PassOutcome, Option<FrictionProfile>), CableError> {
        let (mesh, cable) = match self {
            Self::QuasiStatic(solver, _) => (*solver.mesh(), solver.cable().clone()),
            Self::Explicit(solver, _) => (*solver.mesh(), solver.cable().clone()),
        };
        let mut nearest = f64::INFINITY;
        let mut seen = None;
        let outcome = self.pass_observed(vehicle, state, |vehicle_position_m, state| {
            let distance = (vehicle_position_m - position).abs();
            // A look at all nodes in every step would cost more than a pass of a long duct.
            if distance <= mesh.vehicle_step() && distance < nearest {
                nearest = distance;
                let state = state();
                let limits = state.friction_limits(&cable).unwrap_or_default();
                seen = Some(FrictionProfile {
                    vehicle,
                    vehicle_position_m,
                    positions_m: (0..mesh.nodes())
                        .map(|node| mesh.spacing() * node as f64)
                        .collect(),
                    friction_n_per_m: state.friction().to_vec(),
                    slip_lengths: state.slip_lengths(&limits).into(),
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
            "time step {step:.3e} s, a margin of {:.2} to the limit: {:.3e} s of the springs and {:.3e} s of friction together",
            limits.together() / step,
            limits.elastic,
            limits.friction
        ))
    }

    /// What a law without memory loses in each vehicle's pass.
    pub fn leaks(&self) -> Vec<SigmoidLeak> {
        let Self::Explicit(solver, ducts) = self else {
            return Vec::new();
        };
        let leak = |duct| SigmoidLeak::new(solver.cable(), solver.time_step(duct), duct);
        ducts.iter().filter_map(leak).collect()
    }
}
