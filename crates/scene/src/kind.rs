//! What may stand at a key: a number with a unit, a text, a word, a list, a table.

use crate::document::{Content, Entry, Node, joined, number};
use crate::error::{SceneError, WrongKind};
use crate::key::{Form, Keys, Kind, Table, Visit};
use crate::range::Quantity;
use crate::units::Dimension;
use crate::value::Value;

impl Kind for Quantity {
    type Value = f64;

    fn read(&self, value: &Value) -> Result<f64, SceneError> {
        value.quantity(*self)
    }

    fn write(&self, value: &f64) -> Option<Content> {
        Some(match self.dimension.and_then(Dimension::si) {
            Some(unit) => Content::Text(format!("{value:?} {unit}")),
            None => number(*value),
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
