//! What a document holds: texts, numbers, lists and tables, each with the place where it was written.

use std::borrow::Cow;
use std::ops::Range;

use serde::{Serialize, Serializer};
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use crate::error::{Result, SceneError};
use crate::location::Location;
use crate::shown::{quoted, shortened, shown};

/// A place in a file, a preset or an override.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Place {
    pub source: usize,
    pub bytes: Range<usize>,
}

/// A value where it was written; the place of one that a program has means nothing.
#[derive(Debug, Clone, Serialize)]
#[serde(transparent)]
pub struct Node {
    /// Its key in a table.
    #[serde(skip)]
    pub key: String,
    #[serde(skip)]
    pub key_place: Place,
    #[serde(skip)]
    pub place: Place,
    /// Its text, the first line of it.
    #[serde(skip)]
    pub written: String,
    pub content: Content,
}

#[derive(Debug, Clone, Serialize)]
#[serde(untagged)]
pub enum Content {
    Text(String),
    /// A whole number of at least 0 that fits, however it is written.
    Whole(u64),
    Number(f64),
    /// What no scene holds: a truth value, a date.
    Other,
    List(Vec<Node>),
    /// In the order of the file.
    #[serde(serialize_with = "as_map")]
    Table(Vec<Node>),
}

fn as_map<S: Serializer>(entries: &[Node], serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_map(entries.iter().map(|node| (&node.key, node)))
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
        Self {
            written,
            ..Self::new(Place::default(), "", content)
        }
    }
}

impl Content {
    /// A number that may be whole: `1e6` passes are as good as `1000000`.
    pub fn number(value: f64) -> Self {
        let whole = value as u64;
        match whole as f64 == value && value.is_sign_positive() {
            true => Self::Whole(whole),
            false => Self::Number(value),
        }
    }

    pub fn as_number(&self) -> Option<f64> {
        match self {
            Self::Whole(whole) => Some(*whole as f64),
            Self::Number(value) => Some(*value),
            _ => None,
        }
    }

    pub fn as_text(&self) -> Option<&str> {
        match self {
            Self::Text(text) => Some(text),
            _ => None,
        }
    }

    /// A table with the values that there are.
    pub fn table<'k>(values: impl IntoIterator<Item = (&'k str, Option<Self>)>) -> Self {
        let values = values.into_iter();
        let entry = |(key, value): (&str, Option<Self>)| Some(Node::from(value?).named(key));
        Self::Table(values.filter_map(entry).collect())
    }

    /// The value of a table at exactly this key.
    pub fn entry(&self, key: &str) -> Option<&Node> {
        match self {
            Self::Table(entries) => entries.iter().find(|node| node.key == key),
            _ => None,
        }
    }

    /// The value of a table at this key, or at its other name, or of a list at this index.
    pub fn get(&self, segment: &str) -> Option<&Node> {
        if let Self::List(items) = self {
            return items.get(segment.parse::<usize>().ok()?);
        }
        let other = || self.entry(other_name(segment)?);
        self.entry(segment).or_else(other)
    }
}

impl Node {
    /// A value that stands at this place of a text.
    pub fn new(place: Place, text: &str, content: Content) -> Self {
        const LONGEST: usize = 60;
        let all = text.get(place.bytes.clone()).unwrap_or_default();
        let line = all.lines().next().unwrap_or_default();
        let more = if line.len() < all.len() { "…" } else { "" };
        Self {
            key: String::new(),
            key_place: place.clone(),
            place,
            written: shortened(line, LONGEST) + more,
            content,
        }
    }

    /// The same at this key of a table.
    pub fn named(self, key: &str) -> Self {
        let key = key.to_owned();
        Self { key, ..self }
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

    /// Every value below this one that is no table and no list, with its key.
    pub fn values(&self, key: &str) -> Vec<(String, &Self)> {
        let key_of = |index, node: &Self| match self.content {
            Content::List(_) => joined(key, index),
            _ => joined(key, &node.key),
        };
        let (Content::List(inner) | Content::Table(inner)) = &self.content else {
            return vec![(key.to_owned(), self)];
        };
        let inner = inner.iter().enumerate();
        inner
            .flat_map(|(index, node)| node.values(&key_of(index, node)))
            .collect()
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

/// The entries of a text, which is the source of this number; `name` stands for it in errors.
pub fn entries_of(name: &str, text: &str, source: usize) -> Result<Vec<Node>> {
    let table = DeTable::parse(text).map_err(|error| syntax_error(name, text, &error))?;
    Ok(entries(table.get_ref(), source, text))
}

fn entries(table: &DeTable, source: usize, text: &str) -> Vec<Node> {
    let entry = |(key, value): (&Spanned<Cow<str>>, _)| {
        let bytes = key.span();
        let mut node = node(value, source, text).named(key.get_ref());
        node.key_place = Place { source, bytes };
        node
    };
    let mut entries: Vec<Node> = table.iter().map(entry).collect();
    entries.sort_by_key(|node| node.key_place.bytes.start);
    entries
}

pub fn node(value: &Spanned<DeValue>, source: usize, text: &str) -> Node {
    let content = match value.get_ref() {
        DeValue::String(text) => Content::Text(text.to_string()),
        DeValue::Integer(number) => match i128::from_str_radix(number.as_str(), number.radix()) {
            // Whole numbers are needed exactly only where they are small: elsewhere this is a quantity in SI.
            Ok(whole) => u64::try_from(whole).map_or(Content::Number(whole as f64), Content::Whole),
            Err(_) => Content::Number(f64::INFINITY),
        },
        DeValue::Float(number) => number.as_str().parse().map_or(Content::Other, Content::number),
        DeValue::Boolean(_) | DeValue::Datetime(_) => Content::Other,
        DeValue::Array(items) => Content::List(items.iter().map(|item| node(item, source, text)).collect()),
        DeValue::Table(table) => Content::Table(entries(table, source, text)),
    };
    let bytes = value.span();
    Node::new(Place { source, bytes }, text, content)
}

/// Why the parser gave up on a text, and where.
fn syntax_error(name: &str, text: &str, error: &toml::de::Error) -> SceneError {
    // The parser does not say where keys are nested too deep.
    let deepest = || {
        let line = text.lines().max_by_key(|line| line.matches('.').count());
        text.find(line.unwrap_or_default()).unwrap_or_default()
    };
    let mut span = error.span().unwrap_or_else(|| deepest()..deepest());
    span.start = span.start.min(text.trim_end().len());
    SceneError::Syntax {
        location: Location::new(name, text, span, true),
        message: error.message().to_owned(),
    }
}
