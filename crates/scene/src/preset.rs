//! `preset = "…"`: the values of a preset, below those that the scene gives itself.
//!
//! Keys given next to a preset override it, whichever stands first. A preset that an override names later wins over what was
//! written before it.

use crate::document::{Content, Document, Entry, Node, joined};
use crate::error::SceneError;
use crate::key::listed;
use crate::presets::{Preset, PresetKind, of};
use crate::rivals::gives_way;
use crate::value::Value;

const KEY: &str = "preset";
const SECTIONS: [(&str, PresetKind); 4] = [
    ("cable", PresetKind::Cable),
    ("friction", PresetKind::Friction),
    ("ground", PresetKind::Pavement),
    ("vehicles", PresetKind::Vehicle),
];

/// Puts the values of presets into the sections that name one.
pub fn expand(document: &mut Document) -> Result<(), SceneError> {
    let mut root = document.root.clone();
    if let Content::Table(entries) = &mut root.content {
        for entry in entries {
            let Some((section, kind)) = SECTIONS.iter().find(|(section, _)| entry.key == *section) else {
                continue;
            };
            match &mut entry.value.content {
                Content::Array(items) => {
                    for (index, item) in items.iter_mut().enumerate() {
                        fill(document, &joined(section, &index.to_string()), *kind, item)?;
                    }
                }
                _ => fill(document, section, *kind, &mut entry.value)?,
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
    let Some(index) = entries.iter().position(|entry| entry.key == KEY) else {
        return Ok(());
    };
    let named = entries.remove(index);
    let words: Vec<(&str, &Preset)> = of(kind).map(|preset| (preset.name.as_str(), preset)).collect();
    let preset = Value {
        document,
        path: joined(path, KEY),
        node: &named.value,
    }
    .word(&words, &listed(words.iter().map(|(word, _)| *word)))?;
    // An earlier preset goes, and so does what was set before this one was named: in the file, or by another override.
    let source = named.key_place.source;
    entries.retain(|entry| !document.is_of_preset(&entry.key_place));
    for entry in document.add_preset(preset) {
        let excludes = |present: &Entry| present.key == entry.key || gives_way(path, present, &entry);
        if !entries
            .iter()
            .any(|present| present.key_place.source == source && excludes(present))
        {
            entries.retain(|present| !excludes(present));
            entries.push(entry);
        }
    }
    Ok(())
}
