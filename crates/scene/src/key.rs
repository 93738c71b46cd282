//! One table of the file is one type: its keys, what may stand at each, and what each means.
//!
//! The macro [`keys!`] declares such a type. Reading, writing, checking ranges, `creepage explain` and the JSON Schema all follow from its
//! rows: a key's documentation, its field, its [`Kind`], and what counts if it is left out.

use crate::document::{Content, Entry, joined, other_name};
use crate::error::{SceneError, WrongKind};
use crate::range::Quantity;
use crate::value::Value;

/// A table of the file.
pub trait Keys: Sized {
    /// What its keys hold.
    fn read(table: &Table) -> Result<Self, SceneError>;
    /// Its keys with their values, without those that need not be written.
    fn write(&self) -> Vec<(&'static str, Content)>;
    /// Calls `visit` with every quantity below the key `path`.
    fn each(&self, path: &str, visit: &mut Visit);
    /// Its keys.
    fn keys() -> Vec<Key>;
}

/// What is called with a key, its value in SI and its quantity.
pub type Visit<'v> = dyn FnMut(&str, f64, Quantity) + 'v;

/// What may stand at a key.
pub trait Kind {
    type Value;
    fn read(&self, value: &Value) -> Result<Self::Value, SceneError>;
    /// The value as it is written; nothing for one that need not be.
    fn write(&self, value: &Self::Value) -> Option<Content>;
    fn each(&self, _value: &Self::Value, _path: &str, _visit: &mut Visit) {}
    fn form(&self) -> Form;
    /// What counts if the key is left out; nothing if it is required.
    fn absent(&self) -> Option<Self::Value> {
        None
    }
}

/// A key and what is to be said of it.
pub struct Key {
    pub name: &'static str,
    pub meaning: &'static str,
    pub form: Form,
    /// What counts if it is left out; `None` if it is required.
    pub default: Option<&'static str>,
}

/// The forms that a value may have.
pub enum Form {
    Quantity(Quantity),
    /// A text, and what is allowed in words.
    Text(&'static str),
    Words(Vec<&'static str>, Option<&'static str>),
    Table(Vec<Key>),
    /// A list of so many items at least, and what is allowed in words.
    #[cfg_attr(
        not(feature = "schema"),
        allow(dead_code, reason = "the schema alone says how many")
    )]
    List(Box<Form>, usize, &'static str),
    /// A value that is no table, or a table, and what is allowed in words; the second is not repeated by it.
    Either(Box<Form>, Vec<Key>, Option<&'static str>),
}

impl Form {
    /// The keys of a table, or of the tables of a list.
    pub fn keys(self) -> Vec<Key> {
        match self {
            Self::Table(keys) | Self::Either(_, keys, _) => keys,
            Self::List(form, ..) => form.keys(),
            _ => Vec::new(),
        }
    }

    /// The SI unit of a number, if it has one.
    pub fn unit(&self) -> Option<&'static str> {
        match self {
            Self::Quantity(quantity) => quantity.dimension?.si(),
            Self::Either(form, ..) => form.unit(),
            _ => None,
        }
    }

    /// What is allowed, in words.
    pub fn allowed(&self) -> String {
        match self {
            Self::Quantity(quantity) => quantity.allowed(),
            Self::Text(allowed)
            | Self::Words(_, Some(allowed))
            | Self::List(_, _, allowed)
            | Self::Either(_, _, Some(allowed)) => (*allowed).to_owned(),
            Self::Words(words, None) => listed(words.iter().copied()),
            Self::Table(keys) => {
                let names: Vec<&str> = keys.iter().map(|key| key.name).collect();
                format!("a section with the keys {}", names.join(", "))
            }
            Self::Either(form, _, None) => form.allowed(),
        }
    }
}

/// Words as they are typed, one after the other.
pub fn listed<'w>(words: impl Iterator<Item = &'w str>) -> String {
    words
        .map(|word| format!("\"{word}\""))
        .collect::<Vec<_>>()
        .join(", ")
}

/// A table of a document, which knows its keys when it is opened: a misspelt key is reported as such and not as the lack of the right one.
pub struct Table<'d> {
    value: Value<'d>,
    entries: &'d [Entry],
}

impl<'d> Table<'d> {
    /// Opens a table, which may hold only the `known` keys.
    pub fn open(value: &Value<'d>, known: &[Key]) -> Result<Self, SceneError> {
        let names: Vec<&str> = known.iter().map(|key| key.name).collect();
        let is_known = |entry: &Entry| {
            let other = other_name(&entry.key);
            names.contains(&&*entry.key) || other.is_some_and(|other| names.contains(&other))
        };
        let Content::Table(entries) = &value.node.content else {
            return Err(value.wrong_type(format!("a table with the keys {}", names.join(", "))));
        };
        if let Some(entry) = entries.iter().find(|entry| !is_known(entry)) {
            let key = joined(&value.path, &entry.key);
            let known = names.join(", ");
            return Err(value
                .document
                .wrong(WrongKind::UnknownKey, &entry.span, &key, "", known));
        }
        Ok(Self {
            value: value.clone(),
            entries,
        })
    }

    /// What stands at `key`.
    pub fn get<K: Kind>(&self, key: &str, kind: &K) -> Result<K::Value, SceneError> {
        let is_meant = |entry: &&Entry| entry.key == key || Some(&*entry.key) == other_name(key);
        if let Some(entry) = self.entries.iter().find(is_meant) {
            return kind.read(&self.value.child(&entry.key, &entry.value));
        }
        kind.absent().ok_or_else(|| {
            // The section that lacks it is shown.
            let Value { document, path, node } = &self.value;
            let (key, allowed) = (joined(path, key), kind.form().allowed());
            document.wrong(WrongKind::MissingKey, &node.span, &key, "", allowed)
        })
    }
}

/// Declares a table of the file, or the keys of a type that is already there (`for TYPE`).
macro_rules! keys {
    (
        $(#[$about:meta])*
        $vis:vis struct $name:ident {
            $(preset $preset:literal;)?
            $($(#[doc = $meaning:literal])+ $key:ident: $type:ty = $kind:expr $(, $default:literal)?;)+
        }
    ) => {
        $(#[$about])*
        #[derive(Debug, Clone, PartialEq)]
        $vis struct $name {
            $($(#[doc = $meaning])+ pub $key: $type,)+
        }
        $crate::key::keys!(for $name { $(preset $preset;)? $($(#[doc = $meaning])+ $key = $kind $(, $default)?;)+ });
    };
    (for $name:ty { $(preset $preset:literal;)? $($(#[doc = $meaning:literal])+ $key:ident = $kind:expr $(, $default:literal)?;)+ }) => {
        impl $crate::key::Keys for $name {
            fn read(table: &$crate::key::Table) -> Result<Self, $crate::error::SceneError> {
                Ok(Self { $($key: table.get(stringify!($key), &$kind)?,)+ })
            }

            fn write(&self) -> Vec<(&'static str, $crate::document::Content)> {
                let all = [$((stringify!($key), $crate::key::Kind::write(&$kind, &self.$key)),)+];
                all.into_iter().filter_map(|(key, content)| Some((key, content?))).collect()
            }

            fn each(&self, path: &str, visit: &mut $crate::key::Visit) {
                $($crate::key::Kind::each(&$kind, &self.$key, &$crate::document::joined(path, stringify!($key)), visit);)+
            }

            fn keys() -> Vec<$crate::key::Key> {
                // The name of a preset is no longer there when the table is read.
                let preset: &[&str] = &[$($preset)?];
                let preset = preset.first().map(|meaning| $crate::key::Key {
                    name: "preset",
                    meaning,
                    form: $crate::key::Form::Text("a name that `creepage presets` lists"),
                    default: Some("none"),
                });
                preset.into_iter().chain([$($crate::key::Key {
                    name: stringify!($key),
                    meaning: concat!($($meaning),+).trim_ascii(),
                    form: $crate::key::Kind::form(&$kind),
                    default: [$($default)?].first().copied(),
                },)+]).collect()
            }
        }
    };
}
pub(crate) use keys;
