//! Any solver on any problem.

use std::rc::Rc;

use boussinesq::HalfSpace;
use cable_dem::{
    CableError, CableState, DuctedCable, EndForces, EnergyBalance, Explicit, ExplicitOptions, FrictionLaw,
    Mesh, MovingDuct, PassOutcome, Passage, QuasiStatic, laid,
};
use ground_field::Direction;

pub type Outcome = Result<(), Box<dyn std::error::Error>>;

/// Mass per metre of the cable \[kg/m\]: 108.8 N/m.
pub const MASS: f64 = 108.8 / 9.80665;
/// EA of the full-scale experiment's cables \[N\].
pub const AXIAL_STIFFNESS: f64 = 8.01e6;
/// Its friction limits \[N/m\]: upper cable, and lower cable with the load of the others.
pub const LIMITS: [f64; 2] = [0.25 * 108.8, 0.27 * 163.2];
/// Distance beyond the duct's ends from which its vehicle comes \[m\].
pub const APPROACH: f64 = 15.0;
/// 40 km/h.
pub const SPEED: f64 = 40.0 / 3.6;

/// The sheath of the full-scale experiment's cables, q b/2 = 1e8 N/m².
pub fn sheathed(limit: f64) -> FrictionLaw {
    FrictionLaw::ElasticPlastic {
        shape_factor: 2e8 / limit,
    }
}

/// The duct 1.2 m below a load of 20 tf on ground of 800 MPa, ν = 0.4, at 40 km/h.
pub fn truck() -> Result<Drive, Box<dyn std::error::Error>> {
    let motion = testkit::truck(&HalfSpace::new(testkit::soil(800e6, 0.4)), SPEED)?;
    Ok(Drive::new(SPEED, APPROACH, move |xi| motion.longitudinal(xi)))
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

    /// The same vehicle on its way back.
    pub fn back(&self) -> Self {
        Self {
            direction: match self.direction {
                Direction::Forward => Direction::Reverse,
                Direction::Reverse => Direction::Forward,
            },
            ..self.clone()
        }
    }
}

impl std::fmt::Debug for Drive {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(
            f,
            "{:?} {} m/s from {} m",
            self.direction, self.speed, self.approach
        )
    }
}

/// A cable on a mesh, and the vehicles that may come.
#[derive(Clone, Debug)]
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
    /// Of solvers with inertia.
    pub energy: Option<EnergyBalance>,
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
        let ducts = || -> Result<Vec<MovingDuct>, CableError> {
            let duct = |drive: &Drive| {
                let shape = &*drive.shape;
                MovingDuct::from_shape(cable, mesh, drive.direction, drive.speed, shape, drive.approach)
            };
            drives.iter().map(duct).collect()
        };
        let passage =
            |drive: &Drive| Passage::from_shape(cable, mesh, drive.direction, &*drive.shape, drive.approach);
        let own = cable.clone();
        let solver = match kind {
            Kind::QuasiStatic => Solver::QuasiStatic(
                Box::new(QuasiStatic::new(own, *mesh)?),
                drives.iter().map(passage).collect::<Result<_, _>>()?,
            ),
            Kind::Explicit => {
                let explicit = Explicit::new(own, *mesh, MASS, ExplicitOptions::default())?;
                Solver::Explicit(Box::new(explicit), ducts()?)
            }
        };
        Ok(Self { solver, state })
    }

    /// Lets the vehicle of this index pass.
    pub fn pass(&mut self, drive: usize) -> Result<Pass, CableError> {
        let transient = match &mut self.solver {
            Solver::QuasiStatic(solver, passages) => {
                let cable = solver.cable().clone();
                let mut last = self.state.clone();
                let outcome = solver.pass_observed(&passages[drive], &mut self.state, |_, state| {
                    last = state();
                })?;
                return Ok(Pass {
                    outcome,
                    before_rest: last.end_forces(&cable)?,
                    energy: None,
                    pushed: Some(last),
                });
            }
            Solver::Explicit(solver, ducts) => solver.pass(&ducts[drive], &mut self.state)?,
        };
        Ok(Pass {
            outcome: transient.pass,
            before_rest: transient.force_before_rest,
            energy: Some(transient.energy),
            pushed: None,
        })
    }

    /// Largest friction as a share of its limit, infinite for NaN.
    pub fn utilisation(&self, problem: &Problem) -> f64 {
        let largest = self.state.friction().iter().fold(0.0, |worst: f64, f| {
            if f.is_nan() {
                f64::INFINITY
            } else {
                worst.max(f.abs())
            }
        });
        largest / problem.cable.friction().limit()
    }

    /// Several passes of the first vehicle, at least one; what the last one did.
    pub fn passes(&mut self, count: usize) -> Result<Pass, CableError> {
        for _ in 1..count {
            self.pass(0)?;
        }
        self.pass(0)
    }
}
