//! What the solvers with inertia share: the duct's motion in time, masses and supports, energy, the steps from rest and to it.

mod energy;
mod implicit;
mod inertia;
mod leak;
mod lumped;
mod moving_duct;
mod pass;
mod rest;
mod sigmoid;

pub use energy::EnergyBalance;
pub use inertia::inertia_ratio;
pub use leak::SigmoidLeak;
pub use moving_duct::MovingDuct;
pub use pass::TransientOutcome;

pub(crate) use implicit::Implicit;
pub(crate) use lumped::Lumped;
pub(crate) use pass::pass;
