//! The solver without inertia.

mod pass;
mod passage;
mod schedule;
mod supports;
mod window;

pub use passage::Passage;

use friction_chain::{Contact, ImplicitStep};
use ground_field::DuctMotion;

use crate::chain::{Bends, chain, check_precision};
use crate::clamps::ClampShares;
use crate::ends::EndReader;
use crate::error::checked;
use crate::laid::laid;
use crate::tuning::{QUIET_SHARE, UNBALANCED_SHARE};
use crate::{CableError, CableState, DuctedCable, Mesh, PassOutcome};
use supports::Supports;
use window::{Window, WindowBounds};

/// Quasi-static solver for one cable on one mesh: inertia left out, every step an equilibrium.
///
/// The vehicle advances in steps. Each solves, for the displacements u and the friction f after it,
///
/// K u + S u = w (f + p),  f from the slip ΔD − Δu by the [friction law](crate::FrictionLaw),
///
/// with K the stiffness of a chain of springs EA/h, S the springs of ends and clamps, w a node's length of cable and p the body force: one implicit step of
/// a rate-independent system, exact as long as no node reverses its slip within the step. Work is done only where something moves: in
/// windows around zones that slip, which travel with the vehicle, and in small ones at ends and clamps.
/// Outside the windows up to 1e-3 of the friction limit stays unbalanced while the vehicle passes.
///
/// Before the vehicle comes and after it has left the ground is at rest. The first step takes the duct from there to the vehicle's
/// first position, the last one from its last position back: steps of the whole cable, so that the state a pass leaves is in
/// equilibrium and within the friction bounds everywhere.
///
/// A pass is a function of the state and the passage: the solver keeps nothing of earlier ones.
///
/// ```
/// use cable_dem::{DuctedCable, End, Friction, FrictionLaw, Mesh, QuasiStatic};
/// use boussinesq::HalfSpace;
/// use ground_field::{DuctLine, DuctMotion, Soil, Vehicle};
///
/// let ground = HalfSpace::new(Soil::new(800e6, 0.4)?);
/// let truck = Vehicle::point("truck", 196_133.0, 11.1)?;
/// let motion = DuctMotion::new(&ground, &truck, DuctLine::new(1.2, 0.0)?, 46.0, 1e-6)?;
///
/// let q = 0.25 * 108.8;
/// let friction = Friction::new(FrictionLaw::ElasticPlastic { shape_factor: 2e8 / q }, q)?;
/// let cable = DuctedCable::new(30.0, 8.01e6, friction)?.with_ends(End::Free, End::Fixed)?;
/// let mut solver = QuasiStatic::new(cable, Mesh::for_depth(30.0, 1.2, 12.0)?)?;
/// let passage = solver.passage(&motion, 15.0)?;
/// let mut state = solver.at_rest();
/// let force = solver.pass(&passage, &mut state)?.force.downstream;
/// assert!((force / 102.0 - 1.0).abs() < 0.01);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct QuasiStatic {
    cable: DuctedCable,
    mesh: Mesh,
    /// The cable as laid.
    laid: CableState,
    step: ImplicitStep,
    bends: Bends,
    clamps: ClampShares,
    ends: EndReader,
    supports: Supports,
    bounds: WindowBounds,
    /// A node moves if it does so by more than this in a step \[m\].
    quiet: f64,
    /// State in the adherent frame: r \[m\] and g \[N/m\].
    r: Vec<f64>,
    g: Vec<f64>,
    /// Where the duct held every node before the step, r + γ g \[m\].
    anchor: Vec<f64>,
    /// Of the cable in the current pass \[N\].
    thermal_force: f64,
    /// What moved in the last step, and the nodes beside it.
    moving: Vec<Window>,
    /// Storage of a step's windows.
    windows: Vec<Window>,
    /// Contact states on the lattice as the vehicle of the current pass sees them: the pattern of slip travels with it. Measured over
    /// mixed traffic of 600 passes, there is 1.3 to 2.2 times the work without this guess.
    predicted: Vec<Contact>,
    /// What the current pass has shown so far.
    outcome: PassOutcome,
}

impl QuasiStatic {
    /// A solver for `cable` on `mesh`.
    ///
    /// # Errors
    ///
    /// [`CableError::InvalidParameter`] unless the mesh is as long as the cable,
    /// [`CableError::NoRest`] for a law without memory, which has no state of rest, and as for
    /// [`laid`].
    pub fn new(cable: DuctedCable, mesh: Mesh) -> Result<Self, CableError> {
        cable.friction().check_memory("quasi-static")?;
        mesh.check_length(cable.length())?;
        let clamps = ClampShares::new(&cable, &mesh);
        let chain = chain(&cable, &mesh, clamps.stuck(&[]))?;
        let screening = cable.friction().compliance() * chain.stiffness() / mesh.spacing();
        let bounds = WindowBounds::new(chain.free(), screening);
        let zeros = || vec![0.0; mesh.nodes()];
        Ok(Self {
            laid: laid(&cable, &mesh)?,
            supports: Supports::new(&cable, &mesh, &chain, bounds),
            ends: EndReader::new(&cable, &mesh, false),
            bounds,
            quiet: QUIET_SHARE * UNBALANCED_SHARE * cable.least_limit() * mesh.spacing() / chain.stiffness(),
            step: ImplicitStep::new(chain),
            bends: Bends::new(&cable, &mesh),
            clamps,
            r: zeros(),
            g: zeros(),
            anchor: zeros(),
            thermal_force: 0.0,
            moving: Vec::new(),
            windows: Vec::new(),
            predicted: Vec::new(),
            outcome: PassOutcome::default(),
            cable,
            mesh,
        })
    }

    /// The mesh.
    pub fn mesh(&self) -> &Mesh {
        &self.mesh
    }

    /// The cable.
    pub fn cable(&self) -> &DuctedCable {
        &self.cable
    }

    /// The cable as laid, at rest under its own weight ([`laid`]).
    pub fn at_rest(&self) -> CableState {
        self.laid.clone()
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
    /// another mesh, axial stiffness or friction, [`CableError::Precision`] if rounding would blur
    /// the answer, [`CableError::NoConvergence`] if a step found no equilibrium, [`CableError::InvalidParameter`] for a cable without friction that
    /// is not as warm as it was laid.
    pub fn pass(&mut self, passage: &Passage, state: &mut CableState) -> Result<PassOutcome, CableError> {
        self.pass_observed(passage, state, |_, _| {})
    }

    /// As [`QuasiStatic::pass`]; `observe` is called at every vehicle position \[m\] with a
    /// function that gives the state there.
    ///
    /// # Errors
    ///
    /// As for [`QuasiStatic::pass`].
    pub fn pass_observed(
        &mut self,
        passage: &Passage,
        state: &mut CableState,
        observe: impl FnMut(f64, &dyn Fn() -> CableState),
    ) -> Result<PassOutcome, CableError> {
        state.check(&self.mesh)?;
        if !passage.fits(&self.cable, &self.mesh) {
            return Err(CableError::PassageMismatch);
        }
        if self.cable.friction().limit() == 0.0 {
            return self.without_friction(state);
        }
        check_precision(&self.cable, &self.mesh, state.displacement(), passage.peak)?;
        self.drive(passage, state, observe)
    }

    /// Nothing drags the cable, and what held it is gone: it lies as laid, or where it was if nothing
    /// else holds it.
    fn without_friction(&self, state: &mut CableState) -> Result<PassOutcome, CableError> {
        checked("thermal_force without friction", state.thermal_force, "0", |v| {
            v == 0.0
        })?;
        let mean = state.displacement.iter().sum::<f64>() / state.displacement.len() as f64;
        state.clone_from(&self.laid);
        if !self.step.chain.is_held() {
            state.displacement.fill(mean);
        }
        PassOutcome::at_rest(&self.cable, state)
    }
}
