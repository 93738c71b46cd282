//! The explicit solver.

mod energy;
mod leak;
mod limits;
mod moving_duct;
mod nodes;
mod pass;

pub use energy::EnergyBalance;
pub use leak::SigmoidLeak;
pub use limits::{StepLimit, StepLimits};
pub use moving_duct::MovingDuct;
pub use pass::ExplicitOutcome;

use ground_field::DuctMotion;

use crate::error::checked;
use crate::laid::laid;
use crate::lumped::Lumped;
use crate::outcome::Recorder;
use crate::{CableError, CableState, DuctedCable, FrictionLaw, Mesh, StepView};
use nodes::MovingNodes;
use pass::pass;

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
    /// Most node updates (steps × nodes) that one pass may take.
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
/// Before the vehicle comes and after it has left the ground is at rest; both steps are taken without inertia, and the last one ends
/// the cable's vibration.
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
    lumped: Lumped,
    options: ExplicitOptions,
    limits: StepLimits,
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
        let lumped = Lumped::new(cable, mesh, mass_per_metre)?;
        let limits = StepLimits::new(&lumped);
        checked(
            "max_node_updates",
            options.max_node_updates,
            "finite and positive",
            |v| v > 0.0,
        )?;
        if let Some(time_step) = options.time_step {
            checked("time_step", time_step, "finite and positive", |v| v > 0.0)?;
            let margin = limits.margin(time_step);
            if options.check_limits && (margin < 1.0 || margin.is_nan()) {
                return Err(CableError::UnstableStep {
                    time_step,
                    limit: limits.together(),
                    formula: limits.governing().formula,
                });
            }
        }
        Ok(Self {
            laid: laid(&lumped.cable, &mesh)?,
            lumped,
            options,
            limits,
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

    /// Limits of the time step.
    pub fn limits(&self) -> &StepLimits {
        &self.limits
    }

    /// The time step \[s\] of a pass of `duct`, a whole fraction of its duration.
    pub fn time_step(&self, duct: &MovingDuct) -> f64 {
        duct.duration() / self.steps(duct)
    }

    fn steps(&self, duct: &MovingDuct) -> f64 {
        let advance = self.lumped.mesh.vehicle_step() / duct.speed();
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
        MovingDuct::new(&self.lumped.cable, &self.lumped.mesh, motion, approach)
    }

    /// Lets one vehicle pass and carries `state` on. When it fails, `state` is as it was.
    ///
    /// # Errors
    ///
    /// [`CableError::StateMismatch`] and [`CableError::PassageMismatch`] for a state and a duct of another mesh,
    /// [`CableError::Precision`] where rounding would
    /// blur the answer, [`CableError::TooManySteps`] where the pass would take more work than allowed,
    /// [`CableError::EnergyNotConserved`] where the energy balance shows that the step was too long,
    /// [`CableError::NoConvergence`] where the cable found no rest.
    pub fn pass(&mut self, duct: &MovingDuct, state: &mut CableState) -> Result<ExplicitOutcome, CableError> {
        self.pass_observed(duct, state, |_| {})
    }

    /// As [`Explicit::pass`]; `observe` looks at the cable after every time step.
    ///
    /// # Errors
    ///
    /// As for [`Explicit::pass`].
    pub fn pass_observed(
        &mut self,
        duct: &MovingDuct,
        state: &mut CableState,
        mut observe: impl FnMut(StepView<'_>),
    ) -> Result<ExplicitOutcome, CableError> {
        let steps = self.steps(duct);
        let time_step = duct.duration() / steps;
        let Self { lumped, options, .. } = &*self;
        pass(lumped, duct, time_step, state, |state, recorder| {
            let node_updates = steps * lumped.mesh.nodes() as f64;
            let allowed = options.max_node_updates;
            if node_updates > allowed {
                return Err(CableError::TooManySteps {
                    steps,
                    time_step,
                    node_updates,
                    allowed,
                });
            }
            let start = state.clone();
            let look = |t: f64, nodes: &MovingNodes| {
                let state = || {
                    let mut state = start.clone();
                    nodes.store(&mut state);
                    state
                };
                observe(StepView {
                    vehicle_position: duct.vehicle_position(t),
                    mesh: &lumped.mesh,
                    limit: lumped.cable.friction().limit(),
                    state: &state,
                });
            };
            let energy = rub(lumped, duct, steps as usize, state, recorder, look)?;
            if options.check_energy {
                energy.check()?;
            }
            Ok(energy)
        })
    }
}

/// All steps of one pass, whichever the friction law; `state` is carried on.
fn rub(
    lumped: &Lumped,
    duct: &MovingDuct,
    steps: usize,
    state: &mut CableState,
    recorder: &mut Recorder,
    look: impl FnMut(f64, &MovingNodes),
) -> Result<EnergyBalance, CableError> {
    let time_step = duct.duration() / steps as f64;
    let (q, per_mass) = (lumped.cable.friction().limit(), time_step / lumped.mass_per_metre);
    match lumped.cable.friction().law() {
        // The friction that stops the slip, returned to ±q where that is too much (J. J. Moreau's time stepping, node by node, as the
        // masses are lumped).
        FrictionLaw::Coulomb => {
            let per_time = 1.0 / time_step;
            let law = move |velocity: f64, duct: f64, _| {
                let stopping = (duct * per_time - velocity) / per_mass;
                let friction = stopping.max(-q).min(q);
                (velocity + per_mass * friction, friction)
            };
            run(lumped, law, duct, steps, (state, recorder), look)
        }
        // f ← clamp(f + (q b/2) Δs, −q, q): return mapping of the elastic predictor.
        FrictionLaw::ElasticPlastic { shape_factor } => {
            let slope = 0.5 * q * shape_factor;
            let law = move |velocity, duct, friction| {
                let velocity = velocity + per_mass * friction;
                let trial: f64 = friction + slope * (duct - time_step * velocity);
                (velocity, trial.max(-q).min(q))
            };
            run(lumped, law, duct, steps, (state, recorder), look)
        }
        // f = q tanh(b Δs/2).
        FrictionLaw::Sigmoid { shape_factor } => {
            let half = 0.5 * shape_factor;
            let law = move |velocity: f64, duct: f64, friction: f64| {
                let velocity = velocity + per_mass * friction;
                (velocity, q * (half * (duct - time_step * velocity)).tanh())
            };
            run(lumped, law, duct, steps, (state, recorder), look)
        }
    }
}

/// The same by one law: see [`MovingNodes::step`].
fn run(
    lumped: &Lumped,
    law: impl Fn(f64, f64, f64) -> (f64, f64) + Copy,
    duct: &MovingDuct,
    steps: usize,
    (state, recorder): (&mut CableState, &mut Recorder),
    mut look: impl FnMut(f64, &MovingNodes),
) -> Result<EnergyBalance, CableError> {
    let count = lumped.mesh.nodes();
    let time_step = duct.duration() / steps as f64;
    let mut nodes = MovingNodes::new(state);
    duct.displacement(0.0, &mut nodes.duct);
    let mut peak_kinetic = 0.0_f64;
    for step in 1..=steps {
        let t = time_step * step as f64;
        duct.at(t, count).advance(&mut nodes.duct, &mut nodes.increment);
        nodes.step(lumped, law, time_step);
        recorder.record(nodes.end_forces(lumped));
        look(t, &nodes);
        if step % LOOK == 0 || step == steps {
            let kinetic = lumped.kinetic_energy(&nodes.velocity);
            if !kinetic.is_finite() {
                return Err(CableError::EnergyNotConserved {
                    unbalanced: 1.0,
                    returned: nodes.energy(lumped, state, peak_kinetic).returned_share(),
                });
            }
            peak_kinetic = peak_kinetic.max(kinetic);
        }
    }
    let energy = EnergyBalance {
        reference: lumped.reference_work(duct.peak()),
        ..nodes.energy(lumped, state, peak_kinetic)
    };
    recorder.statistics.steps = steps;
    recorder.statistics.node_updates += steps * count;
    recorder.statistics.widest_window = count;
    nodes.store(state);
    Ok(energy)
}
