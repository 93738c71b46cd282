#![doc = include_str!("../README.md")]

#[doc(hidden)]
pub mod cable;
mod cost;
#[doc(hidden)]
pub mod error;
mod error_source;
#[doc(hidden)]
pub mod finite;
#[doc(hidden)]
pub mod ground;
#[doc(hidden)]
pub mod hash;
mod mesh;
mod method;
mod mix;
pub mod occurrence;
mod period;
mod plan;
mod report;
mod representatives;
mod saved_state;
#[doc(hidden)]
pub mod shown;
#[doc(hidden)]
pub mod tuning;
mod warnings;

pub use cost::Estimates;
pub use error::{Error, with_causes};
pub use error_source::ErrorSource;
pub use mesh::Levels;
pub use method::MAX_PASSES;
pub use period::Period;
#[doc(hidden)]
pub use plan::plan_over;
pub use plan::{Plan, plan};
pub use report::{Candidate, Part, PlanReport};
pub use saved_state::{PastPass, SavedState};
