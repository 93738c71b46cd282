//! A file under a name that nobody can guess, until it takes its place.

use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

use tempfile::{Builder, NamedTempFile};

/// All temporary files of this process: what stops it removes them.
static LIVING: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

fn living() -> MutexGuard<'static, Vec<PathBuf>> {
    LIVING.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Removes the temporary files of this process. While the answer is kept there are no new ones, and none takes its place.
#[cfg(unix)]
#[must_use]
pub fn remove_all() -> impl Sized {
    let living = living();
    for path in living.iter() {
        let _ = fs::remove_file(path);
    }
    living
}

/// A temporary file, removed with this value.
pub struct Temporary {
    file: NamedTempFile,
    /// Goes after the file.
    listed: Listed,
}

struct Listed(PathBuf);

impl Drop for Listed {
    fn drop(&mut self) {
        living().retain(|path| *path != self.0);
    }
}

impl Temporary {
    /// A new file in the folder of `target`, with the permissions of what is there already.
    pub fn beside(target: &Path) -> io::Result<Self> {
        let mut living = living();
        let old = fs::metadata(target).ok();
        // The target's own name may be too long to be made longer.
        let mut builder = Builder::new();
        builder.prefix(".creepage-").suffix(".partial").rand_bytes(12);
        // A new file has the permissions of the umask; one that gets those of an older file is its owner's alone until then.
        #[cfg(unix)]
        if old.is_none() {
            use std::os::unix::fs::PermissionsExt;
            builder.permissions(fs::Permissions::from_mode(0o666));
        }
        let file = builder.tempfile_in(folder(target))?;
        if let Some(old) = old {
            keep_owner(file.as_file(), &old);
            file.as_file().set_permissions(old.permissions())?;
        }
        living.push(file.path().to_owned());
        let listed = Listed(file.path().to_owned());
        Ok(Self { file, listed })
    }

    /// What writes to it.
    pub fn writer(&self) -> io::Result<File> {
        self.file.as_file().try_clone()
    }

    /// Takes the place of `target`, with all its content on the disk.
    pub fn replace(self, target: &Path) -> io::Result<()> {
        self.file.as_file().sync_all()?;
        {
            // Nothing removes it in the middle of this.
            let _living = living();
            self.file.persist(target)?;
        }
        drop(self.listed);
        // The name is on the disk as well, where folders can be forced there.
        if let Ok(folder) = File::open(folder(target)) {
            let _ = folder.sync_all();
        }
        Ok(())
    }
}

fn folder(target: &Path) -> &Path {
    target
        .parent()
        .filter(|folder| !folder.as_os_str().is_empty())
        .unwrap_or(Path::new("."))
}

/// Gives the file the owner and the group of the old one, as far as that is allowed.
#[cfg(unix)]
fn keep_owner(file: &File, old: &fs::Metadata) {
    use std::os::unix::fs::{MetadataExt, fchown};
    if fchown(file, Some(old.uid()), Some(old.gid())).is_err() {
        let _ = fchown(file, None, Some(old.gid()));
    }
}

#[cfg(not(unix))]
fn keep_owner(_: &File, _: &fs::Metadata) {}
