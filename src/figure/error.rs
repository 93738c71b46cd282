//! What can be wrong with a figure.

/// Error of a figure.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FigureError {
    /// There is nothing to draw.
    #[error("{what} has no data")]
    Empty {
        /// The chart, map or series, by its title or name.
        what: String,
    },
    /// A number is NaN or infinite.
    #[error("{what}: {value} at place {index} is not a finite number")]
    NotFinite {
        /// The series or axis.
        what: String,
        /// Place in its data, from 0.
        index: usize,
        /// The number.
        value: f64,
    },
    /// A logarithmic axis got zero or less.
    #[error("{what}: {value} cannot stand on a logarithmic axis, which takes numbers above 0")]
    NotPositive {
        /// The series or axis.
        what: String,
        /// The number.
        value: f64,
    },
    /// An axis does not run from a smaller to a larger number.
    #[error("axis {axis}: a range from {from} to {to} is none")]
    BadRange {
        /// Label of the axis.
        axis: String,
        /// Its beginning.
        from: f64,
        /// Its end.
        to: f64,
    },
    /// A map's cells do not fill its grid.
    #[error("map {map}: {found} cells do not fill {columns} columns and {rows} rows")]
    CellCount {
        /// Title of the map.
        map: String,
        /// Cells given.
        found: usize,
        /// Values or names on the x axis.
        columns: usize,
        /// Values or names on the y axis.
        rows: usize,
    },
    /// A cell names a class that does not exist.
    #[error("map {map}: cell {index} is of class {class}, and there are {classes}")]
    UnknownClass {
        /// Title of the map.
        map: String,
        /// Place of the cell, row by row.
        index: usize,
        /// The class it names, from 0.
        class: usize,
        /// How many classes there are.
        classes: usize,
    },
    /// The places of a map's rows or columns do not ascend.
    #[error("axis {axis}: places of cells have to ascend, found {next} after {previous}")]
    NotAscending {
        /// Label of the axis.
        axis: String,
        /// A place.
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
    /// The drawing library failed.
    #[error("drawing failed: {0}")]
    Drawing(String),
}
