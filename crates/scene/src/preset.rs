//! `preset = "…"`: the values of a preset, below those that the scene gives itself.
//!
//! Keys given next to a preset override it, whichever stands first. A preset that an override names later wins over what was written before it.

use std::sync::Arc;

use crate::content::{Content, Node, entries_of, joined};
use crate::error::Result;
use crate::key::Form;
use crate::location::{Source, SourceKind};
use crate::presets::{Preset, of_section};
use crate::rivals::gives_way;
use crate::shown::listed;
use crate::stored::Given;

/// Puts the values of presets into the sections that name one.
pub fn expand(root: &mut Node) -> Result<()> {
    let Content::Table(sections) = &mut root.content else {
        return Ok(());
    };
    for section in sections {
        let key = section.key.clone();
        match &mut section.content {
            Content::List(items) => {
                let mut items = items.iter_mut().enumerate();
                items.try_for_each(|(index, item)| fill(&joined(&key, index), &key, item))?;
            }
            _ => fill(&key, &key, section)?,
        }
    }
    Ok(())
}

/// Puts the values of the preset that the table at `path` names into it: one of those of a section.
fn fill(path: &str, section: &str, table: &mut Node) -> Result<()> {
    let presets = of_section(section).map(|preset| (&*preset.name, preset));
    let presets: Vec<(&str, &Preset)> = presets.collect();
    let Content::Table(entries) = &mut table.content else {
        return Ok(());
    };
    let place = entries.iter().position(|node| node.key == "preset");
    let Some(place) = place.filter(|_| !presets.is_empty()) else {
        return Ok(());
    };
    let named = entries.remove(place);
    let allowed = listed(presets.iter().map(|(name, _)| *name));
    let given = Given::new(joined(path, "preset"), &named, Form::Text(""));
    let preset = given.word(&presets, allowed);
    let preset = preset.map_err(|error| error.at(named.place.clone(), false))?;
    // An earlier preset goes, and so does what was set before this one was named: in the file, or by another override.
    entries.retain(|node| node.place.source.kind != SourceKind::Preset);
    let name = format!("preset {}", preset.name);
    for node in entries_of(&Source::new(SourceKind::Preset, &name, &preset.toml))? {
        let excludes = |present: &Node| present.key == node.key || gives_way(path, present, &node);
        let is_beside = |present: &Node| Arc::ptr_eq(&present.key_place.source, &named.key_place.source);
        let mut present = entries.iter();
        if !present.any(|present| is_beside(present) && excludes(present)) {
            entries.retain(|present| !excludes(present));
            entries.push(node);
        }
    }
    Ok(())
}
