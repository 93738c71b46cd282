//! What a name leads to.

use std::fs;
use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};

/// More links than that lead round in a circle.
const MAX_LINKS: usize = 40;
/// Number of the descriptor of standard output.
const STANDARD_OUTPUT: u32 = 1;

/// Where content goes.
#[derive(Debug, Clone)]
pub enum Place {
    /// A file past all links, or the name of a new one.
    File(PathBuf),
    /// A device, a named pipe, or an open file that another program handed over: written as it is.
    Stream(PathBuf),
    /// Where the answers go too.
    StandardOutput,
}

impl Place {
    /// Follows the links at `path`.
    pub fn of(path: &Path) -> io::Result<Self> {
        let refused = |reason: &str| Err(io::Error::new(ErrorKind::InvalidInput, reason));
        let mut at = path.to_owned();
        for _ in 0..MAX_LINKS {
            match descriptor(&at) {
                Some(STANDARD_OUTPUT) => return Ok(Self::StandardOutput),
                Some(_) => return Ok(Self::Stream(path.to_owned())),
                None => {}
            }
            // A link counts from the folder in which it lies.
            let Ok(link) = fs::read_link(&at) else { break };
            at = at.parent().unwrap_or(Path::new("")).join(link);
        }
        match fs::metadata(&at) {
            Ok(found) if found.is_file() => Ok(Self::File(at)),
            Ok(found) if found.is_dir() => refused("it is a folder"),
            Ok(found) if is_stream(found.file_type()) => Ok(Self::Stream(at)),
            Ok(_) => refused("it is not a file"),
            // To join nothing adds a separator, unless there is one at the end.
            Err(error) if error.kind() == ErrorKind::NotFound => {
                if at.join("").as_os_str() == at.as_os_str() {
                    refused("it is not the name of a file")
                } else {
                    Ok(Self::File(at))
                }
            }
            Err(error) => Err(error),
        }
    }
}

/// The number of one of this process's open files, which `/dev/stdout`, `/dev/fd/3` and
/// `/proc/self/fd/3` are links to.
fn descriptor(path: &Path) -> Option<u32> {
    let number = path.file_name()?.to_str()?.parse().ok()?;
    let folder = path.parent()?.canonicalize().ok()?;
    let own = format!("/proc/{}/fd", std::process::id());
    (folder == Path::new(&own) || folder == Path::new("/dev/fd")).then_some(number)
}

/// Whether this takes what is written and has nothing to lose. A disk as a whole has.
fn is_stream(kind: fs::FileType) -> bool {
    #[cfg(unix)]
    {
        use std::os::unix::fs::FileTypeExt;
        kind.is_char_device() || kind.is_fifo()
    }
    #[cfg(not(unix))]
    {
        let _ = kind;
        false
    }
}
