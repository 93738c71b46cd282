//! Occurrence map: force or movement over two varied keys.

use super::axis::Axis;
use super::columns::{Row, numbers};
use super::error::SweepError;
use super::grid::Sweep;
use super::numbers::si;
use creepage_scene::{si_unit, words};
use plain_figure::{Axis as Scale, Chart};

/// Maximum number of columns and rows of a map: beyond that a cell is smaller than a pixel.
const MAX_CELLS: usize = 500;

/// The quantity shown by a map's colour, after the last pass: force \[N\] or movement \[mm\].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum MapValue {
    /// The larger force on an end.
    Force,
    /// The larger movement of an end.
    Movement,
}

words!(MapValue: Force "force", Movement "movement");

impl Sweep {
    /// The map of its `rows` over the two keys, the first along x. A point without an answer stays
    /// white.
    ///
    /// # Errors
    ///
    /// [`SweepError::Invalid`] unless two keys are varied, by lists of at most 500 values.
    pub fn map(&self, rows: &[Row], value: MapValue) -> Result<Chart, SweepError> {
        let is_small = |axis: &Axis| axis.values.len() <= MAX_CELLS;
        let (x, y) = match &self.axes[..] {
            [x, y] if is_small(x) && is_small(y) && self.samples.count == 0 => (x, y),
            axes => {
                let allowed = "a map of two keys, each with a list or range of at most 500 values";
                let found = format!("--map with {} varied keys", axes.len());
                return Err(SweepError::unfit(found, allowed));
            }
        };
        let (ends, scale, title, label) = match value {
            MapValue::Force => {
                let ends = ["upstream_force_n", "downstream_force_n"];
                (ends, 1.0, "Largest force on an end", "force, N")
            }
            MapValue::Movement => {
                let ends = ["upstream_displacement_m", "downstream_displacement_m"];
                (ends, 1e3, "Largest movement of an end", "movement, mm")
            }
        };
        let columns = self.columns();
        let [upstream, downstream] = ends.map(|end| numbers(end, &columns, rows));
        let (width, height) = (x.values.len(), y.values.len());
        let mut cells = vec![None; width * height];
        for (index, (one, other)) in upstream.into_iter().zip(downstream).enumerate() {
            let larger = one.zip(other).map(|(one, other)| one.abs().max(other.abs()));
            cells[index % height * width + index / height] = larger.map(|value| scale * value);
        }
        let scale = Scale::linear(label);
        Ok(Chart::of_values(title, along(x), along(y), scale, cells))
    }
}

/// Ascending numbers have places, everything else names.
fn along(axis: &Axis) -> Scale {
    let numbers: Option<Vec<f64>> = axis.values.iter().map(|value| si(value)).collect();
    match numbers.filter(|numbers| numbers.is_sorted_by(|a, b| a < b)) {
        Some(numbers) => {
            let unit = si_unit(&axis.key).map_or_else(String::new, |unit| format!(", {unit}"));
            Scale::linear(format!("{}{unit}", axis.key)).cells(numbers)
        }
        None => Scale::names(&axis.key, &axis.values),
    }
}
