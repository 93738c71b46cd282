//! Readings of load cells and other instruments, from the tables that they write.
//!
//! [`creepage_tables`] reads text and workbooks. The first row that names a pass, or vehicles
//! counted since the row before, and something measured is the header; names are words of several
//! languages: `pass,force_n[,sigma_n]`, `Überfahrt;Kraft [kN]`. Where the first row holds numbers
//! instead, the columns are pass, force in newtons and standard deviation. Lines that begin with
//! `#` and blank lines are skipped, as are cells without a value: a reading that failed. The same
//! pass may be read more than once, and rows may come in any order.
//!
//! A column of runs, or passes that begin anew, make several series of one file: see [`RunStart`].

mod columns;
mod kinds;
mod list;
mod options;
mod reading;
mod rows;
mod runs;
mod time;

pub use creepage_tables::{Options as TableOptions, TableError as DataError};
pub use list::Readings;
pub use options::{ReadOptions, RunStart};
pub use reading::{Measured, Place, Reading};
