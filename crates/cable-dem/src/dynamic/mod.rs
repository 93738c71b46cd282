//! Dynamic implicit passes: the quasi-static step with inertia as one more term.
//!
//! Time is discretised by the second backward difference (C. W. Gear; E. Hairer, G. Wanner, Solving Ordinary
//! Differential Equations II, 1996, §V.1), for displacement and velocity alike,
//!
//! v_n = (3 u_n − 4 u_{n−1} + u_{n−2})/(2Δt),  a_n = (3 v_n − 4 v_{n−1} + v_{n−2})/(2Δt),
//!
//! so that each step solves (K + S + 9/(4Δt²) M) r = p + w f_n for the increment r, with friction by the law at the
//! end of the step: the quasi-static convex problem with more on the diagonal. The formula is of second order and
//! L-stable: any step is stable, and vibration faster than the step resolves is damped instead of ringing against the
//! friction, which the trapezoidal rule would let it do. Its numerical damping is the residual of the energy balance.
//!
//! The step is the mesh's vehicle step, as in the quasi-static solver; it then costs a few sweeps over the whole cable.
//! Inertia is worth this where [`crate::inertia_ratio`] is not far below the accuracy wanted. After the vehicle has left
//! ground and cable come to rest as after an explicit pass.
//!
//! The `sigmoid` law is solved too (`transient::sigmoid`): its answer depends on the time step by the law's own definition, and what it
//! loses at rest comes with every outcome ([`SigmoidLeak`]).

mod history;
mod prediction;

use ground_field::DuctMotion;

use crate::outcome::Recorder;
use crate::transient::{
    Departed, EnergyBalance, Lumped, MovingDuct, Settler, SigmoidLeak, SigmoidSolver, StepSolver,
    TransientOutcome, tolerance,
};
use crate::{CableError, CableState, DuctedCable, EndForces, Mesh};
use history::History;
use prediction::Prediction;

/// Dynamic implicit solver for one cable on one mesh.
#[derive(Debug, Clone)]
pub struct Dynamic {
    lumped: Lumped,
    history: History,
    prediction: Prediction,
    friction: Vec<f64>,
    before: Vec<f64>,
    duct: Vec<f64>,
    increment: Vec<f64>,
    settler: Settler,
    /// Step solver for the time step it was made for.
    solver: Option<(f64, Solver)>,
}

/// Whichever solves the cable's law.
#[derive(Debug, Clone)]
enum Solver {
    Memory(Box<StepSolver>),
    Sigmoid(Box<SigmoidSolver>),
}

impl Dynamic {
    /// A solver for `cable` on `mesh`, with `mass_per_metre` m′ \[kg/m\] (weight per metre over 9.80665 m/s²).
    ///
    /// # Errors
    ///
    /// [`CableError::InvalidParameter`] unless the mass is finite and positive and the mesh is as long as the cable.
    pub fn new(cable: DuctedCable, mesh: Mesh, mass_per_metre: f64) -> Result<Self, CableError> {
        let lumped = Lumped::new(cable, mesh, mass_per_metre)?;
        let zeros = || vec![0.0; mesh.nodes()];
        Ok(Self {
            history: History::new(mesh.nodes()),
            prediction: Prediction::default(),
            friction: zeros(),
            before: zeros(),
            duct: zeros(),
            increment: zeros(),
            settler: Settler::new(&lumped),
            solver: None,
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

    /// What a law without memory loses in a pass of `duct`; `None` for the others.
    pub fn leak(&self, duct: &MovingDuct) -> Option<SigmoidLeak> {
        SigmoidLeak::new(&self.lumped.cable, self.time_step(duct), duct)
    }

    fn steps(&self, duct: &MovingDuct) -> f64 {
        duct.steps(self.lumped.mesh.vehicle_step() / duct.speed())
    }

    /// The cable as laid.
    pub fn at_rest(&self) -> CableState {
        CableState::at_rest(&self.lumped.mesh)
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
        state.check(&self.lumped.mesh)?;
        duct.check(&self.lumped.mesh)?;
        let time_step = self.time_step(duct);
        if self.lumped.cable.friction().limit() == 0.0 {
            // Nothing drags the cable.
            return Ok(TransientOutcome::untouched(&self.lumped, state, time_step));
        }
        self.lumped.check(state, duct.peak())?;
        self.prepare(time_step);
        let start = self.lumped.end_forces(&state.displacement, &state.friction);
        let mut recorder = Recorder::new(start);
        let mut moving = state.clone();
        let arrival_heat = self
            .settler
            .arrive(&self.lumped, duct, &mut moving, &mut recorder.statistics)?;
        let energy = self.run(duct, &moving, &mut recorder)?;
        energy.check(false)?;
        moving.displacement.copy_from_slice(&self.history.displacement);
        moving.friction.copy_from_slice(&self.friction);
        let departed = Departed {
            duct,
            time_step,
            energy,
            arrival_heat,
            moving,
            recorder,
        };
        let (after, outcome) = departed.close(&self.lumped, &mut self.settler)?;
        *state = after;
        Ok(outcome)
    }

    /// Has a solver for this time step ready.
    fn prepare(&mut self, time_step: f64) {
        if self
            .solver
            .as_ref()
            .is_some_and(|(made_for, _)| *made_for == time_step)
        {
            return;
        }
        let inertia = 9.0 / (4.0 * time_step * time_step);
        let solver = if self.lumped.cable.friction().law().has_memory() {
            Solver::Memory(Box::new(StepSolver::new(&self.lumped, inertia)))
        } else {
            Solver::Sigmoid(Box::new(SigmoidSolver::new(&self.lumped, inertia)))
        };
        self.solver = Some((time_step, solver));
    }

    /// All steps of one pass.
    fn run(
        &mut self,
        duct: &MovingDuct,
        state: &CableState,
        recorder: &mut Recorder,
    ) -> Result<EnergyBalance, CableError> {
        let nodes = self.lumped.mesh.nodes();
        let steps = self.steps(duct) as usize;
        let time_step = duct.duration() / steps as f64;
        let largest = state.displacement.iter().fold(duct.peak(), |l, u| l.max(u.abs()));
        let tolerance = tolerance(&self.lumped, largest);
        self.history.start(&state.displacement);
        self.prediction.start(&self.lumped.mesh, duct.direction(), steps);
        if let Some((_, Solver::Sigmoid(solver))) = &mut self.solver {
            solver.start();
        }
        self.friction.copy_from_slice(&state.friction);
        duct.displacement(0.0, &mut self.duct);
        let elastic = self.lumped.elastic_energy(&state.displacement);
        let stored = self.lumped.stored_energy(&state.friction);
        let mut energy = EnergyBalance {
            initial: elastic + stored,
            reference: self.lumped.reference_work(duct.peak()),
            ..EnergyBalance::default()
        };
        for step in 1..=steps {
            let t = time_step * step as f64;
            duct.at(t, nodes).advance(&mut self.duct, &mut self.increment);
            self.before.copy_from_slice(&self.friction);
            self.prediction.advance();
            self.step(time_step, tolerance, recorder)
                .map_err(|violation| CableError::NoConvergence {
                    vehicle_position: duct.vehicle_position(t),
                    violation,
                })?;
            self.account(&mut energy);
            recorder.record(self.end_forces());
        }
        energy.elastic = self.lumped.elastic_energy(&self.history.displacement) - elastic;
        energy.stored = self.lumped.stored_energy(&self.friction) - stored;
        recorder.statistics.steps = steps;
        recorder.statistics.widest_window = nodes;
        Ok(energy)
    }

    /// One step; on failure the largest violation as a share of the friction limit.
    fn step(
        &mut self,
        time_step: f64,
        tolerance: crate::quasi_static::Tolerance,
        recorder: &mut Recorder,
    ) -> Result<(), f64> {
        let Self {
            lumped,
            history,
            prediction,
            solver,
            friction,
            increment,
            ..
        } = self;
        let statistics = &mut recorder.statistics;
        let Some((_, solver)) = solver else {
            return Err(f64::INFINITY);
        };
        let r = match solver {
            Solver::Memory(solver) => {
                solver.load_elastic(lumped, &history.displacement);
                history.load_inertia(lumped, time_step, &mut solver.load);
                prediction.read(solver.contacts());
                solver.solve(lumped, tolerance, increment, friction, statistics)?;
                prediction.write(solver.contacts());
                solver.increments()
            }
            Solver::Sigmoid(solver) => {
                solver.inner.load_elastic(lumped, &history.displacement);
                history.load_inertia(lumped, time_step, &mut solver.inner.load);
                solver.solve(lumped, tolerance, increment, friction, statistics)?
            }
        };
        history.advance(r, time_step);
        Ok(())
    }

    /// Books the step just taken. Friction acts at its mean over the step where it changes by shear, at its value at
    /// the end where it jumps.
    fn account(&self, energy: &mut EnergyBalance) {
        let friction = self.lumped.cable.friction();
        let sheared = friction.law().has_memory() && friction.compliance() > 0.0;
        let (compliance, share) = if sheared {
            (friction.compliance(), 0.5)
        } else {
            (0.0, 0.0)
        };
        let (f, before, duct, moved) = (
            &self.friction,
            &self.before,
            &self.increment,
            &self.history.increment,
        );
        let acting = |i: usize| (1.0 - share) * f[i] + share * before[i];
        let heat = |i: usize| acting(i) * (duct[i] - moved[i] - compliance * (f[i] - before[i]));
        let nodes = f.len();
        energy.duct_work += self.lumped.weighted(nodes, |i| acting(i) * duct[i]);
        energy.dissipated += self.lumped.weighted(nodes, heat);
        // A held node cannot chatter; what its friction returns is the stretch of the cable within its half element.
        let fixed = self.lumped.fixed;
        let held = |i: usize| (i == 0 && fixed[0]) || (i + 1 == nodes && fixed[1]);
        energy.returned += self
            .lumped
            .weighted(nodes, |i| if held(i) { 0.0 } else { (-heat(i)).max(0.0) });
        energy.kinetic = self.lumped.kinetic_energy(&self.history.velocity);
        energy.peak_kinetic = energy.peak_kinetic.max(energy.kinetic);
    }

    fn end_forces(&self) -> EndForces {
        self.lumped.end_forces(&self.history.displacement, &self.friction)
    }
}
