//! Which of the listed passes a short table shows.

use super::listed::ROUND;
use super::record::PassRecord;
use crate::shown::ROWS;

/// Few enough of `passes` for a short table: all, or round numbers and the last.
pub fn table_rows(passes: &[PassRecord]) -> Vec<&PassRecord> {
    if passes.len() <= ROWS {
        return passes.iter().collect();
    }
    let last = passes.len() - 1;
    let shown = passes.iter().enumerate().filter(|(index, record)| {
        let power = 10_u64.pow(record.pass.ilog10());
        *index == last || (record.pass.is_multiple_of(power) && ROUND.contains(&(record.pass / power)))
    });
    shown.map(|(_, record)| record).collect()
}
