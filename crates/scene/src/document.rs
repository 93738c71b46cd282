//! A TOML document as a tree in which every key and value knows where it was written: in the file, in an override or in a preset.

use std::ops::Range;

use serde::{Serialize, Serializer};
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use crate::error::{SceneError, Wrong, WrongKind};
use crate::location::{Location, line_of};
use crate::quantity::{with_point, without_thousands};
use crate::shown::{quoted, shortened};

/// A value, and the bytes where it stands in the texts of its document.
#[derive(Debug, Clone)]
pub struct Node {
    pub span: Range<usize>,
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
    Table(Vec<Entry>),
}

#[derive(Debug, Clone)]
pub struct Entry {
    pub key: String,
    pub span: Range<usize>,
    pub value: Node,
}

fn as_map<S: Serializer>(entries: &[Entry], serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_map(entries.iter().map(|entry| (&entry.key, &entry.value)))
}

impl Serialize for Node {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.content.serialize(serializer)
    }
}

/// A value that a program has, which stands nowhere.
impl From<Content> for Node {
    fn from(content: Content) -> Self {
        Self { span: 0..0, content }
    }
}

impl Content {
    /// A number that may be whole: `1e6` passes are as good as `1000000`.
    pub fn number(value: f64) -> Self {
        const LARGEST_EXACT: f64 = 9_007_199_254_740_992.0;
        let whole =
            value.fract() == 0.0 && (0.0..=LARGEST_EXACT).contains(&value) && value.is_sign_positive();
        if whole {
            Self::Whole(value as u64)
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
}

impl Node {
    /// The tree of a parsed value, whose text begins at `offset` in the texts of its document.
    pub fn of(value: &Spanned<DeValue>, offset: usize) -> Self {
        let content = match value.get_ref() {
            DeValue::String(text) => Content::Text(text.clone().into_owned()),
            DeValue::Integer(number) => match i128::from_str_radix(number.as_str(), number.radix()) {
                // Whole numbers are needed exactly only where they are small: elsewhere this is a quantity in SI.
                Ok(whole) => u64::try_from(whole).map_or(Content::Number(whole as f64), Content::Whole),
                Err(_) => Content::Number(f64::INFINITY),
            },
            DeValue::Float(number) => number.as_str().parse().map_or(Content::Other, Content::number),
            DeValue::Boolean(_) | DeValue::Datetime(_) => Content::Other,
            DeValue::Array(items) => Content::List(items.iter().map(|item| Self::of(item, offset)).collect()),
            DeValue::Table(table) => Content::Table(entries(table, offset)),
        };
        Self {
            span: moved(value.span(), offset),
            content,
        }
    }

    /// The value of a table at this key, or of a list at this index.
    pub fn child(&self, segment: &str) -> Option<&Self> {
        let named = |entries: &'_ [Entry], key: &str| entries.iter().position(|entry| entry.key == key);
        match &self.content {
            Content::Table(entries) => {
                let place = named(entries, segment).or_else(|| named(entries, other_name(segment)?));
                Some(&entries[place?].value)
            }
            Content::List(items) => items.get(segment.parse::<usize>().ok()?),
            _ => None,
        }
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
                    item.each_value(&joined(key, &index.to_string()), visit);
                }
            }
            _ => visit(key, self),
        }
    }
}

fn entries(table: &DeTable, offset: usize) -> Vec<Entry> {
    let entry = |(key, value): (&Spanned<std::borrow::Cow<str>>, _)| Entry {
        key: key.get_ref().clone().into_owned(),
        span: moved(key.span(), offset),
        value: Node::of(value, offset),
    };
    let mut entries: Vec<Entry> = table.iter().map(entry).collect();
    entries.sort_by_key(|entry| entry.span.start);
    entries
}

fn moved(span: Range<usize>, offset: usize) -> Range<usize> {
    span.start + offset..span.end + offset
}

/// A key with those of the tables around it.
pub fn joined(path: &str, key: &str) -> String {
    if path.is_empty() {
        key.to_owned()
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

/// A file, an override or a preset, and where its text begins.
#[derive(Debug, Clone)]
pub struct Source {
    pub name: String,
    pub start: usize,
    pub is_preset: bool,
}

#[derive(Debug, Clone)]
pub struct Document {
    /// The file's text, and behind it those of presets and overrides as they are named: all spans are spans of this.
    text: String,
    sources: Vec<Source>,
    pub root: Node,
}

impl Document {
    pub fn parse(name: &str, text: &str) -> Result<Self, SceneError> {
        let table = DeTable::parse(text).map_err(|error| syntax_error(name, text, &error))?;
        // What the top level lacks would be added at the end.
        let end = text.trim_end().len();
        let content = Content::Table(entries(table.get_ref(), 0));
        let source = Source {
            name: name.to_owned(),
            start: 0,
            is_preset: false,
        };
        let root = Node {
            span: end..end,
            content,
        };
        Ok(Self {
            text: text.to_owned(),
            sources: vec![source],
            root,
        })
    }

    /// The text of the file.
    pub fn text(&self) -> &str {
        self.text_of(0)
    }

    fn text_of(&self, source: usize) -> &str {
        let next = self.sources.get(source + 1);
        let end = next.map_or(self.text.len(), |next| next.start - 1);
        &self.text[self.sources[source].start..end]
    }

    /// Adds a source: where its text begins.
    pub fn add(&mut self, name: String, text: &str, is_preset: bool) -> usize {
        // What ends at the end of a text is not in the next one.
        self.text.push('\n');
        let start = self.text.len();
        self.text += text;
        self.sources.push(Source {
            name,
            start,
            is_preset,
        });
        start
    }

    /// Adds a preset, with its values.
    pub fn add_preset(&mut self, name: &str, text: &str) -> Vec<Entry> {
        let start = self.add(format!("preset {name}"), text, true);
        // Presets are built in, and tests read them all.
        entries(DeTable::parse_recoverable(text).0.get_ref(), start)
    }

    fn source_at(&self, at: usize) -> usize {
        self.sources.partition_point(|source| source.start <= at) - 1
    }

    /// What a span is in: the file, an override or a preset.
    pub fn source(&self, span: &Range<usize>) -> &Source {
        &self.sources[self.source_at(span.start)]
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

    /// Where in its source a span is.
    pub fn locate(&self, span: &Range<usize>) -> Location {
        let index = self.source_at(span.start);
        let source = &self.sources[index];
        let local = span.start - source.start..span.end - source.start;
        let mut location = Location::new(&source.name, self.text_of(index), local, index == 0);
        if *span == self.root.span {
            // What the top level lacks is not on its last line.
            location.text.clear();
            location.marked = 0..0;
        }
        location
    }

    /// The error for a key or value that stands there.
    pub fn wrong(
        &self,
        kind: WrongKind,
        span: &Range<usize>,
        key: &str,
        found: impl Into<String>,
        allowed: impl Into<String>,
    ) -> SceneError {
        let mut wrong = Wrong::at(kind, key, found, allowed);
        wrong.location = Some(self.locate(span));
        wrong.into()
    }

    /// What is wrong at a key, with the place where that stands; if there is none, that of the section that lacks it.
    pub fn located(&self, mut wrong: Box<Wrong>) -> SceneError {
        let (node, is_value) = self.find(&wrong.key);
        if wrong.kind == WrongKind::OutOfRange && is_value {
            wrong.found = self.written(&node.span);
        }
        wrong.location = Some(self.locate(&node.span));
        wrong.into()
    }

    /// What was written there: its first line, without what is too long to repeat.
    pub fn written(&self, span: &Range<usize>) -> String {
        const LONGEST: usize = 60;
        let text = self.text.get(span.clone()).unwrap_or_default();
        let line = text.lines().next().unwrap_or_default();
        if line.chars().count() <= LONGEST && line.len() < text.len() {
            return format!("{line}…");
        }
        shortened(line, LONGEST)
    }
}

/// Why the parser gave up on a text, and where; with a hint for a quantity without quotes and for a comma in a number.
fn syntax_error(name: &str, text: &str, error: &toml::de::Error) -> SceneError {
    // The parser does not say where keys are nested too deep.
    let deepest = || text.lines().max_by_key(|line| line.matches('.').count());
    let deepest = || text.find(deepest().unwrap_or_default()).unwrap_or_default();
    let mut span = error.span().unwrap_or_else(|| deepest()..deepest());
    span.start = span.start.min(text.trim_end().len());
    let message = hint(line_of(text, span.start).1).unwrap_or_else(|| error.message().to_owned());
    SceneError::Syntax {
        location: Location::new(name, text, span, true),
        message,
    }
}

/// How a number with commas, or with its unit, is written.
fn hint(line: &str) -> Option<String> {
    let (key, value) = line.split_once('=')?;
    let (key, value) = (key.trim(), value.split('#').next()?.trim());
    let is_number = value.starts_with(|c: char| c.is_ascii_digit() || matches!(c, '+' | '-'));
    if !is_number || value.contains(['"', '\'', ':']) || value.contains("..") {
        return None;
    }
    let as_toml = |value: String| {
        if value.parse::<f64>().is_ok() {
            value
        } else {
            quoted(&value)
        }
    };
    if let Some(point) = with_point(value) {
        let whole = without_thousands(value)
            .map(|whole| format!(", or {} if the comma separates thousands", as_toml(whole)));
        let how = "decimals are written with a point, without thousands separators";
        return Some(format!(
            "{how}: {key} = {}{}",
            as_toml(point),
            whole.unwrap_or_default()
        ));
    }
    let unit = value.ends_with(|c: char| c.is_alphabetic() || matches!(c, '%' | '2' | '²'));
    (unit && value.parse::<f64>().is_err())
        .then(|| format!("a quantity with its unit stands in quotes: {key} = \"{value}\""))
}
