//! The one implicit step: a stretch of the cable follows its duct by a small increment.
//!
//! The quasi-static solver takes it in windows under the vehicle and around supports,
//! `RestingCable` for the whole cable. [`problem`] states the equations: a chain of springs,
//! friction bounds that the motion of the duct has shifted, and for each node whether it sticks or
//! slips. [`solver`] guesses these contact states, solves the linear system and corrects them. If
//! that has not ended after a few solves, it counts as cycling, and [`bisection`] of the chain
//! finds the contact states without a guess, from the [`response`]s of its parts.

mod bisection;
mod fixed_end_friction;
mod grip;
mod problem;
mod response;
mod solver;
mod tolerance;

pub(crate) use fixed_end_friction::FixedEndFriction;
pub(crate) use grip::Grip;
pub(crate) use problem::{Chain, Contact, Load, Stretch, Trial};
pub(crate) use solver::StepSolver;
pub(crate) use tolerance::{check_precision, largest};

#[cfg(test)]
mod oracle;
