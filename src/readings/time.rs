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
    let mut parts: Vec<f64> = text
        .split(|c: char| !c.is_ascii_digit())
        .filter(|part| !part.is_empty())
        .filter_map(|part| part.parse().ok())
        .collect();
    let year_first = text.bytes().take_while(u8::is_ascii_digit).count() == 4;
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
    Some(parts)
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
        ] {
            assert!(key(before).unwrap() < key(after).unwrap(), "{before}");
        }
        for text in ["01/02/2025 10:00", "1 Feb 2025", "10:00 PM", ""] {
            assert!(key(text).is_none(), "{text}");
        }
    }
}
