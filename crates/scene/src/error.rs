//! What can be wrong with a scene.

use crate::location::{Location, counted};
use crate::shown::shortened;

pub type Result<T, E = SceneError> = std::result::Result<T, E>;

/// What is wrong with a scene. The message ends with the faulty line, marked.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SceneError {
    /// The file of this name cannot be read, and why.
    #[error("{0}: cannot be read")]
    Unreadable(String, #[source] std::io::Error),
    /// The file is not TOML.
    #[error("{location}: not valid TOML: {}; quantities stand in quotes, decimals have a point: \"1.2 m\"{}", shortened(.message, LONGEST), .location.excerpt())]
    Syntax {
        /// Where.
        location: Location,
        /// What is wrong.
        message: String,
    },
    /// A key or its value is wrong.
    #[error(transparent)]
    Wrong(Box<Wrong>),
}

/// A wrong key or value.
#[derive(Debug, thiserror::Error)]
#[error(
    "{}{found}; allowed: {}{}",
    .location.as_ref().map_or_else(String::new, |location| format!("{location}: ")),
    shortened(.allowed, LONGEST),
    .location.as_ref().map_or_else(String::new, Location::excerpt),
)]
#[non_exhaustive]
pub struct Wrong {
    /// The key, with its section.
    pub key: String,
    /// Whether there is no such key, or no value that an override could change.
    pub is_unknown: bool,
    /// What was found at the key, with what was probably meant.
    pub found: String,
    /// What is allowed.
    pub allowed: String,
    /// Where it stands; `None` in a scene that a program made or changed.
    pub location: Option<Location>,
}

/// Longest text of a scene, or list of its names, that is repeated \[characters\].
const LONGEST: usize = 1000;

impl SceneError {
    /// A value that is wrong: of the wrong type or unit, outside its range, or at odds with another one.
    pub(crate) fn value(key: &str, found: impl AsRef<str>, allowed: impl Into<String>) -> Self {
        let found = format!("{}: found {}", named(key), shortened(found.as_ref(), LONGEST));
        Self::wrong(key, false, found, allowed)
    }

    /// A key that is missing.
    pub(crate) fn missing(key: &str, allowed: impl Into<String>) -> Self {
        Self::wrong(key, false, format!("key {} is missing", named(key)), allowed)
    }

    /// A key that is not known.
    pub(crate) fn unknown(key: &str, meant: Option<&str>, allowed: String) -> Self {
        let found = format!("found unknown key {}{}", named(key), did_you_mean(meant));
        Self::wrong(key, true, found, allowed)
    }

    fn wrong(key: &str, is_unknown: bool, found: String, allowed: impl Into<String>) -> Self {
        Self::Wrong(Box::new(Wrong {
            key: key.to_owned(),
            is_unknown,
            found,
            allowed: allowed.into(),
            location: None,
        }))
    }

    /// The same at this place, and whether nothing is at the key that could be changed.
    pub(crate) fn at(mut self, location: Location, is_unknown: bool) -> Self {
        if let Self::Wrong(wrong) = &mut self {
            (wrong.is_unknown, wrong.location) = (is_unknown, Some(location));
        }
        self
    }

    /// Where the scene is wrong; `None` if its file cannot be read at all, or the scene is not that of a file.
    pub fn location(&self) -> Option<&Location> {
        match self {
            Self::Unreadable(..) => None,
            Self::Syntax { location, .. } => Some(location),
            Self::Wrong(wrong) => wrong.location.as_ref(),
        }
    }
}

/// A key as messages show it.
fn named(key: &str) -> String {
    format!("`{}`{}", shortened(key, LONGEST), counted(key))
}

/// What was probably meant, in words.
pub fn did_you_mean(suggestion: Option<&str>) -> String {
    let words = |word| format!(" (did you mean `{}`?)", shortened(word, LONGEST));
    suggestion.map_or_else(String::new, words)
}
