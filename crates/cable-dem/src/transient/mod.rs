//! What the solvers with inertia share: the duct's motion in time, masses and supports, energy, the steps from rest and to it.

mod energy;
mod inertia;
mod leak;
mod lumped;
mod moving_duct;
mod outcome;
mod rest;
mod sigmoid;
mod step;

pub use energy::EnergyBalance;
pub use inertia::inertia_ratio;
pub use leak::SigmoidLeak;
pub use moving_duct::MovingDuct;
pub use outcome::TransientOutcome;

pub(crate) use lumped::Lumped;
pub(crate) use outcome::Departed;
pub(crate) use rest::Settler;
pub(crate) use sigmoid::SigmoidSolver;
pub(crate) use step::{StepSolver, tolerance};
