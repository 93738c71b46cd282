//! What a sweep has done so far, on disk, so that nothing finished is lost.
//!
//! An append-only file of lines beside the output: one that says which sweep it belongs to, then one for every finished point in
//! the order in which they finished. A line is written at once when its point is done, which a killed process survives, and forced
//! to the disk every second, which a machine that loses power survives. A line that was cut off fails its checksum and is dropped
//! with what follows it. In memory there are eight bytes for a point: where its line begins.

use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::{BufRead, BufReader, ErrorKind, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use super::SweepError;
use super::row::Row;

const MAGIC: &str = "creepage sweep journal 1";
const ABSENT: u64 = u64::MAX;
const FORCED_EVERY: Duration = Duration::from_secs(1);
/// A header longer than this \[bytes\] is none.
const LONGEST_HEADER: u64 = 256;

/// The journal of a sweep.
pub struct Journal {
    path: PathBuf,
    file: File,
    /// Where each point's line begins.
    lines: Vec<u64>,
    end: u64,
    done: usize,
    forced: Instant,
}

impl Journal {
    /// Opens the journal of the sweep `name` with `count` points, or begins it.
    pub fn open(path: PathBuf, name: u64, count: usize) -> Result<Self, SweepError> {
        let failed = |source| failed(&path, source);
        let other = || SweepError::NoJournal {
            journal: path.display().to_string(),
        };
        if fs::symlink_metadata(&path).is_ok_and(|found| !found.is_file()) {
            return Err(other());
        }
        let file = OpenOptions::new()
            .read(true)
            .append(true)
            .create(true)
            .open(&path)
            .map_err(|source| SweepError::Unwritable {
                journal: path.display().to_string(),
                source,
            })?;
        // A link that was put there in between led to another file.
        if !stands_at(&file, &path) {
            return Err(other());
        }
        match file.try_lock() {
            Ok(()) => {}
            Err(TryLockError::WouldBlock) => {
                return Err(SweepError::Busy {
                    journal: path.display().to_string(),
                });
            }
            Err(TryLockError::Error(source)) => return Err(failed(source)),
        }
        let mut journal = Self {
            lines: vec![ABSENT; count],
            end: 0,
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
        let header = format!("{MAGIC} {name:016x} {}\n", self.lines.len());
        let failed = |source| failed(&self.path, source);
        let mut reader = BufReader::new(&self.file);
        let mut line = Vec::new();
        reader
            .by_ref()
            .take(LONGEST_HEADER)
            .read_until(b'\n', &mut line)
            .map_err(failed)?;
        if line != header.as_bytes() {
            // One that was cut off inside its first line has nothing to lose.
            if !header.as_bytes().starts_with(&line) {
                let other = if line.starts_with(MAGIC.as_bytes()) {
                    "another sweep"
                } else {
                    "something else"
                };
                return Err(SweepError::OtherJournal {
                    journal: self.path.display().to_string(),
                    found: other,
                });
            }
            self.file.set_len(0).map_err(failed)?;
            self.file.write_all(header.as_bytes()).map_err(failed)?;
            self.end = header.len() as u64;
            return Ok(());
        }
        let mut end = header.len() as u64;
        loop {
            line.clear();
            let length = reader.read_until(b'\n', &mut line).map_err(failed)? as u64;
            let row = line
                .strip_suffix(b"\n")
                .and_then(|line| Row::of_line(str::from_utf8(line).ok()?))
                .filter(|row| row.index < self.lines.len());
            let Some(row) = row else { break };
            if self.lines[row.index] == ABSENT {
                self.done += 1;
            }
            self.lines[row.index] = end;
            end += length;
        }
        self.file.set_len(end).map_err(failed)?;
        self.end = end;
        Ok(())
    }

    /// How many points are done.
    pub fn done(&self) -> usize {
        self.done
    }

    /// Which points are done.
    pub fn finished(&self) -> Vec<bool> {
        self.lines.iter().map(|&line| line != ABSENT).collect()
    }

    /// Keeps a finished point.
    pub fn append(&mut self, row: &Row) -> Result<(), SweepError> {
        let line = row.to_line() + "\n";
        let failed = |source| failed(&self.path, source);
        self.file.write_all(line.as_bytes()).map_err(failed)?;
        if self.forced.elapsed() > FORCED_EVERY {
            self.file.sync_data().map_err(failed)?;
            self.forced = Instant::now();
        }
        self.lines[row.index] = self.end;
        self.end += line.len() as u64;
        self.done += 1;
        Ok(())
    }

    /// Calls `each` with every finished point in the order of the grid.
    pub fn in_order(&self, mut each: impl FnMut(Row) -> Result<(), SweepError>) -> Result<(), SweepError> {
        let failed = |source| failed(&self.path, source);
        let mut reader = BufReader::new(&self.file);
        let mut at = reader.seek(SeekFrom::Start(0)).map_err(failed)?;
        let mut line = String::new();
        for &start in self.lines.iter().filter(|&&start| start != ABSENT) {
            // Points finish nearly in the order of the grid: most of these steps stay within what was read.
            reader.seek_relative(start as i64 - at as i64).map_err(failed)?;
            line.clear();
            at = start + reader.read_line(&mut line).map_err(failed)? as u64;
            let changed = || {
                failed(std::io::Error::new(
                    ErrorKind::InvalidData,
                    "changed while in use",
                ))
            };
            each(Row::of_line(line.trim_end_matches('\n')).ok_or_else(changed)?)?;
        }
        Ok(())
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
    SweepError::File {
        file: path.display().to_string(),
        source,
    }
}
