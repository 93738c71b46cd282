//! What a run gives, whether it can be true, and how wrong it may be.

pub mod balance;
pub mod error;
mod listed;
mod record;
mod saturation;

pub use listed::{listed, selected};
pub use record::*;
pub use saturation::{force_series, saturation};
