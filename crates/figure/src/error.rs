//! What can be wrong with a figure.

/// Error of a figure.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FigureError {
    /// There is nothing to draw in this chart, series or axis.
    #[error("{0} has no data")]
    Empty(String),
    /// A number is NaN or infinite.
    #[error("{what}: {value} at index {index} is not a finite number")]
    NotFinite {
        /// The series, axis or cells.
        what: String,
        /// Index in its data, from 0.
        index: usize,
        /// The number.
        value: f64,
    },
    /// A logarithmic axis got zero or less.
    #[error("{what}: a logarithmic axis takes numbers above 0, not {value}")]
    NotPositive {
        /// The series, axis or cells.
        what: String,
        /// The number.
        value: f64,
    },
    /// An axis does not run from a smaller to a larger number.
    #[error("axis {axis}: range {from} to {to} is invalid: start must be below end")]
    BadRange {
        /// Label of the axis.
        axis: String,
        /// Its start.
        from: f64,
        /// Its end.
        to: f64,
    },
    /// The cells do not fill their grid.
    #[error("chart {chart}: {found} cells do not fill {columns} columns and {rows} rows")]
    CellCount {
        /// Title of the chart.
        chart: String,
        /// Cells given.
        found: usize,
        /// Cells along the x axis.
        columns: usize,
        /// Cells along the y axis.
        rows: usize,
    },
    /// A cell names a class that does not exist.
    #[error("chart {chart}: cell {index} is of class {class}, and there are {classes}")]
    UnknownClass {
        /// Title of the chart.
        chart: String,
        /// Index of the cell, row by row.
        index: usize,
        /// The class it names, from 0.
        class: usize,
        /// Number of classes.
        classes: usize,
    },
    /// The centres of rows or columns of cells do not ascend.
    #[error("axis {axis}: centres of cells must ascend, found {next} after {previous}")]
    NotAscending {
        /// Label of the axis.
        axis: String,
        /// A centre.
        previous: f64,
        /// The one that follows.
        next: f64,
    },
    /// A text would be cut off or cover another.
    #[error("no room for \"{text}\": about {needed:.0} px needed, {room:.0} px there")]
    NoRoom {
        /// The text.
        text: String,
        /// Its estimated width \[px\].
        needed: f64,
        /// The room for it \[px\].
        room: f64,
    },
}

impl FigureError {
    pub(crate) fn empty(kind: &str, name: &str) -> Self {
        Self::Empty(format!("{kind} \"{name}\""))
    }
}
