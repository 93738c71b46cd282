//! The explicit solver.

mod energy;
mod leak;
mod limits;
mod moving_duct;
mod nodes;

pub use energy::EnergyBalance;
pub use leak::SigmoidLeak;
pub use limits::StepLimits;
pub use moving_duct::MovingDuct;

use ground_field::DuctMotion;

use crate::chain::{chain, check_precision};
use crate::error::positive;
use crate::laid::laid;
use crate::{CableError, CableState, DuctedCable, EndForces, Mesh, PassOutcome, RestingCable};
use nodes::MovingNodes;

/// Steps between two looks at the kinetic energy.
const LOOK: usize = 32;

/// How the explicit solver steps.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ExplicitOptions {
    /// Time step \[s\]; by default [`StepLimits::advised`], and short enough for the vehicle to advance no more than the mesh's
    /// vehicle step.
    pub time_step: Option<f64>,
    /// Whether a step beyond the limit is refused; for tests of the energy balance, which watches independently.
    #[doc(hidden)]
    pub check_limits: bool,
    /// Whether a pass whose energy does not balance is an error; for tests. Without either check the scheme may return any number.
    #[doc(hidden)]
    pub check_energy: bool,
    /// Maximum number of node updates (steps × nodes) that one pass may take.
    pub max_node_updates: f64,
}

impl Default for ExplicitOptions {
    /// The longest safe step, limits and energy checked, at most 2e11 node updates: about ten minutes.
    fn default() -> Self {
        Self {
            time_step: None,
            check_limits: true,
            check_energy: true,
            max_node_updates: 2e11,
        }
    }
}

/// What one pass with inertia did.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct ExplicitOutcome {
    /// Forces, peaks and displacements as a quasi-static pass reports them. Peaks include
    /// vibration.
    ///
    /// In its statistics `steps` counts time steps, `node_updates` nodes advanced in time.
    pub pass: PassOutcome,
    /// Duration of one step \[s\].
    pub time_step: f64,
    /// Energies of the pass, between its two steps from rest and to it.
    pub energy: EnergyBalance,
    /// Force on each end \[N\] at the last instant of the pass, before ground and cable came to
    /// rest.
    pub force_before_rest: EndForces,
    /// What a law without memory loses; `None` for the others.
    pub leak: Option<SigmoidLeak>,
}

/// Explicit solver for one cable on one mesh: masses, springs and friction by central differences (Kashiro et al., Equations (2), (3)).
///
/// The cable is a row of masses on springs that the duct rubs, m a + K u = w (f + p), with velocities half a step apart:
///
/// v ← v + Δt (−K u + w (f + p))/m,  u ← u + Δt v,  f ← law(f, ΔD − Δt v).
///
/// The step has a limit ([`StepLimits`]), which is enforced: beyond it the sigmoid chatters from +q to −q and reads next to nothing
/// where hundreds of newtons are right, without ever overflowing. Independently of the limit every pass must balance its energy
/// ([`EnergyBalance`]); one that does not is an error and never a number.
///
/// Before the vehicle comes and after it has left the duct stands at D = 0. One step without
/// inertia takes it from there to the vehicle's first position, one more from the last position
/// back. The step back also ends the cable's vibration: the state that a vibrating cable comes to,
/// however weakly it is damped, is the equilibrium with the same anchors u + γ f. It moves the
/// cable by less than its vibration and leaves the mean where it was. The sigmoid, which has no
/// memory, begins both steps without friction and is the elastic-plastic law of its slope in them;
/// what it had left when the vehicle was gone is [`ExplicitOutcome::force_before_rest`].
///
/// The cost is steps times nodes, some 3e4 × 150 for a pass at 40 km/h over 30 m with h = 0.2 m: forty times the quasi-static one; it falls with
/// the speed. It is the reference for what the quasi-static solver leaves out, and the paper's own scheme.
///
/// ```
/// use cable_dem::{DuctedCable, End, Explicit, ExplicitOptions, Friction, FrictionLaw, Mesh, MovingDuct};
/// use ground_field::Direction;
///
/// let shape = |xi: f64| 40e-6 * xi / (1.0 + xi * xi).powf(1.5);
/// let friction = Friction::new(FrictionLaw::Coulomb, 0.25 * 108.8)?;
/// let cable = DuctedCable::new(10.0, 8.01e6, friction)?.with_ends(End::Free, End::Fixed)?;
/// let mesh = Mesh::for_depth(10.0, 1.2, 3.0)?;
/// let duct = MovingDuct::from_shape(&cable, &mesh, Direction::Forward, 11.1, shape, 15.0)?;
/// let mut solver = Explicit::new(cable, mesh, 108.8 / 9.80665, ExplicitOptions::default())?;
/// let outcome = solver.pass(&duct, &mut solver.at_rest())?;
/// assert!(outcome.time_step < solver.limits().together());
/// # Ok::<(), cable_dem::CableError>(())
/// ```
#[derive(Debug, Clone)]
pub struct Explicit {
    nodes: MovingNodes,
    options: ExplicitOptions,
    limits: StepLimits,
    resting: RestingCable,
    laid: CableState,
}

impl Explicit {
    /// A solver for `cable` on `mesh`, with `mass_per_metre` m′ \[kg/m\] (weight per metre over 9.80665 m/s²). Of the mesh the
    /// spacing counts, and the vehicle step as an upper bound on the vehicle's advance in a time step.
    ///
    /// # Errors
    ///
    /// [`CableError::InvalidParameter`] unless the mass is finite and positive, the mesh is as long as the cable and the
    /// options are positive, [`CableError::UnstableStep`] for a time step beyond its limit; as for [`laid`].
    pub fn new(
        cable: DuctedCable,
        mesh: Mesh,
        mass_per_metre: f64,
        options: ExplicitOptions,
    ) -> Result<Self, CableError> {
        let mut nodes = MovingNodes::new(cable, mesh, mass_per_metre)?;
        let limits = StepLimits::new(&nodes);
        // Clamps slip at any step of time: they are no springs of the chain.
        nodes.chain = chain(&nodes.cable, &mesh, Vec::new())?;
        positive("max_node_updates", options.max_node_updates)?;
        if let Some(time_step) = options.time_step {
            positive("time_step", time_step)?;
            // Written so that NaN fails.
            let is_stable = time_step <= limits.together();
            if options.check_limits && !is_stable {
                let longest = [limits.together(), limits.elastic, limits.friction];
                return Err(CableError::UnstableStep { time_step, longest });
            }
        }
        Ok(Self {
            laid: laid(&nodes.cable, &mesh)?,
            resting: RestingCable::with_memory(&nodes.cable, &mesh)?,
            nodes,
            options,
            limits,
        })
    }

    /// The mesh.
    pub fn mesh(&self) -> &Mesh {
        &self.nodes.mesh
    }

    /// The cable.
    pub fn cable(&self) -> &DuctedCable {
        &self.nodes.cable
    }

    /// Limits of the time step.
    pub fn limits(&self) -> &StepLimits {
        &self.limits
    }

    /// The time step \[s\] of a pass of `duct`, a whole fraction of its duration.
    pub fn time_step(&self, duct: &MovingDuct) -> f64 {
        duct.duration() / self.steps(duct)
    }

    fn steps(&self, duct: &MovingDuct) -> f64 {
        let advance = self.nodes.mesh.vehicle_step() / duct.speed();
        let longest = self.limits.advised().min(advance);
        duct.steps(self.options.time_step.unwrap_or(longest))
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
        MovingDuct::new(&self.nodes.cable, &self.nodes.mesh, motion, approach)
    }

    /// Lets one vehicle pass and carries `state` on. When it fails, `state` is as it was.
    ///
    /// # Errors
    ///
    /// [`CableError::StateMismatch`] and [`CableError::PassageMismatch`] for a state and a duct of another mesh,
    /// [`CableError::Precision`] if rounding would
    /// blur the answer, [`CableError::TooManySteps`] if the pass would take more work than allowed,
    /// [`CableError::EnergyNotConserved`] if the energy balance shows that the step was too long,
    /// [`CableError::NoConvergence`] if the cable found no rest.
    pub fn pass(&mut self, duct: &MovingDuct, state: &mut CableState) -> Result<ExplicitOutcome, CableError> {
        self.pass_observed(duct, state, |_, _| {})
    }

    /// As [`Explicit::pass`]; `observe` is called after every time step with the vehicle's position
    /// \[m\] and a function that gives the state there.
    ///
    /// # Errors
    ///
    /// As for [`Explicit::pass`].
    pub fn pass_observed(
        &mut self,
        duct: &MovingDuct,
        state: &mut CableState,
        observe: impl FnMut(f64, &dyn Fn() -> CableState),
    ) -> Result<ExplicitOutcome, CableError> {
        state.check(self.mesh())?;
        duct.check(self.mesh())?;
        if state.thermal_force != 0.0 {
            return Err(CableError::Heated);
        }
        let (steps, time_step) = (self.steps(duct), self.time_step(duct));
        let mut outcome = PassOutcome::at_rest(self.cable(), state)?;
        let mut moving = state.clone();
        let mut energy = EnergyBalance::default();
        let mut force_before_rest = outcome.force;
        // Without friction nothing drags the cable.
        if self.cable().friction().limit() > 0.0 {
            check_precision(self.cable(), self.mesh(), &state.displacement, duct.peak())?;
            let (node_updates, allowed) = (steps * self.mesh().nodes() as f64, self.options.max_node_updates);
            if node_updates > allowed {
                return Err(CableError::TooManySteps {
                    time_step,
                    node_updates,
                    allowed,
                });
            }
            let arrival = self.rest(duct, 0.0, 1.0, &mut moving)?;
            energy = self.run(duct, steps as usize, &mut moving, &mut outcome, observe)?;
            if self.options.check_energy {
                energy.check()?;
            }
            force_before_rest = self.nodes.end_forces();
            let departure = self.rest(duct, duct.duration(), -1.0, &mut moving)?;
            outcome.dissipated = arrival + energy.dissipated + departure;
        }
        let pass = outcome.ended(self.cable(), &moving)?;
        *state = moving;
        Ok(ExplicitOutcome {
            pass,
            time_step,
            energy,
            force_before_rest,
            leak: SigmoidLeak::new(self.cable(), time_step, duct),
        })
    }

    /// One step without inertia in which the duct moves between rest and where it stands at the
    /// time `t` \[s\]: there with the `sign` 1, back with −1. Returns the heat of the slip \[J\].
    fn rest(
        &mut self,
        duct: &MovingDuct,
        t: f64,
        sign: f64,
        state: &mut CableState,
    ) -> Result<f64, CableError> {
        let mut increment = vec![0.0; state.displacement.len()];
        duct.displacement(t, &mut increment);
        for increment in &mut increment {
            *increment *= sign;
        }
        if self.cable().friction().law().has_memory() {
            return self.resting.follow(state, Some(&increment), 0.0, duct.peak());
        }
        // What a contact without memory stores in a step it forgets before the next.
        state.friction.fill(0.0);
        let heat = self.resting.follow(state, Some(&increment), 0.0, duct.peak())?;
        let friction = &state.friction;
        let forgotten = self.nodes.weighted(|i| friction[i].powi(2));
        Ok(heat + self.nodes.cable.friction().compliance() * forgotten)
    }

    /// All steps of time of one pass; `state` is carried on.
    fn run(
        &mut self,
        duct: &MovingDuct,
        steps: usize,
        state: &mut CableState,
        outcome: &mut PassOutcome,
        mut observe: impl FnMut(f64, &dyn Fn() -> CableState),
    ) -> Result<EnergyBalance, CableError> {
        let (nodes, time_step) = (&mut self.nodes, duct.duration() / steps as f64);
        nodes.begin(state);
        duct.displacement(0.0, &mut nodes.duct);
        let mut peak_kinetic = 0.0_f64;
        for step in 1..=steps {
            let t = time_step * step as f64;
            nodes.step(|d| duct.displacement(t, d), time_step);
            outcome.see(nodes.end_forces());
            if !nodes.clamps.is_empty() {
                let u = |i: usize| nodes.displacement[i];
                outcome.see_clamps(&nodes.shares.forces(&nodes.clamps, nodes.cable.restraints(), u));
            }
            observe(duct.vehicle_position(t), &|| {
                let mut shown = state.clone();
                nodes.store(&mut shown);
                shown
            });
            if step % LOOK == 0 || step == steps {
                let kinetic = nodes.kinetic_energy();
                if !kinetic.is_finite() {
                    return Err(CableError::EnergyNotConserved {
                        unbalanced: 1.0,
                        returned: nodes.energy(state, peak_kinetic, duct.peak()).returned_share(),
                    });
                }
                peak_kinetic = peak_kinetic.max(kinetic);
            }
        }
        let count = nodes.mesh.nodes();
        outcome.statistics.steps = steps;
        outcome.statistics.node_updates += steps * count;
        outcome.statistics.widest_window = count;
        let energy = nodes.energy(state, peak_kinetic, duct.peak());
        nodes.store(state);
        Ok(energy)
    }
}
