//! A TOML document as a tree in which every key and value knows where it was written.

use std::fmt;
use std::ops::Range;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::error::{SceneError, Wrong, WrongKind};
use super::location::Location;
use super::syntax::{Fault, fault};
use crate::presets::Preset;
use crate::shown::shortened;

/// Where something was written: which source, which bytes of it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Place {
    /// 0 is the file; then overrides, and presets where they were named.
    pub source: usize,
    pub span: Range<usize>,
}

#[derive(Clone)]
pub struct Node {
    pub place: Place,
    pub content: Content,
}

#[derive(Debug, Clone)]
pub enum Content {
    Text(String),
    /// A number; `integer` where it is a whole number of at least 0 that fits.
    Number {
        value: f64,
        integer: Option<u64>,
    },
    /// What no scene holds: a truth value, a date.
    Other,
    Array(Vec<Node>),
    /// In the order of the file.
    Table(Vec<Entry>),
}

#[derive(Clone)]
pub struct Entry {
    pub key: String,
    pub key_place: Place,
    pub value: Node,
}

impl Node {
    /// The value of a table at this key, or of a list at this index.
    pub fn child(&self, segment: &str) -> Option<&Self> {
        match &self.content {
            Content::Table(entries) => Some(&entries.iter().find(|entry| entry.key == segment)?.value),
            Content::Array(items) => items.get(segment.parse::<usize>().ok()?),
            _ => None,
        }
    }

    /// Adds all texts below the node at `key`, with their keys.
    #[cfg(feature = "sweep")]
    pub fn texts(&self, key: String, texts: &mut Vec<(String, String)>) {
        let inner = |name: &str| {
            if key.is_empty() {
                name.to_owned()
            } else {
                format!("{key}.{name}")
            }
        };
        match &self.content {
            Content::Text(text) => texts.push((key, text.clone())),
            Content::Array(items) => {
                for (index, item) in items.iter().enumerate() {
                    item.texts(inner(&index.to_string()), texts);
                }
            }
            Content::Table(entries) => {
                for entry in entries {
                    entry.value.texts(inner(&entry.key), texts);
                }
            }
            Content::Number { .. } | Content::Other => {}
        }
    }
}

// Neither shows its place: equal texts are equal contents.

impl fmt::Debug for Node {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.content.fmt(f)
    }
}

impl fmt::Debug for Entry {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:?}={:?}", self.key, self.value)
    }
}

/// What gave a value. Of values given at the same step, a written one overrides a preset's.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Origin {
    /// A preset that was named in what was written.
    Preset,
    /// The file or an override.
    Written,
}

/// When a value was given: what compares greater was given later, and counts. Step 0 is the file, the next are the overrides.
type Rank = (usize, Origin);

/// A file, an override or a preset.
#[derive(Debug, Clone)]
struct Source {
    name: String,
    text: String,
    rank: Rank,
}

#[derive(Debug, Clone)]
pub struct Document {
    sources: Vec<Source>,
    pub root: Node,
}

impl Document {
    /// The text that was parsed.
    pub fn text(&self) -> &str {
        self.sources.first().map_or("", |source| &source.text)
    }

    pub fn parse(name: &str, text: &str) -> Result<Self, SceneError> {
        let table = DeTable::parse(text).map_err(|error| {
            let Fault { span, message } = fault(text, &error);
            SceneError::Syntax {
                location: Location::new(name, text, span, true),
                message,
            }
        })?;
        let end = text.trim_end().len();
        Ok(Self {
            sources: vec![Source {
                name: name.to_owned(),
                text: text.to_owned(),
                rank: (0, Origin::Written),
            }],
            root: Node {
                // What the top level lacks would be added at the end.
                place: Place {
                    source: 0,
                    span: end..end,
                },
                content: Content::Table(entries(table.get_ref(), 0, 0)),
            },
        })
    }

    /// Adds an override as a source and returns its number.
    pub fn add_override(&mut self, text: &str) -> usize {
        let last = self.sources.iter().map(|source| source.rank.0).max();
        self.sources.push(Source {
            name: format!("--set {text}"),
            text: text.to_owned(),
            rank: (last.unwrap_or_default() + 1, Origin::Written),
        });
        self.sources.len() - 1
    }

    /// Adds a preset that was named at `place` as a source and returns its values.
    pub fn add_preset(&mut self, preset: &Preset, place: &Place) -> Vec<Entry> {
        self.sources.push(Source {
            name: format!("preset {}", preset.name),
            text: preset.toml.clone(),
            rank: (self.rank(place).0, Origin::Preset),
        });
        // Presets are built in, and tests read them all.
        let table = DeTable::parse_recoverable(&preset.toml).0;
        entries(table.get_ref(), self.sources.len() - 1, 0)
    }

    /// When and by what the value at this place was given.
    pub fn rank(&self, place: &Place) -> Rank {
        self.sources[place.source].rank
    }

    /// The name of what a place is in: the file, an override or a preset.
    pub fn source(&self, place: &Place) -> &str {
        &self.sources[place.source].name
    }

    /// The value of `key`, or else the section that would hold it; and whether it is the value.
    pub fn find(&self, key: &str) -> (&Node, bool) {
        let mut node = &self.root;
        for segment in key.split('.') {
            match node.child(segment) {
                Some(inner) => node = inner,
                None => return (node, false),
            }
        }
        (node, true)
    }

    /// Where in its source a place is.
    pub fn locate(&self, place: &Place) -> Location {
        let source = &self.sources[place.source];
        let mut location = Location::new(&source.name, &source.text, place.span.clone(), place.source == 0);
        if *place == self.root.place {
            // What the top level lacks is not on its last line.
            location.text.clear();
            location.marked = 0..0;
        }
        location
    }

    /// The error for a key or value at this place.
    pub fn wrong(
        &self,
        kind: WrongKind,
        place: &Place,
        key: &str,
        found: impl Into<String>,
        allowed: impl Into<String>,
    ) -> SceneError {
        SceneError::Wrong(Box::new(Wrong {
            kind,
            key: key.to_owned(),
            found: found.into(),
            allowed: allowed.into(),
            location: Some(self.locate(place)),
        }))
    }

    /// What was written at a place: its first line, without what is too long to repeat.
    pub fn written(&self, place: &Place) -> String {
        const LONGEST: usize = 60;
        let text = self.sources[place.source]
            .text
            .get(place.span.clone())
            .unwrap_or_default();
        let line = text.lines().next().unwrap_or_default();
        if line.chars().count() <= LONGEST && line.len() < text.len() {
            return format!("{line}…");
        }
        shortened(line, LONGEST)
    }
}

/// The value as a tree; `offset` is where its text begins in the source.
pub fn node(value: &Spanned<DeValue>, source: usize, offset: usize) -> Node {
    let content = match value.get_ref() {
        DeValue::String(text) => Content::Text(text.clone().into_owned()),
        DeValue::Integer(number) => {
            let integer = i128::from_str_radix(number.as_str(), number.radix()).ok();
            Content::Number {
                // Whole numbers are needed exactly only where they are small: elsewhere this is a quantity in SI.
                value: integer.map_or(f64::INFINITY, |i| i as f64),
                integer: integer.and_then(|i| u64::try_from(i).ok()),
            }
        }
        DeValue::Float(number) => number.as_str().parse().map_or(Content::Other, self::number),
        DeValue::Boolean(_) | DeValue::Datetime(_) => Content::Other,
        DeValue::Array(items) => {
            Content::Array(items.iter().map(|item| node(item, source, offset)).collect())
        }
        DeValue::Table(table) => Content::Table(entries(table, source, offset)),
    };
    Node {
        place: place(value.span(), source, offset),
        content,
    }
}

/// A number that may be whole: `1e6` passes are as good as `1000000`.
pub fn number(value: f64) -> Content {
    const LARGEST_EXACT: f64 = 9_007_199_254_740_992.0;
    let whole = value.fract() == 0.0 && (0.0..=LARGEST_EXACT).contains(&value);
    Content::Number {
        value,
        integer: whole.then_some(value as u64),
    }
}

fn entries(table: &DeTable, source: usize, offset: usize) -> Vec<Entry> {
    let mut entries: Vec<Entry> = table
        .iter()
        .map(|(key, value)| Entry {
            key: key.get_ref().clone().into_owned(),
            key_place: place(key.span(), source, offset),
            value: node(value, source, offset),
        })
        .collect();
    entries.sort_by_key(|entry| entry.key_place.span.start);
    entries
}

fn place(span: Range<usize>, source: usize, offset: usize) -> Place {
    Place {
        source,
        span: span.start + offset..span.end + offset,
    }
}
