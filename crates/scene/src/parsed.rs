//! TOML text as a tree, each of whose values knows where it was written.

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use crate::content::{Content, Entry, Node, Place};
use crate::error::{Result, SceneError};
use crate::location::Location;

/// The entries of a text, which is the source of this number; `name` stands for it in errors.
pub fn entries_of(name: &str, text: &str, source: usize) -> Result<Vec<Entry>> {
    let table = DeTable::parse(text).map_err(|error| syntax_error(name, text, &error))?;
    Ok(entries(table.get_ref(), source, text))
}

/// The entries of a parsed table, in the order of the text.
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

/// Why the parser gave up on a text, and where.
fn syntax_error(name: &str, text: &str, error: &toml::de::Error) -> SceneError {
    // The parser does not say where keys are nested too deep.
    let deepest = || text.lines().max_by_key(|line| line.matches('.').count());
    let deepest = || text.find(deepest().unwrap_or_default()).unwrap_or_default();
    let mut span = error.span().unwrap_or_else(|| deepest()..deepest());
    span.start = span.start.min(text.trim_end().len());
    SceneError::Syntax {
        location: Location::new(name, text, span, true),
        message: error.message().to_owned(),
    }
}
