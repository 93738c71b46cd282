#![doc = include_str!("../README.md")]

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
