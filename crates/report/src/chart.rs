//! What the charts of the page have in common: narrow, so that their text is still legible on a phone; both ends in all of them, each with a
//! look of its own.

use super::content::Report;
use super::html::Html;
use crate::words::{round_below, significant};
use creepage_run::{ForceProfile, Limited};
use creepage_scene::{CableEnd, End, Scene};
use plain_figure::{Axis, Chart, Panels, Series};

/// Width of a figure, and height of a chart alone, of one of several, and of one of several with legends \[px\].
pub const WIDTH: f64 = 440.0;
pub const ALONE: f64 = 330.0;
pub const STACKED: f64 = 250.0;
pub const WITH_LEGENDS: f64 = 300.0;
/// Look of what is neither of the ends.
pub const OTHER: usize = 2;
/// Metres to millimetres, and to micrometres, in which the duct moves.
pub const MILLI: f64 = 1e3;
pub const MICRO: f64 = 1e6;

/// Shortest part next to an end of the duct, relative to the others.
const MIN_PART: f64 = 0.7;

/// Writes charts of this height below each other with a caption, or why they could not be drawn.
pub fn figure(html: &mut Html, height: f64, charts: impl IntoIterator<Item = Chart>, caption: &str) {
    let panels = Panels::new("").panel_size(WIDTH, height);
    match charts.into_iter().fold(panels, Panels::with).to_svg() {
        Ok(svg) => html.figure(&svg, caption),
        Err(error) => html.paragraph(&format!("A figure could not be drawn: {error}. {caption}")),
    }
}

/// Places along a duct of this length in any unit with their labels, in round parts; the last one is its end.
pub fn ticks(length: f64) -> Vec<(f64, String)> {
    let part = round_below(length / 3.0);
    let places = (0..).map(|k| part * f64::from(k));
    let places = places.take_while(|place| *place <= length - MIN_PART * part);
    let labelled = |place| (place, significant(place));
    places.chain([length]).map(labelled).collect()
}

/// The axis along the duct.
pub fn along_duct(report: &Report) -> Axis {
    let length = report.reader.units.length.of_si(report.scene.duct.length);
    Axis::linear(report.reader.in_length("place along the duct"))
        .range(0.0, length)
        .ticks(ticks(length))
}

/// The ends that are not free: a free one carries nothing.
pub fn held(scene: &Scene) -> Vec<CableEnd> {
    let all = CableEnd::ALL.into_iter();
    all.filter(|end| end.held_in(scene) != End::Free).collect()
}

/// `chart` with a line for each of `ends`; its name has `more` behind that of the end.
pub fn lines<Points: IntoIterator<Item = (f64, f64)>>(
    chart: Chart,
    ends: &[CableEnd],
    more: Option<&str>,
    points: impl Fn(CableEnd) -> Points,
) -> Chart {
    ends.iter().fold(chart, |chart, end| {
        let name = more.map_or_else(String::new, |more| format!("{} end{more}", end.name()));
        chart.with(Series::line(name, points(*end)).look(end.of([1, 0])))
    })
}

/// The axis of force or movement.
pub fn axis(report: &Report, quantity: Limited) -> Axis {
    let name = quantity.of(["force", "movement"]);
    Axis::linear(report.reader.head(name, quantity))
}

/// A chart of force or movement over `x`, without lines yet.
pub fn over(report: &Report, title: &str, x: Axis, quantity: Limited) -> Chart {
    Chart::new(title, x, axis(report, quantity))
}

/// Forces along the cable with their names.
pub fn along_cable<'p>(
    report: &Report,
    title: &str,
    profiles: impl IntoIterator<Item = (String, &'p ForceProfile)>,
) -> Chart {
    let (length, force) = (report.reader.units.length, report.reader.units.force);
    let chart = over(report, title, along_duct(report), Limited::Force);
    profiles.into_iter().fold(chart, |chart, (name, profile)| {
        let points = profile.positions_m.iter().zip(&profile.force_n);
        let points = points.map(|(x, newtons)| (length.of_si(*x), force.of_si(*newtons)));
        chart.with(Series::line(name, points))
    })
}
