//! The state of a cable in a file: what a run leaves, and another goes on from.

use std::path::{Path, PathBuf};

use super::failure::Failure;
use super::shared::STDOUT;
use crate::output::{Files, Output};
use crate::{Error, Run, SavedState};

#[derive(Debug, clap::Args)]
pub struct StartArgument {
    /// Begin with the cable as another run has left it: with other traffic, other ends, or more clamps, which bear nothing at first
    #[arg(long, value_name = "FILE.json")]
    from_state: Option<PathBuf>,
}

#[derive(Debug, clap::Args)]
pub struct SaveArgument {
    /// Write the cable as the last pass leaves it to this file, for --from-state
    #[arg(long, value_name = "FILE.json")]
    save_state: Option<PathBuf>,
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

impl SaveArgument {
    /// Makes sure before hours of computing that the state can be written.
    pub fn destination(&self, files: &mut Files) -> Result<Option<Output>, Failure> {
        let Some(path) = &self.save_state else {
            return Ok(None);
        };
        let output = files.output(path, "json")?;
        if path == Path::new(STDOUT) || output.is_standard_output() {
            return Err(Failure::Usage {
                argument: "--save-state",
                found: format!("`{}`, standard output", path.display()),
                allowed: "a file for --from-state".into(),
            });
        }
        Ok(Some(output))
    }
}

/// Writes the state that `run` has left.
pub fn write(output: &Output, run: &Run) -> Result<(), Failure> {
    let text = serde_json::to_vec(&run.state).map_err(std::io::Error::from)?;
    Ok(output.write(|out| out.write_all(&text))?)
}
