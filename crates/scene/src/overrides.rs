//! `KEY=VALUE` on top of a scene file.

use std::sync::Arc;

use toml::de::DeTable;

use crate::content::{Content, Node, Place, Source, SourceKind, joined, node};
use crate::error::{Result, SceneError};
use crate::rivals::gives_way;

/// No key of a scene is deeper: `vehicles.0.wheels.0.contact_radius`.
const DEEPEST: usize = 8;

/// What was found, and what is allowed.
type Refused = (String, String);

/// Sets one key of a file's tree, or removes it if the value is empty.
pub fn apply(root: &mut Node, text: &str) -> Result<()> {
    let source = Source::new(SourceKind::Override, format!("--set {text}"), text);
    let key = text.split('=').next().unwrap_or_default();
    let place = Place::new(&source, 0..key.len());
    set_text(root, text, &place)
        .map_err(|(found, allowed)| SceneError::value(key.trim(), found, allowed).at(place.location(), true))
}

fn set_text(root: &mut Node, text: &str, place: &Place) -> Result<(), Refused> {
    let Some((key, value)) = text.split_once('=') else {
        let allowed = "KEY=VALUE, such as friction.dynamic_coefficient=0.3";
        return Err((format!("`{text}`, without `=`"), allowed.to_owned()));
    };
    let refused = |allowed: String| Err((format!("`{}`", key.trim()), allowed));
    if key.contains('[') {
        let plain = key.trim().replace('[', ".").replace(']', "");
        return refused(format!("`{plain}`: an item of a list by its number"));
    }
    let keys: Vec<&str> = key.split('.').map(str::trim).collect();
    if keys.len() > DEEPEST || keys.contains(&"") {
        return refused("a key such as duct.length or vehicles.0.speed".to_owned());
    }
    if value.trim().is_empty() {
        return set(root, "", &keys, None, place);
    }
    // The table of axles stands in place of `[[vehicles]]`.
    match &keys[..] {
        ["vehicles"] => set(root, "", &["traffic", "histogram"], None, place).unwrap_or_default(),
        ["traffic", "histogram"] => set(root, "", &["vehicles"], None, place).unwrap_or_default(),
        _ => (),
    }
    let value = parsed(&place.source, key.len() + 1);
    set(root, "", &keys, Some(value), place)
}

/// The value that begins at a byte of an override: TOML, or a text if it is not.
fn parsed(source: &Arc<Source>, start: usize) -> Node {
    let text = &source.text;
    // Behind a key that is as long, so that all places are those in the override.
    let line = format!("{:1$}={2}", "x", start - 1, &text[start..]);
    if let Ok(table) = DeTable::parse(&line)
        && let (Some(value), 1) = (table.get_ref().get("x"), table.get_ref().len())
    {
        return node(value, source);
    }
    let value = text[start..].trim();
    let start = text.len() - text[start..].trim_start().len();
    // Numbers that TOML does not write so: `.5`, `5.`
    let numeric = value.starts_with(|c: char| matches!(c, '0'..='9' | '.' | '+' | '-'));
    let content = match value.parse() {
        Ok(value) if numeric => Content::number(value),
        _ => Content::Text(value.to_owned()),
    };
    Node::new(Place::new(source, start..start + value.len()), content)
}

fn index(items: &[Node], number: &str) -> Result<usize, Refused> {
    let allowed = match items.len() {
        0 => "nothing: the list is empty".to_owned(),
        count => format!("an index from 0 to {} of the list", count - 1),
    };
    let index = number.parse().ok().filter(|index| *index < items.len());
    index.ok_or_else(|| (format!("`{number}`"), allowed))
}

/// Sets what stands at these `keys` below the node at `path`, or removes it where there is no value.
fn set(
    node: &mut Node,
    path: &str,
    keys: &[&str],
    value: Option<Node>,
    place: &Place,
) -> Result<(), Refused> {
    let Some((key, below)) = keys.split_first() else {
        let key = node.key.clone();
        *node = value.unwrap_or_else(|| node.clone()).named(&key);
        return Ok(());
    };
    let (path_of_key, is_removed) = (joined(path, key), value.is_none() && below.is_empty());
    if let Content::List(items) = &mut node.content {
        let index = index(items, key)?;
        if is_removed {
            items.remove(index);
            return Ok(());
        }
        return set(&mut items[index], &path_of_key, below, value, place);
    }
    let table = || Node::new(place.clone(), Content::Table(Vec::new()));
    if !matches!(node.content, Content::Table(_)) {
        // `ends.downstream.spring=…` on `downstream = "fixed"`
        *node = table().named(&node.key);
    }
    let Content::Table(entries) = &mut node.content else {
        return Ok(());
    };
    let known = entries.iter().position(|node| node.key == *key);
    match known {
        Some(at) if is_removed => {
            entries.remove(at);
            return Ok(());
        }
        None if value.is_none() => {
            let found = "an empty value, which removes the key".to_owned();
            return Err((found, "a value, or a key that the scene holds".to_owned()));
        }
        None => entries.push(table().named(key)),
        Some(_) => (),
    }
    let at = known.unwrap_or(entries.len() - 1);
    set(&mut entries[at], &path_of_key, below, value, place)?;
    if below.is_empty() {
        entries[at].key_place = place.clone();
        let node = entries[at].clone();
        entries.retain(|present| !gives_way(path, present, &node));
    }
    Ok(())
}
