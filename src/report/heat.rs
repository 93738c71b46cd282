//! The cable under heat and traffic: a day as it goes, the days one after the other, the cable when it is hottest and coldest.

use super::content::Report;
use super::figure::{MILLI, Passes, along_duct, figure, with_legends};
use super::html::Html;
use super::quantity::{count, length, significant};
use crate::answer::{DayExtremes, DayPoint, HeatRecord, table_days};
use crate::figure::{Axis, Chart, Series};
use crate::scene::{DAYS_PER_YEAR, End, Heat, Warming};
use crate::shown::rounded;

pub fn heat(html: &mut Html, report: &Report) {
    let (Some(record), Some(heat), Some(last)) =
        (&report.run.heat, &report.scene.heat, report.run.days.last())
    else {
        return;
    };
    html.paragraph(&format!("{} {}", course(heat), outcome(record, last)));
    html.raw("<div class=\"figures\">");
    let caption = format!(
        "Day {} as it goes, after passes: temperature of the cable above that at laying, force on the ends, movement of the ends.",
        count(last.day)
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
    let warming = match &heat.warming {
        Warming::Swing(swing) => format!(
            "warms by {} K from midnight to noon and cools again, a cosine",
            significant(*swing)
        ),
        Warming::Profile(points) => {
            let kelvin = points.iter().map(|(_, kelvin)| *kelvin);
            let (least, most) = kelvin.fold((f64::INFINITY, f64::NEG_INFINITY), |(least, most), kelvin| {
                (least.min(kelvin), most.max(kelvin))
            });
            format!(
                "follows a profile of {} points, from {} to {} K",
                points.len(),
                significant(least),
                significant(most)
            )
        }
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
fn outcome(record: &HeatRecord, last: &DayExtremes) -> String {
    let (force, movement) = last.largest_range();
    let lasting = match (record.periodic_from_day, record.drift_per_day_m) {
        (Some(day), Some(drift)) if drift != 0.0 => format!(
            "From day {} on every day is like the one before, but the cable moves on by {} mm a day, {} a year.",
            count(day),
            rounded(MILLI * drift, 3),
            length(DAYS_PER_YEAR * drift)
        ),
        (Some(day), _) => format!("From day {} on every day is like the one before.", count(day)),
        _ => "At the end days still differ from the ones before.".to_owned(),
    };
    format!(
        "{lasting} On the last day the force on an end changes by up to {} N and an end moves by up to {} mm, to and fro: the load of joints that \
         counts for fatigue.",
        rounded(force, 1),
        rounded(MILLI * movement, 3)
    )
}

/// Temperature, forces and movements over the day.
fn day(report: &Report, record: &HeatRecord) -> [Chart; 3] {
    let hours = || Axis::linear("hour of the day").range(0.0, 24.0);
    let line = |name: &str, look, value: fn(&DayPoint) -> f64| {
        Series::line(name, record.cycle.iter().map(|point| (point.hour, value(point)))).look(look)
    };
    let mut force = Chart::new("Force over the day", hours(), Axis::linear("force, N"));
    let ends = &report.scene.ends;
    if ends.downstream != End::Free {
        force = force.with(line("downstream end", 0, |point| point.downstream_force_n));
    }
    if ends.upstream != End::Free {
        force = force.with(line("upstream end", 1, |point| point.upstream_force_n));
    }
    // Free ends carry nothing.
    if (ends.upstream, ends.downstream) == (End::Free, End::Free) {
        force = force.with(line("ends", 0, |point| point.downstream_force_n));
    }
    [
        Chart::new("Temperature over the day", hours(), Axis::linear("warming, K")).with(line(
            "cable",
            2,
            |point| point.warming_k,
        )),
        force,
        Chart::new("Movement over the day", hours(), Axis::linear("movement, mm"))
            .with(line("downstream end", 0, |point| {
                MILLI * point.downstream_displacement_m
            }))
            .with(line("upstream end", 1, |point| {
                MILLI * point.upstream_displacement_m
            })),
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
            along_duct(&report.scene),
            Axis::linear("force, N"),
        ),
        |chart, (name, profile)| {
            let points = profile.positions_m.iter().zip(&profile.force_n);
            chart.with(Series::line(name, points.map(|(x, force)| (*x, *force))))
        },
    )
}

/// Largest and least values day by day.
fn over_days(report: &Report, record: &HeatRecord) -> [Chart; 2] {
    let days = &report.run.days;
    let passes = |day: u64| day * record.passes_per_day;
    let along = Passes::new(&report.scene.traffic, passes(record.all_days.day));
    let line = |name: &str, colour, value: fn(&DayExtremes) -> f64| {
        let points = days.iter().map(|day| (along.place(passes(day.day)), value(day)));
        Series::line(name, points).look(colour)
    };
    let ends = &report.scene.ends;
    let mut force = Chart::new("Force day by day", along.axis(), Axis::linear("force, N"));
    let both_free = (ends.upstream, ends.downstream) == (End::Free, End::Free);
    if both_free {
        force = force
            .with(line("compression in the cable", 0, |day| day.max_compression_n))
            .with(line("tension in the cable", 1, |day| -day.max_tension_n));
    }
    if ends.downstream != End::Free {
        force = force
            .with(line("downstream end, most and least", 0, |day| {
                day.downstream_max_n
            }))
            .with(line("", 0, |day| day.downstream_min_n));
    }
    if ends.upstream != End::Free {
        force = force
            .with(line("upstream end, most and least", 1, |day| day.upstream_max_n))
            .with(line("", 1, |day| day.upstream_min_n));
    }
    let movement = Chart::new("Movement day by day", along.axis(), Axis::linear("movement, mm"))
        .with(line("downstream end, most and least", 0, |day| {
            MILLI * day.downstream_displacement_max_m
        }))
        .with(line("", 0, |day| MILLI * day.downstream_displacement_min_m))
        .with(line("upstream end, most and least", 1, |day| {
            MILLI * day.upstream_displacement_max_m
        }))
        .with(line("", 1, |day| MILLI * day.upstream_displacement_min_m));
    [force, movement]
}

/// Extremes of some days, without what stays zero.
fn days(html: &mut Html, report: &Report, record: &HeatRecord) {
    type Column = (&'static str, fn(&DayExtremes) -> [f64; 2], usize);
    // Soft hyphens: a phone is narrow.
    let mut columns: Vec<Column> = vec![
        (
            "force up\u{ad}stream, N",
            |day| [day.upstream_min_n, day.upstream_max_n],
            1,
        ),
        (
            "force down\u{ad}stream, N",
            |day| [day.downstream_min_n, day.downstream_max_n],
            1,
        ),
        (
            "place of the up\u{ad}stream end, mm",
            |day| [day.upstream_displacement_min_m, day.upstream_displacement_max_m].map(|x| MILLI * x),
            3,
        ),
        (
            "place of the down\u{ad}stream end, mm",
            |day| {
                [
                    day.downstream_displacement_min_m,
                    day.downstream_displacement_max_m,
                ]
                .map(|x| MILLI * x)
            },
            3,
        ),
    ];
    let all = &report.run.days;
    columns.retain(|(_, range, _)| all.iter().any(|day| range(day) != [0.0; 2]));
    let row = |name: String, day: &DayExtremes| {
        let ranges = columns.iter().map(|(_, range, decimals)| {
            let [least, most] = range(day).map(|value| rounded(value, *decimals));
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
        .chain(columns.iter().map(|(name, ..)| *name))
        .collect();
    html.table(0, &head, rows);
}
