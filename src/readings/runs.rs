//! Runs: series of readings that each begin at rest or go on from the one before.

use std::collections::BTreeMap;

use super::options::RunStart;
use super::reading::Reading;

/// Fewest passes of a run that is recognised by them alone: rows in any order are no runs.
const SHORTEST: usize = 3;

/// Splits readings whose passes rise and begin anew, and says so; the names of the runs.
pub fn split_where_passes_begin_anew(readings: &mut [Reading], notes: &mut Vec<String>) -> Vec<String> {
    let rises = |one: &Reading, next: &Reading| one.pass <= next.pass;
    let early = readings.get(SHORTEST - 1).map_or(0, |reading| reading.pass);
    // A run that begins far from the first one's beginning is a part of the same series, written elsewhere.
    let is_run = |run: &[Reading]| {
        let changes = run.windows(2).filter(|pair| pair[0].pass != pair[1].pass);
        changes.count() + 1 >= SHORTEST && run[0].pass <= early
    };
    let runs = readings.chunk_by(rises).count();
    if runs < 2 || !readings.chunk_by(rises).all(is_run) {
        return vec![String::new()];
    }
    let begins = readings
        .chunk_by(rises)
        .skip(1)
        .map(|run| run[0].line.to_string());
    let lines = begins.collect::<Vec<_>>().join(", ");
    notes.push(format!(
        "the passes begin anew on line {lines}: read as {runs} runs"
    ));
    for (index, run) in readings.chunk_by_mut(rises).enumerate() {
        for reading in run {
            reading.run = index;
        }
    }
    (1..=runs).map(|run| run.to_string()).collect()
}

/// Counts the passes of every reading from a cable at rest. Where nobody says how runs begin, their passes do: those that begin anew are
/// a cable's that does.
pub fn count_from_rest(readings: &mut [Reading], start: Option<RunStart>, notes: &mut Vec<String>) {
    // Lowest and highest pass of each run.
    let mut ranges: BTreeMap<usize, (u64, u64)> = BTreeMap::new();
    for Reading { run, pass, .. } in readings.iter() {
        let (lowest, highest) = ranges.entry(*run).or_insert((*pass, *pass));
        (*lowest, *highest) = ((*lowest).min(*pass), (*highest).max(*pass));
    }
    if ranges.len() < 2 {
        return;
    }
    let go_on = ranges
        .values()
        .zip(ranges.values().skip(1))
        .all(|(one, next)| next.0 > one.1);
    let start = start.unwrap_or(if go_on { RunStart::Continue } else { RunStart::Rest });
    let mut offset = 0;
    let mut offsets = BTreeMap::new();
    for (&run, &(_, highest)) in &ranges {
        offsets.insert(run, offset);
        match (start, go_on) {
            (RunStart::Continue, false) => offset += highest as i64,
            (RunStart::Rest, true) => offset = -(highest as i64),
            _ => {}
        }
    }
    for reading in readings {
        reading.passes = (reading.pass as i64 + offsets[&reading.run]).max(0) as u64;
    }
    let (how, other) = match start {
        RunStart::Rest => (
            "from a cable at rest",
            "continue if each goes on from the one before",
        ),
        RunStart::Continue => (
            "going on from the one before",
            "rest if each begins with a cable at rest",
        ),
    };
    notes.push(format!("{} runs, each {how} (--run-start {other})", ranges.len()));
}
