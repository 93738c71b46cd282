//! What can go wrong in a sweep as a whole; what goes wrong at one point is recorded there.

use crate::output::OutputError;
use creepage_scene::SceneError;

/// Error of a sweep.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SweepError {
    /// The scene or a varied key is wrong at every point.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// A varied key is not written as it has to be, or keys, samples and output do not fit together.
    #[error("{argument}found {found}; allowed: {allowed}")]
    Invalid {
        /// The argument, or the file and the line, with a colon behind it; empty if it is none alone.
        argument: String,
        /// What was found.
        found: String,
        /// What is allowed.
        allowed: String,
    },
    /// A distribution in a cell of a table, or in the scene, is not written as it has to be.
    #[error("`{key}`: found {found}; allowed: {allowed}")]
    Cell {
        /// The column or the scene's key.
        key: String,
        /// What was found.
        found: String,
        /// What is allowed.
        allowed: &'static str,
    },
    /// The table of rows cannot be read, and why.
    #[error(transparent)]
    Rows(#[from] creepage_tables::TableError),
    /// What stands beside the output, in the place of rows that are done, is none of this sweep's:
    /// its name, and what it is.
    #[error("{0}: found {1}; allowed: rows of this sweep, or no such file: remove it or name another output")]
    OtherRows(String, &'static str),
    /// The [`Progress`](creepage_run::Progress) callback stopped the sweep. What is done is kept for the
    /// next run.
    #[error("stopped before it was done; the same sweep resumes where it was")]
    Stopped,
    /// Another process writes the same output, with these rows.
    #[error("{0}: another sweep is writing it")]
    Busy(String),
    /// The output cannot be written, or would replace what must not be lost.
    #[error(transparent)]
    Output(#[from] OutputError),
}

impl SweepError {
    pub(super) fn unfit(found: impl Into<String>, allowed: impl Into<String>) -> Self {
        Self::Invalid {
            argument: String::new(),
            found: found.into(),
            allowed: allowed.into(),
        }
    }

    /// The same of a table in `file`, whose header is on this line.
    pub(super) fn in_table(mut self, file: &str, line: u64) -> Self {
        if let Self::Invalid { argument, .. } = &mut self
            && argument.is_empty()
        {
            *argument = format!("{file}:{line}: ");
        }
        self
    }

    /// Whether the input is at fault, not the computation.
    pub fn is_bad_input(&self) -> bool {
        match self {
            Self::Output(error) => error.is_bad_input(),
            Self::Busy(_) | Self::Stopped => false,
            _ => true,
        }
    }
}
