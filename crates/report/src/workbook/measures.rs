//! Measures as a workbook: the table of the terminal, and every combination that was computed.

use std::io;

use rust_xlsxwriter::XlsxError;

use crate::words::Reader;
use crate::words::measures::{measures, recommendation};
use creepage_run::Limited;
use creepage_scene::{SceneFile, si_unit};
use creepage_study::book::{Book, Cell, scene};
use creepage_study::measures::Comparison;

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
    let table = measures(comparison, reader);
    let columns: Vec<(&str, &str)> = table.head.iter().map(|name| (name.as_str(), "")).collect();
    book.sheet("measures", &columns)?;
    for row in table.rows {
        let cells = row.into_iter().map(|text| Cell::Text(text.replace('\u{ad}', "")));
        book.row(cells, false)?;
    }
    book.row([Cell::Text(recommendation(comparison, reader))], false)?;
    let [force, movement] = [Limited::Force, Limited::Movement].map(|quantity| reader.unit(quantity));
    let keys = comparison.uncertain.iter().map(|unknown| &*unknown.key);
    let keys = keys.map(|key| (key, si_unit(key).unwrap_or_default()));
    let columns: Vec<(&str, &str)> = [("measure", "")]
        .into_iter()
        .chain(keys)
        .chain([
            ("force on an end", force.symbol()),
            ("movement of an end", movement.symbol()),
            ("force on a clamp", force.symbol()),
            ("largest share of a limit", ""),
        ])
        .collect();
    book.sheet("combinations", &columns)?;
    for measure in &comparison.measures {
        for outcome in &measure.outcomes {
            let mut cells = vec![Cell::Text(measure.name.clone())];
            cells.extend(
                comparison
                    .uncertain
                    .iter()
                    .map(|unknown| Cell::Number(outcome.at[&unknown.key])),
            );
            cells.extend([
                Cell::Number(force.of_si(outcome.force_n)),
                Cell::Number(movement.of_si(outcome.movement_m)),
                outcome
                    .clamp_force_n
                    .map_or(Cell::Absent, |clamp| Cell::Number(force.of_si(clamp))),
                Cell::Share(outcome.share()),
            ]);
            book.row(cells, outcome.failure.is_some())?;
        }
    }
    scene(&mut book, file)?;
    book.finish()
}
