//! Times, so far as their order goes.

use super::DataError;
use super::columns::Columns;

impl Columns<'_> {
    /// Refuses vehicles that are not in the order of their times: they are counted from row to row.
    pub fn check_order_of_times(&self) -> Result<(), DataError> {
        let Some(column) = self.time.filter(|_| self.vehicles.is_some()) else {
            return Ok(());
        };
        for pair in self.table.rows.windows(2) {
            let is_one_run = self.run.is_none_or(|run| pair[0].cell(run) == pair[1].cell(run));
            if is_one_run && is_earlier(pair[1].cell(column), pair[0].cell(column)) {
                let before = pair[0].cell(column);
                let allowed = format!("rows in the order of their times: the row before has \"{before}\"");
                return Err(self.table.wrong_cell(&pair[1], column, allowed));
            }
        }
        Ok(())
    }
}

/// Whether a time is certainly earlier than another.
fn is_earlier(after: &str, before: &str) -> bool {
    let keys = key(after).zip(key(before));
    keys.is_some_and(|(after, before)| after < before)
}

/// What orders a time: a number, or year, month, day and the rest. `None` where day and month may be either, noon is
/// counted apart, or the distance from UTC is said, as clocks that are put back show an hour twice.
fn key(text: &str) -> Option<Vec<f64>> {
    if let Ok(number) = text.replace(',', ".").parse() {
        return Some(vec![number]);
    }
    let is_word = text.chars().any(|c| c.is_ascii_alphabetic() && !"TZ".contains(c));
    let zone = text.rfind(['+', '-']).filter(|&sign| text[..sign].contains(':'));
    if is_word || zone.is_some() {
        return None;
    }
    let parts = text.split(|c: char| !c.is_ascii_digit());
    let mut parts: Vec<f64> = parts.filter_map(|part| part.parse().ok()).collect();
    let first = text.bytes().take_while(u8::is_ascii_digit).count();
    match parts[..] {
        _ if first == 4 => {}
        // 24.12.2025 17:30
        [_, _, _, ..] if first > 0 && text.contains('.') => parts.swap(0, 2),
        _ if text.contains('/') || !text.contains(':') => return None,
        _ => {}
    }
    Some(parts)
}

#[cfg(test)]
mod tests {
    use super::{is_earlier, key};

    #[test]
    fn times_are_ordered_where_that_is_certain() {
        for (before, after) in [
            ("2025-12-24 17:30:00", "2025-12-24 17:31:00"),
            ("2025-12-24T17:30:00Z", "2026-01-01T00:00:00Z"),
            ("31.01.2025 09:00", "01.02.2025 08:00"),
            ("9:05:00", "10:00:00"),
            ("45000.5", "45001,25"),
            // Clocks are put back; the mean of an hour.
            ("2025-10-26T02:40:00+02:00", "2025-10-26T02:10:00+01:00"),
            ("2025-01-31 22:00-23:00", "2025-01-31 23:00-00:00"),
            ("2025-10-26 02:40:00Z", "2025-10-27 03:00:00"),
        ] {
            assert!(!is_earlier(after, before), "{before}");
        }
        for (before, after) in [
            ("2025-10-26T02:40:00Z", "2025-10-26T01:10:00Z"),
            ("31.01.2025 09:00", "31.01.2025 08:00"),
        ] {
            assert!(is_earlier(after, before), "{before}");
        }
        for text in [
            "01/02/2025 10:00",
            "1 Feb 2025",
            "10:00 PM",
            "2025-10-26 02:40+01:00",
            "",
        ] {
            assert!(key(text).is_none(), "{text}");
        }
    }
}
