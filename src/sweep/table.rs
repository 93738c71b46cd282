//! The finished table, as CSV or a workbook.

use std::io;
use std::path::Path;

use serde_json::Value;

use super::columns::AnswerColumn;
use super::error::SweepError;
use super::numbers::si;
use crate::SceneFile;
use crate::output::Draft;
#[cfg(feature = "xlsx")]
use crate::workbook::{self, Book, Cell};

/// Kind of the table file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    Csv,
    #[cfg(feature = "xlsx")]
    Xlsx,
}

/// Formats of this program, by the endings of their names.
const ALLOWED: &str = if cfg!(feature = "xlsx") {
    "a file that ends in .csv or .xlsx; in Python, pyarrow reads and writes Parquet from and to the tables of creepage.sweep"
} else {
    "a file that ends in .csv: this program was built without workbooks"
};

impl Format {
    /// The format that the file's name asks for.
    pub fn of(file: &Path) -> Result<Self, SweepError> {
        let extension = file.extension().unwrap_or_default().to_ascii_lowercase();
        match extension.to_str() {
            Some("csv") => Ok(Self::Csv),
            #[cfg(feature = "xlsx")]
            Some("xlsx") => Ok(Self::Xlsx),
            _ => Err(SweepError::Unfit {
                found: format!("the table {}", file.display()),
                allowed: ALLOWED,
            }),
        }
    }

    /// What the names of its files end in.
    pub fn ending(self) -> &'static str {
        match self {
            Self::Csv => "csv",
            #[cfg(feature = "xlsx")]
            Self::Xlsx => "xlsx",
        }
    }

    /// Most rows that a table of this format holds: a sheet has two more, for the names and the
    /// units of its columns.
    pub fn most_rows(self) -> usize {
        match self {
            Self::Csv => usize::MAX,
            #[cfg(feature = "xlsx")]
            Self::Xlsx => 1_048_574,
        }
    }

    /// Writes the table, and of a workbook also the `scene`, to `draft`.
    #[cfg_attr(
        not(feature = "xlsx"),
        allow(unused_variables, reason = "only a workbook holds the scene")
    )]
    pub fn write(
        self,
        draft: Draft,
        columns: &[AnswerColumn],
        scene: &SceneFile,
        mut rows: impl Iterator<Item = Vec<Value>>,
    ) -> io::Result<Draft> {
        match self {
            Self::Csv => {
                let mut writer = csv::Writer::from_writer(draft);
                writer.write_record(columns.iter().map(|column| &column.name))?;
                rows.try_for_each(|cells| writer.write_record(texts(&cells)))?;
                let draft = writer.into_inner();
                draft.map_err(|error| io::Error::other(error.to_string()))
            }
            #[cfg(feature = "xlsx")]
            Self::Xlsx => write_book(draft, columns, scene, rows),
        }
    }
}

/// Cells as texts.
pub fn texts(cells: &[Value]) -> impl Iterator<Item = String> {
    cells.iter().map(|cell| match cell {
        Value::String(text) => harmless(text),
        Value::Number(number) if number.is_f64() => number.as_f64().unwrap_or_default().to_string(),
        Value::Number(count) => count.to_string(),
        Value::Bool(flag) => flag.to_string(),
        _ => String::new(),
    })
}

/// A text that no spreadsheet takes for a formula: an apostrophe goes before what would begin one,
/// unless it is a number.
fn harmless(text: &str) -> String {
    if text.starts_with(['=', '+', '-', '@', '\t', '\r']) && si(text).is_none() {
        format!("'{text}")
    } else {
        text.to_owned()
    }
}

#[cfg(feature = "xlsx")]
fn write_book(
    mut draft: Draft,
    columns: &[AnswerColumn],
    scene: &SceneFile,
    rows: impl Iterator<Item = Vec<Value>>,
) -> io::Result<Draft> {
    let fill = || {
        let title = scene.scene().map_or(String::new(), |scene| scene.title);
        let mut book = Book::new(&title)?;
        let headings = columns
            .iter()
            .map(|column| (&*column.heading.0, column.heading.1));
        book.sheet("sweep", &headings.collect::<Vec<_>>())?;
        for cells in rows {
            let cells = cells.into_iter().zip(columns).map(|(cell, column)| match cell {
                Value::String(text) => Cell::Text(text),
                Value::Bool(flag) => Cell::Text(if flag { "yes" } else { "no" }.to_owned()),
                cell => cell.as_f64().map_or(Cell::Absent, |si| {
                    Cell::Number(column.unit.map_or(si, |unit| unit.of_si(si)))
                }),
            });
            book.row(cells, false)?;
        }
        workbook::scene(&mut book, scene)?;
        book.finish()
    };
    let bytes = fill().map_err(|error: rust_xlsxwriter::XlsxError| io::Error::other(error))?;
    io::Write::write_all(&mut draft, &bytes)?;
    Ok(draft)
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
