//! What a run gives, whether it can be true, and how wrong it may be.

pub mod balance;
pub mod error_estimate;
mod listed;
mod record;
mod saturation;
#[cfg(any(feature = "cli", feature = "plot"))]
mod table_rows;

pub use listed::{listed, simulated};
pub use record::*;
pub use saturation::{LEVEL, borne_out, force_series, larger, saturation};
#[cfg(any(feature = "cli", feature = "plot"))]
pub use table_rows::table_rows;
