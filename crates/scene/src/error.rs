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
    /// The file of this name is far larger than any scene; the largest size allowed \[bytes\].
    #[error("{0}: found more than {1} bytes; allowed: a scene file of at most {1} bytes")]
    TooLarge(String, u64),
    /// The file is not UTF-8 text here.
    #[error("{0}: found text that is not UTF-8; allowed: UTF-8, with or without byte order mark{excerpt}", excerpt = .0.excerpt())]
    NotUtf8(Location),
    /// The file is not TOML.
    #[error("{location}: not valid TOML: {}{}", shortened(.message, LONGEST_LIST), .location.excerpt())]
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
    /// The value is of the wrong type, such as a text in place of a list, or contradicts another one.
    Value,
    /// The unit is missing, not known, or one of another dimension: which of them.
    Unit(String),
    /// The value is outside its range, or not a finite number.
    OutOfRange,
}

/// Longest list of what is allowed, which may be one of names from the scene, and longest text that is repeated \[characters\].
const LONGEST_LIST: usize = 1000;
const LONGEST_TEXT: usize = 300;

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

    /// A value that is of the wrong type, or contradicts another one.
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
            Self::Unreadable(..) | Self::TooLarge(..) => None,
            Self::NotUtf8(location) | Self::Syntax { location, .. } => Some(location),
            Self::Wrong(wrong) => wrong.location.as_ref(),
        }
    }
}

impl fmt::Display for Wrong {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let key = format!("`{}`{}", shortened(&self.key, LONGEST_TEXT), counted(&self.key));
        let found = shortened(&self.found, LONGEST_TEXT);
        if let Some(location) = &self.location {
            write!(f, "{location}: ")?;
        }
        let what = match &self.kind {
            WrongKind::UnknownKey => format!("found unknown key {key}{found}"),
            WrongKind::MissingKey => format!("key {key} is missing"),
            WrongKind::Unit(problem) => format!("{key}: {}: found {found}", shortened(problem, LONGEST_TEXT)),
            WrongKind::OutOfRange => format!("{key}: out of range: found {found}"),
            WrongKind::Override | WrongKind::Value => format!("{key}: found {found}"),
        };
        let excerpt = self.location.as_ref().map_or_else(String::new, Location::excerpt);
        write!(
            f,
            "{what}; allowed: {}{excerpt}",
            shortened(&self.allowed, LONGEST_LIST)
        )
    }
}

impl std::error::Error for Wrong {}

/// What was probably meant, in words.
pub fn did_you_mean(suggestion: Option<&str>) -> String {
    suggestion.map_or_else(String::new, |word| {
        format!(" (did you mean `{}`?)", shortened(word, LONGEST_TEXT))
    })
}
