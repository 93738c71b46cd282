//! `KEY=VALUE` on top of a scene file.

use std::sync::Arc;

use toml::de::DeTable;

use crate::content::{Content, Node, joined, node};
use crate::error::{Result, SceneError};
use crate::location::{Location, Source, SourceKind};
use crate::rivals::gives_way;

/// No key of a scene is deeper: `vehicles.0.wheels.0.contact_radius`.
const DEEPEST: usize = 8;

/// What was found, and what is allowed.
type Refused = (String, String);

/// Sets one key of a file's tree, or removes it if the value is empty.
pub fn apply(root: &mut Node, text: &str) -> Result<()> {
    let source = Source::new(SourceKind::Override, &format!("--set {text}"), text);
    let key = text.split('=').next().unwrap_or_default();
    let place = Location::new(&source, 0..key.len());
    let refused = |(found, allowed): Refused| SceneError::value(key.trim(), found, allowed);
    set_text(root, &place).map_err(|why| refused(why).at(place.clone(), true))
}

fn set_text(root: &mut Node, place: &Location) -> Result<(), Refused> {
    let text = &place.source.text;
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
        return set(root, "", &keys, None);
    }
    // The table of axles stands in place of `[[vehicles]]`.
    match &keys[..] {
        ["vehicles"] => set(root, "", &["traffic", "histogram"], None).unwrap_or_default(),
        ["traffic", "histogram"] => set(root, "", &["vehicles"], None).unwrap_or_default(),
        _ => (),
    }
    let mut value = parsed(&place.source, key.len() + 1);
    value.key_place = place.clone();
    set(root, "", &keys, Some(value))
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
    Node::new(Location::new(source, start..start + value.len()), content)
}

/// Sets what stands at these `keys` below the node at `path`, or removes it if there is no value.
fn set(node: &mut Node, path: &str, keys: &[&str], value: Option<Node>) -> Result<(), Refused> {
    let Some((key, below)) = keys.split_first() else {
        let key = node.key.clone();
        *node = value.unwrap_or_else(|| node.clone()).named(&key);
        return Ok(());
    };
    let path_of_key = joined(path, key);
    let is_removed = value.is_none() && below.is_empty();
    let place = value.as_ref().map(|value| value.key_place.clone());
    let empty = || Node::new(place.clone().unwrap_or_default(), Content::Table(Vec::new()));
    if let Content::List(items) = &mut node.content {
        let index = key.parse().ok().filter(|index| *index < items.len());
        let allowed = match items.len() {
            0 => "nothing: the list is empty".to_owned(),
            count => format!("an index from 0 to {} of the list", count - 1),
        };
        let index: usize = index.ok_or_else(|| (format!("`{key}`"), allowed))?;
        if is_removed {
            items.remove(index);
            return Ok(());
        }
        return set(&mut items[index], &path_of_key, below, value);
    }
    if !matches!(node.content, Content::Table(_)) {
        // `ends.downstream.spring=…` on `downstream = "fixed"`
        *node = empty().named(&node.key);
    }
    let Content::Table(entries) = &mut node.content else {
        return Ok(());
    };
    let known = entries.iter().position(|node| node.key == *key);
    if known.is_none() && value.is_none() {
        let found = "an empty value, which removes the key".to_owned();
        return Err((found, "a value, or a key that the scene holds".to_owned()));
    }
    let at = known.unwrap_or_else(|| {
        entries.push(empty().named(key));
        entries.len() - 1
    });
    if is_removed {
        entries.remove(at);
        return Ok(());
    }
    set(&mut entries[at], &path_of_key, below, value)?;
    if below.is_empty() {
        let node = entries[at].clone();
        entries.retain(|present| !gives_way(path, present, &node));
    }
    Ok(())
}
