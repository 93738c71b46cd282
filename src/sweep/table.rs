//! The finished table, as CSV or a workbook.

use std::io;
use std::path::Path;

use super::error::SweepError;
use super::numbers::si;
use super::sink::{Cell, Column, Sink};
use crate::SceneFile;
use crate::output::Draft;

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

    /// Most rows that a table of this format holds.
    pub fn most_rows(self) -> usize {
        match self {
            #[cfg(feature = "xlsx")]
            Self::Xlsx => super::xlsx::MOST_ROWS,
            _ => usize::MAX,
        }
    }

    #[cfg_attr(
        not(feature = "xlsx"),
        allow(unused_variables, reason = "only a workbook holds the scene")
    )]
    pub fn sink(self, file: Draft, columns: &[Column], scene: &SceneFile) -> io::Result<Box<dyn Sink>> {
        Ok(match self {
            Self::Csv => {
                let mut writer = csv::Writer::from_writer(file);
                writer.write_record(columns.iter().map(|column| &column.name))?;
                Box::new(writer)
            }
            #[cfg(feature = "xlsx")]
            Self::Xlsx => Box::new(super::xlsx::Xlsx::new(file, columns, scene)?),
        })
    }
}

impl Sink for csv::Writer<Draft> {
    fn row(&mut self, cells: Vec<Cell>) -> io::Result<()> {
        let text = |cell| match cell {
            Cell::Absent => String::new(),
            Cell::Number(value) => value.to_string(),
            Cell::Count(value) => value.to_string(),
            Cell::Text(value) => harmless(&value),
        };
        Ok(self.write_record(cells.into_iter().map(text))?)
    }

    fn finish(self: Box<Self>) -> io::Result<Draft> {
        let draft = self.into_inner();
        draft.map_err(|error| io::Error::other(error.to_string()))
    }
}

/// A text that no spreadsheet takes for a formula: an apostrophe goes before what would begin one, unless it is a number.
fn harmless(text: &str) -> String {
    if text.starts_with(['=', '+', '-', '@', '\t', '\r']) && si(text).is_none() {
        format!("'{text}")
    } else {
        text.to_owned()
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
