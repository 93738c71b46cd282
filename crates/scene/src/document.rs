//! A TOML file with what was set on top of it: texts, and the tree of what they say.

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use crate::content::{Content, Entry, Node, Place};
use crate::error::{SceneError, WrongKind};
use crate::location::{Location, line_of};
use crate::quantity::{with_point, without_thousands};
use crate::shown::quoted;

/// The text of the file, of an override or of a preset.
#[derive(Debug, Clone)]
pub struct Source {
    pub name: String,
    pub text: String,
    pub is_preset: bool,
}

#[derive(Debug, Clone)]
pub struct Document {
    /// The file, and behind it presets and overrides as they are named.
    pub sources: Vec<Source>,
    pub root: Node,
}

impl Document {
    pub fn parse(name: &str, text: &str) -> Result<Self, SceneError> {
        let table = DeTable::parse(text).map_err(|error| syntax_error(name, text, &error))?;
        let root = Content::Table(entries(table.get_ref(), 0, text)).into();
        let sources = Vec::new();
        let mut document = Self { sources, root };
        document.add(name.to_owned(), text, false);
        Ok(document)
    }

    /// Adds a text: its number.
    pub fn add(&mut self, name: String, text: &str, is_preset: bool) -> usize {
        let text = text.to_owned();
        self.sources.push(Source {
            name,
            text,
            is_preset,
        });
        self.sources.len() - 1
    }

    /// Adds a preset, with its values.
    pub fn add_preset(&mut self, name: &str, text: &str) -> Vec<Entry> {
        let source = self.add(format!("preset {name}"), text, true);
        // Presets are built in, and tests read them all.
        entries(DeTable::parse_recoverable(text).0.get_ref(), source, text)
    }

    pub fn source(&self, node: &Node) -> &Source {
        &self.sources[node.place.source]
    }

    /// The value of `key`, or else the section that would hold it; and whether it is the value.
    pub fn find(&self, key: &str) -> (&Node, bool) {
        let mut node = &self.root;
        for segment in key.split('.') {
            match node.content.get(segment) {
                Some(inner) => node = inner,
                None => return (node, false),
            }
        }
        (node, true)
    }

    pub fn locate(&self, place: &Place) -> Location {
        let Source { name, text, .. } = &self.sources[place.source];
        if *place != self.root.place {
            return Location::new(name, text, place.bytes.clone(), place.source == 0);
        }
        // What the top level lacks would be added at the end, but is not on its last line.
        let end = text.trim_end().len();
        Location::new(name, &text[..end], end..end, true).without_line()
    }

    /// The error with the place of its key; if nothing stands there, with that of the section that lacks it.
    pub fn located(&self, error: SceneError) -> SceneError {
        let SceneError::Wrong(mut wrong) = error else {
            return error;
        };
        let (node, is_value) = self.find(&wrong.key);
        if wrong.kind == WrongKind::OutOfRange && is_value {
            wrong.found.clone_from(&node.written);
        }
        let (section, key) = wrong.key.rsplit_once('.').unwrap_or(("", &wrong.key));
        let entry = self.find(section).0.content.entry(key);
        let unknown = entry.filter(|_| wrong.kind == WrongKind::UnknownKey);
        let place = unknown.map_or(&node.place, |entry| &entry.place);
        SceneError::Wrong(wrong).at(self.locate(place))
    }
}

/// The entries of a parsed table, whose text is the source of this number.
fn entries(table: &DeTable, source: usize, text: &str) -> Vec<Entry> {
    let entry = |(key, value): (&Spanned<std::borrow::Cow<str>>, _)| Entry {
        key: key.get_ref().clone().into_owned(),
        place: Place {
            source,
            bytes: key.span(),
        },
        value: node(value, source, text),
    };
    let mut entries: Vec<Entry> = table.iter().map(entry).collect();
    entries.sort_by_key(|entry| entry.place.bytes.start);
    entries
}

/// The tree of a parsed value.
pub fn node(value: &Spanned<DeValue>, source: usize, text: &str) -> Node {
    let content = match value.get_ref() {
        DeValue::String(text) => Content::Text(text.clone().into_owned()),
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
    let as_toml = |value: String| match value.parse::<f64>() {
        Ok(_) => value,
        Err(_) => quoted(&value),
    };
    if let Some(point) = with_point(value) {
        let whole = without_thousands(value)
            .map(|whole| format!(", or {} if the comma separates thousands", as_toml(whole)));
        let (point, whole) = (as_toml(point), whole.unwrap_or_default());
        return Some(format!(
            "decimals are written with a point, without thousands separators: {key} = {point}{whole}"
        ));
    }
    let unit = value.ends_with(|c: char| c.is_alphabetic() || matches!(c, '%' | '2' | '²'));
    (unit && value.parse::<f64>().is_err())
        .then(|| format!("a quantity with its unit stands in quotes: {key} = \"{value}\""))
}
