//! Axisymmetric finite elements of layered ground under a wheel.
//!
//! [`LayeredFem`] is the model: bonded elastic layers, a Young's modulus that varies linearly with depth within a layer, a half-space or
//! rock below. Its equations, error estimate and limits stand there.

mod cholesky;
mod element;
mod error;
mod front;
mod grading;
mod level;
mod line;
mod load;
mod material;
mod mesh;
mod model;
mod options;
mod system;

pub use error::FemError;
pub use model::LayeredFem;
pub use options::{ErrorEstimate, FemOptions, FemStatistics};

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
