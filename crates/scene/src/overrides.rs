//! `KEY=VALUE` on top of a scene file.

use toml::de::DeValue;

use crate::document::{Content, Document, Entry, Node, Place, node, number};
use crate::error::{SceneError, WrongKind};
use crate::rivals::give_way;

/// No key of a scene is deeper: `vehicles.0.wheels.0.contact_radius`.
const DEEPEST: usize = 8;

/// Sets one key of the document, or removes it where the value is empty.
pub fn apply(document: &mut Document, text: &str) -> Result<(), SceneError> {
    let source = document.add_override(text);
    let place = |end| Place { source, span: 0..end };
    let wrong = |document: &Document, place: Place, key: &str, found: String, allowed: &str| {
        document.wrong(WrongKind::Override, &place, key, found, allowed)
    };
    let Some((key, written)) = text.split_once('=') else {
        let allowed = "KEY=VALUE, such as friction.dynamic_coefficient=0.3";
        let found = format!("`{text}`, without `=`");
        return Err(wrong(document, place(text.len()), text.trim(), found, allowed));
    };
    let key_place = place(key.len());
    let key = key.trim();
    let segments: Vec<&str> = key.split('.').map(str::trim).collect();
    if segments.len() > DEEPEST || segments.iter().any(|segment| segment.is_empty()) {
        let allowed = "a key such as duct.length or vehicles.0.speed";
        return Err(wrong(document, key_place, key, format!("`{key}`"), allowed));
    }
    if let Some(meant) = with_points(key) {
        let allowed = format!("`{meant}`: an item of a list by its number, from 0 on");
        return Err(wrong(document, key_place, key, format!("`{key}`"), &allowed));
    }
    let value = value(written, source, text.len() - written.len());
    let is_set = value.is_some();
    descend(&mut document.root, &segments, value, &key_place)
        .map_err(|(found, allowed)| wrong(document, key_place, key, found, &allowed))?;
    if is_set {
        give_way(document, &segments.join("."));
    }
    Ok(())
}

/// A key with the numbers of list items in brackets, `ground.layers[1].thickness`, as it is to be written.
fn with_points(key: &str) -> Option<String> {
    let bracketed = key.contains('[') && key.contains(']');
    bracketed.then(|| key.replace('[', ".").replace(']', ""))
}

/// There is nothing at the key: what was found, and what is allowed.
type Missing = (String, String);

/// The value as TOML, or as a text where it is not TOML; `None` where it is empty.
fn value(written: &str, source: usize, offset: usize) -> Option<Node> {
    let trimmed = written.trim();
    if trimmed.is_empty() {
        return None;
    }
    let start = offset + written.len() - written.trim_start().len();
    if let Ok(value) = DeValue::parse(trimmed) {
        return Some(node(&value, source, start));
    }
    // Numbers that TOML does not write so: `.5`, `5.`
    let numeric = trimmed.starts_with(|c: char| matches!(c, '0'..='9' | '.' | '+' | '-'));
    let content = match trimmed.parse() {
        Ok(value) if numeric => number(value),
        _ => Content::Text(trimmed.to_owned()),
    };
    Some(Node {
        place: Place {
            source,
            span: start..start + trimmed.len(),
        },
        content,
    })
}

fn descend(
    node: &mut Node,
    segments: &[&str],
    value: Option<Node>,
    key_place: &Place,
) -> Result<(), Missing> {
    let Some((segment, rest)) = segments.split_first() else {
        if let Some(value) = value {
            *node = value;
        }
        return Ok(());
    };
    if let Content::Array(items) = &mut node.content {
        let count = items.len();
        let index = segment.parse().ok().filter(|&index: &usize| index < count);
        let Some(index) = index else {
            let allowed = match count {
                0 => "nothing: the list is empty".to_owned(),
                1 => "the index 0, for the only item of the list".to_owned(),
                _ => format!("an index from 0 to {} of the list", count - 1),
            };
            return Err((format!("`{segment}`"), allowed));
        };
        if rest.is_empty() && value.is_none() {
            items.remove(index);
            return Ok(());
        }
        return descend(&mut items[index], rest, value, key_place);
    }
    if !matches!(node.content, Content::Table(_)) {
        // `ends.downstream.spring=…` on `downstream = "fixed"`
        *node = Node {
            place: key_place.clone(),
            content: Content::Table(Vec::new()),
        };
    }
    let Content::Table(entries) = &mut node.content else {
        return Ok(());
    };
    let found = entries.iter().position(|entry| entry.key == *segment);
    let index = match (found, &value) {
        (Some(index), None) if rest.is_empty() => {
            entries.remove(index);
            return Ok(());
        }
        (Some(index), _) => index,
        (None, None) => {
            let found = "an empty value, which removes the key".to_owned();
            return Err((found, "a value, or a key that the scene holds".to_owned()));
        }
        (None, Some(_)) => {
            entries.push(Entry {
                key: (*segment).to_owned(),
                key_place: key_place.clone(),
                value: Node {
                    place: key_place.clone(),
                    content: Content::Table(Vec::new()),
                },
            });
            entries.len() - 1
        }
    };
    let entry = &mut entries[index];
    if rest.is_empty() {
        entry.key_place = key_place.clone();
    }
    descend(&mut entry.value, rest, value, key_place)
}
