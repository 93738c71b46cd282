//! What fills the cells of a chart: classes or values.

use crate::axis::Axis;
use crate::error::FigureError;

/// A class or a value for each cell, row by row from the lowest, each row along x.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Cells {
    /// Names of the classes, and the index of each cell's.
    Classes(Vec<String>, Vec<usize>),
    /// Values on the scale of the axis; a cell without value stays white.
    Values(Axis, Vec<Option<f64>>),
}

impl Cells {
    /// Whether they fill the grid of the chart named `chart`, with classes and values that exist.
    pub fn check(&self, chart: &str, columns: usize, rows: usize) -> Result<(), FigureError> {
        let (found, with_data) = match self {
            Self::Classes(_, cells) => (cells.len(), cells.len()),
            Self::Values(_, cells) => (cells.len(), cells.iter().flatten().count()),
        };
        if with_data == 0 {
            return Err(FigureError::empty("chart", chart));
        }
        if found != columns * rows {
            return Err(FigureError::CellCount {
                chart: chart.to_owned(),
                found,
                columns,
                rows,
            });
        }
        match self {
            Self::Values(axis, cells) => axis.check(&axis.label, cells.iter().flatten().copied()),
            Self::Classes(classes, cells) => match cells.iter().position(|class| *class >= classes.len()) {
                None => Ok(()),
                Some(index) => Err(FigureError::UnknownClass {
                    chart: chart.to_owned(),
                    index,
                    class: cells[index],
                    classes: classes.len(),
                }),
            },
        }
    }
}
