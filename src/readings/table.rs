//! Readings from CSV, each with its line.

use csv::{ReaderBuilder, StringRecord, Trim};

use super::error::DataError;
use crate::shown::shortened;

const PASS: &str = "pass";
const FORCE: &str = "force_n";
const SIGMA: &str = "sigma_n";
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

/// The readings of `file`, which holds these bytes, and the number of rows without a force.
pub fn read(file: &str, bytes: &[u8]) -> Result<(Vec<Reading>, usize), DataError> {
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
            source: source.into(),
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
    Ok((readings, skipped))
}

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
        let wrong = |problem, column| {
            let allowed = "a header `pass,force_n` or `pass,force_n,sigma_n`";
            self.wrong(format!("{problem} column {column}"), allowed)
        };
        let find = |column| {
            let mut places = (0..self.record.len()).filter(|&i| self.record[i].eq_ignore_ascii_case(column));
            let place = places.next();
            if places.next().is_some() {
                return Err(wrong("a second", column));
            }
            Ok(place)
        };
        let missing = |column| wrong("no", column);
        let columns = Columns {
            pass: find(PASS)?.ok_or_else(|| missing(PASS))?,
            force: find(FORCE)?.ok_or_else(|| missing(FORCE))?,
            sigma: find(SIGMA)?,
        };
        Ok((columns, true))
    }

    fn cell(&self, place: usize) -> &str {
        self.record.get(place).unwrap_or("")
    }

    fn wrong(&self, found: String, allowed: &'static str) -> DataError {
        DataError::Line {
            file: self.file.to_owned(),
            line: self.line,
            found,
            allowed,
        }
    }

    fn wrong_cell(&self, column: &str, found: &str, allowed: &'static str) -> DataError {
        let found = shortened(found, LONGEST_CELL);
        self.wrong(format!("{column}: found \"{found}\""), allowed)
    }

    /// The reading, `None` where the force is blank.
    fn reading(&self, columns: Columns) -> Result<Option<Reading>, DataError> {
        let found = self.cell(columns.force);
        if found.is_empty() {
            return Ok(None);
        }
        let force =
            finite(found).ok_or_else(|| self.wrong_cell(FORCE, found, "a finite number of newtons"))?;
        let found = self.cell(columns.pass);
        // "12.0" is what a spreadsheet makes of 12.
        let pass = finite(found)
            .filter(|pass| pass.fract() == 0.0 && (1.0..=1e15).contains(pass))
            .ok_or_else(|| self.wrong_cell(PASS, found, "a whole number from 1"))?;
        let found = columns.sigma.map_or("", |place| self.cell(place));
        let sigma = if found.is_empty() {
            None
        } else {
            let allowed = "a finite, positive number of newtons";
            let sigma = finite(found).filter(|sigma| *sigma > 0.0);
            Some(sigma.ok_or_else(|| self.wrong_cell(SIGMA, found, allowed))?)
        };
        Ok(Some(Reading {
            pass: pass as u64,
            force,
            sigma,
            line: self.line,
        }))
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
