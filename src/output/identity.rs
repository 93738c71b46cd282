//! Whether two names mean one file.

use std::fs;
use std::path::{Path, PathBuf};

/// What makes a file this one, whatever it is called.
#[derive(Debug, Clone)]
pub struct Identity {
    /// Its name past all links.
    path: PathBuf,
    /// Device and number of the file, which hard links share.
    #[cfg(unix)]
    number: Option<(u64, u64)>,
}

impl Identity {
    /// The identity of a file, one that is not there yet included; `None` for what is no file of a disk.
    pub fn of(path: &Path) -> Option<Self> {
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

    /// Whether both are one file.
    pub fn is(&self, other: &Self) -> bool {
        #[cfg(unix)]
        if self.number.is_some() && self.number == other.number {
            return true;
        }
        self.path == other.path
    }
}
