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

impl PresetKind {
    /// The kind of preset that a section takes.
    pub(crate) fn of_section(section: &str) -> Option<Self> {
        match section {
            "cable" => Some(Self::Cable),
            "friction" => Some(Self::Friction),
            "ground" => Some(Self::Pavement),
            "vehicles" => Some(Self::Vehicle),
            _ => None,
        }
    }
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

/// A data file: lines of `KEY: SOURCE`, and presets.
#[derive(Default, Deserialize)]
struct Data {
    #[serde(flatten)]
    sources: Sources,
    presets: Vec<Row>,
}

/// Where values are from: of a preset, or of all in a file that have no sources of their own.
#[derive(Default, Deserialize)]
#[serde(default)]
struct Sources {
    sources: String,
    assumed: String,
}

#[derive(Deserialize)]
struct Row {
    name: String,
    summary: String,
    values: String,
    #[serde(flatten)]
    sources: Sources,
}

impl Sources {
    fn list(&self) -> Vec<Source> {
        let lines = [(&self.sources, false), (&self.assumed, true)].into_iter();
        let lines = lines.flat_map(|(text, assumed)| text.lines().map(move |line| (line, assumed)));
        let source = |(line, assumed): (&str, bool)| {
            let (key, source) = line.split_once(": ")?;
            let (key, source) = (key.to_owned(), source.to_owned());
            Some(Source { key, source, assumed })
        };
        lines.filter_map(source).collect()
    }
}

/// The presets of a data file. The files are built in, and tests read them: there is nothing to report here.
fn read(kind: PresetKind, text: &str) -> Vec<Preset> {
    let data: Data = toml::from_str(text).unwrap_or_default();
    let preset = |row: Row| {
        let own = row.sources.list();
        Preset {
            kind,
            name: row.name,
            summary: row.summary,
            toml: row.values,
            sources: if own.is_empty() { data.sources.list() } else { own },
        }
    };
    data.presets.into_iter().map(preset).collect()
}
