//! Values that stand as words in a scene file or on the command line.

/// A text that is not one of the allowed words.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("found \"{found}\"; allowed: {allowed}")]
#[non_exhaustive]
pub struct UnknownWord {
    /// The text.
    pub found: String,
    /// The allowed words.
    pub allowed: String,
}

/// Gives an enum its words: `WORDS`, `Display` and `FromStr`.
macro_rules! words {
    ($type:ident: $($variant:ident $word:literal),+) => {
        impl $type {
            /// Every value with its word.
            pub const WORDS: &'static [(&'static str, Self)] = &[$(($word, Self::$variant)),+];
        }

        impl std::fmt::Display for $type {
            fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                f.pad(match self {
                    $(Self::$variant => $word),+
                })
            }
        }

        impl std::str::FromStr for $type {
            type Err = $crate::scene::UnknownWord;

            fn from_str(text: &str) -> Result<Self, Self::Err> {
                let found = Self::WORDS.iter().find(|(word, _)| *word == text);
                found.map(|(_, value)| *value).ok_or_else(|| $crate::scene::UnknownWord {
                    found: text.to_owned(),
                    allowed: [$($word),+].join(", "),
                })
            }
        }
    };
}

pub(crate) use words;
