//! Days of heat and traffic, printed.

use std::io::Write;

use crate::Units;
use crate::answer::{DayExtremes, HeatRecord, in_unit, table_days};
use crate::scene::DAYS_PER_YEAR;

/// The last digit that is shown of movements, which are large \[m\].
const DIGIT: f64 = 1e-6;

/// The extremes of days, and what heat does over all of them.
pub fn print(
    out: &mut impl Write,
    days: &[DayExtremes],
    heat: &HeatRecord,
    passes: u64,
    units: &Units,
) -> std::io::Result<()> {
    let Some(whole) = heat.last_whole(days, passes) else {
        return Ok(());
    };
    let Units { force, movement, .. } = units;
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
            &format!("upstream force, {}", force.symbol()),
            &format!("downstream force, {}", force.symbol()),
            &format!("upstream end, {}", movement.symbol()),
            &format!("downstream end, {}", movement.symbol()),
        ],
    )?;
    heading(
        out,
        ["day", "least to most", "least to most", "from to", "from to"],
    )?;
    let row = |out: &mut dyn Write, name: &str, day: &DayExtremes| {
        let shown = |value: f64| units.force(value);
        let place = |value: f64| in_unit(value, *movement, DIGIT);
        writeln!(
            out,
            "{name:>8} {:>9} {:>9} {:>9} {:>9} {:>10} {:>10} {:>10} {:>10}",
            shown(day.upstream_min_n),
            shown(day.upstream_max_n),
            shown(day.downstream_min_n),
            shown(day.downstream_max_n),
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
            "from day {day} on every day is like the one before, but the cable moves on by {} {} a day, {:.3} {} a year",
            in_unit(drift, *movement, DIGIT),
            movement.symbol(),
            units.length.of_si(DAYS_PER_YEAR * drift),
            units.length.symbol()
        )?,
        (Some(day), _) => writeln!(out, "from day {day} on every day is like the one before")?,
        _ => writeln!(out, "days still differ from the ones before")?,
    }
    let (cyclic_force, cyclic_movement) = whole.largest_range();
    writeln!(
        out,
        "on the last {} the force on an end changes by up to {} {} and an end moves by up to {} {}, to and fro",
        if passes.is_multiple_of(heat.passes_per_day) {
            "day"
        } else {
            "whole day"
        },
        units.force(cyclic_force),
        force.symbol(),
        in_unit(cyclic_movement, *movement, DIGIT),
        movement.symbol()
    )
}
