//! Readings, in the order of their file.

use std::fs::File;
use std::io::Read;
use std::path::Path;

use super::error::DataError;
use super::table::{self, Reading};

/// A file larger than this \[bytes\] holds no readings: it is a million of them many times over.
const LARGEST_FILE: u64 = 64 << 20;

/// Readings of one load cell, in the order of the file.
///
/// ```
/// use creepage::Readings;
///
/// let readings = Readings::from_csv("cell.csv", b"pass,force_n\n1,113.4\n2,152.5\n")?;
/// assert_eq!(readings.forces(), [113.4, 152.5]);
/// assert_eq!(readings.last_pass(), 2);
/// # Ok::<(), creepage::DataError>(())
/// ```
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Readings {
    file: String,
    list: Vec<Reading>,
    skipped: usize,
}

impl Readings {
    /// Reads the file at `path`.
    ///
    /// # Errors
    ///
    /// [`DataError`] with the first thing that is wrong, and its line.
    pub fn from_file(path: impl AsRef<Path>) -> Result<Self, DataError> {
        let path = path.as_ref();
        let file = path.display().to_string();
        let mut bytes = Vec::new();
        // One byte more tells a file that is too large, without all of it.
        match File::open(path).and_then(|open| open.take(LARGEST_FILE + 1).read_to_end(&mut bytes)) {
            Ok(_) => Self::from_csv(&file, &bytes),
            Err(source) => Err(DataError::Unreadable(file, source)),
        }
    }

    /// Reads CSV from `bytes`; `file` stands for it in errors.
    ///
    /// # Errors
    ///
    /// As for [`Readings::from_file`].
    pub fn from_csv(file: &str, bytes: &[u8]) -> Result<Self, DataError> {
        if bytes.len() as u64 > LARGEST_FILE {
            return Err(DataError::TooLarge {
                file: file.to_owned(),
                allowed: LARGEST_FILE,
            });
        }
        let (list, skipped) = table::read(file, bytes)?;
        let file = file.to_owned();
        if list.is_empty() {
            return Err(DataError::Empty(file));
        }
        let bare = list.iter().find(|reading| reading.sigma.is_none());
        match bare.filter(|_| list.iter().any(|reading| reading.sigma.is_some())) {
            Some(bare) => Err(DataError::Line {
                file,
                line: bare.line,
                found: "sigma_n is blank, but given for other readings".into(),
                allowed: "all or none",
            }),
            None => Ok(Self { file, list, skipped }),
        }
    }

    /// Makes sure that there are at least `needed` readings for this number of parameters.
    ///
    /// # Errors
    ///
    /// [`DataError::TooFew`].
    pub fn check_count(&self, parameters: usize, needed: usize) -> Result<(), DataError> {
        if self.list.len() >= needed {
            return Ok(());
        }
        Err(DataError::TooFew {
            file: self.file.clone(),
            readings: self.list.len(),
            line: self.list.last().map_or(0, |reading| reading.line),
            parameters,
            needed,
        })
    }

    /// The readings, in the order of the file.
    pub fn readings(&self) -> &[Reading] {
        &self.list
    }

    /// Rows without a force.
    pub fn skipped(&self) -> usize {
        self.skipped
    }

    /// The last pass that was read.
    pub fn last_pass(&self) -> u64 {
        self.list.iter().map(|reading| reading.pass).max().unwrap_or(0)
    }

    /// The forces \[N\].
    pub fn forces(&self) -> Vec<f64> {
        self.list.iter().map(|reading| reading.force).collect()
    }

    /// The standard deviations \[N\], where the file gives them.
    pub fn sigmas(&self) -> Option<Vec<f64>> {
        self.list.iter().map(|reading| reading.sigma).collect()
    }
}

impl FromIterator<Reading> for Readings {
    fn from_iter<I: IntoIterator<Item = Reading>>(readings: I) -> Self {
        Self {
            file: "readings".into(),
            list: readings.into_iter().collect(),
            skipped: 0,
        }
    }
}
