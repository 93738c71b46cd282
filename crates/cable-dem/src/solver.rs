//! One of the two solvers, chosen while the program runs.

use ground_field::DuctMotion;

use crate::{
    CableError, CableState, DuctedCable, Explicit, Mesh, MovingDuct, PassOutcome, Passage, QuasiStatic,
    SigmoidLeak, StepLimits, StepView,
};

/// One of the two solvers: what a program holds that chooses between them while it runs.
///
/// ```
/// use boussinesq::HalfSpace;
/// use cable_dem::{DuctedCable, End, Explicit, ExplicitOptions, Friction, FrictionLaw, Mesh, QuasiStatic, Solver};
/// use ground_field::{DuctLine, DuctMotion, Soil, Vehicle};
///
/// let ground = HalfSpace::new(Soil::new(800e6, 0.4)?);
/// let truck = Vehicle::point("truck", 196_133.0, 11.1)?;
/// let motion = DuctMotion::new(&ground, &truck, DuctLine::new(1.2, 0.0)?, 30.0, 1e-8)?;
///
/// let friction = Friction::new(FrictionLaw::Coulomb, 0.25 * 108.8)?;
/// let cable = DuctedCable::new(10.0, 8.01e6, friction)?.with_ends(End::Free, End::Fixed)?;
/// let mesh = Mesh::for_depth(10.0, 1.2, 6.0)?;
/// let solvers: [Solver; 2] = [
///     QuasiStatic::new(cable.clone(), mesh)?.into(),
///     Explicit::new(cable, mesh, 108.8 / 9.80665, ExplicitOptions::default())?.into(),
/// ];
/// let mut forces = Vec::new();
/// for mut solver in solvers {
///     let passage = solver.passage(&motion, 15.0)?;
///     let mut state = solver.at_rest();
///     forces.push(solver.pass(&passage, &mut state)?.force.downstream);
/// }
/// // Inertia hardly matters at 40 km/h.
/// assert!((forces[1] / forces[0] - 1.0).abs() < 0.01);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
#[non_exhaustive]
pub enum Solver {
    /// Without inertia.
    QuasiStatic(Box<QuasiStatic>),
    /// With inertia.
    Explicit(Box<Explicit>),
}

/// A vehicle's passage as a [`Solver`] takes it.
#[derive(Debug, Clone)]
pub struct SolverPassage(Kind);

#[derive(Debug, Clone)]
enum Kind {
    Still(Passage),
    Moving(MovingDuct),
}

impl From<QuasiStatic> for Solver {
    fn from(solver: QuasiStatic) -> Self {
        Self::QuasiStatic(Box::new(solver))
    }
}

impl From<Explicit> for Solver {
    fn from(solver: Explicit) -> Self {
        Self::Explicit(Box::new(solver))
    }
}

impl Solver {
    /// The cable.
    pub fn cable(&self) -> &DuctedCable {
        match self {
            Self::QuasiStatic(solver) => solver.cable(),
            Self::Explicit(solver) => solver.cable(),
        }
    }

    /// The mesh.
    pub fn mesh(&self) -> &Mesh {
        match self {
            Self::QuasiStatic(solver) => solver.mesh(),
            Self::Explicit(solver) => solver.mesh(),
        }
    }

    /// The cable as laid, at rest under its own weight ([`crate::laid`]).
    pub fn at_rest(&self) -> CableState {
        match self {
            Self::QuasiStatic(solver) => solver.at_rest(),
            Self::Explicit(solver) => solver.at_rest(),
        }
    }

    /// The passage of a vehicle whose duct motion is `motion`, followed from `approach` \[m\] before the duct to `approach` past it
    /// ([`crate::approach`] says how far that has to be).
    ///
    /// # Errors
    ///
    /// As for [`Passage::new`] and [`MovingDuct::new`].
    pub fn passage(&self, motion: &DuctMotion, approach: f64) -> Result<SolverPassage, CableError> {
        Ok(SolverPassage(match self {
            Self::QuasiStatic(solver) => Kind::Still(solver.passage(motion, approach)?),
            Self::Explicit(solver) => Kind::Moving(solver.passage(motion, approach)?),
        }))
    }

    /// Lets one vehicle pass and carries `state` on. When it fails, `state` is as it was.
    ///
    /// # Errors
    ///
    /// As for the solver's own `pass`; [`CableError::PassageMismatch`] for a passage of another kind of solver.
    pub fn pass(
        &mut self,
        passage: &SolverPassage,
        state: &mut CableState,
    ) -> Result<PassOutcome, CableError> {
        self.pass_observed(passage, state, |_| {})
    }

    /// As [`Solver::pass`]; `observe` looks at the cable at every vehicle position.
    ///
    /// # Errors
    ///
    /// As for [`Solver::pass`].
    pub fn pass_observed(
        &mut self,
        passage: &SolverPassage,
        state: &mut CableState,
        observe: impl FnMut(StepView<'_>),
    ) -> Result<PassOutcome, CableError> {
        match (self, &passage.0) {
            (Self::QuasiStatic(solver), Kind::Still(passage)) => {
                solver.pass_observed(passage, state, observe)
            }
            (Self::Explicit(solver), Kind::Moving(duct)) => {
                Ok(solver.pass_observed(duct, state, observe)?.pass)
            }
            _ => Err(CableError::PassageMismatch),
        }
    }

    /// The time step \[s\] of a pass; `None` without inertia.
    pub fn time_step(&self, passage: &SolverPassage) -> Option<f64> {
        match (self, &passage.0) {
            (Self::Explicit(solver), Kind::Moving(duct)) => Some(solver.time_step(duct)),
            _ => None,
        }
    }

    /// What limits the time step; `None` where nothing does.
    pub fn limits(&self) -> Option<&StepLimits> {
        match self {
            Self::Explicit(solver) => Some(solver.limits()),
            Self::QuasiStatic(_) => None,
        }
    }

    /// What a law without memory loses in a pass; `None` for the others.
    pub fn leak(&self, passage: &SolverPassage) -> Option<SigmoidLeak> {
        match &passage.0 {
            Kind::Moving(duct) => SigmoidLeak::new(self.cable(), self.time_step(passage)?, duct),
            Kind::Still(_) => None,
        }
    }
}
