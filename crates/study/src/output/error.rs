//! What keeps a file from being written.

use std::io;
use std::path::Path;

/// Error of a file that is to be written.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum OutputError {
    /// The file of this name cannot be written, and why; found before anything is computed.
    #[error("{0}: cannot be written")]
    Unwritable(String, #[source] io::Error),
    /// The command reads the file of this name, or writes it already, in words.
    #[error("{0}: found a file which {1}; allowed: another file")]
    Taken(String, &'static str),
    /// There is a file of this name, which does not end as the output's does: with this, without a point.
    #[error(
        "{0}: found a file that would be lost; allowed: a new name, the name of a .{1} file, which is replaced, or --force to insist"
    )]
    OtherEnding(String, &'static str),
    /// Writing the file of this name broke off, and why.
    #[error("{0}: cannot be written")]
    Failed(String, #[source] io::Error),
}

impl OutputError {
    /// Writing `file` broke off.
    pub fn failed(file: &Path, source: io::Error) -> Self {
        Self::Failed(file.display().to_string(), source)
    }

    /// Whether the input is at fault, not the disk.
    pub fn is_bad_input(&self) -> bool {
        !matches!(self, Self::Failed(..))
    }
}
