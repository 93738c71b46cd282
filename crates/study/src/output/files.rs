//! The files that one command reads and writes.

use std::fs;
use std::path::{Path, PathBuf};

use super::error::OutputError;
use super::place::Place;
use super::target::Output;
use super::temporary::folder;

/// The files that a command reads and writes.
pub struct Files {
    read: Vec<PathBuf>,
    written: Vec<PathBuf>,
    force: bool,
}

impl Files {
    /// A command that reads the files at `paths`; `force` replaces files of any ending, but never one
    /// of these.
    pub fn reading<'p>(paths: impl IntoIterator<Item = &'p Path>, force: bool) -> Self {
        Self {
            read: paths.into_iter().map(Path::to_owned).collect(),
            written: Vec::new(),
            force,
        }
    }

    /// The output at `path`, which can be written. An older file there may be replaced if its name ends
    /// in `ending`. Nothing is changed yet.
    pub fn output(&mut self, path: &Path, ending: &'static str) -> Result<Output, OutputError> {
        let name = path.display().to_string();
        let place = Place::of(path).map_err(|source| OutputError::Unwritable(name.clone(), source))?;
        let output = Output::new(path, place, ending, self.force);
        let is_it = |other: &PathBuf| is_same(other, output.path());
        if self.read.iter().any(is_it) {
            return Err(OutputError::Taken(name, "is read by this command"));
        }
        if self.written.iter().any(is_it) {
            return Err(OutputError::Taken(name, "this command writes twice"));
        }
        output.check()?;
        self.written.push(output.path().to_owned());
        Ok(output)
    }
}

/// Whether two names are those of one file of a disk, also of one that is not there yet.
fn is_same(one: &Path, other: &Path) -> bool {
    #[cfg(unix)]
    if let (Ok(one), Ok(other)) = (fs::metadata(one), fs::metadata(other)) {
        use std::os::unix::fs::MetadataExt;
        return one.is_file() && (one.dev(), one.ino()) == (other.dev(), other.ino());
    }
    let past_links = |path: &Path| match path.canonicalize() {
        Ok(path) => Some(path),
        Err(_) => Some(folder(path).canonicalize().ok()?.join(path.file_name()?)),
    };
    past_links(one).is_some_and(|one| past_links(other) == Some(one))
}
