//! A TOML document as a tree in which every key and value knows where it was written.

use std::ops::Range;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::error::shortened;
use super::syntax::{Fault, fault};
use super::table::Table;
use super::{Location, SceneError};
use crate::presets::Preset;

/// Where something was written: which source, which bytes of it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Place {
    /// 0 is the file; then overrides, and presets where they were named.
    pub source: usize,
    pub span: Range<usize>,
}

/// A value and its place.
#[derive(Debug, Clone)]
pub(super) struct Node {
    pub place: Place,
    pub content: Content,
}

#[derive(Debug, Clone)]
pub(super) enum Content {
    Text(String),
    /// A number; `integer` where it is a whole number that fits.
    Number {
        value: f64,
        integer: Option<i64>,
    },
    /// Something that no scene holds: a truth value, a date.
    Other,
    Array(Vec<Node>),
    /// In the order of the file.
    Table(Vec<Entry>),
}

impl Content {
    /// Appends the content in a form that no other content has.
    #[cfg(feature = "sweep")]
    fn write(&self, out: &mut String) {
        use std::fmt::Write;
        // Writing to a text does not fail.
        let _ = match self {
            Self::Text(text) => write!(out, "{text:?}"),
            Self::Number { value, integer } => write!(out, "{value:?} {integer:?}"),
            Self::Other => write!(out, "other"),
            Self::Array(items) => {
                out.push('[');
                for item in items {
                    item.content.write(out);
                    out.push(',');
                }
                write!(out, "]")
            }
            Self::Table(entries) => {
                let mut entries: Vec<&Entry> = entries.iter().collect();
                entries.sort_by(|one, other| one.key.cmp(&other.key));
                out.push('{');
                for entry in entries {
                    let _ = write!(out, "{:?}=", entry.key);
                    entry.value.content.write(out);
                    out.push(',');
                }
                write!(out, "}}")
            }
        };
    }
}

#[derive(Debug, Clone)]
pub(super) struct Entry {
    pub key: String,
    pub key_place: Place,
    pub value: Node,
}

impl Entry {
    fn move_to(&mut self, source: usize) {
        self.key_place.source = source;
        self.value.move_to(source);
    }
}

impl Node {
    /// Says that this was written in the source of that number.
    fn move_to(&mut self, source: usize) {
        self.place.source = source;
        match &mut self.content {
            Content::Array(items) => items.iter_mut().for_each(|item| item.move_to(source)),
            Content::Table(entries) => entries.iter_mut().for_each(|entry| entry.move_to(source)),
            _ => {}
        }
    }
}

/// A file, an override or a preset.
#[derive(Debug, Clone)]
struct Source {
    name: String,
    text: String,
    /// What ranks higher was set later. Files and overrides have odd ranks, and a preset the even one below what names it.
    rank: usize,
}

/// A scene file with its overrides.
#[derive(Debug, Clone)]
pub(super) struct Document {
    sources: Vec<Source>,
    pub root: Node,
}

impl Document {
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
                rank: 1,
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
    pub fn add_source(&mut self, text: &str) -> usize {
        let highest = self.sources.iter().map(|source| source.rank).max();
        self.sources.push(Source {
            name: format!("--set {text}"),
            text: text.to_owned(),
            rank: highest.unwrap_or_default() + 2,
        });
        self.sources.len() - 1
    }

    /// Adds a preset that was named at `place` as a source and returns its values.
    pub fn add_preset(&mut self, preset: &Preset, place: &Place) -> Result<Vec<Entry>, SceneError> {
        let values = Self::parse(&format!("preset {}", preset.name), &preset.toml)?.root;
        self.sources.push(Source {
            name: format!("preset {}", preset.name),
            text: preset.toml.clone(),
            rank: self.rank(place) - 1,
        });
        let Content::Table(mut entries) = values.content else {
            return Ok(Vec::new());
        };
        for entry in &mut entries {
            entry.move_to(self.sources.len() - 1);
        }
        Ok(entries)
    }

    /// All keys and values in an order of their own: where they were written, and what was remarked there, does not show.
    #[cfg(feature = "sweep")]
    pub fn values(&self) -> String {
        let mut text = String::new();
        self.root.content.write(&mut text);
        text
    }

    /// What ranks higher was set later.
    pub fn rank(&self, place: &Place) -> usize {
        self.sources[place.source].rank
    }

    /// Whether a preset gave what stands at this place.
    pub fn is_preset(&self, place: &Place) -> bool {
        self.rank(place).is_multiple_of(2)
    }

    /// The whole document as a table that may hold only the keys `known`.
    pub fn table(&self, known: &'static [&'static str]) -> Result<Table<'_>, SceneError> {
        Table::new(self, String::new(), &self.root, known)
    }

    #[expect(
        clippy::unnecessary_box_returns,
        reason = "errors hold it boxed, to stay small"
    )]
    pub fn locate(&self, place: &Place) -> Box<Location> {
        let source = &self.sources[place.source];
        let mut location = Location::new(&source.name, &source.text, place.span.clone(), place.source == 0);
        if *place == self.root.place {
            // What the top level lacks is not on its last line.
            location.text.clear();
            location.marked = 0..0;
        }
        location
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
pub(super) fn node(value: &Spanned<DeValue>, source: usize, offset: usize) -> Node {
    let content = match value.get_ref() {
        DeValue::String(text) => Content::Text(text.clone().into_owned()),
        DeValue::Integer(number) => {
            let integer = i128::from_str_radix(number.as_str(), number.radix()).ok();
            Content::Number {
                // Whole numbers are needed exactly only where they are small: elsewhere this is a quantity in SI.
                value: integer.map_or(f64::INFINITY, |i| i as f64),
                integer: integer.and_then(|i| i64::try_from(i).ok()),
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
pub(super) fn number(value: f64) -> Content {
    const LARGEST_EXACT: f64 = 9_007_199_254_740_992.0;
    let whole = value.fract() == 0.0 && value.abs() <= LARGEST_EXACT;
    Content::Number {
        value,
        integer: whole.then_some(value as i64),
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
