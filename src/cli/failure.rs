//! What keeps a command from finishing, what is printed then, and the exit status.

use std::io::{self, Write};
use std::process::ExitCode;

use super::terminal;
use crate::output::OutputError;

#[derive(Debug, thiserror::Error)]
pub enum Failure {
    #[error(transparent)]
    Analysis(#[from] crate::Error),
    #[error(transparent)]
    Sweep(#[from] crate::sweep::SweepError),
    #[error("the figure cannot be drawn")]
    Figure(#[from] crate::figure::FigureError),
    #[error(transparent)]
    Design(#[from] crate::design::DesignError),
    #[error("{0}")]
    NotKept(String),
    #[error("{0}")]
    Exceeded(String),
    #[error("no point of the sweep has an answer")]
    Nothing,
    #[error("{argument}: found {found}; allowed: {allowed}")]
    Usage {
        argument: &'static str,
        found: String,
        allowed: String,
    },
    #[error(transparent)]
    File(#[from] OutputError),
    #[error("standard output: cannot be written")]
    Output(#[from] io::Error),
}

impl From<crate::SceneError> for Failure {
    fn from(error: crate::SceneError) -> Self {
        Self::Analysis(error.into())
    }
}

impl Failure {
    /// An argument that cannot be used as it was found.
    pub fn usage(argument: &'static str, found: impl Into<String>, allowed: impl Into<String>) -> Self {
        let (found, allowed) = (found.into(), allowed.into());
        Self::Usage {
            argument,
            found,
            allowed,
        }
    }

    /// Prints the failure; its exit status.
    fn end(&self) -> ExitCode {
        if self.reader_has_left() {
            return ExitCode::SUCCESS;
        }
        terminal::fail(self);
        ExitCode::from(match self {
            Self::Exceeded(_) => 3,
            failure if failure.is_bad_input() => 2,
            _ => 1,
        })
    }

    /// Whether the reader of a pipe has gone: it has what it wanted.
    fn reader_has_left(&self) -> bool {
        match self {
            Self::Output(error) | Self::File(OutputError::Failed(_, error)) => {
                error.kind() == io::ErrorKind::BrokenPipe
            }
            _ => false,
        }
    }

    fn is_bad_input(&self) -> bool {
        match self {
            Self::Usage { .. } => true,
            Self::File(error) => error.is_bad_input(),
            Self::Design(error) => error.is_bad_input(),
            Self::Sweep(error) => error.is_bad_input(),
            Self::Analysis(error) => error.is_bad_input(),
            _ => false,
        }
    }
}

/// The exit status of a command.
pub fn status(done: Result<(), Failure>) -> ExitCode {
    done.map_or_else(|failure| failure.end(), |()| ExitCode::SUCCESS)
}

/// Prints help, or what is wrong with the arguments; the exit status.
pub fn unparsed(error: &clap::Error) -> ExitCode {
    if !error.use_stderr() {
        return status(error.print().map_err(Failure::from));
    }
    let text = error.render().to_string();
    let mut arguments = std::env::args_os();
    let is_hidden = arguments.any(|argument| argument.to_string_lossy().contains(terminal::is_hidden));
    if terminal::cut(&text) == text && !is_hidden {
        // With its colours.
        let _ = error.print();
    } else {
        let _ = writeln!(terminal::err(), "{}", terminal::cut(text.trim_end()));
    }
    ExitCode::from(2)
}
