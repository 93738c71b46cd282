//! The rows of a sweep that is not finished, on disk, so that nothing is lost.
//!
//! A file beside the output: a remark that says which sweep it belongs to, then the table as far as
//! it is computed, in CSV. A row is written at once when it and all rows before it are done, so it
//! survives a killed process. The sweep goes on behind the last whole row.

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
    /// All rows in the file.
    pub rows: Vec<Row>,
}

impl Unfinished {
    /// Opens the rows of `sweep` for the table at `output`, or begins them.
    pub fn open(output: &Path, sweep: &Sweep, columns: &[AnswerColumn]) -> Result<Self, SweepError> {
        let mut path = output.as_os_str().to_owned();
        path.push(".unfinished");
        let path = PathBuf::from(path);
        let failed = SweepError::of_file(&path);
        let other = |what| Err(SweepError::OtherRows(path.display().to_string(), what));
        if fs::symlink_metadata(&path).is_ok_and(|found| !found.is_file()) {
            return other("a link or something that is no file");
        }
        let mut options = OpenOptions::new();
        let file = options.read(true).append(true).create(true).open(&path);
        let mut file = file.map_err(|source| OutputError::unwritable(&path, source))?;
        file.try_lock().map_err(|error| match error {
            TryLockError::WouldBlock => SweepError::Busy(path.display().to_string()),
            TryLockError::Error(source) => failed(source),
        })?;
        let mut text = Vec::new();
        file.read_to_end(&mut text).map_err(&failed)?;
        let remark = format!("# creepage sweep {:016x}, not finished\n", sweep.name());
        let names: Row = columns.iter().map(|column| &column.name).collect();
        let head = [remark.into_bytes(), line(&names).map_err(&failed)?].concat();
        let mut rows = Vec::new();
        if let Some(table) = text.strip_prefix(&*head) {
            let length;
            (rows, length) = whole_rows(table, sweep.count(), columns.len());
            file.set_len((head.len() + length) as u64).map_err(&failed)?;
        } else if head.starts_with(&text) {
            // One that was cut off so early has nothing to lose.
            let emptied = file.set_len(0);
            emptied.and_then(|()| file.write_all(&head)).map_err(&failed)?;
        } else {
            return other("something else, or the rows of another sweep");
        }
        let writer = csv::Writer::from_writer(file);
        Ok(Self { path, writer, rows })
    }

    /// Keeps a finished row.
    pub fn keep(&mut self, row: Row) -> Result<(), SweepError> {
        let written = self.writer.write_record(&row).map_err(io::Error::from);
        let written = written.and_then(|()| self.writer.flush());
        written.map_err(SweepError::of_file(&self.path))?;
        self.rows.push(row);
        Ok(())
    }

    /// Removes the file, once the output is in place, and returns its rows.
    pub fn remove(self) -> Result<Vec<Row>, SweepError> {
        fs::remove_file(&self.path).map_err(SweepError::of_file(&self.path))?;
        Ok(self.rows)
    }
}

fn line(row: &Row) -> io::Result<Vec<u8>> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    writer.write_record(row)?;
    let line = writer.into_inner();
    line.map_err(|error| io::Error::other(error.to_string()))
}

/// The whole rows of so many cells at the beginning of `table`, at most `count`, and their length in
/// bytes.
fn whole_rows(table: &[u8], count: usize, cells: usize) -> (Vec<Row>, usize) {
    let mut reader = csv::ReaderBuilder::new().has_headers(false).from_reader(table);
    let (mut rows, mut end) = (Vec::new(), 0);
    let mut row = Row::new();
    while rows.len() < count && reader.read_record(&mut row).unwrap_or(false) {
        let position = reader.position().byte() as usize;
        if row.len() != cells || !table[..position].ends_with(b"\n") {
            break;
        }
        rows.push(row.clone());
        end = position;
    }
    (rows, end)
}
