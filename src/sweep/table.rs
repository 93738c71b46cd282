//! The finished table, as CSV or a workbook.

use std::io;
use std::path::Path;

use super::columns::{AnswerColumn, AnswerValues, Row};
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
            _ => Err(SweepError::unfit(
                format!("the table {}", file.display()),
                ALLOWED,
            )),
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
        rows: &[Row],
    ) -> io::Result<Draft> {
        match self {
            Self::Csv => {
                let mut writer = csv::Writer::from_writer(draft);
                writer.write_record(columns.iter().map(|column| &column.name))?;
                for row in rows {
                    writer.write_record(row.iter().map(harmless))?;
                }
                let draft = writer.into_inner();
                draft.map_err(|error| io::Error::other(error.to_string()))
            }
            #[cfg(feature = "xlsx")]
            Self::Xlsx => {
                let book = book(columns, scene, rows).map_err(io::Error::other)?;
                let mut draft = draft;
                io::Write::write_all(&mut draft, &book)?;
                Ok(draft)
            }
        }
    }
}

/// A text that no spreadsheet takes for a formula: an apostrophe goes before what would begin one,
/// unless it is a number.
fn harmless(text: &str) -> String {
    let begins_formula = text.starts_with(['=', '+', '-', '@', '\t', '\r']) && si(text).is_none();
    let apostrophe = if begins_formula { "'" } else { "" };
    format!("{apostrophe}{text}")
}

#[cfg(feature = "xlsx")]
fn book(
    columns: &[AnswerColumn],
    scene: &SceneFile,
    rows: &[Row],
) -> Result<Vec<u8>, rust_xlsxwriter::XlsxError> {
    let title = scene.scene().map_or(String::new(), |scene| scene.title);
    let mut book = Book::new(&title)?;
    let headings = columns
        .iter()
        .map(|AnswerColumn { heading, .. }| (&*heading.0, heading.1));
    book.sheet("sweep", &headings.collect::<Vec<_>>())?;
    for row in rows {
        book.row(
            row.iter().zip(columns).map(|(cell, column)| column.cell(cell)),
            false,
        )?;
    }
    workbook::scene(&mut book, scene)?;
    book.finish()
}

#[cfg(feature = "xlsx")]
impl AnswerColumn {
    /// The cell of a workbook, in the unit of the column.
    fn cell(&self, cell: &str) -> Cell {
        let number = |si: f64| self.unit.map_or(si, |unit| unit.of_si(si));
        match (&self.values, cell) {
            (_, "") => Cell::Absent,
            (AnswerValues::Texts(_), text) => Cell::Text(text.to_owned()),
            (AnswerValues::Flags(_), flag) => {
                Cell::Text(if flag == "true" { "yes" } else { "no" }.to_owned())
            }
            (_, si) => si.parse().map_or(Cell::Absent, |si| Cell::Number(number(si))),
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
