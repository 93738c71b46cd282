//! What a run gives, whether it can be true, and how wrong it may be.

mod along_cable;
pub mod balance;
mod calendar;
pub mod differences;
pub mod error_estimate;
mod fixed_mesh;
mod heat;
mod limits;
mod listed;
mod place;
mod record;
mod saturation;
mod table_rows;
mod units;

pub use along_cable::*;
pub use calendar::after;
pub use differences::{larger, record_of};
pub use error_estimate::{ErrorEstimate, ErrorShares};
pub use fixed_mesh::{FixedMesh, JumpSize};
pub use heat::{DayExtremes, DayPoint, HeatRecord, RestraintRange};
pub use limits::*;
pub use listed::{listed, listed_passes, passes_beyond};
pub use place::{Limited, Place, largest_movement_in_duct};
pub use record::*;
pub use saturation::saturation;
pub use table_rows::{in_rows, table_days, table_rows};
pub use units::{Units, in_unit, si_of_field};
