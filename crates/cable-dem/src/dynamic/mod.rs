//! The implicit solver with inertia.

mod history;

use ground_field::{Direction, DuctMotion};

use crate::laid::laid;
use crate::outcome::Recorder;
use crate::step::{Prediction, Stretch, largest};
use crate::transient::{EnergyBalance, Implicit, Lumped, MovingDuct, TransientOutcome, pass};
use crate::{CableError, CableState, DuctedCable, Mesh};
use history::History;

/// Dynamic implicit solver for one cable on one mesh: the quasi-static step with inertia as one more term.
///
/// M ü + K u + S u = w (f + p) is discretised by the second backward difference (C. W. Gear; E. Hairer, G. Wanner, Solving Ordinary
/// Differential Equations II, 1996, §V.1), for displacement and velocity alike,
///
/// v_n = (3 u_n − 4 u_{n−1} + u_{n−2})/(2Δt),  a_n = (3 v_n − 4 v_{n−1} + v_{n−2})/(2Δt),
///
/// so that each step solves (K + S + 9/(4Δt²) M) r = p + w f_n for the increment r, with friction by the law at the
/// end of the step. The formula is of second order and L-stable: any step is stable, and vibration faster than the step resolves is
/// damped instead of ringing against the friction, which the trapezoidal rule would let it do. Its numerical damping is the residual of
/// the [`EnergyBalance`].
///
/// The step is the mesh's vehicle step, as in the quasi-static solver; it then costs a few linear solves of the whole cable.
/// Inertia is worth this where [`crate::inertia_ratio`] is not far below the accuracy wanted. The steps from rest and to it are taken
/// without inertia, and the last one ends the cable's vibration.
///
/// The `sigmoid` law is solved too: its answer depends on the time step by the law's own definition, and what it loses at rest comes
/// with every outcome ([`crate::SigmoidLeak`]).
///
/// ```
/// use cable_dem::{DuctedCable, Dynamic, End, Friction, FrictionLaw, Mesh, MovingDuct};
/// use ground_field::Direction;
///
/// // A bump that pushes the duct away from the vehicle on both sides, at 11.1 m/s.
/// let shape = |xi: f64| 40e-6 * xi / (1.0 + xi * xi).powf(1.5);
/// let friction = Friction::new(FrictionLaw::Coulomb, 0.25 * 108.8)?;
/// let cable = DuctedCable::new(10.0, 8.01e6, friction)?.with_ends(End::Free, End::Fixed)?;
/// let mesh = Mesh::for_depth(10.0, 1.2, 6.0)?;
/// let duct = MovingDuct::from_shape(&cable, &mesh, Direction::Forward, 11.1, shape, 15.0)?;
/// let mut solver = Dynamic::new(cable, mesh, 108.8 / 9.80665)?;
/// let outcome = solver.pass(&duct, &mut solver.at_rest())?;
/// assert!(outcome.pass.force.downstream > 10.0 && outcome.energy.returned_share() < 1e-6);
/// # Ok::<(), cable_dem::CableError>(())
/// ```
#[derive(Debug, Clone)]
pub struct Dynamic {
    lumped: Lumped,
    laid: CableState,
}

impl Dynamic {
    /// A solver for `cable` on `mesh`, with `mass_per_metre` m′ \[kg/m\] (weight per metre over 9.80665 m/s²).
    ///
    /// # Errors
    ///
    /// [`CableError::InvalidParameter`] unless the mass is finite and positive and the mesh is as long as the cable; as for [`laid`].
    pub fn new(cable: DuctedCable, mesh: Mesh, mass_per_metre: f64) -> Result<Self, CableError> {
        let lumped = Lumped::new(cable, mesh, mass_per_metre)?;
        Ok(Self {
            laid: laid(&lumped.cable, &mesh)?,
            lumped,
        })
    }

    /// The mesh.
    pub fn mesh(&self) -> &Mesh {
        &self.lumped.mesh
    }

    /// The cable.
    pub fn cable(&self) -> &DuctedCable {
        &self.lumped.cable
    }

    /// The time step \[s\] of a pass of `duct`: the vehicle's advance by one vehicle step.
    pub fn time_step(&self, duct: &MovingDuct) -> f64 {
        duct.duration() / self.steps(duct)
    }

    fn steps(&self, duct: &MovingDuct) -> f64 {
        duct.steps(self.lumped.mesh.vehicle_step() / duct.speed())
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
    /// As for [`MovingDuct::new`].
    pub fn passage(&self, motion: &DuctMotion, approach: f64) -> Result<MovingDuct, CableError> {
        MovingDuct::new(&self.lumped.cable, &self.lumped.mesh, motion, approach)
    }

    /// Lets one vehicle pass and carries `state` on. When it fails, `state` is as it was.
    ///
    /// # Errors
    ///
    /// [`CableError::StateMismatch`] and [`CableError::PassageMismatch`] for a state and a duct of another mesh,
    /// [`CableError::Precision`] where rounding would
    /// blur the answer, [`CableError::NoConvergence`] where a step found no solution,
    /// [`CableError::EnergyNotConserved`] where a pass created energy.
    pub fn pass(
        &mut self,
        duct: &MovingDuct,
        state: &mut CableState,
    ) -> Result<TransientOutcome, CableError> {
        let time_step = self.time_step(duct);
        let lumped = &self.lumped;
        pass(lumped, duct, time_step, state, |state, recorder| {
            let energy = Moving::from(state).run(lumped, duct, time_step, state, recorder)?;
            energy.check(false)?;
            Ok(energy)
        })
    }
}

/// The cable in motion.
struct Moving {
    history: History,
    friction: Vec<f64>,
    /// Friction one step before.
    before: Vec<f64>,
    duct: Vec<f64>,
    increment: Vec<f64>,
}

impl Moving {
    fn from(state: &CableState) -> Self {
        let zeros = vec![0.0; state.friction.len()];
        Self {
            history: History::at_rest(&state.displacement),
            friction: state.friction.clone(),
            before: zeros.clone(),
            duct: zeros.clone(),
            increment: zeros,
        }
    }

    /// All steps of one pass; `state` is carried on.
    fn run(
        mut self,
        lumped: &Lumped,
        duct: &MovingDuct,
        time_step: f64,
        state: &mut CableState,
        recorder: &mut Recorder,
    ) -> Result<EnergyBalance, CableError> {
        let mut solver = Implicit::new(lumped, 9.0 / (4.0 * time_step * time_step));
        let (mesh, nodes) = (&lumped.mesh, lumped.mesh.nodes());
        let whole = Stretch {
            lo: 0,
            hi: mesh.elements(),
        };
        let steps = (duct.duration() / time_step).round() as usize;
        let mut prediction = Prediction::new(
            (steps * mesh.stride()).div_ceil(mesh.phases()) + nodes,
            mesh.phases(),
        );
        solver.start(largest(&state.displacement, duct.peak()));
        duct.displacement(0.0, &mut self.duct);
        let elastic = lumped.elastic_energy(&state.displacement);
        let stored = lumped.stored_energy(&state.friction);
        let mut energy = EnergyBalance {
            initial: elastic + stored,
            reference: lumped.reference_work(duct.peak()),
            ..EnergyBalance::default()
        };
        for step in 1..=steps {
            let t = time_step * step as f64;
            duct.at(t, nodes).advance(&mut self.duct, &mut self.increment);
            self.before.copy_from_slice(&self.friction);
            solver.load_elastic(lumped, &self.history.displacement);
            self.history.load_inertia(lumped, time_step, &mut solver.load);
            // The lattice point from which contact states are predicted.
            let first = mesh.stride()
                * match duct.direction() {
                    Direction::Forward => steps - step,
                    Direction::Reverse => step,
                };
            if let Some(contacts) = solver.contacts() {
                prediction.read(first, whole, contacts);
            }
            let moved = solver.solve(lumped, &self.increment, &mut self.friction);
            let moved = moved.map_err(|violation| CableError::NoConvergence {
                vehicle_position: duct.vehicle_position(t),
                violation,
            })?;
            self.history.advance(moved, time_step);
            if let Some(contacts) = solver.contacts() {
                prediction.write(first, whole, contacts);
            }
            self.account(lumped, &mut energy);
            recorder.record(lumped.end_forces(&self.history.displacement, &self.friction));
        }
        energy.body_work = lumped.body_work(&state.displacement, &self.history.displacement);
        energy.elastic = lumped.elastic_energy(&self.history.displacement) - elastic;
        energy.stored = lumped.stored_energy(&self.friction) - stored;
        (state.displacement, state.friction) = (self.history.displacement, self.friction);
        recorder.statistics += solver.statistics();
        recorder.statistics.steps = steps;
        recorder.statistics.widest_window = nodes;
        Ok(energy)
    }

    /// Books the step just taken. Friction acts at its mean over the step where it changes by shear, at its value at
    /// the end where it jumps.
    fn account(&self, lumped: &Lumped, energy: &mut EnergyBalance) {
        let compliance = lumped.elastic_compliance();
        let share = if compliance > 0.0 { 0.5 } else { 0.0 };
        let (f, before, duct, moved) = (
            &self.friction,
            &self.before,
            &self.increment,
            &self.history.increment,
        );
        let acting = |i: usize| (1.0 - share) * f[i] + share * before[i];
        let heat = |i: usize| acting(i) * (duct[i] - moved[i] - compliance * (f[i] - before[i]));
        energy.duct_work += lumped.weighted(|i| acting(i) * duct[i]);
        energy.dissipated += lumped.weighted(heat);
        // A held node cannot chatter; what its friction returns is the stretch of the cable within its half element.
        energy.returned += lumped.weighted(|i| if lumped.holds(i) { 0.0 } else { (-heat(i)).max(0.0) });
        energy.kinetic = lumped.kinetic_energy(&self.history.velocity);
        energy.peak_kinetic = energy.peak_kinetic.max(energy.kinetic);
    }
}
