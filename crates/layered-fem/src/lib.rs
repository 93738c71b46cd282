//! x
pub mod element;
mod error;
mod grading;
mod half_space;
mod level;
mod line;
mod load;
pub mod material;
pub mod mesh;
mod model;
pub mod system;
pub use error::FemError;
pub use model::*;
