//! The three figures of an answer as SVG, to be kept: force after the passes, force along the cable, movement of the ends.

use serde::Serialize;

use crate::figure::{Axis, Chart, FigureError, Panels, Series};
use crate::words::{Reader, after_pass, over_day};
use crate::{CableEnd, Limited, Run};

/// Size of a figure \[px\].
const SIZE: (f64, f64) = (640.0, 400.0);
/// Passes or days beyond which their axis is logarithmic.
const MANY: f64 = 2000.0;

#[derive(Serialize)]
pub struct Figures {
    force: String,
    movement: String,
    along: String,
}

impl Figures {
    pub fn new(run: &Run, reader: &Reader) -> Result<Self, FigureError> {
        let (force, length) = (reader.units.force, reader.units.length);
        let profile = run
            .force_profile
            .positions_m
            .iter()
            .zip(&run.force_profile.force_n);
        let profile = profile.map(|(place, newtons)| (length.of_si(*place), force.of_si(*newtons)));
        let places = Axis::linear(reader.in_length("place along the duct"));
        let forces = Axis::linear(reader.head("force", Limited::Force));
        let along = Chart::new("Force along the cable", places, forces).with(Series::line("", profile));
        Ok(Self {
            force: over_time(run, reader, "force", Limited::Force)?,
            movement: over_time(run, reader, "movement", Limited::Movement)?,
            along: svg(along)?,
        })
    }
}

/// Force or movement of both ends after the passes; of a heated cable the least and the largest of each day.
fn over_time(run: &Run, reader: &Reader, what: &str, quantity: Limited) -> Result<String, FigureError> {
    let is_heated = !run.days.is_empty();
    let unit = reader.unit(quantity);
    // Two lines of each end, which are one without heat.
    let points = |end: CableEnd, extreme: usize| -> Vec<(f64, f64)> {
        let of_days = run
            .days
            .iter()
            .map(|day| (day.day as f64, over_day(day, end, quantity)[extreme]));
        let of_passes = run
            .passes
            .iter()
            .map(|record| (record.pass as f64, after_pass(record, end, quantity)));
        let in_unit = |(time, value)| (time, unit.of_si(value));
        if is_heated {
            of_days.map(in_unit).collect()
        } else {
            of_passes.map(in_unit).collect()
        }
    };
    let time = if is_heated { "days" } else { "passes" };
    let last = points(CableEnd::Upstream, 0)
        .last()
        .map_or(1.0, |(time, _)| *time);
    let axis = if last > MANY {
        Axis::logarithmic(time)
    } else {
        Axis::linear(time)
    };
    let title = format!("The ends’ {what} against {time}");
    let mut chart = Chart::new(title, axis, Axis::linear(reader.head(what, quantity)));
    for (look, end) in [(1, CableEnd::Upstream), (0, CableEnd::Downstream)] {
        let name = format!("{} end", end.name());
        chart = chart.with(Series::line(name, points(end, 1)).look(look));
        if is_heated {
            chart = chart.with(Series::line("", points(end, 0)).look(look));
        }
    }
    svg(chart)
}

fn svg(chart: Chart) -> Result<String, FigureError> {
    Panels::new("").panel_size(SIZE.0, SIZE.1).with(chart).to_svg()
}
