#![doc = include_str!("../README.md")]

mod approach;
mod cable;
mod carried;
mod chain;
mod clamps;
mod course;
mod ends;
mod error;
mod explicit;
mod extremes;
mod fixed_end_friction;
mod friction;
mod inertia;
mod laid;
mod mesh;
mod outcome;
mod quasi_static;
mod resting;
mod section;
mod state;
mod statistics;
mod traffic;
mod tuning;

pub use approach::approach;
pub use cable::{DuctedCable, End, Restraint};
pub use carried::carried;
pub use clamps::ClampState;
pub use ends::EndForces;
pub use error::CableError;
pub use explicit::{
    EnergyBalance, Explicit, ExplicitOptions, ExplicitOutcome, MovingDuct, SigmoidLeak, StepLimits,
};
pub use friction::{Friction, FrictionLaw};
pub use friction_chain;
pub use inertia::inertia_ratio;
pub use laid::laid;
pub use mesh::Mesh;
pub use outcome::PassOutcome;
pub use quasi_static::{Passage, QuasiStatic};
pub use resting::RestingCable;
pub use section::Section;
pub use state::{CableState, SlipLengths};
pub use statistics::Statistics;
pub use traffic::{Order, Traffic};
