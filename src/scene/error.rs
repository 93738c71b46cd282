//! What can be wrong with a scene.

use std::string::FromUtf8Error;

use ground_field::GroundError;

use super::Location;

/// What is wrong with a scene. The message ends with the faulty line, marked.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SceneError {
    /// The file cannot be read.
    #[error("{file}: cannot be read: {source}")]
    Unreadable {
        /// The file.
        file: String,
        /// Why.
        source: std::io::Error,
    },
    /// The file is far larger than any scene.
    #[error("{file}: found more than {allowed} bytes; allowed: a scene file of at most {allowed} bytes")]
    TooLarge {
        /// The file.
        file: String,
        /// Largest size allowed \[bytes\].
        allowed: u64,
    },
    /// The file is not UTF-8 text.
    #[error("{location}: found text that is not UTF-8; allowed: UTF-8, with or without byte order mark{}", .location.excerpt())]
    NotUtf8 {
        /// Where.
        location: Box<Location>,
    },
    /// The file is not TOML.
    #[error("{location}: not valid TOML: {}{}", bounded(.message), .location.excerpt())]
    Syntax {
        /// Where.
        location: Box<Location>,
        /// What is wrong.
        message: String,
    },
    /// An override is not `KEY=VALUE`, or there is nothing at its key.
    #[error("{location}: `{}`: found {}; allowed: {}{}", cut(.key), cut(.found), bounded(.allowed), .location.excerpt())]
    Override {
        /// Where.
        location: Box<Location>,
        /// The key that it meant to set.
        key: String,
        /// What was found.
        found: String,
        /// What is allowed.
        allowed: String,
    },
    /// A key that is not known.
    #[error("{location}: found unknown key `{}`{}; allowed: {}{}", cut(.key), did_you_mean(.suggestion.as_deref()), bounded(.allowed), .location.excerpt())]
    UnknownKey {
        /// Where.
        location: Box<Location>,
        /// The key, with its section.
        key: String,
        /// The known keys.
        allowed: String,
        /// The nearest known key.
        suggestion: Option<String>,
    },
    /// A required key is not there.
    #[error("{location}: key `{}` is missing; allowed: {}{}", cut(.key), bounded(.allowed), .location.excerpt())]
    MissingKey {
        /// The section that lacks it.
        location: Box<Location>,
        /// The key, with its section.
        key: String,
        /// What is allowed.
        allowed: String,
    },
    /// A value of the wrong kind, such as a text where a list belongs.
    #[error("{location}: `{}`: found {}; allowed: {}{}", cut(.key), cut(.found), bounded(.allowed), .location.excerpt())]
    WrongType {
        /// Where.
        location: Box<Location>,
        /// The key, with its section.
        key: String,
        /// What was found.
        found: String,
        /// What is allowed.
        allowed: String,
    },
    /// A number in quotes without a unit.
    #[error("{location}: `{}`: missing unit: found {}; allowed: {}{}", cut(.key), cut(.found), bounded(.allowed), .location.excerpt())]
    MissingUnit {
        /// Where.
        location: Box<Location>,
        /// The key, with its section.
        key: String,
        /// What was found.
        found: String,
        /// What is allowed.
        allowed: String,
    },
    /// A unit that is not known.
    #[error("{location}: `{}`: unknown unit `{}`: found {}{}; allowed: {}{}", cut(.key), cut(.unit), cut(.found), did_you_mean(*.suggestion), bounded(.allowed), .location.excerpt())]
    UnknownUnit {
        /// Where.
        location: Box<Location>,
        /// The key, with its section.
        key: String,
        /// The unit as written.
        unit: String,
        /// What was found.
        found: String,
        /// What is allowed.
        allowed: String,
        /// The nearest unit that is allowed.
        suggestion: Option<&'static str>,
    },
    /// A unit of another dimension.
    #[error("{location}: `{}`: wrong dimension: found {}, {dimension}; allowed: {}{}", cut(.key), cut(.found), bounded(.allowed), .location.excerpt())]
    WrongDimension {
        /// Where.
        location: Box<Location>,
        /// The key, with its section.
        key: String,
        /// What was found.
        found: String,
        /// The dimension that was found, in words.
        dimension: &'static str,
        /// What is allowed.
        allowed: String,
    },
    /// A value outside its range, or not a finite number.
    #[error("{location}: `{}`: out of range: found {}; allowed: {}{}", cut(.key), cut(.found), bounded(.allowed), .location.excerpt())]
    OutOfRange {
        /// Where.
        location: Box<Location>,
        /// The key, with its section.
        key: String,
        /// What was found.
        found: String,
        /// What is allowed.
        allowed: String,
    },
    /// A word that is not one of the allowed ones.
    #[error("{location}: `{}`: found {}{}; allowed: {}{}", cut(.key), cut(.found), did_you_mean(.suggestion.as_deref()), bounded(.allowed), .location.excerpt())]
    UnknownWord {
        /// Where.
        location: Box<Location>,
        /// The key, with its section.
        key: String,
        /// What was found.
        found: String,
        /// The allowed words.
        allowed: String,
        /// The nearest of them.
        suggestion: Option<String>,
    },
    /// A value that contradicts another one.
    #[error("{location}: `{}`: found {}; allowed: {}{}", cut(.key), cut(.found), bounded(.allowed), .location.excerpt())]
    Inconsistent {
        /// Where.
        location: Box<Location>,
        /// The key, with its section.
        key: String,
        /// What was found.
        found: String,
        /// What is allowed.
        allowed: String,
    },
    /// A value of a scene that was made or changed by a program.
    #[error("`{key}`: found {found}; allowed: {allowed}")]
    Value {
        /// The key, with its section.
        key: String,
        /// What was found.
        found: String,
        /// What is allowed.
        allowed: String,
    },
    /// The ground or a vehicle cannot be built from these values.
    #[error("{location}: `{}`: {source}{}", cut(.key), .location.excerpt())]
    Rejected {
        /// Where.
        location: Box<Location>,
        /// The key, with its section.
        key: String,
        /// Why.
        source: GroundError,
    },
}

fn did_you_mean(suggestion: Option<&str>) -> String {
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

/// The beginning of the text, and how long it is where that is not all.
pub(super) fn shortened(text: &str, longest: usize) -> String {
    match text.char_indices().nth(longest) {
        None => text.to_owned(),
        Some((end, _)) => format!("{}… ({} characters)", &text[..end], text.chars().count()),
    }
}

/// The error for a file whose bytes are not UTF-8.
pub(super) fn not_utf8(file: &str, error: &FromUtf8Error) -> SceneError {
    let valid = error.utf8_error().valid_up_to();
    let text = String::from_utf8_lossy(error.as_bytes());
    SceneError::NotUtf8 {
        location: Location::new(file, &text, valid..valid, true),
    }
}

impl SceneError {
    /// Where the scene is wrong; `None` if its file cannot be read at all, or the scene is not that of a file.
    pub fn location(&self) -> Option<&Location> {
        match self {
            Self::Unreadable { .. } | Self::TooLarge { .. } | Self::Value { .. } => None,
            Self::NotUtf8 { location }
            | Self::Syntax { location, .. }
            | Self::Override { location, .. }
            | Self::UnknownKey { location, .. }
            | Self::MissingKey { location, .. }
            | Self::WrongType { location, .. }
            | Self::MissingUnit { location, .. }
            | Self::UnknownUnit { location, .. }
            | Self::WrongDimension { location, .. }
            | Self::OutOfRange { location, .. }
            | Self::UnknownWord { location, .. }
            | Self::Inconsistent { location, .. }
            | Self::Rejected { location, .. } => Some(location),
        }
    }
}
