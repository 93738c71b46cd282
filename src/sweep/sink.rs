//! What takes the rows of a table.

use std::io;

use crate::output::Draft;

/// A column and what it holds.
pub struct Column {
    pub name: String,
    pub kind: Kind,
}

/// What a column holds; a value may be absent.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    Number,
    Count,
    Text,
}

/// One value of a row.
pub enum Cell<'a> {
    Number(Option<f64>),
    Count(Option<u64>),
    Text(Option<&'a str>),
}

/// Takes rows one after the other.
pub trait Sink {
    fn row(&mut self, cells: &[Cell]) -> io::Result<()>;
    /// Everything that was written, on its way to its place.
    fn finish(self: Box<Self>) -> io::Result<Draft>;
}
