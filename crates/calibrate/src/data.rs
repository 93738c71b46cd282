//! Load-cell data from CSV: columns `pass,force_n[,sigma_n]`.
//!
//! The first line that is not a comment names the columns, in any order; where it holds numbers instead, the columns are taken in
//! the order above. Lines that begin with `#` and blank lines are skipped, as are rows without a force: a reading that failed. The
//! same pass may be read more than once, and rows may come in any order. Further columns are ignored.

use std::fs::File;
use std::io::Read;
use std::path::Path;

use csv::{ReaderBuilder, StringRecord, Trim};

const PASS: &str = "pass";
const FORCE: &str = "force_n";
const SIGMA: &str = "sigma_n";
/// A file larger than this \[bytes\] holds no readings: it is a million of them many times over.
const LARGEST_FILE: u64 = 64 << 20;
/// Longest text of a cell that a message repeats \[characters\].
const LONGEST_CELL: usize = 80;

/// A reading of the load cell.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reading {
    /// Number of the pass after which it was taken, from 1.
    pub pass: u64,
    /// Force \[N\], compression positive.
    pub force: f64,
    /// Its standard deviation \[N\], where the file gives it.
    pub sigma: Option<f64>,
    /// Line of the file, from 1.
    pub line: u64,
}

/// Readings of one load cell, in the order of the file.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Readings {
    file: String,
    list: Vec<Reading>,
    skipped: usize,
}

/// What is wrong with a data file, and where.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum DataError {
    /// The file cannot be read.
    #[error("{file}: cannot be read: {source}")]
    Unreadable {
        /// The file.
        file: String,
        /// Why.
        source: std::io::Error,
    },
    /// The file is far larger than any readings.
    #[error("{file}: found more than {allowed} bytes; allowed: a table of at most {allowed} bytes")]
    TooLarge {
        /// The file.
        file: String,
        /// Largest size allowed \[bytes\].
        allowed: u64,
    },
    /// The file is no CSV.
    #[error("{file}:{line}: not a table: {source}")]
    Table {
        /// The file.
        file: String,
        /// The line, 0 where it is not known.
        line: u64,
        /// Why.
        source: csv::Error,
    },
    /// The header lacks a column or names one twice.
    #[error(
        "{file}:{line}: {problem} column {column}; allowed: a header `pass,force_n` or `pass,force_n,sigma_n`"
    )]
    Column {
        /// The file.
        file: String,
        /// The line.
        line: u64,
        /// What is wrong with it: no such, or a second.
        problem: &'static str,
        /// The column.
        column: &'static str,
    },
    /// A cell does not hold what it should.
    #[error("{file}:{line}: {column}: found \"{found}\"; allowed: {allowed}")]
    Cell {
        /// The file.
        file: String,
        /// The line.
        line: u64,
        /// The column.
        column: &'static str,
        /// What was found.
        found: String,
        /// What is allowed.
        allowed: &'static str,
    },
    /// Some readings have a sigma and some have none.
    #[error("{file}:{line}: sigma_n is blank, but given for other readings; allowed: all or none")]
    SomeSigmas {
        /// The file.
        file: String,
        /// The first line without one.
        line: u64,
    },
    /// There is nothing in the file.
    #[error("{file}: no readings; allowed: a table with the columns pass,force_n[,sigma_n]")]
    Empty {
        /// The file.
        file: String,
    },
    /// Fewer readings than parameters.
    #[error(
        "{file}: {readings} readings, the last on line {line}; needed for {parameters} parameters: {needed}"
    )]
    TooFew {
        /// The file.
        file: String,
        /// Number of readings.
        readings: usize,
        /// Line of the last.
        line: u64,
        /// Parameters to be fitted.
        parameters: usize,
        /// Fewest readings.
        needed: usize,
    },
}

impl Readings {
    /// Reads the file at `path`.
    ///
    /// # Errors
    ///
    /// [`DataError`] with the first thing that is wrong, and its line.
    pub fn from_file(path: &Path) -> Result<Self, DataError> {
        let file = path.display().to_string();
        let mut bytes = Vec::new();
        // One byte more tells a file that is too large, without all of it.
        match File::open(path).and_then(|open| open.take(LARGEST_FILE + 1).read_to_end(&mut bytes)) {
            Ok(_) => Self::from_csv(&file, &bytes),
            Err(source) => Err(DataError::Unreadable { file, source }),
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
        // Spreadsheets begin UTF-8 with a byte order mark.
        let bytes = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes);
        let mut reader = ReaderBuilder::new()
            .has_headers(false)
            .flexible(true)
            .comment(Some(b'#'))
            .trim(Trim::All)
            .from_reader(bytes);
        let mut columns = None;
        let mut readings = Vec::new();
        let mut skipped = 0;
        for record in reader.records() {
            let record = record.map_err(|source| DataError::Table {
                file: file.to_owned(),
                line: source.position().map_or(0, csv::Position::line),
                source,
            })?;
            if record.iter().all(str::is_empty) || record[0].starts_with('#') {
                continue;
            }
            let row = Row {
                file,
                line: record.position().map_or(0, |position| line(bytes, position)),
                record: &record,
            };
            let columns = if let Some(columns) = columns {
                columns
            } else {
                let (found, is_header) = row.columns()?;
                columns = Some(found);
                if is_header {
                    continue;
                }
                found
            };
            match row.reading(columns)? {
                Some(reading) => readings.push(reading),
                None => skipped += 1,
            }
        }
        if readings.is_empty() {
            return Err(DataError::Empty {
                file: file.to_owned(),
            });
        }
        if readings.iter().any(|reading| reading.sigma.is_some())
            && let Some(bare) = readings.iter().find(|reading| reading.sigma.is_none())
        {
            return Err(DataError::SomeSigmas {
                file: file.to_owned(),
                line: bare.line,
            });
        }
        Ok(Self {
            file: file.to_owned(),
            list: readings,
            skipped,
        })
    }

    /// Makes sure that there are at least `needed` readings for so many parameters.
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

/// Where the columns stand.
#[derive(Debug, Clone, Copy)]
struct Columns {
    pass: usize,
    force: usize,
    sigma: Option<usize>,
}

struct Row<'a> {
    file: &'a str,
    line: u64,
    record: &'a StringRecord,
}

impl Row<'_> {
    /// The columns by this first row, and whether it is a header.
    fn columns(&self) -> Result<(Columns, bool), DataError> {
        if self.record.iter().take(2).all(|cell| cell.parse::<f64>().is_ok()) {
            let columns = Columns {
                pass: 0,
                force: 1,
                sigma: (self.record.len() > 2).then_some(2),
            };
            return Ok((columns, false));
        }
        let find = |column: &'static str| {
            let mut places = (0..self.record.len()).filter(|&i| self.record[i].eq_ignore_ascii_case(column));
            let place = places.next();
            if places.next().is_some() {
                return Err(self.column("a second", column));
            }
            Ok(place)
        };
        let missing = |column| self.column("no", column);
        let columns = Columns {
            pass: find(PASS)?.ok_or_else(|| missing(PASS))?,
            force: find(FORCE)?.ok_or_else(|| missing(FORCE))?,
            sigma: find(SIGMA)?,
        };
        Ok((columns, true))
    }

    fn column(&self, problem: &'static str, column: &'static str) -> DataError {
        DataError::Column {
            file: self.file.to_owned(),
            line: self.line,
            problem,
            column,
        }
    }

    fn cell(&self, place: usize) -> &str {
        self.record.get(place).unwrap_or("")
    }

    fn wrong(&self, column: &'static str, found: &str, allowed: &'static str) -> DataError {
        DataError::Cell {
            file: self.file.to_owned(),
            line: self.line,
            column,
            found: cut(found),
            allowed,
        }
    }

    /// The reading, `None` where the force is blank.
    fn reading(&self, columns: Columns) -> Result<Option<Reading>, DataError> {
        let found = self.cell(columns.force);
        if found.is_empty() {
            return Ok(None);
        }
        let force = finite(found).ok_or_else(|| self.wrong(FORCE, found, "a finite number of newtons"))?;
        let found = self.cell(columns.pass);
        // "12.0" is what a spreadsheet makes of 12.
        let pass = finite(found)
            .filter(|pass| pass.fract() == 0.0 && (1.0..=1e15).contains(pass))
            .ok_or_else(|| self.wrong(PASS, found, "a whole number from 1"))?;
        let found = columns.sigma.map_or("", |place| self.cell(place));
        let sigma = if found.is_empty() {
            None
        } else {
            let allowed = "a finite, positive number of newtons";
            let sigma = finite(found).filter(|sigma| *sigma > 0.0);
            Some(sigma.ok_or_else(|| self.wrong(SIGMA, found, allowed))?)
        };
        Ok(Some(Reading {
            pass: pass as u64,
            force,
            sigma,
            line: self.line,
        }))
    }
}

/// The text, as far as a message repeats it.
fn cut(text: &str) -> String {
    match text.char_indices().nth(LONGEST_CELL) {
        None => text.to_owned(),
        Some((end, _)) => format!("{}… ({} characters)", &text[..end], text.chars().count()),
    }
}

fn finite(text: &str) -> Option<f64> {
    text.parse().ok().filter(|value: &f64| value.is_finite())
}

/// The line of the record at `position`, which csv counts from the end of the record before: past comments and blank lines.
fn line(bytes: &[u8], position: &csv::Position) -> u64 {
    let rest = usize::try_from(position.byte())
        .ok()
        .and_then(|start| bytes.get(start..));
    let skipped = rest
        .unwrap_or_default()
        .split(|&byte| byte == b'\n')
        .take_while(|line| line.starts_with(b"#") || line.trim_ascii().is_empty())
        .count();
    position.line() + skipped as u64
}
