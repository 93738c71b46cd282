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
use toml::de::DeTable;

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
    let file = DeTable::parse_recoverable(text).0;
    let presets = file
        .get_ref()
        .get("presets")
        .and_then(|list| list.get_ref().as_array());
    let preset = |table: &DeTable| {
        let own = sources(table);
        Some(Preset {
            kind,
            name: text_at(table, "name")?.to_owned(),
            summary: text_at(table, "summary")?.to_owned(),
            toml: text_at(table, "values")?.to_owned(),
            sources: if own.is_empty() {
                sources(file.get_ref())
            } else {
                own
            },
        })
    };
    let tables = presets
        .into_iter()
        .flatten()
        .filter_map(|item| item.get_ref().as_table());
    tables.filter_map(preset).collect()
}

fn text_at<'t>(table: &'t DeTable, key: &str) -> Option<&'t str> {
    table.get(key)?.get_ref().as_str()
}

/// The sources in lines of `KEY: SOURCE`.
fn sources(table: &DeTable) -> Vec<Source> {
    let lists = [("sources", false), ("assumed", true)].into_iter();
    let pairs = lists.flat_map(|(list, assumed)| {
        let lines = text_at(table, list).unwrap_or_default().lines();
        lines.filter_map(move |line| Some((line.split_once(": ")?, assumed)))
    });
    let source = |((key, source), assumed): ((&str, &str), bool)| Source {
        key: key.to_owned(),
        source: source.to_owned(),
        assumed,
    };
    pairs.map(source).collect()
}
