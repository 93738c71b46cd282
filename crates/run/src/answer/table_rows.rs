//! Which of the listed passes a short table shows.

use super::calendar::calendar;
use super::heat::DayExtremes;
use super::listed::ROUND;
use super::record::PassRecord;
use creepage_plan::{
    Period,
    cable::{known_order, traffic},
    shown::ROWS,
};
use creepage_scene::{Scene, Traffic};

/// Few enough of `passes` for a short table: all, or round numbers and the last. Where the vehicles
/// a day are known, those from the first day on are round times.
pub fn table_rows<'r>(passes: &'r [PassRecord], traffic: &Traffic) -> Vec<&'r PassRecord> {
    if passes.len() <= ROWS {
        return passes.iter().collect();
    }
    let last = passes.len() - 1;
    let times = calendar(traffic);
    let first = times.first().map_or(u64::MAX, |(pass, _)| *pass);
    let is_time = |record: &PassRecord| times.iter().any(|(pass, _)| *pass == record.pass);
    let shown = passes.iter().enumerate().filter(|(index, record)| {
        *index == last || is_time(record) || record.pass < first && is_round(record.pass)
    });
    shown.map(|(_, record)| record).collect()
}

/// In what `rows` differ besides the number of the pass, and what that is in each: the hour of the
/// day where the cable is heated and there are `a_day` passes, else the vehicle. `None` if they
/// do not.
pub fn in_rows(
    rows: &[&PassRecord],
    scene: &Scene,
    a_day: Option<u64>,
    are_means: bool,
) -> Option<(&'static str, Vec<String>)> {
    if let Some(a_day) = a_day {
        let hour = |pass: u64| 24.0 * (((pass - 1) % a_day) as f64 + 0.5) / a_day as f64;
        let hours = rows.iter().map(|record| format!("{:.1}", hour(record.pass)));
        return Some(("hour", hours.collect()));
    }
    if scene.vehicles.len() == 1 || are_means {
        return None;
    }
    let own = Period::own(scene).ok()?;
    let last = rows.last().filter(|_| own.is_none()).map_or(0, |row| row.pass);
    let order = traffic(scene, scene.order()).ok()?;
    let first: Vec<usize> = order.take(last.min(known_order(scene)) as usize).collect();
    let name = |record: &&PassRecord| {
        let place = record.pass as usize - 1;
        let vehicle = match &own {
            Some(period) => period.get(place % period.len()),
            // Between jumps over other vehicles than the scene's rows are means.
            None => first.get(place).filter(|_| !record.interpolated),
        };
        vehicle.map_or("mean".to_owned(), |vehicle| scene.vehicles[*vehicle].name.clone())
    };
    Some(("vehicle", rows.iter().map(name).collect()))
}

/// Few enough of `days` for a short table: round numbers and the last, which stands for all from
/// the day `periodic_from` on.
pub fn table_days(days: &[DayExtremes], periodic_from: Option<u64>) -> Vec<&DayExtremes> {
    let last = days.last().map_or(0, |day| day.day);
    let is_round = |day: u64| is_round(day) && periodic_from.is_none_or(|from| day <= from);
    let is_shown = |day: &&DayExtremes| day.day == last || is_round(day.day);
    days.iter().filter(is_shown).collect()
}

fn is_round(number: u64) -> bool {
    let power = 10_u64.pow(number.ilog10());
    number.is_multiple_of(power) && ROUND.contains(&(number / power))
}
