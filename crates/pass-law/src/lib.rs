//! Many passes at the cost of one.

mod advance;
mod cell;
mod error;
mod evolution;
mod grid;
mod layer;
mod mix;
mod pass_law;
mod resolution;
mod slow;
mod table;
mod tridiagonal;

pub use advance::{AdvanceLaw, LawStatistics};
pub use error::LawError;
pub use evolution::{Evolution, EvolutionStatistics, PassRecord};
pub use mix::MixedLaw;
pub use pass_law::{PassLaw, Preparation};
pub use resolution::Resolution;
