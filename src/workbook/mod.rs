//! Excel workbooks: what a run answers, for a reader, in units of a reader.
//!
//! A sheet begins with the names of its columns; where they have units, these stand in a second row. Numbers are numbers, texts are texts,
//! never formulas. A workbook holds no date: the same answer is the same file, byte for byte.

mod book;
mod run;

pub(crate) use book::{Book, Cell, scene};
pub use run::of_run;
