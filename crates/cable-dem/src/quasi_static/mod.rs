//! Quasi-static passes: inertia left out, every step an equilibrium.
//!
//! The vehicle advances in steps; each is one implicit step of a rate-independent system, which is exact as long as no
//! node reverses its slip within the step. Work is done only where something moves: in a window that travels with the
//! vehicle (see [`passage`]) and in small ones at ends and clamps, which are solved again when the vehicle's effect on them
//! has changed. A window grows when its edge is disturbed and shrinks when it is quiet.
//!
//! Before the vehicle comes and after it has left the ground is at rest. The first step takes the duct from there to the vehicle's
//! first position, the last one from its last position back: steps of the whole cable, so that the state a pass leaves is in
//! equilibrium and within the friction bounds everywhere.

mod active_set;
mod chain;
mod exact;
mod graph;
mod memory;
mod passage;
mod schedule;
mod settle;
mod support;
mod sweeper;
mod view;
mod window;

pub use passage::Passage;
pub use view::{SlipLengths, StepView};

// The solvers with inertia take the same step on the whole cable.
pub(crate) use active_set::{Elimination, Outcome};
pub(crate) use chain::{Chain, Contact, Load, Stretch, Tolerance, Trial};
pub(crate) use exact::contacts;
pub(crate) use support::Support;

use ground_field::{Direction, DuctMotion};

use crate::outcome::Recorder;
use crate::{CableError, CableState, DuctedCable, Mesh, PassOutcome};
use sweeper::Sweeper;

/// Share of the friction limit up to which rounding may blur equilibrium.
const MAX_ROUNDING: f64 = 1e-3;

/// Quasi-static solver for one cable on one mesh.
#[derive(Debug, Clone)]
pub struct QuasiStatic {
    cable: DuctedCable,
    mesh: Mesh,
    forward: Sweeper,
    /// The cable seen in the mirror, for reverse traffic; made when first needed.
    reverse: Option<Sweeper>,
    without_iteration: bool,
}

impl QuasiStatic {
    /// A solver for `cable` on `mesh`.
    ///
    /// # Errors
    ///
    /// [`CableError::InvalidParameter`] unless the mesh is as long as the cable, [`CableError::UnsupportedLaw`] for a law
    /// without memory, which has no state of rest.
    pub fn new(cable: DuctedCable, mesh: Mesh) -> Result<Self, CableError> {
        let law = cable.friction().law();
        if !law.has_memory() {
            return Err(CableError::UnsupportedLaw {
                solver: "quasi-static",
                law: law.name(),
                reason: "its friction depends on the time step and fades at rest",
            });
        }
        mesh.check_length(&cable)?;
        Ok(Self {
            forward: Sweeper::new(&cable, &mesh),
            reverse: None,
            without_iteration: false,
            cable,
            mesh,
        })
    }

    /// The same solver, which takes the exact step (dynamic programming along the cable) in every window instead of
    /// iterating first. The answer is the same and costs more: it is there to check the iteration by another method.
    #[must_use]
    pub fn without_iteration(mut self) -> Self {
        self.without_iteration = true;
        self.forward.without_iteration = true;
        self
    }

    /// The mesh.
    pub fn mesh(&self) -> &Mesh {
        &self.mesh
    }

    /// The cable.
    pub fn cable(&self) -> &DuctedCable {
        &self.cable
    }

    /// The cable as laid.
    pub fn at_rest(&self) -> CableState {
        CableState::at_rest(&self.mesh)
    }

    /// The passage of a vehicle whose duct motion is `motion`, followed from `approach` \[m\] before the duct to `approach` past it
    /// ([`crate::approach`] says how far that has to be).
    ///
    /// # Errors
    ///
    /// As for [`Passage::new`].
    pub fn passage(&self, motion: &DuctMotion, approach: f64) -> Result<Passage, CableError> {
        Passage::new(&self.cable, &self.mesh, motion, approach)
    }

    /// Lets one vehicle pass and carries `state` on. When it fails, `state` is as it was.
    ///
    /// # Errors
    ///
    /// [`CableError::StateMismatch`] for a state of another mesh, [`CableError::PassageMismatch`] for a passage computed for
    /// another mesh, axial stiffness or friction, [`CableError::Precision`] where rounding would blur
    /// the answer, [`CableError::NoConvergence`] where a step found no equilibrium.
    pub fn pass(&mut self, passage: &Passage, state: &mut CableState) -> Result<PassOutcome, CableError> {
        self.pass_observed(passage, state, |_| {})
    }

    /// As [`QuasiStatic::pass`]; `observe` looks at the cable at every vehicle position.
    ///
    /// # Errors
    ///
    /// As for [`QuasiStatic::pass`].
    pub fn pass_observed(
        &mut self,
        passage: &Passage,
        state: &mut CableState,
        mut observe: impl FnMut(StepView<'_>),
    ) -> Result<PassOutcome, CableError> {
        state.check(&self.mesh)?;
        if !passage.fits(&self.cable, &self.mesh) {
            return Err(CableError::PassageMismatch);
        }
        if self.cable.friction().limit() == 0.0 {
            // Nothing drags the cable, and what held it is gone.
            state.release(&self.cable);
            return Ok(self.outcome(state, Recorder::new(state.ends(&self.cable))));
        }
        self.check_precision(passage, state)?;
        let mirrored = passage.direction() == Direction::Reverse;
        let sweeper = if mirrored {
            let reverse = self
                .reverse
                .get_or_insert_with(|| Sweeper::new(&self.cable.mirrored(), &self.mesh));
            reverse.without_iteration = self.without_iteration;
            reverse
        } else {
            &mut self.forward
        };
        let mut after = state.clone();
        if mirrored {
            after.mirror();
        }
        let mut recorder = sweeper.pass(passage, &mut after, |sweeper, snapshot| {
            observe(StepView {
                sweeper,
                snapshot,
                mirrored,
            });
        })?;
        if mirrored {
            after.mirror();
            recorder.mirror();
        }
        *state = after;
        Ok(self.outcome(state, recorder))
    }

    fn outcome(&self, state: &CableState, recorder: Recorder) -> PassOutcome {
        let force = state.ends(&self.cable);
        recorder.outcome(&self.cable, state, force)
    }

    /// Rounding of k (2 u_i − u_{i−1} − u_{i+1}) beside the friction on one element.
    fn check_precision(&self, passage: &Passage, state: &CableState) -> Result<(), CableError> {
        let largest = state
            .displacement()
            .iter()
            .fold(passage.peak(), |largest, u| largest.max(u.abs()));
        let share = sweeper::rounding(&self.cable, &self.mesh, largest) / self.cable.friction().limit();
        if share <= MAX_ROUNDING {
            Ok(())
        } else {
            Err(CableError::Precision {
                share,
                axial_stiffness: self.cable.axial_stiffness(),
                spacing: self.mesh.spacing(),
            })
        }
    }
}
