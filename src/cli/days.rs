//! Days of heat and traffic, printed.

use std::io::Write;

use super::terminal;
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
    let of_ends = |what: &str, unit: &str| {
        ["upstream", "downstream"].map(|end| [format!("{end} {what}, {unit}: least"), "most".to_owned()])
    };
    let mut names = vec!["day".to_owned()];
    names.extend(of_ends("force", force.symbol()).into_iter().flatten());
    names.extend(of_ends("moved", movement.symbol()).into_iter().flatten());
    let row = |name: String, day: &DayExtremes| {
        let forces = [
            day.upstream_min_n,
            day.upstream_max_n,
            day.downstream_min_n,
            day.downstream_max_n,
        ];
        let places = [
            day.upstream_displacement_min_m,
            day.upstream_displacement_max_m,
            day.downstream_displacement_min_m,
            day.downstream_displacement_max_m,
        ];
        let mut row = vec![name];
        row.extend(forces.map(|value| units.force(value)));
        row.extend(places.map(|value| in_unit(value, *movement, DIGIT)));
        row
    };
    let days = table_days(days, heat.periodic_from_day).into_iter();
    let mut rows: Vec<Vec<String>> = days.map(|day| row(day.day.to_string(), day)).collect();
    rows.push(row("all days".to_owned(), &heat.all_days));
    terminal::table(out, &names, &rows)?;
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
