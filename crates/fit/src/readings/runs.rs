//! Runs: series of readings that each begin at rest or go on from the one before.

use std::collections::BTreeMap;

use super::{Reading, Readings, RunStart};

/// Minimum number of passes of a run that is recognised by them alone: rows in any order are no runs.
const SHORTEST: usize = 3;

/// Splits readings whose passes rise and begin anew, and says so.
pub fn split_where_passes_begin_anew(readings: &mut Readings) {
    let rises = |one: &Reading, next: &Reading| one.pass <= next.pass;
    let early = readings.list.get(SHORTEST - 1).map_or(0, |reading| reading.pass);
    // A run that begins far from the first one's beginning is a part of the same series.
    let is_run = |run: &[Reading]| {
        let changes = run.windows(2).filter(|pair| pair[0].pass != pair[1].pass);
        changes.count() + 1 >= SHORTEST && run[0].pass <= early
    };
    let runs: Vec<&[Reading]> = readings.list.chunk_by(rises).collect();
    if runs.len() < 2 || !runs.iter().all(|run| is_run(run)) {
        readings.runs = vec![String::new()];
        return;
    }
    let begins: Vec<String> = runs[1..].iter().map(|run| run[0].line.to_string()).collect();
    let (count, lines) = (runs.len(), begins.join(", "));
    readings.notes.push(format!(
        "the passes begin anew on line {lines}: read as {count} runs"
    ));
    readings.runs = (1..=count).map(|run| run.to_string()).collect();
    for (index, run) in readings.list.chunk_by_mut(rises).enumerate() {
        for reading in run {
            reading.run = index;
        }
    }
}

/// Counts the passes of every reading from a cable at rest. If nobody says how runs begin, their
/// passes do: those that begin anew are a cable's that does.
pub fn count_from_rest(readings: &mut Readings, start: Option<RunStart>) {
    // Lowest and highest pass of each run.
    let mut ranges: BTreeMap<usize, (u64, u64)> = BTreeMap::new();
    for Reading { run, pass, .. } in &readings.list {
        let (lowest, highest) = ranges.entry(*run).or_insert((*pass, *pass));
        (*lowest, *highest) = ((*lowest).min(*pass), (*highest).max(*pass));
    }
    if ranges.len() < 2 {
        return;
    }
    let mut pairs = ranges.values().zip(ranges.values().skip(1));
    let go_on = pairs.all(|(one, next)| next.0 > one.1);
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
    for reading in &mut readings.list {
        reading.passes = (reading.pass as i64 + offsets[&reading.run]).max(0) as u64;
    }
    let how = match start {
        RunStart::Rest => "from a cable at rest (--run-start continue if each goes on from the one before)",
        RunStart::Continue => {
            "going on from the one before (--run-start rest if each begins with a cable at rest)"
        }
    };
    readings.notes.push(format!("{} runs, each {how}", ranges.len()));
}
