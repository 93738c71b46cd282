//! What can be wrong with a scene.

use std::fmt;

use crate::location::{Location, counted};
use crate::shown::shortened;

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
#[derive(Debug)]
#[non_exhaustive]
pub struct Wrong {
    /// In which way it is wrong.
    pub kind: WrongKind,
    /// The key, with its section.
    pub key: String,
    /// What was found, with what was probably meant.
    pub found: String,
    /// What is allowed.
    pub allowed: String,
    /// Where it stands; `None` in a scene that a program made or changed.
    pub location: Option<Location>,
}

/// The ways in which a key or value can be wrong.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub enum WrongKind {
    /// The key is not known.
    UnknownKey,
    /// A required key is missing.
    MissingKey,
    /// An override is not `KEY=VALUE`, or there is nothing at its key.
    Override,
    /// The value is of the wrong type or unit, is outside its range, or contradicts another one.
    Value,
}

/// Longest text of a scene, or list of its names, that is repeated \[characters\].
const LONGEST: usize = 1000;

impl SceneError {
    /// What is wrong at a key, without the place where it stands.
    pub(crate) fn wrong(
        kind: WrongKind,
        key: &str,
        found: impl Into<String>,
        allowed: impl Into<String>,
    ) -> Self {
        let (key, found, allowed) = (key.to_owned(), found.into(), allowed.into());
        Self::Wrong(Box::new(Wrong {
            kind,
            key,
            found,
            allowed,
            location: None,
        }))
    }

    /// A value that is wrong.
    pub(crate) fn value(key: &str, found: impl Into<String>, allowed: impl Into<String>) -> Self {
        Self::wrong(WrongKind::Value, key, found, allowed)
    }

    /// A key that is missing.
    pub(crate) fn missing(key: &str, allowed: impl Into<String>) -> Self {
        Self::wrong(WrongKind::MissingKey, key, "", allowed)
    }

    /// The same, at this place.
    pub(crate) fn at(mut self, location: Location) -> Self {
        if let Self::Wrong(wrong) = &mut self {
            wrong.location = Some(location);
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

impl fmt::Display for Wrong {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let key = format!("`{}`{}", shortened(&self.key, LONGEST), counted(&self.key));
        let [found, allowed] = [&self.found, &self.allowed].map(|text| shortened(text, LONGEST));
        if let Some(location) = &self.location {
            write!(f, "{location}: ")?;
        }
        match self.kind {
            WrongKind::UnknownKey => write!(f, "found unknown key {key}{found}"),
            WrongKind::MissingKey => write!(f, "key {key} is missing"),
            WrongKind::Override | WrongKind::Value => write!(f, "{key}: found {found}"),
        }?;
        write!(f, "; allowed: {allowed}")?;
        self.location
            .as_ref()
            .map_or(Ok(()), |location| f.write_str(&location.excerpt()))
    }
}

impl std::error::Error for Wrong {}

/// What was probably meant, in words.
pub fn did_you_mean(suggestion: Option<&str>) -> String {
    let words = |word| format!(" (did you mean `{}`?)", shortened(word, LONGEST));
    suggestion.map_or_else(String::new, words)
}
