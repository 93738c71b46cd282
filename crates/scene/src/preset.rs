//! `preset = "…"`: the values of a preset, below those that the scene gives itself.
//!
//! Keys given next to a preset override it, whichever stands first. A preset that an override names later wins over what was written before it.

use crate::document::{Content, Document, Entry, Node, joined};
use crate::error::SceneError;
use crate::key::listed;
use crate::presets::{Preset, PresetKind, of};
use crate::rivals::gives_way;
use crate::value::Value;

/// Puts the values of presets into the sections that name one.
pub fn expand(document: &mut Document) -> Result<(), SceneError> {
    let mut root = document.root.clone();
    if let Content::Table(sections) = &mut root.content {
        for Entry { key, value, .. } in sections {
            let kind = match &**key {
                "cable" => PresetKind::Cable,
                "friction" => PresetKind::Friction,
                "ground" => PresetKind::Pavement,
                "vehicles" => PresetKind::Vehicle,
                _ => continue,
            };
            match &mut value.content {
                Content::List(items) => {
                    for (index, item) in items.iter_mut().enumerate() {
                        fill(document, &joined(key, &index.to_string()), kind, item)?;
                    }
                }
                _ => fill(document, key, kind, value)?,
            }
        }
    }
    document.root = root;
    Ok(())
}

fn fill(document: &mut Document, path: &str, kind: PresetKind, section: &mut Node) -> Result<(), SceneError> {
    let Content::Table(entries) = &mut section.content else {
        return Ok(());
    };
    let Some(place) = entries.iter().position(|entry| entry.key == "preset") else {
        return Ok(());
    };
    let named = entries.remove(place);
    let words: Vec<(&str, &Preset)> = of(kind).map(|preset| (preset.name.as_str(), preset)).collect();
    let (path_of_name, node) = (joined(path, "preset"), &named.value);
    let name = Value {
        document,
        path: path_of_name,
        node,
    };
    let preset = name.word(&words, &listed(words.iter().map(|(word, _)| *word)))?;
    // An earlier preset goes, and so does what was set before this one was named: in the file, or by another override.
    entries.retain(|entry| !document.source(&entry.span).is_preset);
    for entry in document.add_preset(&preset.name, &preset.toml) {
        let excludes = |present: &Entry| present.key == entry.key || gives_way(path, present, &entry);
        let is_beside =
            |present: &Entry| document.source(&present.span).start == document.source(&named.span).start;
        if !entries
            .iter()
            .any(|present| is_beside(present) && excludes(present))
        {
            entries.retain(|present| !excludes(present));
            entries.push(entry);
        }
    }
    Ok(())
}
