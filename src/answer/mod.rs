//! What a run gives, whether it can be true, and how wrong it may be.

pub mod balance;
pub mod error_estimate;
mod listed;
mod record;
mod saturation;
#[cfg(any(feature = "cli", feature = "plot"))]
mod table_rows;

pub use listed::{beyond, listed, simulated};
pub use record::*;
pub use saturation::{larger, saturation};
#[cfg(any(feature = "cli", feature = "plot"))]
pub use table_rows::table_rows;
