//! The finished table, as CSV or Parquet.

use std::fs::{self, File};
use std::io::{self, BufWriter};
use std::path::{Path, PathBuf};

use super::SweepError;

/// Kind of the table file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// Comma-separated text.
    Csv,
    /// Apache Parquet.
    #[cfg(feature = "parquet")]
    Parquet,
}

/// A column and what it holds.
pub struct Column {
    pub name: String,
    pub kind: Kind,
}

/// What a column holds; a value may be absent.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    Number,
    Count,
    Text,
}

/// One value of a row.
pub enum Cell<'a> {
    Number(Option<f64>),
    Count(Option<u64>),
    Text(Option<&'a str>),
}

/// Takes rows one after the other.
pub trait Sink {
    fn row(&mut self, cells: &[Cell]) -> io::Result<()>;
    fn finish(self: Box<Self>) -> io::Result<File>;
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

    fn sink(self, file: File, columns: &[Column]) -> io::Result<Box<dyn Sink>> {
        Ok(match self {
            Self::Csv => Box::new(Csv::new(file, columns)?),
            #[cfg(feature = "parquet")]
            Self::Parquet => Box::new(super::parquet::Parquet::new(file, columns)?),
        })
    }
}

/// Writes a table under another name and puts it in place when it is whole.
pub fn write(
    output: &Path,
    format: Format,
    columns: &[Column],
    rows: impl FnOnce(&mut dyn Sink) -> Result<(), SweepError>,
) -> Result<(), SweepError> {
    let partial = beside(output, "partial");
    let failed = |source| SweepError::File {
        file: partial.display().to_string(),
        source,
    };
    let mut sink = File::create(&partial)
        .and_then(|file| format.sink(file, columns))
        .map_err(failed)?;
    rows(&mut *sink)?;
    sink.finish().and_then(|file| file.sync_all()).map_err(failed)?;
    fs::rename(&partial, output).map_err(|source| SweepError::File {
        file: output.display().to_string(),
        source,
    })
}

/// The file's name with one more ending.
pub fn beside(output: &Path, ending: &str) -> PathBuf {
    let mut name = output.as_os_str().to_owned();
    name.push(".");
    name.push(ending);
    name.into()
}

struct Csv {
    writer: csv::Writer<BufWriter<File>>,
}

impl Csv {
    fn new(file: File, columns: &[Column]) -> io::Result<Self> {
        let mut writer = csv::Writer::from_writer(BufWriter::new(file));
        writer.write_record(columns.iter().map(|column| &column.name))?;
        Ok(Self { writer })
    }
}

impl Sink for Csv {
    fn row(&mut self, cells: &[Cell]) -> io::Result<()> {
        let text = |cell: &Cell| match cell {
            Cell::Number(Some(value)) => value.to_string(),
            Cell::Count(Some(value)) => value.to_string(),
            Cell::Text(Some(value)) => (*value).to_owned(),
            _ => String::new(),
        };
        Ok(self.writer.write_record(cells.iter().map(text))?)
    }

    fn finish(self: Box<Self>) -> io::Result<File> {
        let buffer = self
            .writer
            .into_inner()
            .map_err(|error| io::Error::other(error.to_string()))?;
        buffer.into_inner().map_err(io::IntoInnerError::into_error)
    }
}
