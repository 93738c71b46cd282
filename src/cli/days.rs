//! Days of heat and traffic, printed.

use std::io::Write;

use crate::answer::{DayExtremes, HeatRecord, table_days};
use crate::scene::DAYS_PER_YEAR;
use crate::shown::rounded;

/// The extremes of days, and what heat does over all of them.
pub fn print(out: &mut impl Write, days: &[DayExtremes], heat: &HeatRecord) -> std::io::Result<()> {
    let Some(last) = days.last() else {
        return Ok(());
    };
    let heading = |out: &mut dyn Write, texts: [&str; 5]| {
        let [day, rest @ ..] = texts;
        writeln!(
            out,
            "{day:>8} {:>19} {:>19} {:>21} {:>21}",
            rest[0], rest[1], rest[2], rest[3]
        )
    };
    heading(
        out,
        [
            "",
            "upstream force, N",
            "downstream force, N",
            "upstream end, mm",
            "downstream end, mm",
        ],
    )?;
    heading(
        out,
        ["day", "least to most", "least to most", "from to", "from to"],
    )?;
    let row = |out: &mut dyn Write, name: &str, day: &DayExtremes| {
        let force = |value: f64| rounded(value, 1);
        let place = |value: f64| rounded(1e3 * value, 3);
        writeln!(
            out,
            "{name:>8} {:>9} {:>9} {:>9} {:>9} {:>10} {:>10} {:>10} {:>10}",
            force(day.upstream_min_n),
            force(day.upstream_max_n),
            force(day.downstream_min_n),
            force(day.downstream_max_n),
            place(day.upstream_displacement_min_m),
            place(day.upstream_displacement_max_m),
            place(day.downstream_displacement_min_m),
            place(day.downstream_displacement_max_m),
        )
    };
    for day in table_days(days, heat.periodic_from_day) {
        row(out, &day.day.to_string(), day)?;
    }
    row(out, "all days", &heat.all_days)?;
    writeln!(out)?;
    match (heat.periodic_from_day, heat.drift_per_day_m) {
        (Some(day), Some(drift)) if drift != 0.0 => writeln!(
            out,
            "from day {day} on every day is like the one before, but the cable moves on by {:.3} mm a day, {:.3} m a year",
            1e3 * drift,
            DAYS_PER_YEAR * drift
        )?,
        (Some(day), _) => writeln!(out, "from day {day} on every day is like the one before")?,
        _ => writeln!(out, "days still differ from the ones before")?,
    }
    let (force, movement) = last.largest_range();
    writeln!(
        out,
        "on the last day the force on an end changes by up to {force:.1} N and an end moves by up to {:.3} mm, to and fro",
        1e3 * movement
    )
}
