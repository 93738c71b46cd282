//! The scene that a command works on.

use serde::Serialize;

use super::arguments::SceneArguments;
use super::{Failure, terminal};
use crate::{Error, Scene, SceneFile, finite};

/// A scene and the file it came from.
pub struct Input {
    pub file: SceneFile,
    pub scene: Scene,
    /// What looks like a slip in the file.
    pub warnings: Vec<String>,
}

impl Input {
    /// Reads the scene and warns of numbers that look like slips.
    pub fn read(arguments: &SceneArguments) -> Result<Self, Failure> {
        let file = SceneFile::read(&arguments.scene)?.with(&arguments.set)?;
        let scene = file.scene()?;
        let mut warnings = Vec::new();
        for slip in file.unit_slips() {
            warnings.push(slip.to_string());
            terminal::warn(format_args!("{slip}{}", slip.location.excerpt()));
        }
        Ok(Self {
            file,
            scene,
            warnings,
        })
    }

    /// The answer, all of whose numbers are finite, or the error with the line of the key at fault.
    pub fn judged<T: Serialize>(&self, answer: Result<T, Error>) -> Result<T, Failure> {
        let answer = self.located(answer)?;
        finite::check(&answer)?;
        Ok(answer)
    }

    /// The answer, or the error with the line of the key at fault.
    pub fn located<T>(&self, answer: Result<T, Error>) -> Result<T, Failure> {
        answer.map_err(|error| Failure::Analysis(error.located(&self.file)))
    }
}
