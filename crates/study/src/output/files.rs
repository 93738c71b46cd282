//! The files that one command reads and writes, and whether two names mean one of them.

use std::fs;
use std::path::{Path, PathBuf};

use super::error::OutputError;
use super::place::Place;
use super::target::Output;

/// The files that a command reads and writes.
pub struct Files {
    read: Vec<Identity>,
    written: Vec<Identity>,
    force: bool,
}

impl Files {
    /// A command that reads the files at `paths`; `force` replaces files of any ending, but never one of
    /// these.
    pub fn reading<'p>(paths: impl IntoIterator<Item = &'p Path>, force: bool) -> Self {
        Self {
            read: paths.into_iter().filter_map(Identity::of).collect(),
            written: Vec::new(),
            force,
        }
    }

    /// The output at `path`, which can be written. An older file there may be replaced if its name ends in
    /// `ending`. Nothing is changed yet.
    pub fn output(&mut self, path: &Path, ending: &'static str) -> Result<Output, OutputError> {
        let place = Place::of(path).map_err(|source| OutputError::unwritable(path, source))?;
        let identity = match &place {
            Place::File(file) => Identity::of(file),
            // Standard output may have been led to a file.
            _ => Identity::of(path),
        };
        if let Some(identity) = identity {
            let (known, file) = (|other: &Identity| other.is(&identity), path.display().to_string());
            if self.read.iter().any(known) {
                return Err(OutputError::Taken(file, "is read by this command"));
            }
            if self.written.iter().any(known) {
                return Err(OutputError::Taken(file, "this command writes twice"));
            }
            self.written.push(identity);
        }
        let output = Output {
            name: path.to_owned(),
            place,
            ending,
            force: self.force,
        };
        output.check()?;
        Ok(output)
    }
}

/// What makes a file this one, whatever it is called.
#[derive(Debug, Clone)]
struct Identity {
    /// Its name past all links.
    path: PathBuf,
    /// Device and number of the file, which hard links share.
    #[cfg(unix)]
    number: Option<(u64, u64)>,
}

impl Identity {
    /// The identity of a file, one that is not there yet included; `None` for what is no file of a disk.
    fn of(path: &Path) -> Option<Self> {
        let found = fs::metadata(path).ok();
        if found.as_ref().is_some_and(|found| !found.is_file()) {
            return None;
        }
        let canonical = path.canonicalize().or_else(|_| {
            let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
            let folder = folder.unwrap_or(Path::new(".")).canonicalize()?;
            Ok::<_, std::io::Error>(folder.join(path.file_name().unwrap_or_default()))
        });
        Some(Self {
            path: canonical.ok()?,
            #[cfg(unix)]
            number: found.map(|found| {
                use std::os::unix::fs::MetadataExt;
                (found.dev(), found.ino())
            }),
        })
    }

    fn is(&self, other: &Self) -> bool {
        #[cfg(unix)]
        if self.number.is_some() && self.number == other.number {
            return true;
        }
        self.path == other.path
    }
}
