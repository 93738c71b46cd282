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
    /// The ends of an axis, or the centres of its rows or columns of cells, do not ascend, or by more than a number can hold.
    #[error("axis {axis}: {from} to {to} is invalid: ends and centres of cells must ascend")]
    BadRange {
        /// Label of the axis.
        axis: String,
        /// Its start, or a centre.
        from: f64,
        /// Its end, or the centre that follows.
        to: f64,
    },
    /// The cells do not fill their grid.
    #[error("chart {chart}: {found} cells do not fill a grid of {grid}")]
    CellCount {
        /// Title of the chart.
        chart: String,
        /// Cells given.
        found: usize,
        /// Cells of the grid.
        grid: usize,
    },
    /// A cell names a class that does not exist.
    #[error("chart {chart}: cell {index} is of class {class}, which does not exist")]
    UnknownClass {
        /// Title of the chart.
        chart: String,
        /// Index of the cell, row by row.
        index: usize,
        /// The class it names, from 0.
        class: usize,
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
