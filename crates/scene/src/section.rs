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
        impl $crate::key::Section for $name {
            const KEYS: &'static [$crate::key::Key] = &[
                $($crate::key::Key::preset($preset),)?
                $($crate::key::Key {
                    absent: [$($absent)?].first().copied(),
                    ..$crate::key::Key::required(stringify!($key), concat!($($meaning),+).trim_ascii(), $form)
                },)+
            ];
        }

        impl $crate::stored::Stored for $name {
            fn read(given: &$crate::stored::Given) -> $crate::error::Result<Self> {
                given.check_table()?;
                Ok(Self { $($key: given.value(stringify!($key), $crate::section::absent!($($absent $(=> $value)?)?))?,)+ })
            }

            fn write(&self, form: $crate::key::Form) -> $crate::content::Content {
                let entries = [$($crate::stored::entry(
                    form.keys(), stringify!($key), &self.$key, $crate::section::absent!($($absent $(=> $value)?)?),
                ),)+];
                $crate::content::Content::table(entries.into_iter().flatten())
            }
        }
    };
}
pub(crate) use keys;
