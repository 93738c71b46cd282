//! Enums whose values are words of the file.

/// Gives an enum its words: `WORDS`, `Display` and `FromStr`.
#[macro_export]
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
            type Err = String;

            fn from_str(text: &str) -> Result<Self, Self::Err> {
                let found = Self::WORDS.iter().find(|(word, _)| *word == text);
                let allowed = || [$($word),+].join(", ");
                found.map(|(_, value)| *value).ok_or_else(|| format!("found \"{text}\"; allowed: {}", allowed()))
            }
        }
    };
}

/// The same for words of the file, with their `FORM` and what else is to be said of them.
macro_rules! file_words {
    ($type:ident: $($variant:ident $word:literal),+ $(; $more:literal)?) => {
        $crate::words!($type: $($variant $word),+);

        impl $type {
            pub(crate) const FORM: $crate::key::Form = $crate::key::Form::Words(&[$($word),+], concat!($($more)?));
        }

        impl $crate::stored::Stored for $type {
            fn read(given: &$crate::stored::Given) -> $crate::error::Result<Self> {
                given.word(Self::WORDS, given.form.allowed())
            }

            fn write(&self, _: $crate::key::Form) -> $crate::content::Content {
                $crate::content::Content::Text(self.to_string())
            }
        }
    };
}
pub(crate) use file_words;
