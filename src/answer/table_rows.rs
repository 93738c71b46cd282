//! Which of the listed passes a short table shows.

use super::calendar::calendar;
use super::heat::DayExtremes;
use super::listed::ROUND;
use super::record::PassRecord;
use crate::scene::Traffic;
use crate::shown::ROWS;

/// Few enough of `passes` for a short table: all, or round numbers and the last. Where the vehicles a day are known, those from the first
/// day on are round times.
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

/// Few enough of `days` for a short table: round numbers and the last, which stands for all from the day `periodic_from` on.
pub fn table_days(days: &[DayExtremes], periodic_from: Option<u64>) -> Vec<&DayExtremes> {
    let last = days.last().map_or(0, |day| day.day);
    let is_shown = |day: u64| is_round(day) && periodic_from.is_none_or(|from| day <= from);
    days.iter()
        .filter(|day| day.day == last || is_shown(day.day))
        .collect()
}

fn is_round(number: u64) -> bool {
    let power = 10_u64.pow(number.ilog10());
    number.is_multiple_of(power) && ROUND.contains(&(number / power))
}
