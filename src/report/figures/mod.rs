//! The report's figures: narrow ones, so that their text is still read on a phone.

mod duct;
mod force;
mod measures;

pub use duct::{Areas, areas, friction, motion, velocity};
pub use force::{along, force, movement};
pub use measures::measures;

use crate::PassRecord;
use crate::figure::{Axis, Chart, Panels};

/// Width of a figure and height of a panel \[px\].
const WIDTH: f64 = 440.0;
const HEIGHT: f64 = 330.0;
/// Height where two are stacked.
const LOW: f64 = 250.0;
/// Passes from which their axis is logarithmic.
const MANY: u64 = 2000;
/// Passes that are all drawn, and by what share the next ones are later than the one before.
const ALL_DRAWN: u64 = 1000;
const GROWTH: f64 = 1.01;

/// One chart.
fn single(chart: Chart) -> Panels {
    Panels::new("").panel_size(WIDTH, HEIGHT).with(chart)
}

/// Charts below each other.
fn stacked(charts: impl IntoIterator<Item = Chart>) -> Panels {
    charts
        .into_iter()
        .fold(Panels::new("").panel_size(WIDTH, LOW), Panels::with)
}

/// The axis of the passes.
fn passes_axis(last: u64) -> Axis {
    if last > MANY {
        Axis::logarithmic("passes")
    } else {
        Axis::linear("passes")
    }
}

/// A value of each pass; of very many, all of the first and then ever fewer.
fn series(passes: &[PassRecord], value: impl Fn(&PassRecord) -> f64) -> Vec<(f64, f64)> {
    let mut next = 0.0;
    let mut points = Vec::new();
    for (index, record) in passes.iter().enumerate() {
        let pass = record.pass as f64;
        if record.pass <= ALL_DRAWN || pass >= next || index + 1 == passes.len() {
            points.push((pass, value(record)));
            next = GROWTH * pass;
        }
    }
    points
}
