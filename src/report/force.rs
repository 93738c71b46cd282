//! Force and movement over the passes, and force along the cable.

use super::agreement::Agreement;
use super::content::Report;
use super::ends::{self, OTHER};
use super::figure::{Passes, along_duct, figure};
use super::html::Html;
use super::quantity::{Shown, count};
use crate::answer::{after, in_rows, table_rows};
use crate::figure::{Axis, Chart, Reference, Series};
use crate::shown::words_if;
use crate::{CableEnd, ForceProfile, Limited, PassRecord, Place, Units};

/// Readings that are drawn at most: of more every second, third, … is.
const READINGS: usize = 300;

pub fn force(html: &mut Html, report: &Report) {
    html.raw("<div class=\"figures\">");
    let measured = report.agreement.as_ref();
    let measured = measured.map_or(String::new(), |agreement| measured_in(agreement, &report.shown));
    let when = words_if(report.run.heat.is_some(), ", on the first day");
    let earlier = words_if(
        !report.history.is_empty(),
        " What earlier runs left stands before the vertical line.",
    );
    let caption = format!(
        "Force after each pass{when}, compression positive. A free end carries none.{earlier}{measured}"
    );
    figure(html, [over_passes(report)], &caption);
    let caption = "Force along the cable after the first pass, the last, and up to two round numbers between them, compression positive.";
    if !report.run.stages.is_empty() {
        figure(html, [along(report)], caption);
    }
    let caption =
        format!("Displacement of the cable’s ends{when}, positive toward growing x, downstream.{earlier}");
    figure(html, [movement(report)], &caption);
    passes(html, report);
    html.raw("</div>");
    clamps(html, report);
}

/// What each clamp carries.
fn clamps(html: &mut Html, report: &Report) {
    let Report { run, shown, .. } = report;
    if run.restraints.is_empty() {
        return;
    }
    let when = if run.heat.is_some() {
        "at most, in passes and in heat"
    } else {
        "at most during a pass"
    };
    let rows = run.restraints.iter().map(|clamp| {
        let largest = |quantity| run.largest(Place::Clamp(clamp.position_m), quantity);
        vec![
            shown.length(clamp.position_m),
            shown.force_number(clamp.force_n),
            shown.force_number(largest(Limited::Force)),
            shown.movement_number(largest(Limited::Movement)),
        ]
    });
    let [last, most] = ["after the last pass", when].map(|when| shown.in_force(&format!("force {when}")));
    let moved = shown.in_movement(&format!("moved {when}"));
    html.table(1, &["clamp at", &last, &most, &moved], rows);
}

fn measured_in(agreement: &Agreement, shown: &Shown) -> String {
    let [rms, mean, largest] = agreement.numbers().map(|force| shown.force(force));
    let bars = words_if(
        agreement.readings.iter().any(|reading| reading.sigma.is_some()),
        " Bars are one standard deviation long to either side.",
    );
    format!(
        " {} readings at the {} end; measured minus computed force of {} of them: mean {mean}, root of the mean square {rms}, \
         largest reading {largest}.{bars} “creepage calibrate” says whether friction, ground or an error of the cell makes the difference.",
        agreement.readings.len(),
        agreement.end.name(),
        agreement.compared,
    )
}

/// Force on the ends against passes, the saturated force, and readings.
fn over_passes(report: &Report) -> Chart {
    let Report { run, shown, .. } = report;
    let in_unit = |newtons| shown.units.force.of_si(newtons);
    let readings = report.agreement.as_ref().map_or(&[][..], |a| &a.readings);
    let drawn = drawn(report);
    let computed = drawn.iter().map(|record| record.pass);
    let last = computed
        .chain(readings.iter().map(|reading| reading.passes))
        .max();
    let along = Passes::new(report, last.unwrap_or(1));
    let force = Axis::linear(shown.in_force("force"));
    let mut chart = Chart::new(along.title("Force"), along.axis(), force);
    let ends = ends::held(&report.scene);
    chart = ends::lines(chart, &ends, Some(""), |end| {
        along.series(drawn, |record| in_unit(ends::of_pass(record, end)[0]))
    });
    chart = along.with_history(chart, &ends, |past, end| in_unit(end.of(past.force_n)));
    if ends.is_empty() {
        let inside = along.series(drawn, |record| in_unit(record.max_compression_n));
        chart = chart.with(Series::line("largest in the cable", inside).look(OTHER).solid());
    }
    if let Some(saturation) = &run.saturation {
        let label = format!("levels off at {}", shown.force(saturation.force_n));
        chart = chart.refer(Reference::horizontal(in_unit(saturation.force_n), label));
    }
    if readings.is_empty() {
        return chart;
    }
    let seen = || readings.iter().step_by(readings.len().div_ceil(READINGS));
    for reading in seen() {
        if let Some(sigma) = reading.sigma {
            let bar =
                [-sigma, sigma].map(|sigma| (along.place(reading.passes), in_unit(reading.value + sigma)));
            chart = chart.with(Series::line("", bar).colour(OTHER).solid());
        }
    }
    let points = seen().map(|reading| (along.place(reading.passes), in_unit(reading.value)));
    chart.with(Series::points("measured", points).look(OTHER).marker(0))
}

fn along(report: &Report) -> Chart {
    let force = Axis::linear(report.shown.in_force("force"));
    let chart = Chart::new("Force along the cable", along_duct(report), force);
    let stages = report.run.stages.iter();
    stages.fold(chart, |chart, stage| {
        let name = if stage.pass == 1 {
            "pass 1".into()
        } else {
            count(stage.pass)
        };
        chart.with(Series::line(
            name,
            profile_points(&stage.force_profile, &report.shown),
        ))
    })
}

/// Force against place.
pub fn profile_points(profile: &ForceProfile, shown: &Shown) -> Vec<(f64, f64)> {
    let Units { length, force, .. } = shown.units;
    let points = profile.positions_m.iter().zip(&profile.force_n);
    points
        .map(|(x, newtons)| (length.of_si(*x), force.of_si(*newtons)))
        .collect()
}

/// The passes that a line can follow: of a heated cable those of the first day.
fn drawn(report: &Report) -> &[PassRecord] {
    let passes = &report.run.passes;
    let heat = report.run.heat.as_ref();
    let count = heat.map_or(passes.len(), |heat| {
        passes.partition_point(|record| record.pass <= heat.passes_per_day)
    });
    &passes[..count]
}

/// Until the cable leaves the duct.
fn movement(report: &Report) -> Chart {
    let most = report.shown.most;
    let is_in = |end: CableEnd, record: &PassRecord| record.movement(end) <= most;
    let passes = drawn(report);
    let inside = passes.partition_point(|record| CableEnd::ALL.into_iter().all(|end| is_in(end, record)));
    let passes = &passes[..inside.max(1).min(passes.len())];
    let last = passes.last().map_or(1, |record| record.pass);
    let along = Passes::new(report, last);
    let unit = report.shown.units.movement;
    let moved = Axis::linear(report.shown.in_movement("movement"));
    let chart = Chart::new("Movement of the ends", along.axis(), moved);
    let chart = ends::lines(chart, &CableEnd::ALL, Some(""), |end| {
        along.series(passes, |record| unit.of_si(ends::of_pass(record, end)[1]))
    });
    along.with_history(chart, &CableEnd::ALL, |past, end| {
        unit.of_si(end.of(past.displacement_m))
    })
}

/// Some passes, as the terminal shows them; without what stays zero, as the force on a free end.
fn passes(html: &mut Html, report: &Report) {
    let Report { run, shown, .. } = report;
    let passes = &run.passes;
    let mut columns = ends::columns(shown, "moved *");
    let is_shown = |(_, end, kind): &(String, CableEnd, usize)| {
        let mut values = passes.iter().map(|record| ends::of_pass(record, *end)[*kind]);
        values.any(|value| value != 0.0)
    };
    if columns.iter().any(is_shown) {
        columns.retain(is_shown);
    }
    let traffic = &report.scene.traffic;
    let rows = table_rows(passes, traffic);
    let a_day = run.heat.as_ref().map(|heat| heat.passes_per_day);
    let (kind, kinds) = in_rows(&rows, &report.scene, a_day, run.random.is_some()).unzip();
    let mut kinds = kinds.into_iter().flatten();
    let row = |record: &PassRecord| {
        let values = columns
            .iter()
            .map(|(_, end, kind)| match ends::of_pass(record, *end) {
                [force, _] if *kind == 0 => shown.force_number(force),
                [_, metres] => shown.movement_number(metres),
            });
        let time = record.years.map(after);
        std::iter::once(count(record.pass))
            .chain(time)
            .chain(values)
            .chain(kinds.next())
            .collect()
    };
    let names = columns.iter().map(|(name, ..)| name.as_str());
    let time = traffic.per_day.map(|_| "time");
    let first = std::iter::once("after pass").chain(time);
    let head: Vec<&str> = first.chain(names).chain(kind).collect();
    let names = if kind == Some("vehicle") { " names" } else { "" };
    html.raw(&format!("<div class=\"passes{names}\">"));
    html.table(0, &head, rows.into_iter().map(row));
    html.raw("</div>");
}
