//! Force and movement over the passes, and force along the cable.

use crate::PassRecord;
use crate::figure::{Axis, Chart, Panels, Reference, Series};
use crate::report::Report;
use crate::report::quantity::count;
use crate::scene::End;

use super::{passes_axis, series, single};

/// Readings that are drawn at most: of more every second, third, … is.
const READINGS: usize = 300;
/// Metres to millimetres.
const MILLI: f64 = 1e3;

/// Force on the ends against passes, the saturated force, and readings.
pub fn force(report: &Report) -> Panels {
    let run = &report.run;
    let readings = report.agreement.as_ref().map_or(&[][..], |a| &a.readings);
    let last = run.passes.last().map_or(1, |record| record.pass);
    let last = readings.iter().fold(last, |last, reading| last.max(reading.pass));
    let mut chart = Chart::new(
        "Force against passes",
        passes_axis(last),
        Axis::linear("force, N"),
    );
    let mut line = |name: &str, look, value: fn(&PassRecord) -> f64| {
        chart = chart
            .clone()
            .with(Series::line(name, series(&run.passes, value)).look(look));
    };
    let ends = &report.scene.ends;
    if ends.downstream != End::Free {
        line("downstream end", 0, |record| record.downstream_force_n);
    }
    if ends.upstream != End::Free {
        line("upstream end", 1, |record| record.upstream_force_n);
    }
    if (ends.upstream, ends.downstream) == (End::Free, End::Free) {
        line("largest in the cable", 0, |record| record.max_compression_n);
    }
    if let Some(saturation) = &run.saturation {
        let label = format!("levels off at {:.1} N", saturation.force_n);
        chart = chart.refer(Reference::horizontal(saturation.force_n, label));
    }
    if !readings.is_empty() {
        let shown = || readings.iter().step_by(readings.len().div_ceil(READINGS));
        for (pass, force, sigma) in shown().filter_map(|r| Some((r.pass as f64, r.force, r.sigma?))) {
            let bar = [(pass, force - sigma), (pass, force + sigma)];
            chart = chart.with(Series::line("", bar).colour(1).solid());
        }
        let points = shown().map(|reading| (reading.pass as f64, reading.force));
        chart = chart.with(Series::points("measured", points).look(1).marker(0));
    }
    single(chart)
}

/// Force along the cable after some passes.
pub fn along(report: &Report) -> Panels {
    let chart = Chart::new(
        "Force along the cable",
        Axis::linear("place along the duct, m"),
        Axis::linear("force, N"),
    );
    single(
        report
            .run
            .stages
            .iter()
            .enumerate()
            .fold(chart, |chart, (look, stage)| {
                let profile = &stage.force_profile;
                let points = profile
                    .positions_m
                    .iter()
                    .copied()
                    .zip(profile.force_n.iter().copied());
                let name = if stage.pass == 1 {
                    "pass 1".into()
                } else {
                    count(stage.pass)
                };
                chart.with(Series::line(name, points).look(look))
            }),
    )
}

/// Movement of both ends against passes.
pub fn movement(report: &Report) -> Panels {
    let passes = &report.run.passes;
    let last = passes.last().map_or(1, |record| record.pass);
    let chart = Chart::new(
        "Movement of the ends",
        passes_axis(last),
        Axis::linear("movement, mm"),
    )
    .with(Series::line(
        "upstream end",
        series(passes, |record| MILLI * record.upstream_displacement_m),
    ))
    .with(Series::line(
        "downstream end",
        series(passes, |record| MILLI * record.downstream_displacement_m),
    ));
    single(chart)
}
