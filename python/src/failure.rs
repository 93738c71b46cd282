//! Errors of Rust as exceptions of `creepage._errors`.

use creepage::sweep::SweepError;
use creepage::{Error, SceneError, with_causes};
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;

/// What went wrong, ready to be raised.
pub struct Failure {
    /// `InputError` or `ComputationError`.
    class: &'static str,
    message: String,
    file: Option<String>,
    line: Option<usize>,
    key: Option<String>,
}

impl Failure {
    fn of(class: &'static str, message: String) -> Self {
        Self {
            class,
            message,
            file: None,
            line: None,
            key: None,
        }
    }

    /// Bad input.
    pub fn input(error: &dyn std::error::Error) -> Self {
        Self::of("InputError", with_causes(error))
    }

    /// An argument that is none, in words.
    pub fn argument(message: String) -> Self {
        Self::of("InputError", message)
    }

    /// A column of a type that no cell has.
    pub fn column(name: &str, found: &impl std::fmt::Display) -> Self {
        let message =
            format!("column `{name}`: found {found}; allowed: texts, numbers, or a dictionary of them");
        Self {
            key: Some(name.to_owned()),
            ..Self::of("InputError", message)
        }
    }

    /// A computation that failed.
    pub fn computation(error: &dyn std::error::Error) -> Self {
        Self::of("ComputationError", with_causes(error))
    }

    /// A computation that broke off.
    pub fn broken() -> Self {
        Self::of("ComputationError", "the computation broke off".into())
    }

    /// The exception.
    pub fn raised(self, py: Python<'_>) -> PyErr {
        let Self {
            class,
            message,
            file,
            line,
            key,
        } = self;
        let made = py
            .import("creepage._errors")
            .and_then(|module| module.getattr(class))
            .and_then(|class| class.call1((&message, file, line, key)));
        match made {
            Ok(exception) => PyErr::from_value(exception),
            Err(_) => PyRuntimeError::new_err(message),
        }
    }
}

impl From<Error> for Failure {
    fn from(error: Error) -> Self {
        let failure = if error.is_bad_input() {
            Self::input(&error)
        } else {
            Self::computation(&error)
        };
        let (file, line) = match error.location() {
            Some(location) => (Some(location.file().to_owned()), location.line()),
            None => (None, None),
        };
        Self {
            file,
            line,
            key: error.key().map(str::to_owned),
            ..failure
        }
    }
}

impl From<SceneError> for Failure {
    fn from(error: SceneError) -> Self {
        Error::from(error).into()
    }
}

impl From<SweepError> for Failure {
    fn from(error: SweepError) -> Self {
        match error {
            SweepError::Scene(error) => error.into(),
            SweepError::Cell { ref key, .. } => Self {
                key: Some(key.clone()),
                ..Self::input(&error)
            },
            error if error.is_bad_input() => Self::input(&error),
            error => Self::computation(&error),
        }
    }
}
