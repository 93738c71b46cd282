//! A section of the file is a type. The macro [`keys!`] declares it: each key with its meaning, its field, what may stand
//! there, and what counts if it is left out. Reading, writing, `creepage explain` and the JSON Schema follow from that.

use crate::content::Content;
use crate::range::Quantity;
use crate::stored::Stored;

/// A type that is a table of the file.
pub trait Section: Stored {
    const KEYS: &'static [Key];
}

/// A key and what is to be said of it.
pub struct Key {
    pub name: &'static str,
    pub meaning: &'static str,
    pub form: Form,
    /// What counts if it is left out, in words; `None` if it is required.
    pub absent: Option<&'static str>,
}

impl Key {
    pub const fn required(name: &'static str, meaning: &'static str, form: Form) -> Self {
        Self {
            name,
            meaning,
            form,
            absent: None,
        }
    }

    pub const fn preset(meaning: &'static str) -> Self {
        Self {
            name: "preset",
            meaning,
            form: Form::Text("a name that `creepage presets` lists"),
            absent: Some("none"),
        }
    }
}

/// What may stand at a key.
#[derive(Clone, Copy)]
pub enum Form {
    Number(Quantity),
    /// A text, and what is allowed in words.
    Text(&'static str),
    /// A text that is not blank, and what is allowed in words.
    Name(&'static str),
    Words {
        words: &'static [&'static str],
        /// What is allowed, if that is more than they say.
        allowed: Option<&'static str>,
        /// A word that once was one of them, and why it no longer is.
        gone: Option<(&'static str, &'static str)>,
    },
    Table(&'static [Key]),
    /// A list of so many items at least, and what is allowed in words.
    List(&'static Form, usize, &'static str),
    /// A pair of values, and what is allowed in words.
    Pair([&'static Form; 2], &'static str),
    /// A value that is no table, or a table, and what is allowed if that is more than for the value alone. A text stands for the
    /// first key of the table.
    Either(&'static Form, &'static [Key], Option<&'static str>),
}

impl Form {
    /// The keys of a table, or of the tables of a list.
    pub fn keys(self) -> &'static [Key] {
        match self {
            Self::Table(keys) | Self::Either(_, keys, _) => keys,
            Self::List(form, ..) => form.keys(),
            _ => &[],
        }
    }

    /// The quantity of a number, alone or in place of a table.
    pub fn quantity(self) -> Option<Quantity> {
        match self {
            Self::Number(quantity) => Some(quantity),
            Self::Either(form, ..) => form.quantity(),
            _ => None,
        }
    }

    /// What is allowed, in words.
    pub fn allowed(self) -> String {
        match self {
            Self::Number(quantity) => quantity.allowed(),
            Self::Text(allowed)
            | Self::Name(allowed)
            | Self::List(_, _, allowed)
            | Self::Pair(_, allowed) => allowed.to_owned(),
            Self::Words { words, allowed, .. } => {
                allowed.map_or_else(|| listed(words.iter().copied()), str::to_owned)
            }
            Self::Table(keys) => {
                let names: Vec<&str> = keys.iter().map(|key| key.name).collect();
                format!("a table with the keys {}", names.join(", "))
            }
            Self::Either(form, _, allowed) => allowed.map_or_else(|| form.allowed(), str::to_owned),
        }
    }

    /// A value in SI as it is written in a file.
    pub fn in_file(self, content: &Content) -> Content {
        let entry = |key: &Key, content: &Content| {
            let value = &content.entry(key.name)?.value.content;
            Some((key.name, key.form.in_file(value)))
        };
        match (self, content) {
            (Self::Number(quantity), Content::Number(value)) => match quantity.unit() {
                Some(unit) => Content::Text(format!("{value:?} {unit}")),
                None => content.clone(),
            },
            (Self::Table(keys) | Self::Either(_, keys, _), Content::Table(_)) => {
                Content::table(keys.iter().filter_map(|key| entry(key, content)))
            }
            (Self::Either(form, ..), _) => form.in_file(content),
            (Self::List(form, ..), Content::List(items)) => {
                let items = items.iter().map(|item| form.in_file(&item.content).into());
                Content::List(items.collect())
            }
            (Self::Pair(forms, _), Content::List(items)) => {
                let pair = forms.iter().zip(items);
                Content::List(
                    pair.map(|(form, item)| form.in_file(&item.content).into())
                        .collect(),
                )
            }
            _ => content.clone(),
        }
    }
}

/// Words as they are typed, one after the other.
pub fn listed<'w>(words: impl Iterator<Item = &'w str>) -> String {
    let quoted: Vec<String> = words.map(|word| format!("\"{word}\"")).collect();
    quoted.join(", ")
}

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
        $crate::key::keys!(for $name {
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
                    name: stringify!($key),
                    meaning: concat!($($meaning),+).trim_ascii(),
                    form: $form,
                    absent: [$($absent)?].first().copied(),
                },)+
            ];
        }

        impl $crate::stored::Stored for $name {
            fn read(content: &$crate::content::Content) -> Option<Self> {
                use $crate::stored::value;
                Some(Self { $($key: value(content, stringify!($key), $crate::key::absent!($($absent $(=> $value)?)?))?,)+ })
            }

            fn write(&self) -> $crate::content::Content {
                use $crate::stored::entry;
                let entries = [$(entry(stringify!($key), &self.$key, $crate::key::absent!($($absent $(=> $value)?)?)),)+];
                $crate::content::Content::table(entries.into_iter().flatten())
            }
        }
    };
}
pub(crate) use keys;
