//! The cable under heat and traffic: a day as it goes, the days one after the other, the cable when it is hottest and coldest.

use super::content::Report;
use super::ends::{self, OTHER};
use super::figure::{Passes, along_duct, figure, with_legends};
use super::force::profile_points;
use super::html::Html;
use super::quantity::{Shown, count, significant};
use crate::answer::{DayExtremes, HeatRecord, table_days};
use crate::figure::{Axis, Chart, Series};
use crate::scene::{DAYS_PER_YEAR, Heat, Unit};
use crate::{CableEnd, Units};

pub fn heat(html: &mut Html, report: &Report) {
    let (run, passes) = (&report.run, report.scene.traffic.passes);
    let (Some(record), Some(heat)) = (&run.heat, &report.scene.heat) else {
        return;
    };
    let Some(whole) = record.last_whole(&run.days, passes) else {
        return;
    };
    html.paragraph(&format!(
        "{} {}",
        course(heat),
        outcome(record, whole, &report.shown)
    ));
    html.raw("<div class=\"figures\">");
    let part = if passes.is_multiple_of(record.passes_per_day) {
        ""
    } else {
        ", in which the passes end"
    };
    let caption = format!(
        "Day {} as it goes, after passes{part}: temperature of the cable above that at laying, force on the ends, movement of the ends.",
        count(record.all_days.day)
    );
    with_legends(html, day(report, record), &caption);
    let caption = "Force along the cable when that day is hottest and coldest.";
    figure(html, [along(report, record)], caption);
    let caption = "Largest and least force and farthest places of the ends on each day.";
    with_legends(html, over_days(report, record), caption);
    html.raw("<div class=\"ranges\">");
    days(html, report, record);
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
        let kelvin = points.iter().map(|(_, kelvin)| *kelvin);
        let (least, most) = kelvin.fold((f64::INFINITY, f64::NEG_INFINITY), |(least, most), kelvin| {
            (least.min(kelvin), most.max(kelvin))
        });
        let [least, most] = [least, most].map(significant);
        format!(
            "follows a profile of {} points, from {least} to {most} K",
            points.len()
        )
    } else {
        let swing = significant(heat.daily_swing.unwrap_or(0.0));
        format!("warms by {swing} K from midnight to noon and cools again, a cosine")
    };
    let offset = match heat.offset {
        0.0 => String::new(),
        offset => format!(", {} K above the temperature at laying", significant(offset)),
    };
    format!(
        "The cable {warming} every day{offset}; it expands by {}·10⁻⁶ per kelvin.",
        significant(1e6 * heat.expansion)
    )
}

/// What comes of it.
fn outcome(record: &HeatRecord, whole: &DayExtremes, shown: &Shown) -> String {
    let (force, movement) = whole.largest_range();
    let lasting = match (record.periodic_from_day, record.drift_per_day_m) {
        (Some(day), Some(drift)) if drift != 0.0 => format!(
            "From day {} on every day is like the one before, but the cable moves on by {} a day, {} a year.",
            count(day),
            shown.movement(drift),
            shown.length(DAYS_PER_YEAR * drift)
        ),
        (Some(day), _) => format!("From day {} on every day is like the one before.", count(day)),
        _ => "At the end days still differ from the ones before.".to_owned(),
    };
    format!(
        "{lasting} On the last whole day the force on an end changes by up to {} and an end moves by up to {}, to and fro: the load of joints that \
         counts for fatigue.",
        shown.force(force),
        shown.movement(movement)
    )
}

/// Temperature, forces and movements over the day.
fn day(report: &Report, record: &HeatRecord) -> [Chart; 3] {
    let hours = || Axis::linear("hour of the day").range(0.0, 24.0);
    let shown = &report.shown;
    let Units { force, movement, .. } = shown.units;
    let points = |end, kind: usize, unit: Unit| {
        let points = record.cycle.iter();
        points.map(move |point| (point.hour, unit.of_si(ends::of_time(point, end)[kind])))
    };
    let forces = Chart::new(
        "Force over the day",
        hours(),
        Axis::linear(shown.in_force("force")),
    );
    let movements = Axis::linear(shown.in_movement("movement"));
    let movements = Chart::new("Movement over the day", hours(), movements);
    // Free ends carry nothing, which is drawn where both are.
    let held = match &ends::held(&report.scene)[..] {
        [] => CableEnd::ALL.to_vec(),
        held => held.to_vec(),
    };
    let warming = record.cycle.iter().map(|point| (point.hour, point.warming_k));
    [
        Chart::new("Temperature over the day", hours(), Axis::linear("warming, K"))
            .with(Series::line("cable", warming).look(OTHER)),
        ends::lines(forces, &held, Some(""), |end| points(end, 0, force)),
        ends::lines(movements, &CableEnd::ALL, Some(""), |end| {
            points(end, 1, movement)
        }),
    ]
}

fn along(report: &Report, record: &HeatRecord) -> Chart {
    let profiles = [
        ("hottest", &record.hot_profile),
        ("coldest", &record.cold_profile),
    ];
    profiles.into_iter().fold(
        Chart::new(
            "Hot and cold force along the cable",
            along_duct(report),
            Axis::linear(report.shown.in_force("force")),
        ),
        |chart, (name, profile)| chart.with(Series::line(name, profile_points(profile, &report.shown))),
    )
}

/// Largest and least values day by day.
fn over_days(report: &Report, record: &HeatRecord) -> [Chart; 2] {
    let days = &report.run.days;
    let passes = |day: u64| day * record.passes_per_day;
    let along = Passes::new(report, passes(record.all_days.day));
    let shown = &report.shown;
    let Units { force, movement, .. } = shown.units;
    let place = |day: &DayExtremes| along.place(passes(day.day));
    let of_ends = |chart, ends: &[CableEnd], kind: usize, unit: Unit| {
        let line = |end, which: usize| {
            let values = days.iter().map(move |day| (day, day.of(end)[kind][which]));
            values.map(|(day, value)| (place(day), unit.of_si(value)))
        };
        let chart = ends::lines(chart, ends, Some(", most and least"), |end| line(end, 1));
        ends::lines(chart, ends, None, |end| line(end, 0))
    };
    let held = ends::held(&report.scene);
    let axis = Axis::linear(shown.in_force("force"));
    let mut forces = Chart::new("Force day by day", along.axis(), axis);
    if held.is_empty() {
        let line = |name: &str, value: fn(&DayExtremes) -> f64| {
            Series::line(name, days.iter().map(|day| (place(day), force.of_si(value(day)))))
        };
        forces = forces
            .with(line("compression in the cable", |day| day.max_compression_n))
            .with(line("tension in the cable", |day| -day.max_tension_n));
    }
    let axis = Axis::linear(shown.in_movement("movement"));
    let movements = Chart::new("Movement day by day", along.axis(), axis);
    [
        of_ends(forces, &held, 0, force),
        of_ends(movements, &CableEnd::ALL, 1, movement),
    ]
}

/// Extremes of some days, without what stays zero.
fn days(html: &mut Html, report: &Report, record: &HeatRecord) {
    let shown = &report.shown;
    let all = &report.run.days;
    let mut columns = ends::columns(shown, "place of the * end");
    columns.retain(|(_, end, kind)| all.iter().any(|day| day.of(*end)[*kind] != [0.0; 2]));
    let row = |name: String, day: &DayExtremes| {
        let ranges = columns.iter().map(|(_, end, kind)| {
            let [least, most] = day.of(*end)[*kind].map(|value| match kind {
                0 => shown.force_number(value),
                _ => shown.movement_number(value),
            });
            format!("{least} to {most}")
        });
        std::iter::once(name).chain(ranges).collect()
    };
    let mut rows: Vec<Vec<String>> = table_days(all, record.periodic_from_day)
        .into_iter()
        .map(|day| row(count(day.day), day))
        .collect();
    rows.push(row("all days".into(), &record.all_days));
    let head: Vec<&str> = std::iter::once("day")
        .chain(columns.iter().map(|(name, ..)| name.as_str()))
        .collect();
    html.paragraph(
        "Each day’s least and largest value after passes and between them; while a vehicle is above the duct a force may be larger.",
    );
    html.table(0, &head, rows);
}
