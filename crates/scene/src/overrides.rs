//! `KEY=VALUE` on top of a scene file.

use std::ops::Range;

use toml::de::DeValue;

use crate::document::{Content, Document, Entry, Node, joined};
use crate::error::{SceneError, WrongKind};
use crate::rivals::gives_way;

/// No key of a scene is deeper: `vehicles.0.wheels.0.contact_radius`.
const DEEPEST: usize = 8;

/// Sets one key of the document, or removes it if the value is empty.
pub fn apply(document: &mut Document, text: &str) -> Result<(), SceneError> {
    let start = document.add(format!("--set {text}"), text, false);
    let Some((key, written)) = text.split_once('=') else {
        let allowed = "KEY=VALUE, such as friction.dynamic_coefficient=0.3";
        let span = start..start + text.len();
        let found = format!("`{text}`, without `=`");
        return Err(document.wrong(WrongKind::Override, &span, text.trim(), found, allowed));
    };
    let span = start..start + key.len();
    let value = value(written, start + text.len() - written.len());
    let key = key.trim();
    let segments: Vec<&str> = key.split('.').map(str::trim).collect();
    let placed = if segments.len() > DEEPEST || segments.contains(&"") {
        Err((
            format!("`{key}`"),
            "a key such as duct.length or vehicles.0.speed".to_owned(),
        ))
    } else if key.contains('[') && key.contains(']') {
        let meant = key.replace('[', ".").replace(']', "");
        Err((
            format!("`{key}`"),
            format!("`{meant}`: an item of a list by its number, from 0 on"),
        ))
    } else {
        // The table of axles stands in place of `[[vehicles]]`.
        let rival = match (&*segments.join("."), &value) {
            ("vehicles", Some(_)) => Some("traffic.histogram"),
            ("traffic.histogram", Some(_)) => Some("vehicles"),
            _ => None,
        };
        if let Some(rival) = rival.filter(|rival| document.find(rival).1) {
            let segments: Vec<&str> = rival.split('.').collect();
            set(&mut document.root, "", &segments, None, &span).ok();
        }
        set(&mut document.root, "", &segments, value, &span)
    };
    placed.map_err(|(found, allowed)| document.wrong(WrongKind::Override, &span, key, found, allowed))
}

/// The value as TOML, or as a text if it is not TOML; `None` if it is empty. It begins at `start` in the texts of the document.
fn value(written: &str, start: usize) -> Option<Node> {
    let trimmed = written.trim();
    let start = start + written.len() - written.trim_start().len();
    if let Ok(value) = DeValue::parse(trimmed) {
        return Some(Node::of(&value, start));
    }
    // Numbers that TOML does not write so: `.5`, `5.`
    let numeric = trimmed.starts_with(|c: char| matches!(c, '0'..='9' | '.' | '+' | '-'));
    let content = match trimmed.parse() {
        Ok(value) if numeric => Content::number(value),
        _ => Content::Text(trimmed.to_owned()),
    };
    let span = start..start + trimmed.len();
    (!trimmed.is_empty()).then_some(Node { span, content })
}

/// Sets or removes what stands at these `segments` below the node at `path`; what was found, and what is allowed, if there is no such place.
fn set(
    node: &mut Node,
    path: &str,
    segments: &[&str],
    value: Option<Node>,
    key_span: &Range<usize>,
) -> Result<(), (String, String)> {
    let [segment, rest @ ..] = segments else {
        return Ok(());
    };
    if let Content::List(items) = &mut node.content {
        let count = items.len();
        let Some(index) = segment.parse().ok().filter(|index: &usize| *index < count) else {
            let allowed = match count {
                0 => "nothing: the list is empty".to_owned(),
                1 => "the index 0, for the only item of the list".to_owned(),
                _ => format!("an index from 0 to {} of the list", count - 1),
            };
            return Err((format!("`{segment}`"), allowed));
        };
        match (rest, value) {
            ([], None) => _ = items.remove(index),
            ([], Some(value)) => items[index] = value,
            (_, value) => return set(&mut items[index], &joined(path, segment), rest, value, key_span),
        }
        return Ok(());
    }
    let table = || Node {
        span: key_span.clone(),
        content: Content::Table(Vec::new()),
    };
    if !matches!(node.content, Content::Table(_)) {
        // `ends.downstream.spring=…` on `downstream = "fixed"`
        *node = table();
    }
    let Content::Table(entries) = &mut node.content else {
        return Ok(());
    };
    let place = entries.iter().position(|entry| entry.key == *segment);
    let place = match (place, &value) {
        (Some(place), _) => place,
        (None, Some(_)) => {
            entries.push(Entry {
                key: (*segment).to_owned(),
                span: key_span.clone(),
                value: table(),
            });
            entries.len() - 1
        }
        (None, None) => {
            let found = "an empty value, which removes the key".to_owned();
            return Err((found, "a value, or a key that the scene holds".to_owned()));
        }
    };
    match (rest, value) {
        ([], None) => _ = entries.remove(place),
        ([], Some(value)) => {
            let entry = &mut entries[place];
            (entry.span, entry.value) = (key_span.clone(), value);
            let set = entry.clone();
            entries.retain(|present| !gives_way(path, present, &set));
        }
        (_, value) => {
            return set(
                &mut entries[place].value,
                &joined(path, segment),
                rest,
                value,
                key_span,
            );
        }
    }
    Ok(())
}
