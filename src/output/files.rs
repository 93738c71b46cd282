//! The files that one command reads and writes.

use std::path::Path;

use super::error::OutputError;
use super::identity::Identity;
use super::kind::Kind;
use super::place::Place;
use super::target::Output;

/// The files that one command reads and writes.
pub struct Files {
    read: Vec<Identity>,
    written: Vec<Identity>,
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
