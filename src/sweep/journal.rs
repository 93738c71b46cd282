//! What a sweep has done so far, on disk, so that nothing finished is lost.
//!
//! An append-only file of lines beside the output: one that says which sweep it belongs to, then one for every finished point in
//! the order in which they finished. A line is written at once when its point is done, so it survives a killed process; it is forced
//! to the disk every second, so it survives a loss of power. A line that was cut off fails its checksum and is dropped with what
//! follows it.

use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::{BufRead, BufReader, Read, Write};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use super::error::SweepError;
use super::row::Row;
use crate::output::OutputError;

const MAGIC: &str = "creepage sweep journal 2";
const FORCED_EVERY: Duration = Duration::from_secs(1);
/// No header is longer than this \[bytes\].
const LONGEST_HEADER: u64 = 256;

pub struct Journal {
    path: PathBuf,
    file: File,
    /// The points in the order of the grid, and how many are done.
    rows: Vec<Option<Row>>,
    done: usize,
    forced: Instant,
}

impl Journal {
    /// Opens the journal of the sweep `name` with `count` points, or begins it.
    pub fn open(path: PathBuf, name: u64, count: usize) -> Result<Self, SweepError> {
        let failed = |source| failed(&path, source);
        let name_of = || path.display().to_string();
        let other = || SweepError::OtherJournal(name_of(), "a link or something that is no file");
        if fs::symlink_metadata(&path).is_ok_and(|found| !found.is_file()) {
            return Err(other());
        }
        let file = OpenOptions::new()
            .read(true)
            .append(true)
            .create(true)
            .open(&path)
            .map_err(|source| OutputError::unwritable(&path, source))?;
        // A link that was put there in between led to another file.
        if !stands_at(&file, &path) {
            return Err(other());
        }
        match file.try_lock() {
            Ok(()) => {}
            Err(TryLockError::WouldBlock) => {
                return Err(SweepError::Busy(name_of()));
            }
            Err(TryLockError::Error(source)) => return Err(failed(source)),
        }
        let mut journal = Self {
            rows: vec![None; count],
            done: 0,
            forced: Instant::now(),
            path,
            file,
        };
        journal.read(name)?;
        Ok(journal)
    }

    /// Reads what is there, and leaves the file at the end of the last whole line.
    fn read(&mut self, name: u64) -> Result<(), SweepError> {
        let header = format!("{MAGIC} {name:016x} {}\n", self.rows.len());
        let failed = |source| failed(&self.path, source);
        let mut reader = BufReader::new(&self.file);
        let mut line = Vec::new();
        let mut first = reader.by_ref().take(LONGEST_HEADER);
        first.read_until(b'\n', &mut line).map_err(failed)?;
        if line != header.as_bytes() {
            // One that was cut off inside its first line has nothing to lose.
            if !header.as_bytes().starts_with(&line) {
                let found = if line.starts_with(MAGIC.as_bytes()) {
                    "the journal of another sweep"
                } else {
                    "something else"
                };
                return Err(SweepError::OtherJournal(self.path.display().to_string(), found));
            }
            self.file.set_len(0).map_err(failed)?;
            return self.file.write_all(header.as_bytes()).map_err(failed);
        }
        let mut end = header.len() as u64;
        loop {
            line.clear();
            let length = reader.read_until(b'\n', &mut line).map_err(failed)? as u64;
            let row = line
                .strip_suffix(b"\n")
                .and_then(|line| Row::of_line(str::from_utf8(line).ok()?))
                .filter(|row| row.index < self.rows.len());
            let Some(row) = row else { break };
            let index = row.index;
            self.done += usize::from(self.rows[index].replace(row).is_none());
            end += length;
        }
        self.file.set_len(end).map_err(failed)
    }

    pub fn done(&self) -> usize {
        self.done
    }

    pub fn finished(&self) -> Vec<bool> {
        self.rows.iter().map(Option::is_some).collect()
    }

    /// Keeps a finished point.
    pub fn append(&mut self, row: Row) -> Result<(), SweepError> {
        let failed = |source| failed(&self.path, source);
        let line = row.to_line().map_err(|error| failed(error.into()))? + "\n";
        self.file.write_all(line.as_bytes()).map_err(failed)?;
        if self.forced.elapsed() > FORCED_EVERY {
            self.file.sync_data().map_err(failed)?;
            self.forced = Instant::now();
        }
        let index = row.index;
        self.rows[index] = Some(row);
        self.done += 1;
        Ok(())
    }

    /// The finished points in the order of the grid.
    pub fn rows(&self) -> impl Iterator<Item = &Row> {
        self.rows.iter().flatten()
    }

    /// Forces all to the disk.
    pub fn force(&self) -> Result<(), SweepError> {
        self.file.sync_all().map_err(|source| failed(&self.path, source))
    }

    /// Removes the journal, once the output is in place.
    pub fn remove(self) -> Result<(), SweepError> {
        fs::remove_file(&self.path).map_err(|source| failed(&self.path, source))
    }
}

/// Whether the open file is the one at `path`, and no link leads there.
#[cfg(unix)]
fn stands_at(file: &File, path: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    match (file.metadata(), fs::symlink_metadata(path)) {
        (Ok(open), Ok(there)) => there.is_file() && (open.dev(), open.ino()) == (there.dev(), there.ino()),
        _ => false,
    }
}

#[cfg(not(unix))]
fn stands_at(_: &File, path: &Path) -> bool {
    fs::symlink_metadata(path).is_ok_and(|there| there.is_file())
}

fn failed(path: &Path, source: std::io::Error) -> SweepError {
    SweepError::File(path.display().to_string(), source)
}
