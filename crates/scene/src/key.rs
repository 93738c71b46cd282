//! One table of the file is one type: its keys, what may stand at each, and what each means.
//!
//! The macro [`keys!`] declares such a type. Reading, writing, checking ranges, `creepage explain` and the JSON Schema all follow from its
//! rows: a key's documentation, its field, its [`Kind`], and what counts if it is left out.

use crate::document::{Content, Entry, Node, Place, joined, other_name};
use crate::error::{SceneError, WrongKind};
use crate::range::Quantity;
use crate::units::Dimension;
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
            let place = &entry.key_place;
            return Err(value
                .document
                .wrong(WrongKind::UnknownKey, place, &key, "", names.join(", ")));
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
            document.wrong(WrongKind::MissingKey, &node.place, &key, "", allowed)
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

impl Kind for Quantity {
    type Value = f64;

    fn read(&self, value: &Value) -> Result<f64, SceneError> {
        value.quantity(*self)
    }

    fn write(&self, value: &f64) -> Option<Content> {
        Some(match self.dimension.and_then(Dimension::si) {
            Some(unit) => Content::Text(format!("{value:?} {unit}")),
            None => crate::document::number(*value),
        })
    }

    fn each(&self, value: &f64, path: &str, visit: &mut Visit) {
        visit(path, *value, *self);
    }

    fn form(&self) -> Form {
        Form::Quantity(*self)
    }
}

/// A whole number.
pub struct Whole(pub Quantity);

impl Kind for Whole {
    type Value = u64;

    fn read(&self, value: &Value) -> Result<u64, SceneError> {
        value.integer(self.0)
    }

    fn write(&self, value: &u64) -> Option<Content> {
        Some(Content::Number {
            value: *value as f64,
            integer: Some(*value),
        })
    }

    fn each(&self, value: &u64, path: &str, visit: &mut Visit) {
        visit(path, *value as f64, self.0);
    }

    fn form(&self) -> Form {
        Form::Quantity(self.0)
    }
}

/// A text, and what is allowed in words.
pub struct Text(pub &'static str);

impl Kind for Text {
    type Value = String;

    fn read(&self, value: &Value) -> Result<String, SceneError> {
        value.text(self.0)
    }

    fn write(&self, value: &String) -> Option<Content> {
        Some(Content::Text(value.clone()))
    }

    fn form(&self) -> Form {
        Form::Text(self.0)
    }
}

/// One of some words.
pub struct Word<T: 'static> {
    pub words: &'static [(&'static str, T)],
    /// What is allowed, if that says more than the words.
    pub allowed: Option<&'static str>,
    /// A word that is no longer one of them, and why.
    pub gone: Option<(&'static str, &'static str)>,
}

impl<T> Word<T> {
    /// One of these words.
    pub const fn of(words: &'static [(&'static str, T)]) -> Self {
        let (allowed, gone) = (None, None);
        Self { words, allowed, gone }
    }
}

impl<T: Copy + PartialEq> Kind for Word<T> {
    type Value = T;

    fn read(&self, value: &Value) -> Result<T, SceneError> {
        match (value.text(""), self.gone) {
            (Ok(text), Some((word, reason))) if text == word => {
                let allowed = format!("{}; {reason}", self.form().allowed());
                Err(value.wrong(WrongKind::Value, value.written(), allowed))
            }
            _ => value.word(self.words, &self.form().allowed()),
        }
    }

    fn write(&self, value: &T) -> Option<Content> {
        let (word, _) = self.words.iter().find(|(_, meaning)| meaning == value)?;
        Some(Content::Text((*word).to_owned()))
    }

    fn form(&self) -> Form {
        Form::Words(self.words.iter().map(|(word, _)| *word).collect(), self.allowed)
    }
}

/// What may be left out.
pub struct Optional<K>(pub K);

impl<K: Kind> Kind for Optional<K> {
    type Value = Option<K::Value>;

    fn read(&self, value: &Value) -> Result<Self::Value, SceneError> {
        self.0.read(value).map(Some)
    }

    fn write(&self, value: &Self::Value) -> Option<Content> {
        self.0.write(value.as_ref()?)
    }

    fn each(&self, value: &Self::Value, path: &str, visit: &mut Visit) {
        if let Some(value) = value {
            self.0.each(value, path, visit);
        }
    }

    fn form(&self) -> Form {
        self.0.form()
    }

    fn absent(&self) -> Option<Self::Value> {
        Some(None)
    }
}

/// What has a value of its own if it is left out.
pub struct Or<K: Kind>(pub K, pub K::Value);

impl<K: Kind<Value: Clone + PartialEq>> Kind for Or<K> {
    type Value = K::Value;

    fn read(&self, value: &Value) -> Result<Self::Value, SceneError> {
        self.0.read(value)
    }

    fn write(&self, value: &Self::Value) -> Option<Content> {
        self.0.write(value).filter(|_| *value != self.1)
    }

    fn each(&self, value: &Self::Value, path: &str, visit: &mut Visit) {
        self.0.each(value, path, visit);
    }

    fn form(&self) -> Form {
        self.0.form()
    }

    fn absent(&self) -> Option<Self::Value> {
        Some(self.1.clone())
    }
}

/// A list of so many items at least, and what is allowed in words.
pub struct List<K>(pub K, pub usize, pub &'static str);

impl<K: Kind> Kind for List<K> {
    type Value = Vec<K::Value>;

    fn read(&self, value: &Value) -> Result<Self::Value, SceneError> {
        let items = value.items(self.2)?;
        if items.len() < self.1 {
            let found = ["an empty list", "one item"][items.len()];
            return Err(value.wrong(WrongKind::Value, found, self.2));
        }
        items.iter().map(|item| self.0.read(item)).collect()
    }

    fn write(&self, value: &Self::Value) -> Option<Content> {
        let items = value.iter().filter_map(|item| self.0.write(item));
        let items: Vec<Node> = items.map(Node::of_program).collect();
        (!items.is_empty()).then_some(Content::Array(items))
    }

    fn each(&self, value: &Self::Value, path: &str, visit: &mut Visit) {
        for (index, item) in value.iter().enumerate() {
            self.0.each(item, &joined(path, &index.to_string()), visit);
        }
    }

    fn form(&self) -> Form {
        Form::List(Box::new(self.0.form()), self.1, self.2)
    }

    fn absent(&self) -> Option<Self::Value> {
        (self.1 == 0).then(Vec::new)
    }
}

/// A table with the keys of `T`.
pub struct Section<T>(std::marker::PhantomData<T>);

/// A table with the keys of `T`.
pub const fn section<T: Keys>() -> Section<T> {
    Section(std::marker::PhantomData)
}

impl<T: Keys> Kind for Section<T> {
    type Value = T;

    fn read(&self, value: &Value) -> Result<T, SceneError> {
        T::read(&Table::open(value, &T::keys())?)
    }

    fn write(&self, value: &T) -> Option<Content> {
        let entry = |(key, content)| Entry::of_program(key, content);
        Some(Content::Table(value.write().into_iter().map(entry).collect()))
    }

    fn each(&self, value: &T, path: &str, visit: &mut Visit) {
        value.each(path, visit);
    }

    fn form(&self) -> Form {
        Form::Table(T::keys())
    }
}

/// Where what a program writes stands: nowhere.
const NOWHERE: Place = Place {
    source: 0,
    span: 0..0,
};

impl Node {
    /// A value that a program has.
    pub fn of_program(content: Content) -> Self {
        Self {
            place: NOWHERE,
            content,
        }
    }
}

impl Entry {
    /// A key and a value that a program has.
    pub fn of_program(key: &str, content: Content) -> Self {
        let (key, value) = (key.to_owned(), Node::of_program(content));
        Self {
            key,
            key_place: NOWHERE,
            value,
        }
    }
}
