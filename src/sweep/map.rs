//! Occurrence map: force or movement over two varied keys.

use super::axis::Axis;
use super::error::SweepError;
use super::grid::Sweep;
use super::numbers::si;
use super::point::{Answer, Row};
use crate::figure::{self, Chart};
use crate::scene::si_unit;

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

impl Sweep {
    /// The map of these `rows` over the two keys, the first along x. A point without an answer
    /// stays white.
    ///
    /// # Errors
    ///
    /// [`SweepError::Unfit`] unless two keys are varied, by lists of at most 500 values.
    pub fn map(&self, rows: &[Row], value: MapValue) -> Result<Chart, SweepError> {
        let [x, y] = &self.axes[..] else {
            return Err(self.no_map());
        };
        let (columns, lines) = (x.values.len(), y.values.len());
        if columns.max(lines) > MOST_CELLS || self.samples.count > 0 {
            return Err(self.no_map());
        }
        let larger = |a: f64, b: f64| f64::max(a.abs(), b.abs());
        let mut cells = vec![None; columns * lines];
        for Row { index, outcome } in rows {
            let of = |answer: &Answer| match value {
                MapValue::Force => larger(answer.upstream_force_n, answer.downstream_force_n),
                MapValue::Movement => {
                    1e3 * larger(answer.upstream_displacement_m, answer.downstream_displacement_m)
                }
            };
            cells[index % lines * columns + index / lines] = outcome.as_ref().ok().map(of);
        }
        let (title, label) = match value {
            MapValue::Force => ("Largest force on an end", "force, N"),
            MapValue::Movement => ("Largest movement of an end", "movement, mm"),
        };
        let scale = figure::Axis::linear(label);
        Ok(Chart::of_values(title, along(x), along(y), scale, cells))
    }

    fn no_map(&self) -> SweepError {
        SweepError::Unfit {
            found: format!("--map with {} varied keys", self.axes.len()),
            allowed: "a map of two keys, each with a list or range of at most 500 values",
        }
    }
}

/// Ascending numbers have places, everything else names.
fn along(axis: &Axis) -> figure::Axis {
    let numbers: Option<Vec<f64>> = axis.values.iter().map(|value| si(value)).collect();
    match numbers.filter(|numbers| numbers.is_sorted_by(|a, b| a < b)) {
        Some(numbers) => {
            let unit = si_unit(&axis.key).map_or_else(String::new, |unit| format!(", {unit}"));
            figure::Axis::linear(format!("{}{unit}", axis.key)).cells(numbers)
        }
        None => figure::Axis::names(&axis.key, &axis.values),
    }
}
