//! Occurrence map: force or movement over two varied keys.

use std::sync::{Mutex, PoisonError};

use super::axis::AxisValues;
use super::error::SweepError;
use super::grid::Sweep;
use super::numbers::{si, si_unit};
use super::row::Row;
use crate::figure::{Axis, Chart, FigureError};

/// Most columns and rows of a map: beyond that a cell is smaller than a pixel.
const MOST_CELLS: usize = 500;

/// The quantity shown by a map's colour.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "cli", derive(clap::ValueEnum))]
#[non_exhaustive]
pub enum MapValue {
    /// The larger force on an end after the last pass \[N\].
    #[cfg_attr(feature = "cli", value(help = "The larger force on an end"))]
    Force,
    /// The larger displacement of an end after the last pass \[mm\].
    #[cfg_attr(feature = "cli", value(help = "The larger movement of an end"))]
    Movement,
}

/// A map: takes the rows of a sweep, then draws them. A point that failed stays white.
#[derive(Debug)]
pub struct SweepMap<'a> {
    sweep: &'a Sweep,
    value: MapValue,
    cells: Mutex<Vec<Option<f64>>>,
}

impl<'a> SweepMap<'a> {
    /// A map over the two keys of `sweep`, the first along x.
    ///
    /// # Errors
    ///
    /// [`SweepError::Unfit`] unless two keys are varied, by lists of at most 500 values.
    pub fn new(sweep: &'a Sweep, value: MapValue) -> Result<Self, SweepError> {
        let listed = |axis: &super::axis::Axis| matches!(&axis.values, AxisValues::List(list) if list.len() <= MOST_CELLS);
        if sweep.axes.len() != 2 || !sweep.axes.iter().all(listed) {
            return Err(SweepError::Unfit {
                found: format!("--map with {} varied keys", sweep.axes.len()),
                allowed: "a map of two keys, each with a list or range of at most 500 values",
            });
        }
        Ok(Self {
            sweep,
            value,
            cells: Mutex::new(vec![None; sweep.count()]),
        })
    }

    /// Takes a finished point.
    pub fn add(&self, row: &Row) {
        let Ok(answer) = &row.outcome else { return };
        let (columns, rows) = (self.sweep.axes[0].count(), self.sweep.axes[1].count());
        let (column, line) = (row.index / rows, row.index % rows);
        let larger = |a: f64, b: f64| f64::max(a.abs(), b.abs());
        self.cells.lock().unwrap_or_else(PoisonError::into_inner)[line * columns + column] =
            Some(match self.value {
                MapValue::Force => larger(answer.upstream_force_n, answer.downstream_force_n),
                MapValue::Movement => {
                    1e3 * larger(answer.upstream_displacement_m, answer.downstream_displacement_m)
                }
            });
    }

    /// The map as SVG.
    ///
    /// # Errors
    ///
    /// [`FigureError`] where there is nothing to show, or no room for it.
    pub fn to_svg(&self) -> Result<String, FigureError> {
        let (title, label) = match self.value {
            MapValue::Force => ("Largest force on an end", "force, N"),
            MapValue::Movement => ("Largest movement of an end", "movement, mm"),
        };
        let [x, y] = [0, 1].map(|index| grid_axis(&self.sweep.axes[index]));
        Chart::of_values(
            title,
            x,
            y,
            Axis::linear(label),
            self.cells.lock().unwrap_or_else(PoisonError::into_inner).clone(),
        )
        .to_svg()
    }
}

/// Ascending numbers have places, everything else names.
fn grid_axis(axis: &super::axis::Axis) -> Axis {
    let list = match &axis.values {
        AxisValues::List(list) => list.as_slice(),
        AxisValues::Drawn(_) => &[],
    };
    let numbers: Option<Vec<f64>> = list.iter().map(|value| si(value)).collect();
    let unit = list.first().and_then(|value| si_unit(value));
    match numbers.filter(|numbers| numbers.is_sorted_by(|a, b| a < b)) {
        Some(numbers) => {
            let unit = unit.map_or_else(String::new, |unit| format!(", {unit}"));
            Axis::linear(format!("{}{unit}", axis.key)).cells(numbers)
        }
        None => Axis::names(&axis.key, list),
    }
}
