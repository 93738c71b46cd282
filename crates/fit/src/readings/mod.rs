//! Readings of load cells and other instruments, from the tables that they write.
//!
//! [`creepage_tables`] reads text and workbooks. The first row that names a pass, or vehicles
//! counted since the row before, and something measured is the header; names are words of several
//! languages: `pass,force_n[,sigma_n]`, `Überfahrt;Kraft [kN]`. Where the first row holds numbers
//! instead, the columns are pass, force in newtons and standard deviation. Lines that begin with
//! `#` and blank lines are skipped, as are cells without a value: a reading that failed. The same
//! pass may be read more than once, and rows may come in any order.
//!
//! A column of runs, or passes that begin anew, make several series of one file: see [`RunStart`].

mod columns;
mod kinds;
mod options;
mod reading;
mod rows;
mod runs;
mod vehicles;

use std::path::Path;

use creepage_tables::Table;

pub use creepage_tables::{Options as TableOptions, TableError as DataError};
pub use options::{ReadOptions, RunStart};
pub(crate) use reading::Instrument;
pub use reading::{Measured, Place, Reading};

/// Readings of one scene.
///
/// ```
/// use creepage_fit::readings::Readings;
///
/// let readings = Readings::from_csv("cell.csv", b"pass,force_n\n1,113.4\n2,152.5\n")?;
/// assert_eq!(readings.list[0].value, 113.4);
/// assert_eq!(readings.last_pass(), 2);
/// # Ok::<(), creepage_fit::readings::DataError>(())
/// ```
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Readings {
    /// The readings, in the order of the file.
    pub list: Vec<Reading>,
    /// Names of the runs; one without a name where the file tells none apart.
    pub runs: Vec<String>,
    /// What the user should know of how the file was read.
    pub notes: Vec<String>,
}

impl Readings {
    /// Reads the file at `path` as `options` say.
    ///
    /// # Errors
    ///
    /// [`DataError`] with the first thing that is wrong, and its line.
    pub fn from_file(path: impl AsRef<Path>, options: &ReadOptions) -> Result<Self, DataError> {
        let table = Table::from_file(path.as_ref(), &options.table, &kinds::LAYOUT)?;
        columns::columns(table, options)?.readings()
    }

    /// Reads a table from `bytes`, recognising how it is written; `file` stands for it in errors.
    ///
    /// # Errors
    ///
    /// As for [`Readings::from_file`].
    pub fn from_csv(file: &str, bytes: &[u8]) -> Result<Self, DataError> {
        Self::from_bytes(file, bytes, &ReadOptions::default())
    }

    /// Reads a table or a workbook from `bytes` as `options` say; `file` stands for it in errors.
    ///
    /// # Errors
    ///
    /// As for [`Readings::from_file`].
    pub fn from_bytes(file: &str, bytes: &[u8], options: &ReadOptions) -> Result<Self, DataError> {
        let table = Table::read(file, bytes, &options.table, &kinds::LAYOUT)?;
        columns::columns(table, options)?.readings()
    }

    /// Passes from a cable at rest to the last reading.
    pub fn last_pass(&self) -> u64 {
        self.list.iter().map(|reading| reading.passes).max().unwrap_or(0)
    }
}

impl FromIterator<Reading> for Readings {
    fn from_iter<I: IntoIterator<Item = Reading>>(readings: I) -> Self {
        Self {
            list: readings.into_iter().collect(),
            runs: vec![String::new()],
            notes: Vec::new(),
        }
    }
}
