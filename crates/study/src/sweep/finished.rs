//! The rows that are done, also on disk until the table is written, so that nothing is lost.
//!
//! A file beside the output: a remark that says which sweep it belongs to, then the rows in CSV, behind
//! the numbers of their points, in the order in which they were finished. A row is written as soon as
//! it is done, so it survives a killed process. The sweep goes on with the points that have no whole
//! row.

use std::collections::BTreeMap;
use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};

use super::columns::{AnswerColumn, Row};
use super::error::SweepError;
use super::grid::Sweep;
use crate::output::OutputError;

/// The rows that are done, by the numbers of their points.
#[derive(Default)]
pub struct Finished {
    pub rows: BTreeMap<usize, Row>,
    /// Where they are kept; nowhere else if there is none.
    file: Option<(PathBuf, csv::Writer<File>)>,
}

impl Finished {
    /// The rows of `sweep` that an earlier run has left beside the table at `output`, and where the
    /// others are going to be kept.
    pub fn beside(output: &Path, sweep: &Sweep, columns: &[AnswerColumn]) -> Result<Self, SweepError> {
        let mut path = output.as_os_str().to_owned();
        path.push(".unfinished");
        let path = PathBuf::from(path);
        let name = path.display().to_string();
        let failed = |source| SweepError::from(OutputError::failed(&path, source));
        if fs::symlink_metadata(&path).is_ok_and(|found| !found.is_file()) {
            return Err(SweepError::OtherRows(name, "a link or something that is no file"));
        }
        let file = OpenOptions::new()
            .read(true)
            .append(true)
            .create(true)
            .open(&path);
        let mut file = file.map_err(|source| OutputError::Unwritable(name.clone(), source))?;
        match file.try_lock() {
            Err(TryLockError::WouldBlock) => return Err(SweepError::Busy(name)),
            locked => locked.map_err(|error| failed(error.into()))?,
        }
        let mut text = Vec::new();
        file.read_to_end(&mut text).map_err(failed)?;
        let names: Vec<&str> = columns.iter().map(|column| &*column.name).collect();
        let (sweep_name, names) = (sweep.name(), names.join(","));
        let head = format!("# creepage sweep {sweep_name:016x}, not finished\npoint,{names}\n");
        let (rows, end) = match text.strip_prefix(head.as_bytes()) {
            Some(table) => {
                let (rows, length) = whole_rows(table, sweep.count(), columns.len());
                (rows, head.len() + length)
            }
            // One that was cut off so early has nothing to lose.
            None if head.as_bytes().starts_with(&text) => (BTreeMap::new(), 0),
            None => {
                let found = "something else, or the rows of another sweep";
                return Err(SweepError::OtherRows(name, found));
            }
        };
        file.set_len(end as u64).map_err(failed)?;
        if end == 0 {
            file.write_all(head.as_bytes()).map_err(failed)?;
        }
        let file = Some((path, csv::Writer::from_writer(file)));
        Ok(Self { rows, file })
    }

    /// Keeps the finished row of a point.
    pub fn keep(&mut self, point: usize, row: Row) -> Result<(), SweepError> {
        if let Some((path, writer)) = &mut self.file {
            let number = point.to_string();
            let written = writer.write_record(std::iter::once(&*number).chain(&row));
            let written = written.map_err(io::Error::from).and_then(|()| writer.flush());
            written.map_err(|source| OutputError::failed(path, source))?;
        }
        self.rows.insert(point, row);
        Ok(())
    }

    /// Removes the file, once the output is in place, and returns the rows.
    pub fn whole(self) -> Result<Vec<Row>, SweepError> {
        if let Some((path, _)) = &self.file {
            fs::remove_file(path).map_err(|source| OutputError::failed(path, source))?;
        }
        Ok(self.rows.into_values().collect())
    }
}

/// The whole rows of so many cells at the beginning of `table`, of `count` points, and their length
/// in bytes.
fn whole_rows(table: &[u8], count: usize, cells: usize) -> (BTreeMap<usize, Row>, usize) {
    let mut reader = csv::ReaderBuilder::new().has_headers(false).from_reader(table);
    let (mut rows, mut end) = (BTreeMap::new(), 0);
    let mut row = Row::new();
    while reader.read_record(&mut row).unwrap_or(false) {
        let position = reader.position().byte() as usize;
        let is_whole = row.len() == cells + 1 && table[..position].ends_with(b"\n");
        match row[0].parse() {
            Ok(point) if is_whole && point < count => rows.insert(point, row.iter().skip(1).collect()),
            _ => break,
        };
        end = position;
    }
    (rows, end)
}
