//! Measures as a workbook: the table of the terminal, and every combination that was computed.

use std::io;

use rust_xlsxwriter::XlsxError;

use crate::words::Reader;
use crate::words::measures::{measures, recommendation};
use creepage_run::Limited;
use creepage_scene::SceneFile;
use creepage_scene::si_unit;
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
        book.row(
            row.into_iter().map(|text| Cell::Text(text.replace('\u{ad}', ""))),
            false,
        )?;
    }
    book.row([Cell::Text(recommendation(comparison, reader))], false)?;
    let [force, movement] = [Limited::Force, Limited::Movement].map(|quantity| reader.unit(quantity));
    let mut columns = vec![("measure", "")];
    columns.extend(
        comparison
            .uncertain
            .iter()
            .map(|unknown| (&*unknown.key, si_unit(&unknown.key).unwrap_or_default())),
    );
    columns.extend([
        ("force on an end", force.symbol()),
        ("movement of an end", movement.symbol()),
        ("force on a clamp", force.symbol()),
        ("largest share of a limit", ""),
    ]);
    book.sheet("combinations", &columns)?;
    for measure in &comparison.measures {
        for outcome in &measure.outcomes {
            let mut cells = vec![Cell::Text(measure.name.clone())];
            cells.extend(outcome.at.iter().copied().map(Cell::Number));
            cells.extend([
                Cell::Number(force.of_si(outcome.force_n)),
                Cell::Number(movement.of_si(outcome.movement_m)),
                Cell::Number(force.of_si(outcome.clamp_force_n)),
                Cell::Share(outcome.share()),
            ]);
            book.row(cells, outcome.failure.is_some())?;
        }
    }
    scene(&mut book, file)?;
    book.finish()
}
