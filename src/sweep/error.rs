//! What can go wrong in a sweep as a whole; what goes wrong at one point is recorded there.

use crate::SceneError;
use crate::output::OutputError;

/// Error of a sweep.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SweepError {
    /// The scene or a varied key is wrong at every point.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// A varied key is not written as it has to be.
    #[error("--vary {text}: found {found}; allowed: {allowed}")]
    Axis {
        /// As written.
        text: String,
        /// What was found.
        found: String,
        /// What is allowed.
        allowed: String,
    },
    /// Keys, samples or output do not fit together.
    #[error("found {found}; allowed: {allowed}")]
    Unfit {
        /// What was found.
        found: String,
        /// What is allowed.
        allowed: &'static str,
    },
    /// What stands at the journal's place beside the output is not the journal of this sweep.
    #[error(
        "{journal}: found {found}; allowed: the journal of this sweep, or none: remove it or name another output"
    )]
    OtherJournal {
        /// The journal.
        journal: String,
        /// What was found.
        found: &'static str,
    },
    /// The [`Progress`](crate::Progress) callback stopped the sweep. What is done is kept for the next run.
    #[error("stopped before it was done; the same sweep resumes where it was")]
    Stopped,
    /// Another process writes the same output.
    #[error("{journal}: another sweep is writing it")]
    Busy {
        /// The journal.
        journal: String,
    },
    /// The output cannot be written, or would replace what must not be lost.
    #[error(transparent)]
    Output(#[from] OutputError),
    /// A file cannot be written or read back.
    #[error("{file}: cannot be written or read")]
    File {
        /// The file.
        file: String,
        /// Why.
        source: std::io::Error,
    },
}

impl SweepError {
    /// Whether the input is at fault, not the computation.
    pub fn is_bad_input(&self) -> bool {
        match self {
            Self::Output(error) => error.is_bad_input(),
            Self::File { .. } | Self::Busy { .. } | Self::Stopped => false,
            _ => true,
        }
    }
}
