//! What the reader is told of a file of readings; the rest it recognises.

use creepage_tables::Options;

use crate::scene::words;

/// How to read a table of readings. What is `None` or empty is recognised.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct ReadOptions {
    /// How the file is written.
    pub table: Options,
    /// Columns by their names in the header.
    pub columns: ColumnNames,
    /// Unit of the forces, such as `kN`, whatever the header says.
    pub unit: Option<String>,
    /// How a further run begins.
    pub run_start: Option<RunStart>,
    /// Whether the cell counts tension as positive.
    pub tension_positive: bool,
}

/// Names of columns. A force or a movement may say its end: `upstream=NAME`.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct ColumnNames {
    /// Number of the pass.
    pub pass: Option<String>,
    /// Vehicles counted since the row before.
    pub vehicles: Option<String>,
    /// Forces, one a load cell.
    pub force: Vec<String>,
    /// Name of the run.
    pub run: Option<String>,
    /// Movements of the cable, one a transducer.
    pub movement: Vec<String>,
    /// Where along the duct the row was measured.
    pub position: Option<String>,
}

/// How a further run begins.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RunStart {
    /// With a cable at rest that no vehicle has passed.
    Rest,
    /// As the run before left the cable.
    Continue,
}

words!(RunStart: Rest "rest", Continue "continue");
