//! The finished table, as CSV or Parquet.

use std::io;
use std::path::{Path, PathBuf};

use super::error::SweepError;
use super::numbers::si;
use super::sink::{Cell, Column, Sink};
use crate::output::{Draft, Kind, Output};

/// Kind of the table file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// Comma-separated text.
    Csv,
    /// Apache Parquet.
    #[cfg(feature = "parquet")]
    Parquet,
}

impl Format {
    /// The format that the file's name asks for.
    pub fn of(file: &Path) -> Result<Self, SweepError> {
        let extension = file.extension().unwrap_or_default().to_ascii_lowercase();
        match extension.to_str() {
            Some("csv") => Ok(Self::Csv),
            #[cfg(feature = "parquet")]
            Some("parquet") => Ok(Self::Parquet),
            _ => Err(SweepError::Unfit {
                found: format!("the output {}", file.display()),
                allowed: if cfg!(feature = "parquet") {
                    "a file that ends in .csv or .parquet"
                } else {
                    "a file that ends in .csv: this program was built without Parquet"
                },
            }),
        }
    }

    /// What a file of this format is.
    pub fn kind(self) -> Kind {
        match self {
            Self::Csv => Kind::Sweep,
            #[cfg(feature = "parquet")]
            Self::Parquet => Kind::Parquet,
        }
    }

    fn sink(self, file: Draft, columns: &[Column]) -> io::Result<Box<dyn Sink>> {
        Ok(match self {
            Self::Csv => Box::new(Csv::new(file, columns)?),
            #[cfg(feature = "parquet")]
            Self::Parquet => Box::new(super::parquet::Parquet::new(file, columns)?),
        })
    }
}

/// What the name of an output asks for.
#[cfg(feature = "cli")]
pub fn kind_of(output: &Path) -> Result<Kind, SweepError> {
    Ok(Format::of(output)?.kind())
}

/// Writes a table, which comes into its place when it is whole.
pub fn write(
    output: &Output,
    format: Format,
    columns: &[Column],
    rows: impl FnOnce(&mut dyn Sink) -> Result<(), SweepError>,
) -> Result<(), SweepError> {
    let failed = |source| SweepError::File {
        file: output.path().display().to_string(),
        source,
    };
    let mut sink = format.sink(output.begin()?, columns).map_err(failed)?;
    rows(&mut *sink)?;
    Ok(sink.finish().map_err(failed)?.finish()?)
}

/// The file's name with one more ending.
pub fn beside(output: &Path, ending: &str) -> PathBuf {
    let mut name = output.as_os_str().to_owned();
    name.push(".");
    name.push(ending);
    name.into()
}

struct Csv {
    writer: csv::Writer<Draft>,
}

impl Csv {
    fn new(file: Draft, columns: &[Column]) -> io::Result<Self> {
        let mut writer = csv::Writer::from_writer(file);
        writer.write_record(columns.iter().map(|column| &column.name))?;
        Ok(Self { writer })
    }
}

impl Sink for Csv {
    fn row(&mut self, cells: &[Cell]) -> io::Result<()> {
        let text = |cell: &Cell| match cell {
            Cell::Number(Some(value)) => value.to_string(),
            Cell::Count(Some(value)) => value.to_string(),
            Cell::Text(Some(value)) => harmless(value),
            _ => String::new(),
        };
        Ok(self.writer.write_record(cells.iter().map(text))?)
    }

    fn finish(self: Box<Self>) -> io::Result<Draft> {
        self.writer
            .into_inner()
            .map_err(|error| io::Error::other(error.to_string()))
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
