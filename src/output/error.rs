//! What keeps a file from being written.

use std::io;
use std::path::Path;

/// Error of a file that is to be written.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum OutputError {
    /// The place cannot be written; found before anything is computed.
    #[error("{file}: cannot be written")]
    Unwritable {
        /// The file.
        file: String,
        /// Why.
        source: io::Error,
    },
    /// The command reads this file, or writes it already.
    #[error("{file}: found a file which {how}; allowed: another file")]
    Taken {
        /// The file.
        file: String,
        /// What the command does with it.
        how: &'static str,
    },
    /// There is something that this command did not write.
    #[error(
        "{file}: found {found}, which would be lost; allowed: a new name, {kind} to replace, or --force to insist"
    )]
    OtherKind {
        /// The file.
        file: String,
        /// What it looks like.
        found: String,
        /// What would be replaced.
        kind: String,
    },
    /// Writing broke off.
    #[error("{file}: cannot be written")]
    Failed {
        /// The file.
        file: String,
        /// Why.
        source: io::Error,
    },
    /// Writing to standard output broke off.
    #[error("standard output: cannot be written")]
    StandardOutput(#[source] io::Error),
}

impl OutputError {
    pub(crate) fn unwritable(file: &Path, source: io::Error) -> Self {
        Self::Unwritable {
            file: file.display().to_string(),
            source,
        }
    }

    /// Whether the input is at fault, not the disk.
    pub fn is_bad_input(&self) -> bool {
        !matches!(self, Self::Failed { .. } | Self::StandardOutput(_))
    }
}
