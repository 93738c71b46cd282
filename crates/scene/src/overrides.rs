//! `KEY=VALUE` on top of a scene file.

use toml::de::DeValue;

use crate::content::{Content, Entry, Node, Place, joined};
use crate::document::{Document, first_line, node};
use crate::error::{SceneError, WrongKind};
use crate::rivals::gives_way;

/// No key of a scene is deeper: `vehicles.0.wheels.0.contact_radius`.
const DEEPEST: usize = 8;

/// What was found, and what is allowed.
type Refused = (String, String);

/// Sets one key of the document, or removes it if the value is empty.
pub fn apply(document: &mut Document, text: &str) -> Result<(), SceneError> {
    let source = document.add(format!("--set {text}"), text, false);
    let key = text.split_once('=').map_or(text, |(key, _)| key);
    let place = Place {
        source,
        bytes: 0..key.len(),
    };
    set_text(document, text, &place).map_err(|(found, allowed)| {
        let mut error = SceneError::wrong(WrongKind::Override, key.trim(), found, allowed);
        if let SceneError::Wrong(wrong) = &mut error {
            wrong.location = Some(document.locate(&place));
        }
        error
    })
}

fn set_text(document: &mut Document, text: &str, place: &Place) -> Result<(), Refused> {
    let Some((key, written)) = text.split_once('=') else {
        let allowed = "KEY=VALUE, such as friction.dynamic_coefficient=0.3";
        return Err((format!("`{text}`, without `=`"), allowed.to_owned()));
    };
    let (key, value) = (key.trim(), value(written, key.len() + 1, place.source));
    let segments: Vec<&str> = key.split('.').map(str::trim).collect();
    let found = format!("`{key}`");
    if segments.len() > DEEPEST || segments.contains(&"") {
        return Err((found, "a key such as duct.length or vehicles.0.speed".to_owned()));
    }
    if key.contains('[') && key.contains(']') {
        let meant = key.replace('[', ".").replace(']', "");
        return Err((
            found,
            format!("`{meant}`: an item of a list by its number, from 0 on"),
        ));
    }
    // The table of axles stands in place of `[[vehicles]]`.
    let rival: &[&str] = match (&*segments.join("."), &value) {
        ("vehicles", Some(_)) => &["traffic", "histogram"],
        ("traffic.histogram", Some(_)) => &["vehicles"],
        _ => &[],
    };
    let root = &mut document.root;
    if !rival.is_empty() {
        set(root, "", rival, None, place).ok();
    }
    set(root, "", &segments, value, place)
}

/// The value as TOML, or as a text if it is not TOML; `None` if it is empty. It begins at `start` of the override.
fn value(written: &str, start: usize, source: usize) -> Option<Node> {
    let trimmed = written.trim();
    // Numbers that TOML does not write so: `.5`, `5.`
    let numeric = trimmed.starts_with(|c: char| matches!(c, '0'..='9' | '.' | '+' | '-'));
    let content = match trimmed.parse() {
        Ok(value) if numeric => Content::number(value),
        _ => Content::Text(trimmed.to_owned()),
    };
    let mut value = match DeValue::parse(trimmed) {
        Ok(value) => node(&value, source, trimmed),
        Err(_) if trimmed.is_empty() => return None,
        Err(_) => Node {
            place: Place {
                source,
                bytes: 0..trimmed.len(),
            },
            written: first_line(trimmed),
            content,
        },
    };
    value.shift(start + written.len() - written.trim_start().len());
    Some(value)
}

/// Sets or removes what stands at these `segments` below the node at `path`.
fn set(
    node: &mut Node,
    path: &str,
    segments: &[&str],
    value: Option<Node>,
    place: &Place,
) -> Result<(), Refused> {
    let [segment, rest @ ..] = segments else {
        return Ok(());
    };
    let below = joined(path, segment);
    if let Content::List(items) = &mut node.content {
        let index = index_of(segment, items.len())?;
        match (rest, value) {
            ([], None) => _ = items.remove(index),
            ([], Some(value)) => items[index] = value,
            (_, value) => return set(&mut items[index], &below, rest, value, place),
        }
        return Ok(());
    }
    let table = || Node {
        place: place.clone(),
        written: String::new(),
        content: Content::Table(Vec::new()),
    };
    if !matches!(node.content, Content::Table(_)) {
        // `ends.downstream.spring=…` on `downstream = "fixed"`
        *node = table();
    }
    let Content::Table(entries) = &mut node.content else {
        return Ok(());
    };
    let Some(at) = entries.iter().position(|entry| entry.key == *segment) else {
        if value.is_none() {
            let found = "an empty value, which removes the key".to_owned();
            return Err((found, "a value, or a key that the scene holds".to_owned()));
        }
        entries.push(Entry {
            key: (*segment).to_owned(),
            place: place.clone(),
            value: table(),
        });
        return set(node, path, segments, value, place);
    };
    match (rest, value) {
        ([], None) => _ = entries.remove(at),
        ([], Some(value)) => {
            let entry = &mut entries[at];
            (entry.place, entry.value) = (place.clone(), value);
            let set = entry.clone();
            entries.retain(|present| !gives_way(path, present, &set));
        }
        (_, value) => return set(&mut entries[at].value, &below, rest, value, place),
    }
    Ok(())
}

/// The number of an item of a list that has so many.
fn index_of(segment: &str, count: usize) -> Result<usize, Refused> {
    let allowed = || match count {
        0 => "nothing: the list is empty".to_owned(),
        1 => "the index 0, for the only item of the list".to_owned(),
        _ => format!("an index from 0 to {} of the list", count - 1),
    };
    let index = segment.parse().ok().filter(|index| *index < count);
    index.ok_or_else(|| (format!("`{segment}`"), allowed()))
}
