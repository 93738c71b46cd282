//! The rows of a sweep that is not finished, on disk, so that nothing is lost.
//!
//! A file beside the output: a remark that says which sweep it belongs to, then the table as far as
//! it is computed, in CSV. A row is written at once when it and all rows before it are done, so it
//! survives a killed process. The sweep goes on behind the last whole row.

use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::{Read, Write};
use std::path::{Path, PathBuf};

use serde_json::Value;

use super::columns::{AnswerColumn, row_of};
use super::error::SweepError;
use super::grid::Sweep;
use super::point::Row;
use super::table::texts;
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
        let failed = |source| SweepError::File(path.display().to_string(), source);
        let other = |what| Err(SweepError::OtherRows(path.display().to_string(), what));
        if fs::symlink_metadata(&path).is_ok_and(|found| !found.is_file()) {
            return other("a link or something that is no file");
        }
        let mut options = OpenOptions::new();
        let mut file = options
            .read(true)
            .append(true)
            .create(true)
            .open(&path)
            .map_err(|source| OutputError::unwritable(&path, source))?;
        file.try_lock().map_err(|error| match error {
            TryLockError::WouldBlock => SweepError::Busy(path.display().to_string()),
            TryLockError::Error(source) => failed(source),
        })?;
        let mut text = Vec::new();
        file.read_to_end(&mut text).map_err(failed)?;
        let head = head(sweep, columns).map_err(failed)?;
        let mut rows = Vec::new();
        if let Some(table) = text.strip_prefix(&*head) {
            let length;
            (rows, length) = read(table, sweep, columns);
            file.set_len((head.len() + length) as u64).map_err(failed)?;
        } else if head.starts_with(&text) {
            // One that was cut off so early has nothing to lose.
            file.set_len(0)
                .and_then(|()| file.write_all(&head))
                .map_err(failed)?;
        } else {
            return other("something else, or the rows of another sweep");
        }
        let writer = csv::Writer::from_writer(file);
        Ok(Self { path, writer, rows })
    }

    /// Keeps a finished row and its cells.
    pub fn keep(&mut self, row: Row, cells: &[Value]) -> Result<(), SweepError> {
        let written = self.writer.write_record(texts(cells)).map_err(Into::into);
        written
            .and_then(|()| self.writer.flush())
            .map_err(|source| SweepError::File(self.path.display().to_string(), source))?;
        self.rows.push(row);
        Ok(())
    }

    /// Removes the file, once the output is in place, and returns its rows.
    pub fn remove(self) -> Result<Vec<Row>, SweepError> {
        fs::remove_file(&self.path)
            .map_err(|source| SweepError::File(self.path.display().to_string(), source))?;
        Ok(self.rows)
    }
}

/// The first lines of the file: which sweep it is, and the names of the columns.
fn head(sweep: &Sweep, columns: &[AnswerColumn]) -> std::io::Result<Vec<u8>> {
    let remark = format!("# creepage sweep {:016x}, not finished\n", sweep.name());
    let mut writer = csv::Writer::from_writer(remark.into_bytes());
    writer.write_record(columns.iter().map(|column| &column.name))?;
    writer
        .into_inner()
        .map_err(|error| std::io::Error::other(error.to_string()))
}

/// The whole rows at the beginning of `table`, and their length in bytes.
fn read(table: &[u8], sweep: &Sweep, columns: &[AnswerColumn]) -> (Vec<Row>, usize) {
    let mut reader = csv::ReaderBuilder::new().has_headers(false).from_reader(table);
    let (mut rows, mut end) = (Vec::new(), 0);
    let mut record = csv::StringRecord::new();
    while rows.len() < sweep.count() && reader.read_record(&mut record).unwrap_or(false) {
        let position = reader.position().byte() as usize;
        let is_whole = record.len() == columns.len() && table[..position].ends_with(b"\n");
        let row = row_of(rows.len(), &record, columns);
        let Some(row) = row.filter(|_| is_whole) else {
            break;
        };
        rows.push(row);
        end = position;
    }
    (rows, end)
}
