//! Any solver on any problem.

use std::rc::Rc;

use cable_dem::{
    CableError, CableState, DuctedCable, End, EndForces, EnergyBalance, Explicit, ExplicitOptions, Friction,
    FrictionLaw, Mesh, MovingDuct, PassOutcome, Passage, QuasiStatic, SigmoidLeak, laid,
};
use ground_field::Direction;

pub use super::shared::{APPROACH, AXIAL_STIFFNESS, LIMITS, SPEED, assert_near, largest};
use super::shared::{forces, reference_motion};

pub type Outcome = Result<(), Box<dyn std::error::Error>>;

/// Mass per metre of the cable \[kg/m\]: 108.8 N/m.
pub const MASS: f64 = 108.8 / 9.80665;
/// Sheath of the upper cable.
pub const SHEATH: FrictionLaw = FrictionLaw::ElasticPlastic {
    shape_factor: 2e8 / LIMITS[0],
};
/// The sheath of the full-scale experiment's cables, q b/2 = 1e8 N/m².
pub fn sheathed(limit: f64) -> FrictionLaw {
    FrictionLaw::ElasticPlastic {
        shape_factor: 2e8 / limit,
    }
}

/// The duct 1.2 m below a load of 20 tf on ground of 800 MPa, ν = 0.4, at 40 km/h.
pub fn truck() -> Drive {
    let motion = reference_motion();
    Drive::new(SPEED, APPROACH, move |xi| motion.longitudinal(xi))
}

/// A cable like those of the full-scale experiment, and its mesh: node spacing and vehicle step \[m\].
#[derive(Debug, Clone, Copy)]
pub struct Bar {
    pub length: f64,
    pub axial_stiffness: f64,
    pub law: FrictionLaw,
    pub limit: f64,
    pub ends: (End, End),
    pub mesh: (f64, f64),
}

/// The upper cable.
pub const UPPER: Bar = Bar {
    length: 30.0,
    axial_stiffness: AXIAL_STIFFNESS,
    law: SHEATH,
    limit: LIMITS[0],
    ends: (End::Free, End::Fixed),
    mesh: (0.2, 0.1),
};

impl Bar {
    pub fn cable(&self) -> Result<DuctedCable, CableError> {
        let friction = Friction::new(self.law, self.limit)?;
        DuctedCable::new(self.length, self.axial_stiffness, friction)?.with_ends(self.ends.0, self.ends.1)
    }

    /// With a vehicle that comes forward, and back.
    pub fn under(&self, vehicle: &Drive) -> Result<Problem, CableError> {
        Ok(Problem {
            cable: self.cable()?,
            mesh: Mesh::new(self.length, self.mesh.0, self.mesh.1)?,
            drives: vec![vehicle.clone(), vehicle.back()],
        })
    }
}

/// With at most so many node updates.
pub fn limited(max_node_updates: f64) -> ExplicitOptions {
    ExplicitOptions {
        max_node_updates,
        ..ExplicitOptions::default()
    }
}

/// The solvers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    QuasiStatic,
    Explicit,
}

impl Kind {
    pub const ALL: [Self; 2] = [Self::QuasiStatic, Self::Explicit];

    /// Those that handle `law`.
    pub fn for_law(law: FrictionLaw) -> impl Iterator<Item = Self> {
        let handles = move |kind: &Self| kind.has_inertia() || law.has_memory();
        Self::ALL.into_iter().filter(handles)
    }

    pub fn has_inertia(self) -> bool {
        self != Self::QuasiStatic
    }
}

/// One vehicle: a shape of the duct's displacement that travels along the duct.
#[derive(Clone)]
pub struct Drive {
    pub direction: Direction,
    pub speed: f64,
    pub approach: f64,
    pub shape: Rc<dyn Fn(f64) -> f64>,
}

impl Drive {
    /// Forward traffic.
    pub fn new(speed: f64, approach: f64, shape: impl Fn(f64) -> f64 + 'static) -> Self {
        Self {
            direction: Direction::Forward,
            speed,
            approach,
            shape: Rc::new(shape),
        }
    }

    /// The same at another speed \[m/s\].
    pub fn at(&self, speed: f64) -> Self {
        Self {
            speed,
            ..self.clone()
        }
    }

    /// The same vehicle on its way back, of one that drives forward.
    pub fn back(&self) -> Self {
        Self {
            direction: Direction::Reverse,
            ..self.clone()
        }
    }
}

/// A cable on a mesh, and the vehicles that may come.
#[derive(Clone)]
pub struct Problem {
    pub cable: DuctedCable,
    pub mesh: Mesh,
    pub drives: Vec<Drive>,
}

impl Problem {
    /// Work of friction at its limit over a picometre of slip \[J\]: rounding.
    pub fn negligible_work(&self) -> f64 {
        1e-12 * self.cable.friction().limit() * self.cable.length()
    }

    /// Compression along the cable \[N\]: at its upstream end, in its elements, at its downstream end.
    pub fn forces(&self, state: &CableState) -> Vec<f64> {
        forces(&self.cable, state)
    }

    /// [`Problem::forces`] by the quasi-static solver after vehicles of these indices, and the largest force met in the cable at any time.
    pub fn without_inertia(&self, traffic: &[usize]) -> (Vec<f64>, f64) {
        // If nothing moves nothing is left but rounding.
        let mut most = 1e-6 * self.largest_force();
        let mut run = Run::new(Kind::QuasiStatic, self).expect("a valid problem");
        for &drive in traffic {
            let pass = run.watch(drive, |_, state| most = most.max(largest(self.forces(&state()))));
            pass.expect("an equilibrium");
        }
        (self.forces(&run.state), most)
    }

    /// Largest force that friction can build up: q L \[N\].
    pub fn largest_force(&self) -> f64 {
        self.cable.friction().limit() * self.cable.length()
    }
}

/// A solver with the vehicles as it takes them, and the cable's state.
pub struct Run {
    solver: Solver,
    pub state: CableState,
}

enum Solver {
    QuasiStatic(Box<QuasiStatic>, Vec<Passage>),
    Explicit(Box<Explicit>, Vec<MovingDuct>),
}

/// What one pass did.
#[derive(Debug, Clone, PartialEq)]
pub struct Pass {
    pub outcome: PassOutcome,
    /// Force on each end \[N\] at the vehicle's last position, before the ground returns to rest.
    pub before_rest: EndForces,
    /// Of the solver with inertia.
    pub energy: Option<EnergyBalance>,
    /// Under the sigmoid law.
    pub leak: Option<SigmoidLeak>,
    /// Of the quasi-static solver: the cable at the vehicle's last position.
    pub pushed: Option<CableState>,
}

impl Run {
    /// As laid.
    pub fn new(kind: Kind, problem: &Problem) -> Result<Self, CableError> {
        Self::resumed(kind, problem, laid(&problem.cable, &problem.mesh)?)
    }

    /// From `state`, by a new solver.
    pub fn resumed(kind: Kind, problem: &Problem, state: CableState) -> Result<Self, CableError> {
        let Problem { cable, mesh, drives } = problem;
        if kind == Kind::Explicit {
            let run = Self::explicit(problem, ExplicitOptions::default())?;
            return Ok(Self { state, ..run });
        }
        let passage =
            |drive: &Drive| Passage::from_shape(cable, mesh, drive.direction, &*drive.shape, drive.approach);
        let solver = Box::new(QuasiStatic::new(cable.clone(), *mesh)?);
        let passages = drives.iter().map(passage).collect::<Result<_, _>>()?;
        Ok(Self {
            solver: Solver::QuasiStatic(solver, passages),
            state,
        })
    }

    /// As laid, by the explicit solver with these options.
    pub fn explicit(problem: &Problem, options: ExplicitOptions) -> Result<Self, CableError> {
        let Problem { cable, mesh, drives } = problem;
        let duct = |drive: &Drive| {
            let shape = &*drive.shape;
            MovingDuct::from_shape(cable, mesh, drive.direction, drive.speed, shape, drive.approach)
        };
        let solver = Box::new(Explicit::new(cable.clone(), *mesh, MASS, options)?);
        let ducts = drives.iter().map(duct).collect::<Result<_, _>>()?;
        Ok(Self {
            solver: Solver::Explicit(solver, ducts),
            state: laid(cable, mesh)?,
        })
    }

    /// Lets the vehicle of this index pass.
    pub fn pass(&mut self, drive: usize) -> Result<Pass, CableError> {
        self.watch(drive, |_, _| {})
    }

    /// [`Run::pass`]; `observe` sees the vehicle's position \[m\] and the cable at each of them.
    pub fn watch(
        &mut self,
        drive: usize,
        mut observe: impl FnMut(f64, &dyn Fn() -> CableState),
    ) -> Result<Pass, CableError> {
        match &mut self.solver {
            Solver::QuasiStatic(solver, passages) => {
                let cable = solver.cable().clone();
                let mut last = self.state.clone();
                let outcome = solver.pass_observed(&passages[drive], &mut self.state, |vehicle, state| {
                    observe(vehicle, state);
                    last = state();
                })?;
                Ok(Pass {
                    outcome,
                    before_rest: last.end_forces(&cable)?,
                    energy: None,
                    leak: None,
                    pushed: Some(last),
                })
            }
            Solver::Explicit(solver, ducts) => {
                let found = solver.pass_observed(&ducts[drive], &mut self.state, observe)?;
                Ok(Pass {
                    outcome: found.pass,
                    before_rest: found.force_before_rest,
                    energy: Some(found.energy),
                    leak: found.leak,
                    pushed: None,
                })
            }
        }
    }

    /// Largest friction as a share of its limit, infinite for NaN.
    pub fn utilisation(&self, problem: &Problem) -> f64 {
        largest(self.state.friction().iter().copied()) / problem.cable.friction().limit()
    }

    /// Several passes of the first vehicle, at least one; what the last one did.
    pub fn passes(&mut self, count: usize) -> Result<Pass, CableError> {
        for _ in 1..count {
            self.pass(0)?;
        }
        self.pass(0)
    }
}
