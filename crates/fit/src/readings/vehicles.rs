//! Vehicles that are counted from row to row: in the order of their times, and no running total.

use super::DataError;
use super::columns::Columns;

/// Minimum number of rows of vehicles that only grow for a running total: by chance one file in 120.
const TOTAL: usize = 5;

impl Columns<'_> {
    /// Refuses vehicles that are not in the order of their times.
    pub fn refuse_disorder(&self) -> Result<(), DataError> {
        let Some(column) = self.time.filter(|_| self.vehicles.is_some()) else {
            return Ok(());
        };
        for pair in self.table.rows.windows(2) {
            let is_one_run = self.run.is_none_or(|run| pair[0].cell(run) == pair[1].cell(run));
            let [before, after] = [0, 1].map(|row: usize| pair[row].cell(column));
            if is_one_run && is_earlier(after, before) {
                let allowed = format!("rows in the order of their times: the row before has \"{before}\"");
                return Err(self.table.wrong_cell(&pair[1], column, allowed));
            }
        }
        Ok(())
    }

    /// Refuses vehicles that may be a running total, unless their column was chosen.
    pub fn refuse_totals(&self) -> Result<(), DataError> {
        let (table, rows) = (&self.table, &self.table.rows);
        let open = self.vehicles.filter(|&column| !table.names[column].chosen);
        let count = |row| table.value(row, open?, open?).ok();
        let counts: Vec<f64> = rows.iter().filter_map(count).collect();
        if counts.len() < TOTAL || counts.windows(2).any(|pair| pair[1] <= pair[0]) {
            return Ok(());
        }
        let found = "vehicles that grow from row to row: a running total, or vehicles since the row before";
        let allowed = "either: --column-pass NAME takes a total, --column-vehicles NAME takes those since the row before";
        Err(table.wrong(rows[0].line, found, allowed))
    }
}

/// Whether a time is certainly earlier than another: both are numbers, or times of day with a date
/// from year to day or between points, if any. Not certain is what may be the day or the month,
/// where noon is counted apart, and where the distance from UTC is said, as clocks that are put
/// back show an hour twice.
fn is_earlier(after: &str, before: &str) -> bool {
    let number = |text: &str| text.replace(',', ".").parse::<f64>();
    if let (Ok(after), Ok(before)) = (number(after), number(before)) {
        return after < before;
    }
    // 24.12.2025 08:00 is sorted as 20251224 08:00.
    let sorted = |text: &str| match text.split('.').collect::<Vec<_>>()[..] {
        [day, month, rest] if day.len() == 2 && month.len() == 2 && rest.is_char_boundary(4) => {
            format!("{}{month}{day}{}", &rest[..4], &rest[4..])
        }
        _ => text.to_owned(),
    };
    let is_sorted = |text: &String| {
        let (date, clock) = text.split_once(':').unwrap_or((text, ""));
        let is_plain = text.bytes().all(|c| c.is_ascii_digit() || b"-:T Z".contains(&c));
        is_plain && matches!(date.find('-'), None | Some(4)) && !clock.contains('-')
    };
    let times = [sorted(after), sorted(before)];
    after.len() == before.len() && times.iter().all(is_sorted) && times[0] < times[1]
}

#[cfg(test)]
mod tests {
    use super::is_earlier;

    #[test]
    fn times_are_ordered_where_that_is_certain() {
        for (before, after) in [
            ("2025-12-24 17:30:00", "2025-12-24 17:31:00"),
            ("2025-12-24T17:30:00Z", "2026-01-01T00:00:00Z"),
            ("31.01.2025 09:00", "01.02.2025 08:00"),
            ("31-01-2025 09:00", "01-02-2025 08:00"),
            ("31/01/2025 09:00", "01/02/2025 08:00"),
            ("11:00 AM", "01:00 PM"),
            ("9:05:00", "10:00:00"),
            ("45000.5", "45001,25"),
            // Clocks are put back; the mean of an hour.
            ("2025-10-26T02:40:00+02:00", "2025-10-26T02:10:00+01:00"),
            ("2025-10-26 02:40-04:00", "2025-10-26 02:10-05:00"),
            ("2025-01-31 22:00-23:00", "2025-01-31 23:00-00:00"),
            ("2025-10-26 02:40:00Z", "2025-10-27 03:00:00"),
        ] {
            assert!(!is_earlier(after, before), "{before}");
        }
        for (before, after) in [
            ("2025-10-26T02:40:00Z", "2025-10-26T01:10:00Z"),
            ("2025-10-26 02:40", "2025-10-25 03:10"),
            ("31.01.2025 09:00", "31.01.2025 08:00"),
            ("01.02.2025 09:00", "31.01.2025 10:00"),
            ("09:00", "08:55"),
            ("45000.5", "45000,25"),
        ] {
            assert!(is_earlier(after, before), "{before}");
        }
    }
}
