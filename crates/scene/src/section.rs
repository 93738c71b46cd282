//! A section of the file is a type. The macro [`keys!`] declares it: each key with its meaning, its field, what may stand
//! there, and what counts if it is left out. Reading, writing, `creepage explain` and the JSON Schema follow from that.

/// The value of a key that is left out: none if it is required, else its own or that of its type.
macro_rules! absent {
    () => {
        None
    };
    ($words:literal) => {
        Some(Default::default())
    };
    ($words:literal => $value:expr) => {
        Some($value)
    };
}
pub(crate) use absent;

/// Declares a section of the file, or the keys of a type that is already there (`for TYPE`). A value behind `=>` counts if a key is left
/// out, where that is not the default of its type.
macro_rules! keys {
    (
        $(#[$about:meta])*
        pub struct $name:ident {
            $(preset $preset:literal;)?
            $($(#[doc = $meaning:literal])+ $key:ident: $type:ty = $form:expr $(, $absent:literal $(=> $value:expr)?)?;)+
        }
    ) => {
        $(#[$about])*
        #[derive(Debug, Clone, PartialEq)]
        pub struct $name {
            $($(#[doc = $meaning])+ pub $key: $type,)+
        }
        $crate::section::keys!(for $name {
            $(preset $preset;)?
            $($(#[doc = $meaning])+ $key = $form $(, $absent $(=> $value)?)?;)+
        });
    };
    (for $name:ty {
        $(preset $preset:literal;)?
        $($(#[doc = $meaning:literal])+ $key:ident = $form:expr $(, $absent:literal $(=> $value:expr)?)?;)+
    }) => {
        impl $crate::stored::Stored for $name {
            const KEYS: &'static [$crate::key::Key] = &[
                $($crate::key::Key::preset($preset),)?
                $($crate::key::Key {
                    name: stringify!($key),
                    meaning: concat!($($meaning),+).trim_ascii(),
                    form: $form,
                    absent: [$($absent)?].first().copied(),
                },)+
            ];

            fn read(given: &$crate::stored::Given) -> $crate::error::Result<Self> {
                given.check_table()?;
                Ok(Self { $($key: given.value(stringify!($key), $form, $crate::section::absent!($($absent $(=> $value)?)?))?,)+ })
            }

            fn write(&self, _: $crate::key::Form) -> $crate::content::Content {
                $crate::content::Content::table([$((
                    stringify!($key),
                    $crate::stored::written(&self.$key, $form, $crate::section::absent!($($absent $(=> $value)?)?).as_ref()),
                ),)+])
            }
        }
    };
}
pub(crate) use keys;

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
                match text {
                    $($word => Ok(Self::$variant),)+
                    _ => Err(format!("found \"{text}\"; allowed: {}", [$($word),+].join(", "))),
                }
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
