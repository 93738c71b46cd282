//! A scene's solver of the cable, and how it lets one vehicle pass.

use cable_dem::{
    CableError, CableState, DuctedCable, Explicit, ExplicitOptions, Mesh, MovingDuct, PassOutcome, Passage,
    QuasiStatic, SigmoidLeak,
};

use super::task::Task;
use crate::answer::FrictionProfile;
use creepage_plan::{Error, cable::mass, ground::road::approach};
use creepage_scene::SolverMethod;

/// A friction law that loses more than this share of the stored force in one pass gives no answer.
const LARGEST_LEAK: f64 = 0.9;

/// A solver with the scene's vehicles, ready to let them pass.
pub enum PassSolver {
    QuasiStatic(Box<QuasiStatic>, Vec<Passage>),
    Explicit(Box<Explicit>, Vec<MovingDuct>),
}

impl PassSolver {
    pub fn new(task: &Task<'_>) -> Result<Self, Error> {
        let (scene, cable) = (task.scene, task.cable()?);
        let approach = approach(scene, task.motions)?;
        let motions = task.motions.iter();
        Ok(if task.method == SolverMethod::Explicit {
            let options = ExplicitOptions {
                time_step: scene.solver.time_step,
                ..ExplicitOptions::default()
            };
            let solver = Explicit::new(cable, task.mesh, mass(scene), options)?;
            let ducts = motions.map(|motion| solver.passage(motion, approach));
            let ducts = ducts.collect::<Result<_, _>>()?;
            Self::Explicit(Box::new(solver), ducts)
        } else {
            let solver = QuasiStatic::new(cable, task.mesh)?;
            let passages = motions.map(|motion| solver.passage(motion, approach));
            let passages = passages.collect::<Result<_, _>>()?;
            Self::QuasiStatic(Box::new(solver), passages)
        })
    }

    /// Lets `vehicle` pass.
    pub fn pass(&mut self, vehicle: usize, state: &mut CableState) -> Result<PassOutcome, CableError> {
        // A pass with an observer is compiled with this crate, which is not optimised.
        match self {
            Self::QuasiStatic(solver, passages) => solver.pass(&passages[vehicle], state),
            Self::Explicit(solver, ducts) => Ok(solver.pass(&ducts[vehicle], state)?.pass),
        }
    }

    /// As [`PassSolver::pass`], and looks at the friction on `cable` with the vehicle nearest to the
    /// middle of the duct, where the solver can be looked at.
    pub fn pass_and_look(
        &mut self,
        vehicle: usize,
        cable: &DuctedCable,
        mesh: Mesh,
        state: &mut CableState,
    ) -> Result<(PassOutcome, Option<FrictionProfile>), CableError> {
        // A look at all nodes in every step would cost more than a pass of a long duct.
        let mut nearest = mesh.vehicle_step().next_up();
        let mut found: Option<(f64, CableState)> = None;
        let look = |position: f64, state: &dyn Fn() -> CableState| {
            let distance = (position - 0.5 * mesh.length()).abs();
            if distance < nearest {
                nearest = distance;
                found = Some((position, state()));
            }
        };
        let outcome = match self {
            Self::QuasiStatic(solver, passages) => solver.pass_observed(&passages[vehicle], state, look)?,
            Self::Explicit(solver, ducts) => solver.pass_observed(&ducts[vehicle], state, look)?.pass,
        };
        let nodes = (0..mesh.nodes()).map(|node| mesh.spacing() * node as f64);
        let friction = found.map(|(vehicle_position_m, state)| FrictionProfile {
            vehicle,
            vehicle_position_m,
            positions_m: nodes.collect(),
            friction_n_per_m: state.friction().to_vec(),
            slip_lengths: state.slip_lengths(cable).unwrap_or_default(),
        });
        Ok((outcome, friction))
    }

    /// Adds what limits the time step of an explicit solver to the `reasons`, and a friction law
    /// that loses some of the stored force to the `warnings`; refuses one that loses too much.
    pub fn time_steps(&self, reasons: &mut Vec<String>, warnings: &mut Vec<String>) -> Result<(), Error> {
        let Self::Explicit(solver, ducts) = self else {
            return Ok(());
        };
        let limits = solver.limits();
        let step = (ducts.first()).map_or(limits.advised(), |duct| solver.time_step(duct));
        let (margin, elastic, friction) = (limits.together() / step, limits.elastic, limits.friction);
        reasons.push(format!(
            "time step {step:.3e} s, a margin of {margin:.2} to the limit: {elastic:.3e} s of the springs and {friction:.3e} s of \
             friction together"
        ));
        let leak = |duct| SigmoidLeak::new(solver.cable(), solver.time_step(duct), duct);
        for leak in ducts.iter().filter_map(leak).filter(SigmoidLeak::matters) {
            if leak.loss_per_pass > LARGEST_LEAK {
                return Err(Error::unfit("friction.law", "sigmoid", leak.to_string()));
            }
            warnings.push(leak.to_string());
        }
        Ok(())
    }
}
