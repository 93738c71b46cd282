//! The cable under heat and traffic: a day as it goes, the days one after the other, the cable when it is hottest and coldest.

use super::chart::{ALONE, OTHER, WITH_LEGENDS, along_cable, figure, held, lines, over};
use super::content::Report;
use super::html::Html;
use super::pass_axis::PassAxis;
use crate::words::{count, over_day, range, significant};
use creepage_plan::shown::words_if;
use creepage_run::{
    Limited,
    answer::{DayExtremes, DayPoint, HeatRecord},
};
use creepage_scene::{CableEnd, Heat};
use plain_figure::{Axis, Chart, Series};

pub fn heat(html: &mut Html, report: &Report) {
    let answer = report.answer();
    let (run, passes) = (&report.run, report.scene.traffic.passes);
    let (Some(record), Some(heat), Some(outcome), Some(days)) =
        (&run.heat, &report.scene.heat, answer.heat(), answer.days())
    else {
        return;
    };
    html.paragraph(&format!("{} {outcome}", course(heat)));
    html.raw("<div class=\"figures\">");
    let is_whole = passes.is_multiple_of(record.passes_per_day);
    let part = words_if(!is_whole, ", in which the passes end");
    let caption = format!(
        "Day {} as it goes, after passes{part}: temperature of the cable above that at laying, force on the ends, movement of the ends.",
        count(record.all_days.day)
    );
    figure(html, WITH_LEGENDS, day(report, record), &caption);
    let profiles = [
        ("hottest".to_owned(), &record.hot_profile),
        ("coldest".to_owned(), &record.cold_profile),
    ];
    let along = along_cable(report, "Hot and cold force along the cable", profiles);
    let caption = "Force along the cable when that day is hottest and coldest.";
    figure(html, ALONE, [along], caption);
    let caption = "Largest and least force and farthest places of the ends on each day.";
    figure(html, WITH_LEGENDS, over_days(report, record), caption);
    html.raw("<div class=\"ranges\">");
    html.paragraph(
        "Each day’s least and largest value after passes and between them; while a vehicle is above the duct a force may be larger.",
    );
    html.table(&days);
    html.raw("</div>");
    html.raw("</div>");
    html.paragraph(
        "Forces of heat are upper bounds: the cable snakes in the clearance of its duct as it expands, EA falls as it warms, and its insulation \
         relaxes. Every day is taken to be the same. A swing over the seasons, and more traffic by day than by night, are not computed.",
    );
}

/// How warm the cable is.
fn course(heat: &Heat) -> String {
    let warming = if let Some(points) = &heat.profile {
        let [least, most] = range(points.iter().map(|(_, kelvin)| *kelvin)).map(significant);
        let count = points.len();
        format!("follows a profile of {count} points, from {least} to {most} K")
    } else {
        let swing = significant(heat.daily_swing.unwrap_or(0.0));
        format!("warms by {swing} K from midnight to noon and cools again, a cosine")
    };
    let offset = format!(", {} K above the temperature at laying", significant(heat.offset));
    let offset = words_if(heat.offset != 0.0, &offset);
    let expansion = significant(1e6 * heat.expansion);
    format!("The cable {warming} every day{offset}; it expands by {expansion}·10⁻⁶ per kelvin.")
}

/// Force or displacement of an end at a time of the day.
fn at(point: &DayPoint, end: CableEnd, quantity: Limited) -> f64 {
    end.of(quantity.of([
        [point.upstream_force_n, point.downstream_force_n],
        [point.upstream_displacement_m, point.downstream_displacement_m],
    ]))
}

/// Temperature, forces and movements over the day.
fn day(report: &Report, record: &HeatRecord) -> [Chart; 3] {
    let hours = || Axis::linear("hour of the day").range(0.0, 24.0);
    let chart = |title, ends: &[CableEnd], quantity| {
        let unit = report.reader.unit(quantity);
        lines(over(report, title, hours(), quantity), ends, Some(""), |end| {
            let points = record.cycle.iter();
            points.map(move |point| (point.hour, unit.of_si(at(point, end, quantity))))
        })
    };
    // Free ends carry nothing, which is drawn where both are.
    let held = match &held(&report.scene)[..] {
        [] => CableEnd::ALL.to_vec(),
        held => held.to_vec(),
    };
    let warming = record.cycle.iter().map(|point| (point.hour, point.warming_k));
    [
        Chart::new("Temperature over the day", hours(), Axis::linear("warming, K"))
            .with(Series::line("cable", warming).look(OTHER)),
        chart("Force over the day", &held, Limited::Force),
        chart("Movement over the day", &CableEnd::ALL, Limited::Movement),
    ]
}

/// Largest and least values day by day.
fn over_days(report: &Report, record: &HeatRecord) -> [Chart; 2] {
    let days = &report.run.days;
    let passes = |day: u64| day * record.passes_per_day;
    let along = PassAxis::new(report, passes(record.all_days.day));
    let place = |day: &DayExtremes| along.place(passes(day.day));
    let held = held(&report.scene);
    let chart = |title, ends: &[CableEnd], quantity| {
        let unit = report.reader.unit(quantity);
        let line = |end, which: usize| {
            let value = move |day| unit.of_si(over_day(day, end, quantity)[which]);
            days.iter().map(move |day| (place(day), value(day)))
        };
        let chart = over(report, title, along.axis(), quantity);
        let chart = lines(chart, ends, Some(", most and least"), |end| line(end, 1));
        lines(chart, ends, None, |end| line(end, 0))
    };
    let mut forces = chart("Force day by day", &held, Limited::Force);
    if held.is_empty() {
        let unit = report.reader.units.force;
        let line = |name: &str, value: fn(&DayExtremes) -> f64| {
            Series::line(name, days.iter().map(|day| (place(day), unit.of_si(value(day)))))
        };
        forces = forces
            .with(line("compression in the cable", |day| day.max_compression_n))
            .with(line("tension in the cable", |day| -day.max_tension_n));
    }
    let movements = chart("Movement day by day", &CableEnd::ALL, Limited::Movement);
    [forces, movements]
}
