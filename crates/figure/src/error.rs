//! What can be wrong with a figure.

/// Error of a figure.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FigureError {
    /// There is nothing to draw in this chart, series or axis.
    #[error("{0} has no data")]
    Empty(String),
    /// A number has no place on its axis: it is NaN or infinite, or, where the axis is logarithmic, not above 0.
    #[error("{what}: {value} at index {index} is not finite, or not above 0 on a logarithmic axis")]
    NoPlace {
        /// The series, axis or cells.
        what: String,
        /// Index in its data, from 0.
        index: usize,
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
    /// The cells of the chart of this title do not fill their grid, or are of a class that does not exist.
    #[error("chart {0}: cells must fill their grid, each with the index of a class")]
    BadCells(String),
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
