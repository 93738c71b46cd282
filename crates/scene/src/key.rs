//! Keys of the file: what they mean, and what may stand there.

use crate::range::Quantity;
use crate::shown::listed;

/// A type that is a table of the file.
pub trait Section {
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
        let absent = None;
        Self {
            name,
            meaning,
            form,
            absent,
        }
    }

    pub const fn preset(meaning: &'static str) -> Self {
        Self {
            absent: Some("none"),
            ..Self::required(
                "preset",
                meaning,
                Form::Text("a name that `creepage presets` lists"),
            )
        }
    }
}

/// What may stand at a key; words say what is allowed.
#[derive(Clone, Copy)]
pub enum Form {
    Number(Quantity),
    Text(&'static str),
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
            | Self::Any(allowed)
            | Self::Intervals(_, allowed)
            | Self::List(_, _, allowed) => allowed.to_owned(),
            Self::Words(words, more) => listed(words.iter().copied()) + more,
            Self::Table(keys) => {
                let names: Vec<&str> = keys.iter().map(|key| key.name).collect();
                format!("a table with the keys {}", names.join(", "))
            }
            Self::Either(form, _) => form.allowed(),
        }
    }
}

/// Whether a text of which these words say what is allowed is a name, which is never empty.
pub fn is_name(allowed: &str) -> bool {
    allowed.starts_with("a name")
}
