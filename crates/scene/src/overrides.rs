//! `KEY=VALUE` on top of a scene file.

use toml::de::DeTable;

use crate::content::{Content, Entry, Node, Place, joined};
use crate::error::{SceneError, WrongKind};
use crate::file::SceneFile;
use crate::parsed::node;
use crate::rivals::gives_way;

/// No key of a scene is deeper: `vehicles.0.wheels.0.contact_radius`.
const DEEPEST: usize = 8;

/// What was found, and what is allowed.
type Refused = (String, String);

/// Sets one key of the file, or removes it if the value is empty.
pub fn apply(file: &mut SceneFile, text: &str) -> Result<(), SceneError> {
    let source = file.add(format!("--set {text}"), text, false);
    let key = text.split('=').next().unwrap_or_default();
    let bytes = 0..key.len();
    let place = Place { source, bytes };
    set_text(&mut file.root, text, &place).map_err(|(found, allowed)| {
        let error = SceneError::wrong(WrongKind::Override, key.trim(), found, allowed);
        error.at(file.location(&place))
    })
}

fn set_text(root: &mut Node, text: &str, place: &Place) -> Result<(), Refused> {
    let Some((key, value)) = text.split_once('=') else {
        let allowed = "KEY=VALUE, such as friction.dynamic_coefficient=0.3";
        return Err((format!("`{text}`, without `=`"), allowed.to_owned()));
    };
    let keys: Vec<&str> = key.split('.').map(str::trim).collect();
    if keys.len() > DEEPEST || keys.contains(&"") {
        let allowed = "a key such as duct.length or vehicles.0.speed";
        return Err((format!("`{}`", key.trim()), allowed.to_owned()));
    }
    if value.trim().is_empty() {
        return remove(root, &keys);
    }
    // The table of axles stands in place of `[[vehicles]]`.
    match &keys[..] {
        ["vehicles"] => remove(root, &["traffic", "histogram"]).unwrap_or_default(),
        ["traffic", "histogram"] => remove(root, &["vehicles"]).unwrap_or_default(),
        _ => {}
    }
    set(root, "", &keys, parsed(text, key.len() + 1, place.source), place)
}

/// The value that begins at a byte of an override: TOML, or a text if it is not.
fn parsed(text: &str, start: usize, source: usize) -> Node {
    // Behind a key that is as long, so that all places are those in the override.
    let line = format!("{:1$}={2}", "x", start - 1, &text[start..]);
    if let Ok(table) = DeTable::parse(&line)
        && let (Some(value), 1) = (table.get_ref().get("x"), table.get_ref().len())
    {
        return node(value, source, text);
    }
    let value = text[start..].trim();
    let start = text.len() - text[start..].trim_start().len();
    // Numbers that TOML does not write so: `.5`, `5.`
    let numeric = value.starts_with(|c: char| matches!(c, '0'..='9' | '.' | '+' | '-'));
    let content = match value.parse() {
        Ok(value) if numeric => Content::number(value),
        _ => Content::Text(value.to_owned()),
    };
    let bytes = start..start + value.len();
    Node::new(Place { source, bytes }, text, content)
}

/// The place of an item in a list.
fn index(items: &[Node], number: &str) -> Result<usize, Refused> {
    let allowed = match items.len() {
        0 => "nothing: the list is empty".to_owned(),
        1 => "the index 0, for the only item of the list".to_owned(),
        count => format!("an index from 0 to {} of the list", count - 1),
    };
    let index = number.parse().ok().filter(|index| *index < items.len());
    index.ok_or_else(|| (format!("`{number}`"), allowed))
}

/// Removes what stands at these `keys` below the node.
fn remove(node: &mut Node, keys: &[&str]) -> Result<(), Refused> {
    let nothing = || {
        let found = "an empty value, which removes the key".to_owned();
        (found, "a value, or a key that the scene holds".to_owned())
    };
    let [key, below @ ..] = keys else {
        return Ok(());
    };
    match &mut node.content {
        Content::List(items) => match index(items, key)? {
            index if below.is_empty() => _ = items.remove(index),
            index => remove(&mut items[index], below)?,
        },
        Content::Table(entries) => {
            let at = entries.iter().position(|entry| entry.key == *key);
            match at.ok_or_else(nothing)? {
                at if below.is_empty() => _ = entries.remove(at),
                at => remove(&mut entries[at].value, below)?,
            }
        }
        _ => return Err(nothing()),
    }
    Ok(())
}

/// Sets what stands at these `keys` below the node at `path`.
fn set(node: &mut Node, path: &str, keys: &[&str], value: Node, place: &Place) -> Result<(), Refused> {
    let [key, below @ ..] = keys else {
        *node = value;
        return Ok(());
    };
    let inner = joined(path, key);
    if let Content::List(items) = &mut node.content {
        let index = index(items, key)?;
        return set(&mut items[index], &inner, below, value, place);
    }
    let table = || Node::new(place.clone(), "", Content::Table(Vec::new()));
    if !matches!(node.content, Content::Table(_)) {
        // `ends.downstream.spring=…` on `downstream = "fixed"`
        *node = table();
    }
    let Content::Table(entries) = &mut node.content else {
        return Ok(());
    };
    let known = entries.iter().position(|entry| entry.key == *key);
    let mut entry = known.map(|at| entries.remove(at)).unwrap_or_else(|| Entry {
        key: (*key).to_owned(),
        place: place.clone(),
        value: table(),
    });
    set(&mut entry.value, &inner, below, value, place)?;
    if below.is_empty() {
        entry.place = place.clone();
        entries.retain(|present| !gives_way(path, present, &entry));
    }
    entries.insert(known.unwrap_or(entries.len()).min(entries.len()), entry);
    Ok(())
}
