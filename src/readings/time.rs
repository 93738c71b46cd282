//! Times, so far as their order goes.

use creepage_tables::{Row, Table};

use super::DataError;
use crate::scene::shortened;

/// Longest time that a message repeats \[characters\].
const LONGEST: usize = 80;

/// Refuses rows that are not in the order of the times in `column`: vehicles are counted from row to row.
pub fn check_order(table: &Table, column: usize, run: Option<usize>) -> Result<(), DataError> {
    let same_run = |one: &Row, other: &Row| run.is_none_or(|run| one.cell(run) == other.cell(run));
    for pair in table.rows.windows(2).filter(|pair| same_run(&pair[0], &pair[1])) {
        let [before, after] = [&pair[0], &pair[1]].map(|row| row.cell(column));
        if let (Some(first), Some(second)) = (key(before), key(after))
            && second < first
        {
            let [before, after] = [before, after].map(|text| shortened(text, LONGEST));
            let found = format!("\"{after}\", earlier than the row before, \"{before}\"");
            return Err(table.wrong(pair[1].line, found, "rows in the order of their times"));
        }
    }
    Ok(())
}

/// What orders a time: a number, or year, month, day and the rest. `None` where day and month may be either, or noon is counted apart.
fn key(text: &str) -> Option<Vec<f64>> {
    if let Ok(number) = text.replace(',', ".").parse() {
        return Some(vec![number]);
    }
    if text.chars().any(|c| c.is_ascii_alphabetic() && !"TZ".contains(c)) {
        return None;
    }
    let year_first = text.bytes().take_while(u8::is_ascii_digit).count() == 4;
    // Behind the hours stands the distance from UTC: `+02:00`, `-0530`, or `Z` for none.
    let text = &text.replace('Z', "+00:00");
    let signs = text.rmatch_indices(['+', '-']).filter(|_| year_first);
    let zone = signs
        .map(|(at, _)| text.split_at(at))
        .find(|(local, _)| local.contains(':'));
    let (local, zone) = zone.unwrap_or((text, ""));
    let numbers = |text: &str| -> Vec<f64> {
        let parts = text.split(|c: char| !c.is_ascii_digit());
        parts
            .filter(|part| !part.is_empty())
            .filter_map(|part| part.parse().ok())
            .collect()
    };
    let mut parts = numbers(local);
    if !year_first
        && text.contains('.')
        && parts.len() > 2
        && !text.starts_with(|c: char| !c.is_ascii_digit())
    {
        // 24.12.2025 17:30
        parts.swap(0, 2);
    } else if !year_first && (text.contains('/') || !text.contains(':')) {
        return None;
    }
    match (&parts[..], &numbers(zone)[..]) {
        (&[year, month, day, hour, minute, ref second @ ..], &[of_zone, ref minutes @ ..]) => {
            // Days from the first of March of the year 0, so that the day of a leap year is the last of a year.
            let (year, month) = if month > 2.0 {
                (year, month - 3.0)
            } else {
                (year - 1.0, month + 9.0)
            };
            let leap = (year / 4.0).floor() - (year / 100.0).floor() + (year / 400.0).floor();
            let days = 365.0 * year + leap + ((153.0 * month + 2.0) / 5.0).floor() + day;
            let hours = if of_zone > 99.0 {
                (of_zone / 100.0).floor() + of_zone % 100.0 / 60.0
            } else {
                of_zone
            };
            let east = hours + minutes.first().unwrap_or(&0.0) / 60.0;
            let east = if zone.starts_with('-') { -east } else { east };
            let seconds = second.first().unwrap_or(&0.0);
            Some(vec![
                86400.0 * days + 3600.0 * (hour - east) + 60.0 * minute + seconds,
            ])
        }
        _ => Some(parts),
    }
}

#[cfg(test)]
mod tests {
    use super::key;

    #[test]
    fn times_are_ordered_where_that_is_certain() {
        for (before, after) in [
            ("2025-12-24 17:30:00", "2025-12-24 17:31:00"),
            ("2025-12-24T17:30:00Z", "2026-01-01T00:00:00Z"),
            ("31.01.2025 09:00", "01.02.2025 08:00"),
            ("9:05:00", "10:00:00"),
            ("45000.5", "45001,25"),
            // Clocks are put back, and are read in two zones.
            ("2025-10-26T02:40:00+02:00", "2025-10-26T02:10:00+01:00"),
            ("2024-02-29 23:30:00 -0530", "2024-03-01T05:01:00+00:00"),
            ("2024-12-31T23:59:59+00:00", "2025-01-01T05:00:00+0500"),
        ] {
            assert!(key(before).unwrap() < key(after).unwrap(), "{before}");
        }
        for text in ["01/02/2025 10:00", "1 Feb 2025", "10:00 PM", ""] {
            assert!(key(text).is_none(), "{text}");
        }
    }
}
