//! How figures stand on the page: narrow, so that their text is still legible on a phone.

use super::html::Html;
use crate::PassRecord;
use crate::answer::listed;
use crate::figure::{Axis, Chart, Panels};

/// Width of a figure, and height of a chart alone and of one of several \[px\].
const WIDTH: f64 = 440.0;
const ALONE: f64 = 330.0;
const STACKED: f64 = 250.0;
/// Passes beyond which their axis is logarithmic.
const MANY: u64 = 2000;
/// Passes that are all drawn; of more, those that a run with jumps would list.
const ALL_DRAWN: usize = 1000;

/// Metres to millimetres, and to micrometres.
pub const MILLI: f64 = 1e3;
pub const MICRO: f64 = 1e6;

/// Writes charts below each other with a caption, or why they could not be drawn.
pub fn figure(html: &mut Html, charts: impl IntoIterator<Item = Chart>, caption: &str) {
    let charts: Vec<Chart> = charts.into_iter().collect();
    let height = if charts.len() == 1 { ALONE } else { STACKED };
    let panels = Panels::new("").panel_size(WIDTH, height);
    match charts.into_iter().fold(panels, Panels::with).to_svg() {
        Ok(svg) => html.figure(&svg, caption),
        Err(error) => html.paragraph(&format!("A figure could not be drawn: {error}. {caption}")),
    }
}

pub fn passes_axis(last: u64) -> Axis {
    let axis = if last > MANY {
        Axis::logarithmic
    } else {
        Axis::linear
    };
    axis("passes")
}

/// A value after each pass.
pub fn series(passes: &[PassRecord], value: impl Fn(&PassRecord) -> f64) -> Vec<(f64, f64)> {
    let drawn = listed(passes.last().map_or(1, |record| record.pass));
    let is_drawn = |pass: u64| passes.len() <= ALL_DRAWN || drawn.binary_search(&pass).is_ok();
    let drawn = passes.iter().filter(|record| is_drawn(record.pass));
    drawn.map(|record| (record.pass as f64, value(record))).collect()
}
