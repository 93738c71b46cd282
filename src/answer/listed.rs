//! Which passes an answer lists, and which of these a short table shows.

use super::record::PassRecord;
use crate::shown::ROWS;

/// The first passes are all listed, then each this much later than the one before.
const GROWTH: f64 = 1.03;
/// Leading digits of round numbers.
const ROUND: [u64; 3] = [1, 2, 5];

/// The first passes, then evenly growing numbers, round ones, and the last.
pub fn listed(count: u64) -> Vec<u64> {
    let mut passes = Vec::new();
    let mut next = 1;
    while next < count {
        passes.push(next);
        next = (next + 1).max((GROWTH * next as f64) as u64);
    }
    passes.push(count);
    // The numbers that a reader looks for.
    let round = (0..19).flat_map(|power| ROUND.map(|leading| leading * 10_u64.pow(power.min(18))));
    passes.extend(round.filter(|&pass| pass < count));
    passes.sort_unstable();
    passes.dedup();
    passes
}

/// Few enough of `passes` for a short table: all, or round numbers and the last.
pub fn selected(passes: &[PassRecord]) -> Vec<&PassRecord> {
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
