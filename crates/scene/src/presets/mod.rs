//! Presets: named sets of values for a scene, each value with its source.
//!
//! `preset = "t-25"` in a section of a scene stands for the values listed here; keys given next to it
//! override them. The data are TOML files beside this one. A value without a document behind it is marked
//! ([`Source::assumed`]): use it to get going, and replace it by what you measured.
//!
//! ```
//! use creepage_scene::presets::{PresetKind, all};
//!
//! let truck = all().iter().find(|preset| preset.name == "t-25").expect("a design truck");
//! assert_eq!(truck.kind, PresetKind::Vehicle);
//! assert!(truck.sources.iter().any(|source| source.assumed), "the wheelbase has no source");
//! ```

use std::sync::LazyLock;

use serde::{Deserialize, Serialize};

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

/// A data file: presets, and sources in lines of `KEY: SOURCE` that hold for all that have none of their own.
#[derive(Deserialize)]
struct File {
    presets: Vec<Row>,
    #[serde(flatten)]
    shared: Sources,
}

#[derive(Deserialize)]
struct Row {
    name: String,
    summary: String,
    values: String,
    #[serde(flatten)]
    own: Sources,
}

#[derive(Deserialize, Default)]
#[serde(default)]
struct Sources {
    sources: String,
    assumed: String,
}

/// The presets of a data file. The files are built in, and tests read them: there is nothing to report here.
fn read(kind: PresetKind, text: &str) -> Vec<Preset> {
    let Ok(File { presets, shared }) = toml::from_str(text) else {
        return Vec::new();
    };
    let preset = |Row {
                      name,
                      summary,
                      values,
                      own,
                  }: Row| Preset {
        kind,
        name,
        summary,
        toml: values,
        sources: Some(own.list())
            .filter(|own| !own.is_empty())
            .unwrap_or_else(|| shared.list()),
    };
    presets.into_iter().map(preset).collect()
}

impl Sources {
    fn list(&self) -> Vec<Source> {
        let lists = [(&self.sources, false), (&self.assumed, true)];
        let lines = lists
            .into_iter()
            .flat_map(|(list, assumed)| list.lines().map(move |line| (line, assumed)));
        let source = |(line, assumed): (&str, bool)| {
            let (key, source) = line.split_once(": ")?;
            Some(Source {
                key: key.to_owned(),
                source: source.to_owned(),
                assumed,
            })
        };
        lines.filter_map(source).collect()
    }
}
