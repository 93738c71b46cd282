//! The figures of an answer as SVG, to be kept: force and movement of the ends, force along the cable.

use serde_json::{Value, json};

use crate::figure::{Axis, Chart, FigureError, Series};
use crate::words::{Reader, after_pass, over_day};
use crate::{CableEnd, Limited, Run};

/// Passes or days beyond which their axis is logarithmic.
const MANY: f64 = 2000.0;

/// The figures of a run by their names.
pub fn figures(run: &Run, reader: &Reader) -> Result<Value, FigureError> {
    let profile = run
        .force_profile
        .positions_m
        .iter()
        .zip(&run.force_profile.force_n);
    let in_unit = |(place, newtons): (&f64, &f64)| {
        (
            reader.units.length.of_si(*place),
            reader.units.force.of_si(*newtons),
        )
    };
    let places = Axis::linear(reader.in_length("place along the duct"));
    let forces = Axis::linear(reader.head("force", Limited::Force));
    let along = Chart::new("Force along the cable", places, forces);
    Ok(json!({
        "force": over_time(run, reader, "force", Limited::Force).to_svg()?,
        "movement": over_time(run, reader, "movement", Limited::Movement).to_svg()?,
        "along": along.with(Series::line("", profile.map(in_unit))).to_svg()?,
    }))
}

/// Force or movement of both ends after the passes; of a heated cable the least and the largest of each day.
fn over_time(run: &Run, reader: &Reader, what: &str, quantity: Limited) -> Chart {
    let (unit, is_heated) = (reader.unit(quantity), !run.days.is_empty());
    let points = |end: CableEnd, extreme: usize| -> Vec<(f64, f64)> {
        let of_days = run
            .days
            .iter()
            .map(|day| (day.day, over_day(day, end, quantity)[extreme]));
        let of_passes = run.passes.iter().filter(|_| !is_heated);
        let of_passes = of_passes.map(|record| (record.pass, after_pass(record, end, quantity)));
        let in_unit = |(time, value)| (time as f64, unit.of_si(value));
        of_days.chain(of_passes).map(in_unit).collect()
    };
    let time = if is_heated { "days" } else { "passes" };
    let last = points(CableEnd::Upstream, 0).last().map_or(1.0, |point| point.0);
    let axis = if last > MANY {
        Axis::logarithmic(time)
    } else {
        Axis::linear(time)
    };
    let title = format!("The ends’ {what} against {time}");
    let chart = Chart::new(title, axis, Axis::linear(reader.head(what, quantity)));
    let ends = [(CableEnd::Downstream, 0), (CableEnd::Upstream, 1)];
    ends.into_iter().fold(chart, |chart, (end, look)| {
        let name = format!("{} end", end.name());
        let least = Series::line("", points(end, 0)).look(look);
        chart
            .with(Series::line(name, points(end, 1)).look(look))
            .with(least)
    })
}
