//! What takes the rows of a table.

use std::io;

use crate::output::Draft;
use crate::scene::Unit;

/// A column and what it holds.
#[cfg_attr(not(feature = "xlsx"), allow(dead_code, reason = "CSV shows no units"))]
pub struct Column {
    pub name: String,
    pub kind: Kind,
    /// The SI unit of its numbers.
    pub unit: Option<&'static str>,
    /// Name and unit for a reader, where they differ.
    pub shown: Option<(String, Unit)>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    Number,
    Count,
    Text,
}

/// One value of a row, in a column of its kind.
pub enum Cell {
    Absent,
    Number(f64),
    Count(u64),
    Text(String),
}

pub trait Sink {
    fn row(&mut self, cells: Vec<Cell>) -> io::Result<()>;
    /// Everything that was written, on its way to its place.
    fn finish(self: Box<Self>) -> io::Result<Draft>;
}
