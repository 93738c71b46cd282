//! A power cable in a duct that moves: friction, ends and clamps, pass after pass.
//!
//! The duct moves with the ground under each vehicle (`ground_field::DuctMotion`), friction drags the cable along, and
//! as the duct's forward motion is long and slow and its backward motion short and fast, the cable gains a little at
//! every pass (K. Kashiro et al., Furukawa Review; Equations (2) and (3) there). In equilibrium
//!
//! EA u″ + f + p = 0,  |f| ≤ q = μ_d N′,
//!
//! with u the cable's displacement, EA its axial stiffness, p the part of its weight along a duct that slopes
//! ([`DuctedCable::with_body_force`]) and f the friction per metre, which follows the slip between
//! duct and cable by a [`FrictionLaw`]. [`QuasiStatic`] leaves inertia out: the cable's wave speed √(EA/m′), near 850 m/s, is
//! far above any vehicle's, and [`inertia_ratio`] bounds what that costs. [`Explicit`] integrates masses, springs and friction by
//! central differences as Kashiro et al. do, with inertia; it also takes the `sigmoid` law, which has no state of rest.
//!
//! Before and after a pass the ground is at rest; what remains is the friction locked between cable and duct.
//!
//! SI units throughout; forces in the cable are positive in compression.
//!
//! ```
//! use cable_dem::{DuctedCable, End, Friction, FrictionLaw, Mesh, Passage, QuasiStatic};
//! use ground_field::Direction;
//!
//! // A bump of 15 µm that pushes the duct away from the vehicle on both sides, as ground does under a wheel.
//! let shape = |xi: f64| 40e-6 * xi / (1.0 + xi * xi).powf(1.5);
//!
//! let friction = Friction::new(FrictionLaw::Coulomb, 0.25 * 108.8)?;
//! let cable = DuctedCable::new(30.0, 8.01e6, friction)?.with_ends(End::Free, End::Fixed)?;
//! let mesh = Mesh::new(30.0, 0.1, 0.05)?;
//! let passage = Passage::from_shape(&cable, &mesh, Direction::Forward, shape, 15.0)?;
//!
//! let mut solver = QuasiStatic::new(cable, mesh)?;
//! let mut state = solver.at_rest();
//! let first = solver.pass(&passage, &mut state)?.force.downstream;
//! let second = solver.pass(&passage, &mut state)?.force.downstream;
//! assert!(first > 50.0 && second > 1.3 * first);
//! # Ok::<(), cable_dem::CableError>(())
//! ```

mod approach;
mod cable;
mod course;
mod ends;
mod error;
mod explicit;
mod friction;
mod inertia;
mod laid;
mod lumped;
mod mesh;
mod outcome;
mod quasi_static;
mod resting;
mod solver;
mod state;
mod step;
mod traffic;
mod view;

pub use approach::approach;
pub use cable::{DuctedCable, End, Restraint};
pub use ends::EndForces;
pub use error::CableError;
pub use explicit::{
    EnergyBalance, Explicit, ExplicitOptions, ExplicitOutcome, MovingDuct, SigmoidLeak, StepLimit, StepLimits,
};
pub use friction::{Friction, FrictionLaw};
pub use inertia::inertia_ratio;
pub use laid::laid;
pub use mesh::Mesh;
pub use outcome::{PassOutcome, Statistics};
pub use quasi_static::{Passage, QuasiStatic};
pub use resting::RestingCable;
pub use solver::{Solver, SolverPassage};
pub use state::CableState;
pub use traffic::{Order, Traffic};
pub use view::{SlipLengths, StepView};

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct ReadmeExamples;
