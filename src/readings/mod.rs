//! Readings of load cells and other instruments, from the tables that they write.
//!
//! *Text.* A byte order mark, UTF-8, UTF-16 or Latin-1; commas, semicolons, tabs, bars or spaces between cells; a decimal point or comma,
//! thousands apart. All are recognised, or chosen by [`ReadOptions`]. Excel workbooks (.xlsx) are read as well: their first sheet.
//!
//! *Columns.* The first row that names a pass, or vehicles counted since the row before, and something measured is the header. Names are
//! words of several languages, with units: `pass,force_n[,sigma_n]`, `Überfahrt;Kraft [kN]`. Where the first row holds numbers instead, the
//! columns are pass, force in newtons and standard deviation. Lines that begin with `#` and blank lines are skipped, as are rows without a
//! value: a reading that failed. The same pass may be read more than once, and rows may come in any order.
//!
//! *Runs.* A column of runs, or passes that begin anew, make several series of one file: see [`RunStart`].

mod columns;
mod error;
mod grid;
mod header;
mod layout;
mod list;
mod number;
mod options;
mod reading;
mod runs;
mod table;
mod text;
mod time;
mod workbook;

pub use error::DataError;
pub use list::Readings;
pub use options::{ColumnNames, Decimal, Encoding, ReadOptions, RunStart, Separator};
pub use reading::{Measured, Place, Reading};
