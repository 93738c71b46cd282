//! Any number of vehicles over a cable in a duct: few simulated passes, and implicit jumps between them.
//!
//! *Problem.* A cable advances a little at every pass, ever more slowly, until the friction that stays locked in cancels the
//! advance. That takes up to thousands of passes, and roads see millions. *Way.* Traffic repeats after a period of a few vehicles. Between two passes friction
//! balances the chain of springs, w f = K u, so the displacements u after whole periods are all that has to be followed. A
//! simulated period from u_a to u_b measures the advance v = u_b − u_a at ū = (u_a + u_b)/2, and two of them the slope g = −∂v/∂f at
//! every node. Over many periods the cable then follows
//!
//! y′ = c + J y,  y(0) = 0,  J = −g K/w,  c = (I + ½ g K/w)⁻¹ v,
//!
//! which is stiff and is integrated by an L-stable method (SDIRK2; R. Alexander, SIAM J. Numer. Anal. 14 (1977) 1006). After every
//! jump friction is brought back within its limit, and one period is simulated. Its advance differs from what the slope had said
//! by a defect. The slope is learned once more, now between both ends of the jump; the flow is computed with it, and with what it still
//! leaves of the defect as a source that grows evenly. What the jump has missed, e, is the difference of the two flows, smoothed over one
//! period more. The cable is moved by it; another simulated period heals what that left rough and is the next measurement.
//! The force and the movement in e decide whether the jump stands and how long the next one is. Ends, springs and clamps are in
//! K, and the slope is learned where they act, so they need no rule of their own.
//!
//! *Limits.* Friction with memory, which has a state of rest. The same traffic, ground and friction throughout. An error within
//! [`Jumps::tolerance`] is aimed at, not proved: forces between the first simulated periods and about the sixtieth pass are the least
//! accurate, so compare two runs of different tolerance and [`Jumps::first_jump`]. Near shakedown the state of rest depends on the path, and
//! what a jump overshoots is not forgotten.
//!
//! [`evolve`] knows no vehicles and no solver: the caller simulates a pass, whichever way.
//!
//! ```
//! use cable_dem::{DuctedCable, End, Friction, FrictionLaw, Mesh, Passage, QuasiStatic};
//! use cycle_jump::{Guide, JumpError, Jumps, Next, Request, evolve};
//! use ground_field::Direction;
//!
//! // The duct moves by 15 µm away from the vehicle on both sides, as ground does under a wheel.
//! let shape = |xi: f64| 40e-6 * xi / (1.0 + xi * xi).powf(1.5);
//! let limit = 0.25 * 108.8;
//! let law = FrictionLaw::ElasticPlastic { shape_factor: 2e8 / limit };
//! let cable = DuctedCable::new(20.0, 8.01e6, Friction::new(law, limit)?)?.with_ends(End::Free, End::Fixed)?;
//! let mesh = Mesh::for_depth(20.0, 1.2, 6.0)?;
//! let passage = Passage::from_shape(&cable, &mesh, Direction::Forward, shape, 15.0)?;
//! let mut solver = QuasiStatic::new(cable.clone(), mesh)?;
//!
//! let jumps = Jumps {
//!     tolerance: 5e-3,
//!     first_periods: 8,
//!     first_jump: 0.25,
//!     length_scale: 1.2,
//!     motion: 15.4e-6,
//!     least: (0.01 * limit, 1.5e-6),
//!     most_passes: (150, 1000),
//! };
//! let request = Request {
//!     passes: 1_000_000,
//!     order: &[0],
//!     one_by_one: (0, 0),
//!     wanted: &[10, 40, 1_000_000],
//!     looked_at: &[],
//!     beyond: &[],
//!     guide: Guide::Free,
//! };
//! let one_pass = |_: Next, state: &mut _| solver.pass(&passage, state).map_err(JumpError::from);
//! let evolution = evolve(&cable, &mesh, &jumps, &request, one_pass)?;
//! assert!(evolution.simulated < 100);
//!
//! // The simulation of every pass.
//! let mut solver = QuasiStatic::new(cable, mesh)?;
//! let mut state = solver.at_rest();
//! let mut forces = Vec::new();
//! for _ in 0..1000 {
//!     forces.push(solver.pass(&passage, &mut state)?.force.downstream);
//! }
//! // After a thousand passes nothing changes any more.
//! for (record, right) in evolution.records.iter().zip([forces[9], forces[39], forces[999]]) {
//!     let force = record.outcome.force.downstream;
//!     assert!((force / right - 1.0).abs() < 5e-3, "pass {}: {force} N, {right} N", record.pass);
//! }
//! # Ok::<(), JumpError>(())
//! ```

pub mod days;
mod drive;
mod error;
mod flow;
mod jumped;
mod knowledge;
mod peaks;
mod period;
mod record;
mod request;
mod scale;
mod slope;
mod stretches;
mod walk;

pub use error::JumpError;
pub use peaks::peaks;
pub use record::{Beyond, Evolution, Record};
pub use request::{Guide, Jumps, Next, Request};
pub use walk::evolve;

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct ReadmeExamples;
