//! The state of a cable in a file, from which a run goes on.

use std::path::{Path, PathBuf};

use super::failure::Failure;
use crate::{Error, SavedState};

#[derive(Debug, clap::Args)]
pub struct StartArgument {
    /// Begin with the cable as another run has left it: with other traffic, other ends, or more clamps, which bear nothing at first
    #[arg(long, value_name = "FILE.json")]
    from_state: Option<PathBuf>,
}

impl StartArgument {
    /// The file to begin with, if there is one.
    pub fn read(&self) -> Option<&Path> {
        self.from_state.as_deref()
    }

    /// The state to begin with, if there is one.
    pub fn start(&self) -> Result<Option<SavedState>, Failure> {
        let Some(path) = &self.from_state else {
            return Ok(None);
        };
        let refused = |error: &dyn std::fmt::Display| Error::State {
            reason: format!("{} is no file of --save-state ({error})", path.display()),
        };
        let text = std::fs::read(path).map_err(|error| refused(&error))?;
        let state = serde_json::from_slice(&text).map_err(|error| refused(&error))?;
        Ok(Some(state))
    }
}
