//! What a document holds: texts, numbers, lists and tables, each with the place where it was written.

use std::borrow::Cow;
use std::sync::Arc;

use serde::{Serialize, Serializer};
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use crate::error::{Result, SceneError};
use crate::location::{Location, Source};
use crate::shown::{quoted, shortened, shown};

/// A value where it was written; the place of one that a program has is in no text.
#[derive(Debug, Clone, Serialize)]
#[serde(transparent)]
pub struct Node {
    /// Its key in a table.
    #[serde(skip)]
    pub key: String,
    #[serde(skip)]
    pub key_place: Location,
    #[serde(skip)]
    pub place: Location,
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

impl From<Content> for Node {
    fn from(content: Content) -> Self {
        Self::new(Location::default(), content)
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
    pub fn new(place: Location, content: Content) -> Self {
        Self {
            key: String::new(),
            key_place: place.clone(),
            place,
            content,
        }
    }

    /// The same at this key of a table.
    pub fn named(self, key: &str) -> Self {
        let key = key.to_owned();
        Self { key, ..self }
    }

    /// What stands there, the first line of it; what a program has as a file would have it.
    pub fn written(&self) -> String {
        const LONGEST: usize = 60;
        let bytes = self.place.bytes.clone();
        let written = bytes.and_then(|bytes| self.place.source.text.get(bytes));
        let mut lines = written.unwrap_or_default().lines();
        match (lines.next(), lines.next(), &self.content) {
            (Some(line), None, _) => shortened(line, LONGEST),
            (Some(line), Some(_), _) => shortened(line, LONGEST) + "…",
            (None, _, Content::Text(text)) => quoted(text),
            (None, _, Content::Whole(whole)) => whole.to_string(),
            (None, _, Content::Number(value)) => shown(*value),
            (None, ..) => String::new(),
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
        format!("{kind}{}", self.written())
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

/// The entries of a text of TOML.
pub fn entries_of(source: &Arc<Source>) -> Result<Vec<Node>> {
    let table = DeTable::parse(&source.text).map_err(|error| syntax_error(source, &error))?;
    Ok(entries(table.get_ref(), source))
}

fn entries(table: &DeTable, source: &Arc<Source>) -> Vec<Node> {
    let entry = |(key, value): (&Spanned<Cow<str>>, _)| {
        let mut node = node(value, source).named(key.get_ref());
        node.key_place = Location::new(source, key.span());
        node
    };
    let mut entries: Vec<Node> = table.iter().map(entry).collect();
    entries.sort_by_key(|node| node.key_place.bytes.as_ref().map(|bytes| bytes.start));
    entries
}

pub fn node(value: &Spanned<DeValue>, source: &Arc<Source>) -> Node {
    let content = match value.get_ref() {
        DeValue::String(text) => Content::Text(text.to_string()),
        DeValue::Integer(number) => match i128::from_str_radix(number.as_str(), number.radix()) {
            // Whole numbers beyond these are quantities in SI.
            Ok(whole) => u64::try_from(whole).map_or(Content::Number(whole as f64), Content::Whole),
            Err(_) => Content::Number(f64::INFINITY),
        },
        DeValue::Float(number) => number.as_str().parse().map_or(Content::Other, Content::number),
        DeValue::Boolean(_) | DeValue::Datetime(_) => Content::Other,
        DeValue::Array(items) => Content::List(items.iter().map(|item| node(item, source)).collect()),
        DeValue::Table(table) => Content::Table(entries(table, source)),
    };
    Node::new(Location::new(source, value.span()), content)
}

/// Why the parser gave up on a text, and where.
fn syntax_error(source: &Arc<Source>, error: &toml::de::Error) -> SceneError {
    let text = &source.text;
    // The parser does not say where keys are nested too deep.
    let deepest = || text.find(text.lines().max_by_key(|line| line.matches('.').count())?);
    let deepest = || deepest().unwrap_or_default();
    let span = error.span().unwrap_or_else(|| deepest()..deepest());
    let start = span.start.min(text.trim_end().len());
    SceneError::Syntax {
        location: Location::new(source, start..span.end),
        message: error.message().to_owned(),
    }
}
