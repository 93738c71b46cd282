//! Runs: series of readings that each begin at rest or go on from the one before.

use super::options::RunStart;
use super::reading::Reading;

/// Fewest rows of a run that is recognised by its passes alone: rows in any order are no runs.
const SHORTEST: usize = 3;

/// Splits readings whose passes rise and begin anew, and says so; the names of the runs.
pub fn split_where_passes_begin_anew(readings: &mut [Reading], notes: &mut Vec<String>) -> Vec<String> {
    let mut starts = vec![0];
    starts.extend((1..readings.len()).filter(|&k| readings[k].pass < readings[k - 1].pass));
    let ends = starts[1..].iter().copied().chain([readings.len()]);
    let blocks: Vec<(usize, usize)> = starts.iter().copied().zip(ends).collect();
    let passes = |&(start, end): &(usize, usize)| {
        let mut passes: Vec<u64> = readings[start..end].iter().map(|reading| reading.pass).collect();
        passes.dedup();
        passes.len()
    };
    // A run that begins far from the first one's beginning is a part of the same series, written elsewhere.
    let begins_anew = |&(start, _): &(usize, usize)| {
        readings[start].pass <= readings[SHORTEST.min(readings.len()) - 1].pass
    };
    if blocks.len() < 2
        || !blocks
            .iter()
            .all(|block| passes(block) >= SHORTEST && begins_anew(block))
    {
        return vec![String::new()];
    }
    let lines: Vec<String> = starts[1..]
        .iter()
        .map(|&start| readings[start].line.to_string())
        .collect();
    notes.push(format!(
        "the passes begin anew on line {}: read as {} runs",
        lines.join(", "),
        blocks.len()
    ));
    for (run, &(start, end)) in blocks.iter().enumerate() {
        for reading in &mut readings[start..end] {
            reading.run = run;
        }
    }
    (1..=blocks.len()).map(|run| run.to_string()).collect()
}

/// Counts the passes of every reading from a cable at rest. Where nobody says how runs begin, their passes do: those that begin anew are
/// a cable's that does.
pub fn count_from_rest(
    readings: &mut [Reading],
    runs: usize,
    start: Option<RunStart>,
    notes: &mut Vec<String>,
) {
    let range = |readings: &[Reading], run: usize| {
        let of = || {
            readings
                .iter()
                .filter(|reading| reading.run == run)
                .map(|reading| reading.pass)
        };
        Some((of().min()?, of().max()?))
    };
    let ranges: Vec<(u64, u64)> = (0..runs).filter_map(|run| range(readings, run)).collect();
    if ranges.len() < 2 {
        return;
    }
    let go_on = ranges.windows(2).all(|pair| pair[1].0 > pair[0].1);
    let start = start.unwrap_or(if go_on { RunStart::Continue } else { RunStart::Rest });
    let mut before = 0;
    let mut last = 0;
    let mut offsets = Vec::new();
    for &(_, highest) in &ranges {
        offsets.push(match (start, go_on) {
            (RunStart::Continue, true) | (RunStart::Rest, false) => 0,
            (RunStart::Continue, false) => last,
            (RunStart::Rest, true) => -before,
        });
        before = highest as i64;
        last += highest as i64;
    }
    for reading in readings {
        let passes = reading.pass as i64 + offsets.get(reading.run).copied().unwrap_or(0);
        reading.passes = passes.max(0) as u64;
    }
    notes.push(match start {
        RunStart::Rest => format!(
            "{} runs, each from a cable at rest (--run-start continue if each goes on from the one before)",
            ranges.len()
        ),
        RunStart::Continue => format!(
            "{} runs, each going on from the one before (--run-start rest if each begins with a cable at rest)",
            ranges.len()
        ),
    });
}
