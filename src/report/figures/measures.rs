//! Ways to hold the cable: force against movement.

use crate::design::{Place, TradeOff};
use crate::figure::{Axis, Chart, Panels, Series};
use crate::report::Report;

use super::single;

/// Movements of which the largest is so many times the smallest have a logarithmic axis.
const WIDE: f64 = 50.0;

/// Force against movement of all ways that have an answer; `None` without any.
pub fn measures(report: &Report) -> Option<Panels> {
    let ways = &report.measures.ways;
    let points = |wanted: fn(Place) -> bool| -> Vec<(f64, f64)> {
        ways.iter()
            .filter(|way| wanted(way.measure.place))
            .filter_map(|way| way.answer.as_ref().ok().map(point))
            .collect()
    };
    let springs = points(|place| !matches!(place, Place::Clamp(_)));
    let clamps = points(|place| matches!(place, Place::Clamp(_)));
    let own: Vec<(f64, f64)> = ways
        .iter()
        .filter(|way| way.is_scene)
        .filter_map(|way| way.answer.as_ref().ok().map(point))
        .collect();
    let movements = || springs.iter().chain(&clamps).map(|(movement, _)| *movement);
    let (least, most) = movements().fold((f64::INFINITY, 0.0), |(least, most), movement| {
        (f64::min(least, movement), f64::max(most, movement))
    });
    let wide = least > 0.0 && most > WIDE * least;
    let axis = if wide { Axis::logarithmic } else { Axis::linear };
    let chart = Chart::new(
        "Force against movement",
        axis("largest movement of an end, mm"),
        Axis::linear("largest force on an end, N"),
    );
    let series = [
        (!springs.is_empty()).then(|| Series::line_points("end free … springs … fixed", springs).look(0)),
        (!clamps.is_empty()).then(|| Series::points("with a clamp", clamps).look(1)),
        (!own.is_empty()).then(|| Series::points("the scene’s end", own).look(2).marker(5)),
    ];
    let series: Vec<Series> = series.into_iter().flatten().collect();
    if series.is_empty() {
        return None;
    }
    Some(single(series.into_iter().fold(chart, Chart::with)))
}

fn point(answer: &TradeOff) -> (f64, f64) {
    (1e3 * answer.movement_m, answer.force_n)
}
