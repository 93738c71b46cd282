//! A TOML document as a tree in which every key and value knows where it was written.

use std::ops::Range;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use crate::error::{SceneError, Wrong, WrongKind};
use crate::location::{Location, line_start};
use crate::presets::Preset;
use crate::quantity::{with_point, without_thousands};
use crate::shown::{quoted, shortened};

/// Where something was written: which source, which bytes of it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Place {
    /// 0 is the file; then overrides, and presets where they were named.
    pub source: usize,
    pub span: Range<usize>,
}

#[derive(Debug, Clone)]
pub struct Node {
    pub place: Place,
    pub content: Content,
}

#[derive(Debug, Clone)]
pub enum Content {
    Text(String),
    /// A number; `integer` if it is a whole number of at least 0 that fits.
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

#[derive(Debug, Clone)]
pub struct Entry {
    pub key: String,
    pub key_place: Place,
    pub value: Node,
}

/// Where what a program has stands: nowhere.
const NOWHERE: Place = Place {
    source: 0,
    span: 0..0,
};

impl Entry {
    /// A key and a value that a program has.
    pub fn of_program(key: &str, content: Content) -> Self {
        Self {
            key: key.to_owned(),
            key_place: NOWHERE,
            value: Node::of_program(content),
        }
    }
}

impl Node {
    /// A value that a program has.
    pub fn of_program(content: Content) -> Self {
        Self {
            place: NOWHERE,
            content,
        }
    }

    /// The value of a table at this key, or of a list at this index.
    pub fn child(&self, segment: &str) -> Option<&Self> {
        match &self.content {
            Content::Table(entries) => Some(&entries.iter().find(|entry| entry.key == segment)?.value),
            Content::Array(items) => items.get(segment.parse::<usize>().ok()?),
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
            Content::Array(items) => {
                for (index, item) in items.iter().enumerate() {
                    item.each_value(&joined(key, &index.to_string()), visit);
                }
            }
            _ => visit(key, self),
        }
    }
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

/// A file, an override or a preset.
#[derive(Debug, Clone)]
struct Source {
    name: String,
    text: String,
    is_preset: bool,
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
        let table = DeTable::parse(text).map_err(|error| syntax_error(name, text, &error))?;
        let end = text.trim_end().len();
        let mut document = Self {
            sources: Vec::new(),
            root: Node {
                // What the top level lacks would be added at the end.
                place: Place {
                    source: 0,
                    span: end..end,
                },
                content: Content::Table(entries(table.get_ref(), 0, 0)),
            },
        };
        document.add_source(name.to_owned(), text, false);
        Ok(document)
    }

    fn add_source(&mut self, name: String, text: &str, is_preset: bool) -> usize {
        let text = text.to_owned();
        self.sources.push(Source {
            name,
            text,
            is_preset,
        });
        self.sources.len() - 1
    }

    /// Adds an override as a source and returns its number.
    pub fn add_override(&mut self, text: &str) -> usize {
        self.add_source(format!("--set {text}"), text, false)
    }

    /// Adds a preset as a source and returns its values.
    pub fn add_preset(&mut self, preset: &Preset) -> Vec<Entry> {
        let source = self.add_source(format!("preset {}", preset.name), &preset.toml, true);
        // Presets are built in, and tests read them all.
        let table = DeTable::parse_recoverable(&preset.toml).0;
        entries(table.get_ref(), source, 0)
    }

    /// Whether a preset has what is at this place.
    pub fn is_of_preset(&self, place: &Place) -> bool {
        self.sources[place.source].is_preset
    }

    /// The name of what a place is in: the file, an override or a preset.
    pub fn source(&self, place: &Place) -> &str {
        &self.sources[place.source].name
    }

    /// The value of `key`, or else the section that would hold it; and whether it is the value.
    pub fn find(&self, key: &str) -> (&Node, bool) {
        let mut node = &self.root;
        for segment in key.split('.') {
            match node.child(segment).or_else(|| node.child(other_name(segment)?)) {
                Some(inner) => node = inner,
                None => return (node, false),
            }
        }
        (node, true)
    }

    /// The table at `path`, to be changed.
    pub fn find_mut(&mut self, path: &str) -> Option<&mut Node> {
        let segments = path.split('.').filter(|segment| !segment.is_empty());
        segments
            .into_iter()
            .try_fold(&mut self.root, |node, segment| match &mut node.content {
                Content::Table(entries) => {
                    Some(&mut entries.iter_mut().find(|entry| entry.key == segment)?.value)
                }
                Content::Array(items) => items.get_mut(segment.parse::<usize>().ok()?),
                _ => None,
            })
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
        let mut wrong = Wrong::at(kind, key, found, allowed);
        wrong.location = Some(self.locate(place));
        wrong.into()
    }

    /// What is wrong at a key, with the place where that stands; if there is none, that of the section that lacks it.
    pub fn located(&self, mut wrong: Box<Wrong>) -> SceneError {
        let (node, is_value) = self.find(&wrong.key);
        if wrong.kind == WrongKind::OutOfRange && is_value {
            wrong.found = self.written(&node.place);
        }
        wrong.location = Some(self.locate(&node.place));
        wrong.into()
    }

    /// What was written at a place: its first line, without what is too long to repeat.
    pub fn written(&self, place: &Place) -> String {
        const LONGEST: usize = 60;
        let text = self.sources[place.source].text.get(place.span.clone());
        let text = text.unwrap_or_default();
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
    let line = text[line_start(text, span.start)..].lines().next();
    let message = hint(line.unwrap_or_default()).unwrap_or_else(|| error.message().to_owned());
    let location = Location::new(name, text, span, true);
    SceneError::Syntax { location, message }
}

/// How a number with commas, or with its unit, is written.
fn hint(line: &str) -> Option<String> {
    let (key, value) = line.split_once('=')?;
    let (key, value) = (key.trim(), value.split('#').next()?.trim());
    let is_number = value.starts_with(|c: char| c.is_ascii_digit() || matches!(c, '+' | '-'));
    if !is_number || value.contains(['"', '\'', ':']) || value.contains("..") {
        return None;
    }
    let as_toml = |value: &str| {
        value
            .parse::<f64>()
            .map_or_else(|_| quoted(value), |_| value.to_owned())
    };
    if let Some(point) = with_point(value) {
        let whole = without_thousands(value).map(|whole| as_toml(&whole));
        let or = whole.map_or_else(String::new, |whole| {
            format!(", or {whole} if the comma separates thousands")
        });
        let how = "decimals are written with a point, without thousands separators";
        return Some(format!("{how}: {key} = {}{or}", as_toml(&point)));
    }
    let unit = value.ends_with(|c: char| c.is_alphabetic() || matches!(c, '%' | '2' | '²'));
    (unit && value.parse::<f64>().is_err())
        .then(|| format!("a quantity with its unit stands in quotes: {key} = \"{value}\""))
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
    let place = place(value.span(), source, offset);
    Node { place, content }
}

/// A number that may be whole: `1e6` passes are as good as `1000000`.
pub fn number(value: f64) -> Content {
    const LARGEST_EXACT: f64 = 9_007_199_254_740_992.0;
    let whole = value.fract() == 0.0 && (0.0..=LARGEST_EXACT).contains(&value);
    let integer = whole.then_some(value as u64);
    Content::Number { value, integer }
}

fn entries(table: &DeTable, source: usize, offset: usize) -> Vec<Entry> {
    let entry = |(key, value): (&Spanned<_>, _)| {
        let name: &std::borrow::Cow<str> = key.get_ref();
        Entry {
            key: name.clone().into_owned(),
            key_place: place(key.span(), source, offset),
            value: node(value, source, offset),
        }
    };
    let mut entries: Vec<Entry> = table.iter().map(entry).collect();
    entries.sort_by_key(|entry| entry.key_place.span.start);
    entries
}

fn place(span: Range<usize>, source: usize, offset: usize) -> Place {
    let span = span.start + offset..span.end + offset;
    Place { source, span }
}
