//! What a document holds: texts, numbers, lists and tables, each with the place where it was written.

use std::ops::Range;

use serde::{Serialize, Serializer};

use crate::shown::{quoted, shortened, shown};

/// A place in a file, a preset or an override.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Place {
    /// The number of the text in its document.
    pub source: usize,
    pub bytes: Range<usize>,
}

/// A value where it was written; the place of one that a program has means nothing.
#[derive(Debug, Clone)]
pub struct Node {
    pub place: Place,
    /// Its text, the first line of it.
    pub written: String,
    pub content: Content,
}

#[derive(Debug, Clone)]
pub enum Content {
    Text(String),
    /// A whole number of at least 0 that fits, however it is written.
    Whole(u64),
    Number(f64),
    /// What no scene holds: a truth value, a date.
    Other,
    List(Vec<Node>),
    /// In the order of the file.
    Table(Vec<Entry>),
}

#[derive(Debug, Clone)]
pub struct Entry {
    pub key: String,
    pub place: Place,
    pub value: Node,
}

impl Serialize for Content {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Text(text) => text.serialize(serializer),
            Self::Whole(whole) => whole.serialize(serializer),
            Self::Number(value) => value.serialize(serializer),
            Self::Other => serializer.serialize_unit(),
            Self::List(items) => serializer.collect_seq(items.iter().map(|item| &item.content)),
            Self::Table(entries) => {
                serializer.collect_map(entries.iter().map(|entry| (&entry.key, &entry.value.content)))
            }
        }
    }
}

/// A value that a program has is written as a file would have it.
impl From<Content> for Node {
    fn from(content: Content) -> Self {
        let written = match &content {
            Content::Text(text) => quoted(text),
            Content::Whole(whole) => whole.to_string(),
            Content::Number(value) => shown(*value),
            _ => String::new(),
        };
        let place = Place::default();
        Self {
            place,
            written,
            content,
        }
    }
}

impl Content {
    /// A number that may be whole: `1e6` passes are as good as `1000000`.
    pub fn number(value: f64) -> Self {
        let whole = value as u64;
        let is_whole = whole as f64 == value && value.is_sign_positive();
        if is_whole {
            Self::Whole(whole)
        } else {
            Self::Number(value)
        }
    }

    /// The number, if it is one.
    pub fn as_number(&self) -> Option<f64> {
        match self {
            Self::Whole(whole) => Some(*whole as f64),
            Self::Number(value) => Some(*value),
            _ => None,
        }
    }

    /// The text, if it is one.
    pub fn as_text(&self) -> Option<&str> {
        match self {
            Self::Text(text) => Some(text),
            _ => None,
        }
    }

    /// The entries of a table; none of anything else.
    pub fn entries(&self) -> &[Entry] {
        match self {
            Self::Table(entries) => entries,
            _ => &[],
        }
    }

    /// A table with these values.
    pub fn table<'k>(values: impl IntoIterator<Item = (&'k str, Content)>) -> Self {
        let entry = |(key, value): (&str, Self)| Entry {
            key: key.to_owned(),
            place: Place::default(),
            value: value.into(),
        };
        Self::Table(values.into_iter().map(entry).collect())
    }

    /// The entry of this name, or of its other name.
    pub fn entry(&self, key: &str) -> Option<&Entry> {
        let named = |key: &str| self.entries().iter().find(|entry| entry.key == key);
        named(key).or_else(|| named(other_name(key)?))
    }

    /// The value of a table at this key, or of a list at this index.
    pub fn get(&self, segment: &str) -> Option<&Node> {
        match self {
            Self::List(items) => items.get(segment.parse::<usize>().ok()?),
            _ => self.entry(segment).map(|entry| &entry.value),
        }
    }
}

impl Node {
    /// A value that stands at this place of a text.
    pub fn new(place: Place, text: &str, content: Content) -> Self {
        const LONGEST: usize = 60;
        let all = text.get(place.bytes.clone()).unwrap_or_default();
        let line = all.lines().next().unwrap_or_default();
        let more = if line.len() < all.len() { "…" } else { "" };
        let written = shortened(line, LONGEST) + more;
        Self {
            place,
            written,
            content,
        }
    }

    /// What stands there, with its kind.
    pub fn described(&self) -> String {
        let kind = match self.content {
            Content::Text(_) => "the text ",
            Content::Whole(_) | Content::Number(_) => "the number ",
            Content::Other => "",
            Content::List(_) => "the list ",
            Content::Table(_) => "the table ",
        };
        format!("{kind}{}", self.written)
    }

    /// Calls `visit` with every value below this one that is no table and no list, and its key.
    pub fn each_value(&self, key: &str, visit: &mut impl FnMut(&str, &Self)) {
        match &self.content {
            Content::Table(entries) => {
                for entry in entries {
                    entry.value.each_value(&joined(key, &entry.key), visit);
                }
            }
            Content::List(items) => {
                for (index, item) in items.iter().enumerate() {
                    item.each_value(&joined(key, index), visit);
                }
            }
            _ => visit(key, self),
        }
    }
}

/// A key, or the number of an item, with the keys around it.
pub fn joined(path: &str, key: impl std::fmt::Display) -> String {
    if path.is_empty() {
        key.to_string()
    } else {
        format!("{path}.{key}")
    }
}

/// A key without the numbers of list items.
pub fn without_numbers(path: &str) -> String {
    let is_name = |part: &&str| part.parse::<usize>().is_err();
    path.split('.').filter(is_name).collect::<Vec<_>>().join(".")
}

/// A clamp has a `stiffness`, an end a `spring`: each is understood where the other is meant.
pub fn other_name(key: &str) -> Option<&'static str> {
    match key {
        "spring" => Some("stiffness"),
        "stiffness" => Some("spring"),
        _ => None,
    }
}
