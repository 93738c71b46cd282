//! Files under names that nobody can guess, until they take their places.

use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

use tempfile::{Builder, NamedTempFile};

/// All temporary files that this process ever made: what stops it removes those that are left.
static MADE: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

fn made() -> MutexGuard<'static, Vec<PathBuf>> {
    MADE.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Removes the temporary files of this process. While the answer is kept there are no new ones, and
/// none takes its place.
#[cfg(unix)]
#[must_use]
pub fn remove_all() -> impl Sized {
    let made = made();
    for path in made.iter() {
        let _ = fs::remove_file(path);
    }
    made
}

/// A new file in the folder of `target`, with the permissions of what is there already.
pub fn beside(target: &Path) -> io::Result<NamedTempFile> {
    let mut made = made();
    let old = fs::metadata(target).ok();
    // The target's own name may be too long to be made longer.
    let mut builder = Builder::new();
    builder.prefix(".creepage-").suffix(".partial").rand_bytes(12);
    // A new file has the permissions of the umask; one that gets those of an older file is its
    // owner's alone until then.
    #[cfg(unix)]
    if old.is_none() {
        use std::os::unix::fs::PermissionsExt;
        builder.permissions(fs::Permissions::from_mode(0o666));
    }
    let file = builder.tempfile_in(folder(target))?;
    made.push(file.path().to_owned());
    if let Some(old) = old {
        keep_owner(file.as_file(), &old);
        file.as_file().set_permissions(old.permissions())?;
    }
    Ok(file)
}

/// Puts `bytes` in the place of `target`, once all of them are on the disk.
pub fn replace(target: &Path, bytes: &[u8]) -> io::Result<()> {
    let mut file = beside(target)?;
    file.write_all(bytes)?;
    file.as_file().sync_all()?;
    {
        // Nothing removes it in the middle of this.
        let _made = made();
        file.persist(target)?;
    }
    // The name is on the disk as well, where folders can be forced there.
    if let Ok(folder) = File::open(folder(target)) {
        let _ = folder.sync_all();
    }
    Ok(())
}

/// The folder of a file.
pub fn folder(file: &Path) -> &Path {
    let folder = file.parent().filter(|folder| !folder.as_os_str().is_empty());
    folder.unwrap_or(Path::new("."))
}

/// Gives the file the owner and the group of the old one, as far as that is allowed.
fn keep_owner(file: &File, old: &fs::Metadata) {
    #[cfg(unix)]
    {
        use std::os::unix::fs::{MetadataExt, fchown};
        if fchown(file, Some(old.uid()), Some(old.gid())).is_err() {
            let _ = fchown(file, None, Some(old.gid()));
        }
    }
    #[cfg(not(unix))]
    let _ = (file, old);
}
