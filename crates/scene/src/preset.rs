//! `preset = "…"`: the values of a preset, below those that the scene gives itself.
//!
//! Keys given next to a preset override it, whichever stands first. A preset that an override names later wins over what was written before it.

use std::sync::Arc;

use crate::content::{Content, Node, Source, SourceKind, entries_of, joined};
use crate::error::Result;
use crate::key::Form;
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
        let presets: Vec<(&str, &Preset)> = of_section(&key).map(|preset| (&*preset.name, preset)).collect();
        match &mut section.content {
            _ if presets.is_empty() => (),
            Content::List(items) => {
                let mut items = items.iter_mut().enumerate();
                items.try_for_each(|(index, item)| fill(&joined(&key, index), &presets, item))?;
            }
            _ => fill(&key, &presets, section)?,
        }
    }
    Ok(())
}

fn fill(path: &str, presets: &[(&str, &Preset)], section: &mut Node) -> Result<()> {
    let Content::Table(entries) = &mut section.content else {
        return Ok(());
    };
    let Some(place) = entries.iter().position(|node| node.key == "preset") else {
        return Ok(());
    };
    let named = entries.remove(place);
    let allowed = listed(presets.iter().map(|(name, _)| *name));
    let given = Given::new(joined(path, "preset"), &named, Form::Text(""));
    let preset = given.word(presets, allowed);
    let preset = preset.map_err(|error| error.at(named.place.location(), false))?;
    // An earlier preset goes, and so does what was set before this one was named: in the file, or by another override.
    entries.retain(|node| node.place.source.kind != SourceKind::Preset);
    let name = format!("preset {}", preset.name);
    for node in entries_of(&Source::new(SourceKind::Preset, name, &preset.toml))? {
        let excludes = |present: &Node| present.key == node.key || gives_way(path, present, &node);
        let is_beside = |present: &Node| Arc::ptr_eq(&present.key_place.source, &named.key_place.source);
        if !entries
            .iter()
            .any(|present| is_beside(present) && excludes(present))
        {
            entries.retain(|present| !excludes(present));
            entries.push(node);
        }
    }
    Ok(())
}
