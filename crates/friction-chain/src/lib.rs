#![doc = include_str!("../README.md")]

mod active_set;
mod bisection;
mod chain;
mod clamp;
mod error;
mod node;
mod problem;
mod response;
mod stretch;
#[cfg(test)]
mod tests;
mod tolerance;
pub mod tridiagonal;
mod tuning;

pub use active_set::{ImplicitStep, Work};
pub use chain::Chain;
pub use clamp::Clamp;
pub use error::ChainError;
pub use node::{Node, rounding};
pub use problem::{Contact, Load, Trial};
pub use stretch::Stretch;
