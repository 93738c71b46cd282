//! What can be wrong with a scene.

use std::fmt;
use std::string::FromUtf8Error;

use ground_field::GroundError;

use super::counted::counted;
use super::location::Location;
use super::quantity::QuantityError;
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
    #[error("{location}: not valid TOML: {}{}", bounded(.message), .location.excerpt())]
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
    /// What was found.
    pub found: String,
    /// What is allowed.
    pub allowed: String,
    /// Where it stands; `None` in a scene that a program made or changed.
    pub location: Option<Location>,
}

/// The ways in which a key or value can be wrong.
#[derive(Debug)]
#[non_exhaustive]
pub enum WrongKind {
    /// The key is not known.
    UnknownKey {
        /// The nearest known key.
        suggestion: Option<String>,
    },
    /// A required key is missing.
    MissingKey,
    /// An override is not `KEY=VALUE`, or there is nothing at its key.
    Override,
    /// The value is of the wrong type, such as a text in place of a list, or contradicts another one.
    Value,
    /// The unit is missing, not known, or one of another dimension.
    Quantity(QuantityError),
    /// The value is outside its range, or not a finite number.
    OutOfRange,
    /// The word is not one of the allowed ones.
    UnknownWord {
        /// The nearest of them.
        suggestion: Option<String>,
    },
    /// The ground or a vehicle cannot be built from these values.
    Rejected(GroundError),
}

impl fmt::Display for Wrong {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (key, found, allowed) = (cut(&self.key), cut(&self.found), bounded(&self.allowed));
        if let Some(location) = &self.location {
            write!(f, "{location}: ")?;
        }
        let which = counted(&self.key);
        let message = |problem: &str, meant: &str| {
            format!("`{key}`{which}: {problem}found {found}{meant}; allowed: {allowed}")
        };
        f.write_str(&match &self.kind {
            WrongKind::UnknownKey { suggestion } => {
                let meant = did_you_mean(suggestion.as_deref());
                format!("found unknown key `{key}`{which}{meant}; allowed: {allowed}")
            }
            WrongKind::MissingKey => format!("key `{key}`{which} is missing; allowed: {allowed}"),
            WrongKind::Rejected(error) => format!("`{key}`{which}: {error}"),
            WrongKind::Quantity(QuantityError::UnknownUnit { unit, nearest }) => message(
                &format!("unknown unit `{}`: ", cut(unit)),
                &did_you_mean(*nearest),
            ),
            WrongKind::Quantity(QuantityError::WrongDimension { dimension, .. }) => {
                message("wrong dimension: ", &format!(", {}", dimension.noun()))
            }
            WrongKind::Quantity(_) => message("missing unit: ", ""),
            WrongKind::OutOfRange => message("out of range: ", ""),
            WrongKind::UnknownWord { suggestion } => message("", &did_you_mean(suggestion.as_deref())),
            WrongKind::Override | WrongKind::Value => message("", ""),
        })?;
        let excerpt = self.location.as_ref().map(Location::excerpt);
        f.write_str(&excerpt.unwrap_or_default())
    }
}

impl std::error::Error for Wrong {}

/// What was probably meant, in words.
pub(crate) fn did_you_mean(suggestion: Option<&str>) -> String {
    suggestion.map_or_else(String::new, |word| format!(" (did you mean `{}`?)", cut(word)))
}

/// What was written, as far as a message repeats it.
fn cut(text: &str) -> String {
    /// Longest text that is repeated \[characters\].
    const LONGEST: usize = 100;
    shortened(text, LONGEST)
}

/// What is allowed, which may be a list of names from the scene.
fn bounded(text: &str) -> String {
    /// Longer than every list of this program's own \[characters\].
    const LONGEST: usize = 1000;
    shortened(text, LONGEST)
}

impl SceneError {
    /// The error for a file whose bytes are not UTF-8.
    pub(super) fn not_utf8(file: &str, error: &FromUtf8Error) -> Self {
        let valid = error.utf8_error().valid_up_to();
        let text = String::from_utf8_lossy(error.as_bytes());
        Self::NotUtf8(Location::new(file, &text, valid..valid, true))
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
