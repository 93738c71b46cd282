//! What the page asks: a scene with other numbers, and limits; and why a question is refused.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use serde_json::Value;

use crate::cli::failure::Failure;
use crate::cli::limits::LimitArguments;
use crate::cli::terminal;
use crate::{Error, Limits, Scene, SceneFile, Units, with_causes};

/// A question of the page, as its JSON has it.
#[derive(Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Question {
    /// What is set on top of the scene, each value as `--set` takes it; null takes a key out.
    set: BTreeMap<String, Value>,
    /// Tolerance in place of the scene's.
    tolerance: Option<f64>,
    /// Of force and of movement, as they were typed, with places before `=` as on the command line.
    limits: BTreeMap<String, Vec<String>>,
    /// Whether it is the first pass that is looked at, not the one after the last.
    pub first: bool,
    /// The vehicle that drives in it.
    pub vehicle: usize,
}

/// The scene that a question is about.
pub struct Asked {
    pub file: SceneFile,
    pub scene: Scene,
    /// What was set on top of the scene.
    pub overrides: Vec<String>,
    /// None if none are given.
    pub limits: Option<Limits>,
    pub units: Units,
}

/// Why there is no answer.
#[derive(Debug, Serialize)]
pub struct Refusal {
    #[serde(skip)]
    pub status: u16,
    /// As on the command line.
    message: String,
    /// The scene's key or the option at fault, if one is.
    key: Option<String>,
}

impl Question {
    /// Reads the JSON of a question about `file`.
    pub fn read(body: &[u8], file: &SceneFile) -> Result<(Self, Asked), Refusal> {
        let question: Result<Self, _> = serde_json::from_slice(body);
        let no = |error| Refusal::new(400, None, &format!("not a question in JSON: {error}"));
        let question = question.map_err(no)?;
        let asked = question.about(file)?;
        Ok((question, asked))
    }

    /// The scene of `file` with what the question sets.
    pub fn about(&self, file: &SceneFile) -> Result<Asked, Refusal> {
        let set = |(key, value): (&String, &Value)| match value {
            Value::Null => format!("{key}="),
            Value::String(text) => format!("{key}={text}"),
            value => format!("{key}={value}"),
        };
        let overrides: Vec<String> = self.set.iter().map(set).collect();
        let of_solver = |tolerance| format!("solver.tolerance={tolerance}");
        let tolerance = self.tolerance.map(of_solver);
        let asked = file.with(&overrides)?.with(tolerance.as_slice())?;
        if asked.histogram() != file.histogram() {
            let message = "traffic.histogram: found another file than that of the scene; allowed: that one";
            return Err(Refusal::new(422, Some("traffic.histogram"), message));
        }
        let typed = |name| self.limits.get(name).map_or(&[][..], |texts| texts);
        let limits = LimitArguments::typed(typed("force"), typed("movement"));
        let refused = |(option, why)| Refusal::new(422, Some(option), &format!("{option}: {why}"));
        let (scene, limits) = (asked.scene()?, limits.map_err(refused)?);
        let given = limits.are_given().then(|| limits.limits_with(&scene, &[]));
        Ok(Asked {
            limits: given.transpose()?,
            // A slider's unit says nothing about those of answers.
            units: limits.units(file),
            file: asked,
            scene,
            overrides,
        })
    }
}

impl Asked {
    /// An answer, or the failure with the line of the key at fault.
    pub fn located<T>(&self, answer: Result<T, Error>) -> Result<T, Refusal> {
        answer.map_err(|error| error.located(&self.file).into())
    }
}

impl Refusal {
    pub fn new(status: u16, key: Option<&str>, message: &str) -> Self {
        let (message, key) = (terminal::cut(message), key.map(str::to_owned));
        Self { status, message, key }
    }
}

impl<E: Into<Failure>> From<E> for Refusal {
    fn from(error: E) -> Self {
        let failure = error.into();
        let (status, key) = match &failure {
            Failure::Analysis(Error::Stopped) => (409, None),
            Failure::Analysis(error) => (422, error.key()),
            Failure::Usage { argument, .. } => (422, Some(*argument)),
            _ => (422, None),
        };
        Self::new(status, key, &with_causes(&failure))
    }
}
