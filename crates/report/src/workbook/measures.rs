//! Measures as a workbook: the table of the terminal, and every combination that was computed.

use std::io;

use rust_xlsxwriter::XlsxError;
use serde_json::{Map, Value, json};

use super::{table, text};
use crate::words::{Reader, measures};
use creepage_scene::{SceneFile, si_unit};
use creepage_study::book::{Book, scene};
use creepage_study::measures::{Combination, Comparison};

/// The file of a workbook.
///
/// # Errors
///
/// Where it cannot be written.
pub fn of_measures(comparison: &Comparison, reader: &Reader, file: &SceneFile) -> io::Result<Vec<u8>> {
    write(comparison, reader, file).map_err(io::Error::other)
}

fn write(comparison: &Comparison, reader: &Reader, file: &SceneFile) -> Result<Vec<u8>, XlsxError> {
    let mut book = Book::new(&comparison.title)?;
    let words = measures::measures(comparison, reader);
    let columns: Vec<(&str, &str)> = words.head.iter().map(|name| (name.as_str(), "")).collect();
    book.sheet("measures", &columns)?;
    for row in words.rows {
        // Without soft hyphens.
        book.row(row.iter().map(|cell| text(cell.replace('\u{ad}', ""))), false)?;
    }
    book.row([text(measures::recommendation(comparison, reader))], false)?;
    let records = comparison.measures.iter().flat_map(|measure| {
        let outcomes = measure.outcomes.iter().map(|outcome| {
            let of_measure = json!({ "force_n": outcome.force_n, "movement_m": outcome.movement_m,
                "clamp_force_n": outcome.clamp_force_n, "share_of_a_limit": outcome.share() });
            record(&measure.name, &outcome.at, &of_measure)
        });
        let failures = measure.failures.iter();
        let failures = failures.map(|(at, reason)| record(&measure.name, at, &json!({ "failure": reason })));
        outcomes.chain(failures).collect::<Vec<_>>()
    });
    table(&mut book, "combinations", &records.collect(), &reader.units)?;
    scene(&mut book, file)?;
    book.finish()
}

/// A row for one combination and what it comes to; values of keys are in SI.
fn record(measure: &str, at: &Combination, answer: &Value) -> Value {
    let named = |key: &String| si_unit(key).map_or(key.clone(), |unit| format!("{key}, {unit}"));
    let keys = at.iter().map(|(key, value)| (named(key), json!(value)));
    let mut record = Map::from_iter([("measure".to_owned(), json!(measure))]);
    record.extend(keys);
    record.extend(answer.as_object().cloned().unwrap_or_default());
    Value::Object(record)
}
