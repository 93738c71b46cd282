//! Readings, in the order of their file.

use std::path::Path;

use creepage_tables::{Name, Names, Table};

use super::DataError;
use super::columns::is_header;
use super::options::ReadOptions;
use super::reading::Reading;
use super::rows;
use crate::scene::Dimension;

/// A file larger than this \[bytes\] holds no readings: it is a million of them many times over.
const LARGEST_FILE: u64 = 64 << 20;

/// Readings of one scene, in the order of the file.
///
/// ```
/// use creepage::Readings;
///
/// let readings = Readings::from_csv("cell.csv", b"pass,force_n\n1,113.4\n2,152.5\n")?;
/// assert_eq!(readings.values(), [113.4, 152.5]);
/// assert_eq!(readings.last_pass(), 2);
/// # Ok::<(), creepage::DataError>(())
/// ```
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Readings {
    file: String,
    list: Vec<Reading>,
    runs: Vec<String>,
    skipped: usize,
    notes: Vec<String>,
}

impl Readings {
    /// Reads the file at `path`, recognising how it is written.
    ///
    /// # Errors
    ///
    /// [`DataError`] with the first thing that is wrong, and its line.
    pub fn from_file(path: impl AsRef<Path>) -> Result<Self, DataError> {
        Self::from_file_with(path, &ReadOptions::default())
    }

    /// Reads the file at `path` as `options` say.
    ///
    /// # Errors
    ///
    /// As for [`Readings::from_file`].
    pub fn from_file_with(path: impl AsRef<Path>, options: &ReadOptions) -> Result<Self, DataError> {
        let is_header = |names: &[Name]| is_header(names, &options.columns);
        let names = Names {
            is_header: &is_header,
            unit: Dimension::unit_by_word,
        };
        let table = Table::from_file(path.as_ref(), LARGEST_FILE, &options.table, &names)?;
        Self::of(table, options)
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
        if bytes.len() as u64 > LARGEST_FILE {
            let (file, allowed) = (file.to_owned(), LARGEST_FILE);
            return Err(DataError::TooLarge { file, allowed });
        }
        let is_header = |names: &[Name]| is_header(names, &options.columns);
        let names = Names {
            is_header: &is_header,
            unit: Dimension::unit_by_word,
        };
        Self::of(Table::read(file, bytes, &options.table, &names)?, options)
    }

    fn of(mut table: Table, options: &ReadOptions) -> Result<Self, DataError> {
        let found = rows::read(&mut table, options)?;
        if found.readings.is_empty() {
            return Err(DataError::Empty(table.file));
        }
        if found.readings.iter().all(|reading| reading.passes == 0) {
            let line = found.readings[0].line;
            return Err(table.wrong(
                line,
                "pass: found \"0\" alone".into(),
                "readings after at least one pass",
            ));
        }
        let bare = found.readings.iter().find(|reading| reading.sigma.is_none());
        match bare.filter(|_| found.readings.iter().any(|reading| reading.sigma.is_some())) {
            Some(bare) => {
                let found = "sigma_n is blank, but given for other readings".into();
                Err(table.wrong(bare.line, found, "all or none"))
            }
            None => Ok(Self {
                file: table.file,
                list: found.readings,
                runs: found.runs,
                skipped: found.skipped,
                notes: found.notes,
            }),
        }
    }

    /// Makes sure that there are at least `needed` readings for this number of parameters.
    ///
    /// # Errors
    ///
    /// [`DataError::Line`].
    pub fn check_count(&self, parameters: usize, needed: usize) -> Result<(), DataError> {
        if self.list.len() >= needed {
            return Ok(());
        }
        Err(DataError::Line {
            file: self.file.clone(),
            line: self.list.last().map_or(0, |reading| reading.line),
            found: format!("{} readings", self.list.len()),
            allowed: format!("{needed} or more, needed for {parameters} parameters").into(),
        })
    }

    /// The readings, in the order of the file.
    pub fn readings(&self) -> &[Reading] {
        &self.list
    }

    /// Those of the readings that are to be kept.
    pub(crate) fn keep(&self, keep: impl Fn(&Reading) -> bool) -> Self {
        let mut kept = self.clone();
        kept.list.retain(keep);
        kept
    }

    /// The file's name.
    pub fn file(&self) -> &str {
        &self.file
    }

    /// Names of the runs; one without a name where the file tells none apart.
    pub fn runs(&self) -> &[String] {
        &self.runs
    }

    /// Rows or cells without a value.
    pub fn skipped(&self) -> usize {
        self.skipped
    }

    /// What the user should know of how the file was read.
    pub fn notes(&self) -> &[String] {
        &self.notes
    }

    /// Passes from a cable at rest to the last reading.
    pub fn last_pass(&self) -> u64 {
        self.list.iter().map(|reading| reading.passes).max().unwrap_or(0)
    }

    /// The values, forces in newtons.
    pub fn values(&self) -> Vec<f64> {
        self.list.iter().map(|reading| reading.value).collect()
    }

    /// The standard deviations, where the file gives them.
    pub fn sigmas(&self) -> Option<Vec<f64>> {
        self.list.iter().map(|reading| reading.sigma).collect()
    }
}

impl FromIterator<Reading> for Readings {
    fn from_iter<I: IntoIterator<Item = Reading>>(readings: I) -> Self {
        Self {
            file: "readings".into(),
            list: readings.into_iter().collect(),
            runs: vec![String::new()],
            ..Self::default()
        }
    }
}
