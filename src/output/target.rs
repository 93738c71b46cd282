//! One file that is going to be written.

use std::fs::{File, OpenOptions};
use std::io::{self, ErrorKind, Read};
use std::path::{Path, PathBuf};

use super::error::OutputError;
use super::kind::{Kind, described};
use super::place::Place;
use super::temporary::Temporary;

/// Bytes at the beginning of a file that show its kind.
const HEAD: u64 = 1 << 16;

/// A file that is going to be written.
#[derive(Debug, Clone)]
pub struct Output {
    /// As the user calls it.
    pub(super) name: PathBuf,
    pub(super) place: Place,
    pub(super) kind: Kind,
    pub(super) force: bool,
}

impl Output {
    /// Makes sure that the place can be written and may be.
    pub fn check(&self) -> Result<(), OutputError> {
        let Place::File(file) = &self.place else {
            return Ok(());
        };
        let unwritable = |source| OutputError::unwritable(&self.name, source);
        match OpenOptions::new().append(true).open(file) {
            Ok(_) => self.check_kind(file)?,
            Err(error) if error.kind() == ErrorKind::NotFound => {}
            Err(error) => return Err(unwritable(error)),
        }
        Temporary::beside(file).map(drop).map_err(unwritable)
    }

    /// Refuses what would be lost.
    pub fn check_kind(&self, file: &Path) -> Result<(), OutputError> {
        if self.force {
            return Ok(());
        }
        let mut head = Vec::new();
        let found = match File::open(file).and_then(|open| open.take(HEAD).read_to_end(&mut head)) {
            Ok(_) if head.is_empty() || self.kind.is_kind_of(&head) => return Ok(()),
            Ok(_) => described(&head),
            // It was there a moment ago, or never was.
            Err(error) if error.kind() == ErrorKind::NotFound => return Ok(()),
            Err(_) => "a file that cannot be read".to_owned(),
        };
        Err(OutputError::OtherKind {
            file: self.name.display().to_string(),
            found,
            kind: self.kind.older(),
        })
    }

    /// Where the content will stand, past all links; what is no file stays what it is called.
    pub fn path(&self) -> &Path {
        match &self.place {
            Place::File(file) => file,
            _ => &self.name,
        }
    }

    /// Whether this is standard output under another name.
    #[cfg(feature = "cli")]
    pub fn is_standard_output(&self) -> bool {
        matches!(self.place, Place::StandardOutput)
    }

    /// The error of writing.
    pub fn failed(&self, source: io::Error) -> OutputError {
        match self.place {
            Place::StandardOutput => OutputError::StandardOutput(source),
            _ => OutputError::Failed {
                file: self.name.display().to_string(),
                source,
            },
        }
    }
}
