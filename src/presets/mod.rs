//! Presets: named sets of values for a scene, each value with its source.
//!
//! `preset = "t-25"` in a section of a scene stands for the values listed here; keys given next to it
//! override them. The data are TOML files beside this one. A value without a document behind it is marked
//! ([`Source::assumed`]): use it to get going, and replace it by what you measured.
//!
//! ```
//! use creepage::presets::{PresetKind, all};
//!
//! let truck = all().iter().find(|preset| preset.name == "t-25").expect("a design truck");
//! assert_eq!(truck.kind, PresetKind::Vehicle);
//! assert!(truck.sources.iter().any(|source| source.assumed), "the wheelbase has no source");
//! ```

use std::sync::LazyLock;

use serde::Serialize;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// What a preset describes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum PresetKind {
    /// `[[vehicles]]`
    Vehicle,
    /// `[cable]`
    Cable,
    /// `[friction]`
    Friction,
    /// `[ground]`
    Pavement,
}

/// A named set of values.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
#[non_exhaustive]
pub struct Preset {
    /// The part of a scene that it fills.
    pub kind: PresetKind,
    /// Its name in scene files.
    pub name: String,
    /// What it is, in a line.
    pub summary: String,
    /// Its values as a scene file has them.
    pub toml: String,
    /// Where its values are from.
    pub sources: Vec<Source>,
}

/// Where a value is from.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
#[non_exhaustive]
pub struct Source {
    /// The key, with those around it.
    pub key: String,
    /// The document, or why the value was assumed.
    pub source: String,
    /// Whether there is no document.
    pub assumed: bool,
}

const FILES: [(PresetKind, &str); 4] = [
    (PresetKind::Vehicle, include_str!("vehicles.toml")),
    (PresetKind::Cable, include_str!("cables.toml")),
    (PresetKind::Friction, include_str!("frictions.toml")),
    (PresetKind::Pavement, include_str!("pavements.toml")),
];
const COMMON: [(&str, bool); 2] = [("sources", false), ("assumed", true)];

/// All presets, by kind.
pub fn all() -> &'static [Preset] {
    static ALL: LazyLock<Vec<Preset>> =
        LazyLock::new(|| FILES.iter().flat_map(|(kind, text)| read(*kind, text)).collect());
    &ALL
}

/// The presets of one kind.
pub fn of(kind: PresetKind) -> impl Iterator<Item = &'static Preset> {
    all().iter().filter(move |preset| preset.kind == kind)
}

/// The presets of a data file. The files are built in, and tests read them: there is nothing to report here.
fn read(kind: PresetKind, text: &str) -> Vec<Preset> {
    let Ok(file) = DeTable::parse(text) else {
        return Vec::new();
    };
    let file = file.get_ref();
    let mut presets: Vec<(usize, Preset)> = file
        .iter()
        .filter(|(name, _)| COMMON.iter().all(|(common, _)| name.get_ref() != common))
        .filter_map(|(name, value)| {
            let table = table(value)?;
            let own = COMMON.iter().any(|(key, _)| table.contains_key(*key));
            let preset = Preset {
                kind,
                name: name.get_ref().clone().into_owned(),
                summary: table.get("summary")?.get_ref().as_str()?.to_owned(),
                toml: written(text, table.get("values")?)?,
                sources: sources(if own { table } else { file }),
            };
            Some((name.span().start, preset))
        })
        .collect();
    presets.sort_by_key(|(start, _)| *start);
    presets.into_iter().map(|(_, preset)| preset).collect()
}

fn table<'t, 'i>(value: &'t Spanned<DeValue<'i>>) -> Option<&'t DeTable<'i>> {
    match value.get_ref() {
        DeValue::Table(table) => Some(table),
        _ => None,
    }
}

/// A table's pairs in the order of the file.
fn pairs<'t, 'i>(value: &'t Spanned<DeValue<'i>>) -> Vec<(&'t str, &'t Spanned<DeValue<'i>>)> {
    let mut pairs: Vec<_> = table(value)
        .into_iter()
        .flatten()
        .map(|(key, value)| (key.get_ref().as_ref(), value))
        .collect();
    pairs.sort_by_key(|(_, value)| value.span().start);
    pairs
}

/// The values as they stand in the file.
fn written(text: &str, values: &Spanned<DeValue>) -> Option<String> {
    pairs(values)
        .into_iter()
        .map(|(key, value)| Some(format!("{key} = {}\n", text.get(value.span())?)))
        .collect()
}

fn sources(table: &DeTable) -> Vec<Source> {
    COMMON
        .iter()
        .filter_map(|(key, assumed)| Some((table.get(*key)?, *assumed)))
        .flat_map(|(value, assumed)| pairs(value).into_iter().map(move |pair| (pair, assumed)))
        .filter_map(|((key, value), assumed)| {
            Some(Source {
                key: key.to_owned(),
                source: value.get_ref().as_str()?.to_owned(),
                assumed,
            })
        })
        .collect()
}
