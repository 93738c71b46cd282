#![doc = include_str!("../README.md")]

mod cholesky;
mod element;
mod error;
mod estimate;
mod front;
mod grading;
mod level;
mod line;
mod load;
mod material;
mod mesh;
mod model;
mod system;

pub use error::FemError;
pub use estimate::ErrorEstimate;
pub use model::LayeredFem;
