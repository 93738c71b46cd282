//! Files that are written, and what keeps them from destroying others.
//!
//! A file is written beside its place under a name that nobody can guess, forced to the disk, and put in its place as a whole: what was
//! there before stays until then, also when the disk is full or the process is stopped. The permissions of what is replaced are kept,
//! and its owner where that is allowed. A symbolic link stays one, and what it points to is replaced. What is no file of a disk, such as
//! `/dev/stdout`, `/dev/null` or a named pipe, is written as it is.
//!
//! A file that the same command reads is never replaced, nor is a file written twice: files are told apart by what they are, not by what
//! they are called. A file of another kind is replaced only by force.
//!
//! Limits: another name of the replaced file (a hard link) keeps the old content. Nothing guards against someone who puts a file of
//! another kind there between the last look and the rename.

mod draft;
mod error;
mod identity;
mod kind;
mod place;
mod temporary;

use std::fs::{File, OpenOptions};
use std::io::{self, ErrorKind, Read};
use std::path::{Path, PathBuf};

pub(crate) use draft::Draft;
pub use error::OutputError;
use identity::Identity;
pub(crate) use kind::Kind;
use place::Place;
use temporary::Temporary;
#[cfg(feature = "cli")]
pub(crate) use temporary::remove_all;

/// Bytes of a file that tell its kind.
const HEAD: u64 = 1 << 16;

/// The files that one command reads and writes.
pub(crate) struct Files {
    read: Vec<Identity>,
    written: Vec<Identity>,
    force: bool,
}

/// A file that is going to be written.
#[derive(Debug, Clone)]
pub(crate) struct Output {
    /// As the user calls it.
    name: PathBuf,
    place: Place,
    kind: Kind,
    force: bool,
}

impl Files {
    /// A command that reads the files at `paths`; `force` replaces files of any kind, but never one of these.
    pub fn reading<'p>(paths: impl IntoIterator<Item = &'p Path>, force: bool) -> Self {
        Self {
            read: paths.into_iter().filter_map(Identity::of).collect(),
            written: Vec::new(),
            force,
        }
    }

    /// The output at `path`, which can be written and holds nothing that must not be lost. Nothing is changed yet.
    pub fn output(&mut self, path: &Path, kind: Kind) -> Result<Output, OutputError> {
        let place = Place::of(path).map_err(|source| OutputError::unwritable(path, source))?;
        let identity = match &place {
            Place::File(file) => Identity::of(file),
            // Standard output may have been led to a file.
            _ => Identity::of(path),
        };
        if let Some(identity) = identity {
            let file = || path.display().to_string();
            if self.read.iter().any(|read| read.is(&identity)) {
                return Err(OutputError::IsRead { file: file() });
            }
            if self.written.iter().any(|written| written.is(&identity)) {
                return Err(OutputError::IsWritten { file: file() });
            }
            self.written.push(identity);
        }
        let output = Output {
            name: path.to_owned(),
            place,
            kind,
            force: self.force,
        };
        output.check()?;
        Ok(output)
    }
}

impl Output {
    /// Makes sure that the place can be written and may be.
    fn check(&self) -> Result<(), OutputError> {
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
    fn check_kind(&self, file: &Path) -> Result<(), OutputError> {
        if self.force {
            return Ok(());
        }
        let mut head = Vec::new();
        let found = match File::open(file).and_then(|open| open.take(HEAD).read_to_end(&mut head)) {
            Ok(_) if head.is_empty() || self.kind.is_kind_of(&head) => return Ok(()),
            Ok(_) => kind::described(&head),
            // It was there a moment ago, or never was.
            Err(error) if error.kind() == ErrorKind::NotFound => return Ok(()),
            Err(_) => "a file that cannot be read",
        };
        Err(OutputError::OtherKind {
            file: self.name.display().to_string(),
            found,
            kind: self.kind.name(),
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

    /// Begins to write.
    pub fn begin(&self) -> Result<Draft, OutputError> {
        Draft::of(self)
    }

    /// Writes all of it: what `fill` writes stands there if it succeeds, and else what stood there before.
    #[cfg(feature = "cli")]
    pub fn write(&self, fill: impl FnOnce(&mut dyn io::Write) -> io::Result<()>) -> Result<(), OutputError> {
        let mut draft = self.begin()?;
        fill(&mut draft).map_err(|source| self.failed(source))?;
        draft.finish()
    }

    /// The error of writing.
    fn failed(&self, source: io::Error) -> OutputError {
        match self.place {
            Place::StandardOutput => OutputError::StandardOutput(source),
            _ => OutputError::Failed {
                file: self.name.display().to_string(),
                source,
            },
        }
    }
}
