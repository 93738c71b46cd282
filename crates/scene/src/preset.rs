//! `preset = "…"`: the values of a preset, below those that the scene gives itself.
//!
//! Keys given next to a preset override it, whichever stands first. A preset that an override names later wins over what was written before it.

use crate::content::{Content, Node, joined};
use crate::document::SceneFile;
use crate::error::Result;
use crate::key::Form;
use crate::presets::{Preset, of_section};
use crate::rivals::gives_way;
use crate::shown::listed;
use crate::stored::Given;

/// Puts the values of presets into the sections that name one.
pub fn expand(file: &mut SceneFile) -> Result<()> {
    let mut root = file.root.clone();
    if let Content::Table(sections) = &mut root.content {
        for section in sections {
            let key = section.key.clone();
            let presets: Vec<(&str, &Preset)> =
                of_section(&key).map(|preset| (&*preset.name, preset)).collect();
            match &mut section.content {
                _ if presets.is_empty() => (),
                Content::List(items) => {
                    let mut items = items.iter_mut().enumerate();
                    items.try_for_each(|(index, item)| fill(file, &joined(&key, index), &presets, item))?;
                }
                _ => fill(file, &key, &presets, section)?,
            }
        }
    }
    file.root = root;
    Ok(())
}

fn fill(file: &mut SceneFile, path: &str, presets: &[(&str, &Preset)], section: &mut Node) -> Result<()> {
    let Content::Table(entries) = &mut section.content else {
        return Ok(());
    };
    let Some(place) = entries.iter().position(|node| node.key == "preset") else {
        return Ok(());
    };
    let allowed = listed(presets.iter().map(|(name, _)| *name));
    let given = Given::new(joined(path, "preset"), &entries[place], Form::Text(""));
    let preset = given.word(presets, allowed);
    let preset = preset.map_err(|error| file.located(error))?;
    let named = entries.remove(place).key_place.source;
    // An earlier preset goes, and so does what was set before this one was named: in the file, or by another override.
    entries.retain(|node| !file.source(node).is_preset);
    for node in file.parsed(format!("preset {}", preset.name), &preset.toml, true)? {
        let excludes = |present: &Node| present.key == node.key || gives_way(path, present, &node);
        let stands = |present: &Node| present.key_place.source == named && excludes(present);
        if !entries.iter().any(stands) {
            entries.retain(|present| !excludes(present));
            entries.push(node);
        }
    }
    Ok(())
}
