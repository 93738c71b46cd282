//! One file that is going to be written.

use std::fs::{self, OpenOptions};
use std::io::{self, ErrorKind, Write};
use std::path::{Path, PathBuf};

use super::error::OutputError;
use super::place::Place;
use super::temporary;

/// A file to be written.
#[derive(Debug, Clone)]
pub struct Output {
    /// As the user calls it.
    name: PathBuf,
    place: Place,
    /// What the names of older files end in that it replaces.
    ending: &'static str,
    force: bool,
}

impl Output {
    pub(super) fn new(name: &Path, place: Place, ending: &'static str, force: bool) -> Self {
        Self {
            name: name.to_owned(),
            place,
            ending,
            force,
        }
    }

    /// Makes sure that the place can be written and may be.
    pub(super) fn check(&self) -> Result<(), OutputError> {
        let Place::File(file) = &self.place else {
            return Ok(());
        };
        self.check_ending(file)?;
        let is_writable = match OpenOptions::new().append(true).open(file) {
            Err(error) if error.kind() != ErrorKind::NotFound => Err(error),
            _ => temporary::beside(file).map(drop),
        };
        is_writable.map_err(|source| OutputError::Unwritable(self.name.display().to_string(), source))
    }

    /// Refuses to replace a file whose name ends otherwise, so that a slip of the name costs nobody's
    /// work.
    fn check_ending(&self, file: &Path) -> Result<(), OutputError> {
        let ending = file.extension().unwrap_or_default();
        if self.force || ending.eq_ignore_ascii_case(self.ending) || !file.exists() {
            return Ok(());
        }
        Err(OutputError::OtherEnding(file.display().to_string(), self.ending))
    }

    /// Where the content will stand, past all links; what is no file stays what it is called.
    pub fn path(&self) -> &Path {
        match &self.place {
            Place::File(file) => file,
            _ => &self.name,
        }
    }

    /// Whether this is standard output under another name.
    pub fn is_standard_output(&self) -> bool {
        matches!(self.place, Place::StandardOutput)
    }

    /// Writes all of it: it stands there as a whole, or else what stood there before.
    pub fn write(&self, bytes: &[u8]) -> Result<(), OutputError> {
        let written = match &self.place {
            Place::StandardOutput => io::stdout().write_all(bytes).and_then(|()| io::stdout().flush()),
            // What another program handed over goes on where it is.
            Place::Stream(path) => fs::File::options()
                .append(true)
                .open(path)
                .and_then(|mut out| out.write_all(bytes)),
            Place::File(path) => {
                // Hours may have gone by: what has come into its place meanwhile is kept too.
                self.check_ending(path)?;
                temporary::replace(path, bytes)
            }
        };
        written.map_err(|source| self.failed(source))
    }

    /// The error of content that cannot be made or written.
    pub fn failed(&self, source: io::Error) -> OutputError {
        OutputError::failed(&self.name, source)
    }
}
