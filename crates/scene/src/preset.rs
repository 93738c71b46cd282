//! `preset = "…"`: the values of a preset, below those that the scene gives itself.
//!
//! Keys given next to a preset override it, whichever stands first. A preset that an override names later wins over what was written before it.

use crate::check::unknown_word;
use crate::content::{Content, Entry, Node, joined};
use crate::document::Document;
use crate::error::SceneError;
use crate::key::listed;
use crate::presets::{PresetKind, of};
use crate::rivals::gives_way;

/// Puts the values of presets into the sections that name one.
pub fn expand(document: &mut Document) -> Result<(), SceneError> {
    let mut root = document.root.clone();
    if let Content::Table(sections) = &mut root.content {
        for Entry { key, value, .. } in sections {
            let Some(kind) = PresetKind::of_section(key) else {
                continue;
            };
            match &mut value.content {
                Content::List(items) => {
                    for (index, item) in items.iter_mut().enumerate() {
                        fill(document, &joined(key, index), kind, item)?;
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
    let name = &entries[place].value;
    let words: Vec<&str> = of(kind).map(|preset| &*preset.name).collect();
    let (key, allowed) = (joined(path, "preset"), listed(words.iter().copied()));
    let found = match name.content.as_text() {
        None => Err(SceneError::value(&key, name.described(), allowed)),
        Some(text) => of(kind)
            .find(|preset| preset.name == text)
            .ok_or_else(|| unknown_word(name, text, &words, &key, allowed)),
    };
    let preset = found.map_err(|error| document.located(error))?;
    let named = entries.remove(place).place.source;
    // An earlier preset goes, and so does what was set before this one was named: in the file, or by another override.
    entries.retain(|entry| !document.source(&entry.value).is_preset);
    for entry in document.add_preset(&preset.name, &preset.toml) {
        let excludes = |present: &Entry| present.key == entry.key || gives_way(path, present, &entry);
        let stands = |present: &Entry| present.place.source == named && excludes(present);
        if !entries.iter().any(stands) {
            entries.retain(|present| !excludes(present));
            entries.push(entry);
        }
    }
    Ok(())
}
