//! Readings of a load cell from CSV: columns `pass,force_n[,sigma_n]`.
//!
//! The first line that is not a comment names the columns, in any order; where it holds numbers instead, the columns are taken in
//! the order above. Lines that begin with `#` and blank lines are skipped, as are rows without a force: a reading that failed. The
//! same pass may be read more than once, and rows may come in any order. Further columns are ignored.

mod error;
mod list;
mod table;

pub use error::DataError;
pub use list::Readings;
pub use table::Reading;
