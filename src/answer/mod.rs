//! What a run gives, whether it can be true, and how wrong it may be.

pub mod balance;
pub mod error_estimate;
mod listed;
mod record;
mod saturation;
#[cfg(any(feature = "cli", feature = "plot"))]
mod selected;

pub use listed::listed;
pub use record::*;
pub use saturation::{force_series, saturation};
#[cfg(any(feature = "cli", feature = "plot"))]
pub use selected::selected;
