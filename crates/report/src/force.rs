//! Force and movement over the passes, and force along the cable.

use super::agreement::Agreement;
use super::chart::{ALONE, OTHER, along_cable, figure, held, lines, over};
use super::content::Report;
use super::html::Html;
use super::pass_axis::PassAxis;
use crate::words::{after_pass, count};
use creepage_plan::shown::words_if;
use creepage_run::{Limited, PassRecord};
use creepage_scene::CableEnd;
use plain_figure::{Chart, Reference, Series};

/// Readings that are drawn at most: of more every second, third, … is.
const READINGS: usize = 300;

pub fn force(html: &mut Html, report: &Report) {
    html.raw("<div class=\"figures\">");
    let measured = report.agreement.as_ref();
    let measured = measured.map_or(String::new(), |agreement| agreement.sentence(&report.reader));
    let when = words_if(report.run.heat.is_some(), ", on the first day");
    let earlier = words_if(
        !report.history.is_empty(),
        " What earlier runs left stands before the vertical line.",
    );
    let caption = format!(
        "Force after each pass{when}, compression positive. A free end carries none.{earlier}{measured}"
    );
    figure(html, ALONE, [force_after_passes(report)], &caption);
    let caption = "Force along the cable after the first pass, the last, and up to two round numbers between them, compression positive.";
    let stages = report.run.stages.iter().map(|stage| {
        let pass = words_if(stage.pass == 1, "pass ");
        (format!("{pass}{}", count(stage.pass)), &stage.force_profile)
    });
    if !report.run.stages.is_empty() {
        let along = along_cable(report, "Force along the cable", stages);
        figure(html, ALONE, [along], caption);
    }
    let caption =
        format!("Displacement of the cable’s ends{when}, positive toward growing x, downstream.{earlier}");
    figure(html, ALONE, [movement_after_passes(report)], &caption);
    let passes = report.answer().passes(false);
    let named = passes.head.last().is_some_and(|head| head == "vehicle");
    html.raw(&format!("<div class=\"passes{}\">", words_if(named, " names")));
    html.table(&passes);
    html.raw("</div>");
    html.raw("</div>");
    if let Some(clamps) = report.answer().clamps() {
        html.table(&clamps);
    }
}

/// The passes that a line can follow: of a heated cable those of the first day.
fn drawn(report: &Report) -> &[PassRecord] {
    let heat = report.run.heat.as_ref();
    let first_day = heat.map_or(u64::MAX, |heat| heat.passes_per_day);
    let passes = &report.run.passes;
    &passes[..passes.partition_point(|record| record.pass <= first_day)]
}

/// `chart` with force or movement of `ends` after each of `passes`.
fn after_passes(
    report: &Report,
    (title, along): (&str, &PassAxis<'_>),
    (quantity, ends): (Limited, &[CableEnd]),
    passes: &[PassRecord],
) -> Chart {
    let unit = report.reader.unit(quantity);
    let chart = over(report, title, along.axis(), quantity);
    let chart = lines(chart, ends, Some(""), |end| {
        along.series(passes, |record| unit.of_si(after_pass(record, end, quantity)))
    });
    along.with_history(chart, ends, quantity, unit)
}

/// Force on the ends, the saturated force, and readings.
fn force_after_passes(report: &Report) -> Chart {
    let in_unit = |newtons| report.reader.units.force.of_si(newtons);
    let readings = report.agreement.as_ref().map_or(&[][..], |a| &a.readings);
    let passes = drawn(report);
    let read = readings.iter().map(|reading| reading.passes);
    let last = passes.iter().map(|record| record.pass).chain(read).max();
    let along = PassAxis::new(report, last.unwrap_or(1));
    let ends = held(&report.scene);
    let title = along.title("Force");
    let mut chart = after_passes(report, (&title, &along), (Limited::Force, &ends), passes);
    if ends.is_empty() {
        let inside = along.series(passes, |record| in_unit(record.max_compression_n));
        chart = chart.with(Series::line("largest in the cable", inside).look(OTHER).solid());
    }
    if let Some(saturation) = &report.run.saturation {
        let label = format!("levels off at {}", report.reader.force(saturation.force_n));
        chart = chart.refer(Reference::horizontal(in_unit(saturation.force_n), label));
    }
    if readings.is_empty() {
        return chart;
    }
    let thinned = || readings.iter().step_by(readings.len().div_ceil(READINGS));
    for reading in thinned() {
        let place = along.place(reading.passes);
        if let Some(sigma) = reading.sigma {
            let bar = [-sigma, sigma].map(|sigma| (place, in_unit(reading.value + sigma)));
            chart = chart.with(Series::line("", bar).colour(OTHER).solid());
        }
    }
    let points = thinned().map(|reading| (along.place(reading.passes), in_unit(reading.value)));
    chart.with(Series::points("measured", points).look(OTHER).marker(0))
}

/// Movement of the ends, until the cable leaves the duct.
fn movement_after_passes(report: &Report) -> Chart {
    let is_in = |record: &PassRecord| {
        let mut ends = CableEnd::ALL.into_iter();
        ends.all(|end| record.displacement(end).abs() <= report.reader.most)
    };
    let passes = drawn(report);
    let inside = passes.partition_point(is_in);
    let passes = &passes[..inside.max(1).min(passes.len())];
    let along = PassAxis::new(report, passes.last().map_or(1, |record| record.pass));
    let title = ("Movement of the ends", &along);
    after_passes(report, title, (Limited::Movement, &CableEnd::ALL), passes)
}

impl Agreement {
    /// How far readings and computed force agree.
    fn sentence(&self, reader: &crate::words::Reader) -> String {
        let [rms, mean, largest] = [self.rms_n, self.mean_n, self.largest_n].map(|force| reader.force(force));
        let bars = words_if(
            self.readings.iter().any(|reading| reading.sigma.is_some()),
            " Bars are one standard deviation long to either side.",
        );
        format!(
            " {} readings at the {} end; measured minus computed force of {} of them: mean {mean}, root of the mean square {rms}, \
             largest reading {largest}.{bars} “creepage calibrate” says whether friction, ground or an error of the cell makes the difference.",
            self.readings.len(),
            self.end.name(),
            self.compared,
        )
    }
}
