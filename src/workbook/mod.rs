//! Excel workbooks: what a run answers, for a reader, in units of a reader.
//!
//! A sheet begins with the names of its columns; where they have units, these stand in a second row. Numbers are numbers, texts are texts,
//! never formulas. A workbook holds no date: the same answer is the same file, byte for byte.

mod book;
#[cfg(feature = "cli")]
mod measures;
mod run;

pub(crate) use book::{Book, Cell, scene};
#[cfg(feature = "cli")]
pub(crate) use measures::of_measures;
pub use run::of_run;
