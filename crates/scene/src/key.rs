//! Keys of the file: what they mean, and what may stand there.

use crate::content::{joined, other_name};
use crate::error::{Result, SceneError};
use crate::nearest::meant_by;
use crate::range::Quantity;
use crate::shown::listed;

/// A key and what is to be said of it.
pub struct Key {
    pub name: &'static str,
    pub meaning: &'static str,
    pub form: Form,
    /// What counts if it is left out, in words; `None` if it is required.
    pub absent: Option<&'static str>,
}

impl Key {
    pub const fn preset(meaning: &'static str) -> Self {
        Self {
            name: "preset",
            meaning,
            form: Form::Name("a name that `creepage presets` lists"),
            absent: Some("none"),
        }
    }

    /// Whether this is its name, or the other one under which it is understood.
    pub fn is_named(&self, name: &str) -> bool {
        self.name == name || other_name(self.name) == Some(name)
    }
}

/// What may stand at a key; words say what is allowed.
#[derive(Clone, Copy)]
pub enum Form {
    Number(Quantity),
    Text(&'static str),
    /// A text that is not blank.
    Name(&'static str),
    /// A text or a number.
    Any(&'static str),
    /// One of these words, and what else is to be said of them.
    Words(&'static [&'static str], &'static str),
    Table(&'static [Key]),
    /// A list of so many items at least, all of one form or each of its own.
    List(&'static [Form], usize, &'static str),
    /// A table of the lowest and the highest value of numbers below these keys.
    Intervals(fn() -> &'static [Key], &'static str),
    /// A value that is no table, or a table. A text stands for the first key of the table.
    Either(&'static Form, &'static [Key]),
}

impl Form {
    /// The keys of a table, or of the tables of a list.
    pub fn keys(self) -> &'static [Key] {
        match self {
            Self::Table(keys) | Self::Either(_, keys) => keys,
            Self::List([form, ..], ..) => form.keys(),
            _ => &[],
        }
    }

    /// The quantity of a number, alone or in place of a table.
    pub fn quantity(self) -> Option<Quantity> {
        match self {
            Self::Number(quantity) => Some(quantity),
            Self::Either(form, _) => form.quantity(),
            _ => None,
        }
    }

    /// What is allowed, in words.
    pub fn allowed(self) -> String {
        match self {
            Self::Number(quantity) => quantity.allowed(),
            Self::Text(allowed)
            | Self::Name(allowed)
            | Self::Any(allowed)
            | Self::Intervals(_, allowed)
            | Self::List(_, _, allowed) => allowed.to_owned(),
            Self::Words(words, more) => listed(words.iter().copied()) + more,
            Self::Table(keys) => format!("a table with the keys {}", names(keys)),
            Self::Either(form, _) => form.allowed(),
        }
    }
}

fn names(keys: &[Key]) -> String {
    let names: Vec<&str> = keys.iter().map(|key| key.name).collect();
    names.join(", ")
}

/// The error of a name that is none of these keys of the table at `path`.
pub fn unknown_key(path: &str, name: &str, keys: &[Key]) -> SceneError {
    let meant = meant_by(name, keys.iter().map(|key| key.name));
    SceneError::unknown(&joined(path, name), meant, names(keys))
}

/// The form of the number at a key below these, such as `vehicles.0.load`, which the table at `path`
/// names.
pub fn number_at(keys: &'static [Key], path: &str, key: &str) -> Result<Form> {
    const ALLOWED: &str = "a key of the scene that takes a number, such as \"friction.dynamic_coefficient\" (`creepage explain` lists \
                           them)";
    let (mut form, mut place) = (Form::Table(keys), path.to_owned());
    for part in key.split('.') {
        let keys = form.keys();
        let known = keys.iter().find(|key| key.is_named(part));
        form = match (form, known) {
            (Form::List([item, ..], ..), _) if part.parse::<usize>().is_ok() => *item,
            (Form::List(..), _) => break,
            (_, Some(key)) => key.form,
            _ if keys.is_empty() => break,
            _ => return Err(unknown_key(&place, part, keys)),
        };
        place = joined(&place, part);
    }
    let wrong = || SceneError::value(&place, format!("`{key}`"), ALLOWED);
    form.quantity().map(|_| form).ok_or_else(wrong)
}
