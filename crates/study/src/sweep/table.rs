//! The finished table, as CSV or a workbook.

use std::path::Path;

use super::columns::{AnswerColumn, AnswerValues, Row};
use super::error::SweepError;
use super::numbers::si;
use crate::book::{Book, Cell, scene as scene_sheet};
use creepage_run::answer::si_of_field;
use creepage_scene::{SceneFile, si_unit};

type Result<T, E = Box<dyn std::error::Error + Send + Sync>> = std::result::Result<T, E>;

/// What names of workbooks end in.
const XLSX: &str = "xlsx";
/// What is allowed as the name of a table.
const ALLOWED: &str = "a file that ends in .csv or .xlsx; in Python, pyarrow reads and writes Parquet from and to the tables of \
                       creepage.sweep";
/// Maximum number of rows of a workbook's table: a sheet has two more, for the names and the units of its columns.
const MAX_ROWS: usize = 1_048_574;

/// What the name of a `table` ends in, which is its format.
///
/// # Errors
///
/// [`SweepError::Invalid`] for any other ending.
pub fn ending(table: &Path) -> Result<&'static str, SweepError> {
    let extension = table.extension().unwrap_or_default();
    let mut endings = ["csv", XLSX].into_iter();
    endings
        .find(|ending| extension.eq_ignore_ascii_case(ending))
        .ok_or_else(|| SweepError::unfit(format!("the table {}", table.display()), ALLOWED))
}

/// Refuses more rows than the `table` can hold.
pub fn check_count(rows: usize, table: &Path) -> Result<(), SweepError> {
    if ending(table)? != XLSX || rows <= MAX_ROWS {
        return Ok(());
    }
    Err(SweepError::unfit(
        format!("{rows} points for {}", table.display()),
        format!("at most {MAX_ROWS}, as many as Excel has rows; more in .csv"),
    ))
}

/// The bytes of the table, of a workbook with the `scene` in it.
pub fn bytes<'a>(
    ending: &str,
    columns: &[AnswerColumn],
    scene: &SceneFile,
    rows: impl Iterator<Item = &'a Row>,
) -> Result<Vec<u8>> {
    if ending == XLSX {
        let title = scene.scene().map_or(String::new(), |scene| scene.title);
        let mut book = Book::new(&title)?;
        let headings: Vec<_> = columns.iter().map(AnswerColumn::heading).collect();
        book.sheet("sweep", &headings)?;
        for row in rows {
            let cells = columns.iter().zip(row);
            book.row(cells.map(|(column, cell)| column.cell(cell)), false)?;
        }
        scene_sheet(&mut book, scene)?;
        return Ok(book.finish()?);
    }
    let mut writer = csv::Writer::from_writer(Vec::new());
    writer.write_record(columns.iter().map(|column| &column.name))?;
    for row in rows {
        writer.write_record(row.iter().map(harmless))?;
    }
    Ok(writer.into_inner()?)
}

/// A text that no spreadsheet takes for a formula: an apostrophe goes before what would begin one,
/// unless it is a number.
fn harmless(text: &str) -> String {
    let begins_formula = text.starts_with(['=', '+', '-', '@', '\t', '\r']) && si(text).is_none();
    let apostrophe = if begins_formula { "'" } else { "" };
    format!("{apostrophe}{text}")
}

impl AnswerColumn {
    /// The name in a workbook, and the unit there.
    fn heading(&self) -> (&str, &'static str) {
        let (name, si) = si_of_field(&self.name).unwrap_or((&self.name, ""));
        match self.unit {
            Some(unit) => (name, unit.symbol()),
            None => (&self.name, si_unit(&self.name).unwrap_or(si)),
        }
    }

    /// The cell of a workbook, in the unit of the column.
    fn cell(&self, cell: &str) -> Cell {
        let number = |si: f64| Cell::Number(self.unit.map_or(si, |unit| unit.of_si(si)));
        match (&self.values, cell) {
            (_, "") => Cell::Absent,
            (AnswerValues::Texts(_), text) => Cell::Text(text.to_owned()),
            (AnswerValues::Flags(_), "true") => Cell::Text("yes".to_owned()),
            (AnswerValues::Flags(_), _) => Cell::Text("no".to_owned()),
            (_, si) => si.parse().map_or(Cell::Absent, number),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::harmless;

    #[test]
    fn formulas_become_texts_and_numbers_stay() {
        for text in ["=1+1", "@SUM(A1)", "+cmd|' /C calc'!A0", "-cmd", "\t=1"] {
            assert_eq!(harmless(text), format!("'{text}"));
        }
        for text in ["-0.5 m", "+3", "-2e-3", "fixed", "", "a=b"] {
            assert_eq!(harmless(text), text);
        }
    }
}
