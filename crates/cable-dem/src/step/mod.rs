//! The one implicit step: a stretch of the cable follows its duct by a small increment.
//!
//! The quasi-static solver takes it in windows that travel with the vehicle, the explicit one for the steps from rest and to it.
//! [`chain`] states the problem, [`solver`] finds the answer by iteration and, where that cycles, by [`exact`] from the [`response`]s of parts of the chain.

mod chain;
mod exact;
mod fixed_end_friction;
mod prediction;
mod response;
mod solver;
mod support;
mod tolerance;

pub(crate) use chain::{Chain, Load, Stretch, Trial};
pub(crate) use fixed_end_friction::FixedEndFriction;
pub(crate) use prediction::Prediction;
pub(crate) use solver::StepSolver;
pub(crate) use support::Support;
pub(crate) use tolerance::{check_precision, largest};

#[cfg(test)]
mod oracle;
