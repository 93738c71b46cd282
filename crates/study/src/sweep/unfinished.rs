//! The rows of a sweep that is not finished, on disk, so that nothing is lost.
//!
//! A file beside the output: a remark that says which sweep it belongs to, then the rows that are
//! computed, in CSV, behind the number of their point. A row is written as soon as it is done, so it
//! survives a killed process. The sweep goes on with the points that have no whole row.

use std::collections::BTreeMap;
use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};

use super::columns::{AnswerColumn, Row};
use super::error::SweepError;
use super::grid::Sweep;
use crate::output::OutputError;

pub struct Unfinished {
    path: PathBuf,
    writer: csv::Writer<File>,
    /// All rows in the file, by their points.
    pub rows: BTreeMap<usize, Row>,
}

impl Unfinished {
    /// Opens the rows of `sweep` for the table at `output`, or begins them.
    pub fn open(output: &Path, sweep: &Sweep, columns: &[AnswerColumn]) -> Result<Self, SweepError> {
        let mut path = output.as_os_str().to_owned();
        path.push(".unfinished");
        let path = PathBuf::from(path);
        let name = path.display().to_string();
        let other = |what| Err(SweepError::OtherRows(name.clone(), what));
        if fs::symlink_metadata(&path).is_ok_and(|found| !found.is_file()) {
            return other("a link or something that is no file");
        }
        let mut options = OpenOptions::new();
        let file = options.read(true).append(true).create(true).open(&path);
        let mut file = file.map_err(|source| OutputError::unwritable(&path, source))?;
        file.try_lock().map_err(|error| match error {
            TryLockError::WouldBlock => SweepError::Busy(name.clone()),
            TryLockError::Error(source) => failed(&path, source),
        })?;
        let mut text = Vec::new();
        file.read_to_end(&mut text)
            .map_err(|source| failed(&path, source))?;
        let names: Vec<&str> = columns.iter().map(|column| &*column.name).collect();
        let (sweep_name, names) = (sweep.name(), names.join(","));
        let head = format!("# creepage sweep {sweep_name:016x}, not finished\npoint,{names}\n");
        let mut rows = BTreeMap::new();
        let whole = if let Some(table) = text.strip_prefix(head.as_bytes()) {
            let length;
            (rows, length) = whole_rows(table, sweep.count(), columns.len());
            file.set_len((head.len() + length) as u64)
        } else if head.as_bytes().starts_with(&text) {
            // One that was cut off so early has nothing to lose.
            let emptied = file.set_len(0);
            emptied.and_then(|()| file.write_all(head.as_bytes()))
        } else {
            return other("something else, or the rows of another sweep");
        };
        whole.map_err(|source| failed(&path, source))?;
        let writer = csv::Writer::from_writer(file);
        Ok(Self { path, writer, rows })
    }

    /// Keeps the finished row of a point.
    pub fn keep(&mut self, point: usize, row: Row) -> Result<(), SweepError> {
        let number = point.to_string();
        let cells = std::iter::once(&*number).chain(&row);
        let written = self.writer.write_record(cells).map_err(io::Error::from);
        let written = written.and_then(|()| self.writer.flush());
        written.map_err(|source| failed(&self.path, source))?;
        self.rows.insert(point, row);
        Ok(())
    }

    /// Removes the file, once the output is in place, and returns its rows.
    pub fn remove(self) -> Result<Vec<Row>, SweepError> {
        fs::remove_file(&self.path).map_err(|source| failed(&self.path, source))?;
        Ok(self.rows.into_values().collect())
    }
}

fn failed(path: &Path, source: io::Error) -> SweepError {
    OutputError::Failed(path.display().to_string(), source).into()
}

/// The whole rows of so many cells at the beginning of `table`, of `count` points, and their length
/// in bytes.
fn whole_rows(table: &[u8], count: usize, cells: usize) -> (BTreeMap<usize, Row>, usize) {
    let mut reader = csv::ReaderBuilder::new().has_headers(false).from_reader(table);
    let (mut rows, mut end) = (BTreeMap::new(), 0);
    let mut row = Row::new();
    while reader.read_record(&mut row).unwrap_or(false) {
        let position = reader.position().byte() as usize;
        let point = row.get(0).and_then(|point| point.parse().ok());
        let point = point.filter(|point| *point < count);
        let is_whole = row.len() == cells + 1 && table[..position].ends_with(b"\n");
        let Some(point) = point.filter(|_| is_whole) else {
            break;
        };
        rows.insert(point, row.iter().skip(1).collect());
        end = position;
    }
    (rows, end)
}
