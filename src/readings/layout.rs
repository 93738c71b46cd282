//! What the columns of a table hold, and their units.

use super::error::DataError;
use super::grid::Row;
use super::header::{factor, strain_factor};
use super::options::ReadOptions;
use super::reading::Measured;
use crate::scene::Dimension;
use crate::shown::shortened;

/// Longest text of a cell that a message repeats \[characters\].
pub const LONGEST_CELL: usize = 80;

/// A column of values.
#[derive(Debug, Clone, PartialEq)]
pub struct Values {
    pub place: usize,
    pub name: String,
    pub measured: Measured,
    /// SI value of 1.
    pub factor: f64,
    /// Whether header or options name the unit.
    pub has_unit: bool,
    pub sigma: Option<(usize, f64)>,
}

/// The columns of a table.
#[derive(Debug, Clone, PartialEq)]
pub struct Columns {
    pub pass: Option<usize>,
    pub vehicles: Option<usize>,
    /// Whether the column of vehicles was named by the caller.
    pub sure_of_vehicles: bool,
    pub run: Option<usize>,
    pub time: Option<usize>,
    pub position: Option<usize>,
    pub values: Vec<Values>,
    /// Cells of a row.
    pub width: usize,
    /// Rows before the first reading.
    pub skip: usize,
    /// Whether a header names them.
    pub named: bool,
}

/// SI value of the unit that the caller names.
pub fn option_factor(file: &str, line: u64, options: &ReadOptions) -> Result<Option<f64>, DataError> {
    let Some(unit) = &options.unit else {
        return Ok(None);
    };
    match factor(Dimension::Force, unit) {
        Some(factor) => Ok(Some(factor)),
        None => Err(unknown_unit(file, line, "--unit", unit)),
    }
}

pub fn unknown_unit(file: &str, line: u64, of: &str, unit: &str) -> DataError {
    DataError::Line {
        file: file.to_owned(),
        line,
        found: format!("{of}: the unit `{}`", shortened(unit, LONGEST_CELL)),
        allowed: "N, kN, daN, kgf, lbf and so on for forces, m, mm, um for movements; --unit names that of the forces".into(),
    }
}

/// Takes the units from a row below the names, if that is what it is.
pub fn take_units(columns: &mut Columns, row: &Row) -> bool {
    let bare = |cell: &str| cell.trim_matches(|c| "[]()".contains(c)).trim().to_owned();
    let unit_of = |value: &Values| unit_factor(value.measured, &bare(row.cell(value.place)));
    let factors: Vec<Option<f64>> = columns.values.iter().map(unit_of).collect();
    let is_row = !row
        .cells
        .iter()
        .any(|cell| cell.starts_with(|c: char| c.is_ascii_digit()))
        && columns
            .values
            .iter()
            .zip(&factors)
            .all(|(value, factor)| factor.is_some() && !row.cell(value.place).is_empty());
    if is_row {
        for (value, factor) in columns.values.iter_mut().zip(factors) {
            if !value.has_unit {
                value.factor = factor.unwrap_or(1.0);
                value.sigma = value.sigma.map(|(place, _)| (place, value.factor));
                value.has_unit = true;
            }
        }
    }
    is_row
}

pub fn unit_factor(measured: Measured, unit: &str) -> Option<f64> {
    match measured {
        Measured::Force(_) => factor(Dimension::Force, unit),
        Measured::Strain(_) => strain_factor(unit),
        Measured::Movement(_) | Measured::Deflection => factor(Dimension::Length, unit),
    }
}
