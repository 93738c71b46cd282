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
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum PresetKind {
    /// `[[vehicles]]`
    #[default]
    Vehicle,
    /// `[cable]`
    Cable,
    /// `[friction]`
    Friction,
    /// `[ground]`
    Pavement,
}

/// A named set of values.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Preset {
    /// The part of a scene that it fills.
    #[serde(default)]
    pub kind: PresetKind,
    /// Its name in scene files.
    pub name: String,
    /// What it is, in a line.
    pub summary: String,
    /// Its values as a scene file has them.
    pub toml: String,
    /// Where its values are from.
    #[serde(default)]
    pub sources: Vec<Source>,
}

/// Where a value is from.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Source {
    /// The key, with those around it.
    pub key: String,
    /// The document, or why the value was assumed.
    pub source: String,
    /// Whether there is no document.
    #[serde(default)]
    pub assumed: bool,
}

/// A data file. Presets without sources have those of their file.
#[derive(Default, Deserialize)]
#[serde(default)]
struct Data {
    sources: Vec<Source>,
    presets: Vec<Preset>,
}

/// The files, each with the section of a scene that takes its presets.
const FILES: [(PresetKind, &str, &str); 4] = [
    (PresetKind::Vehicle, "vehicles", include_str!("vehicles.toml")),
    (PresetKind::Cable, "cable", include_str!("cables.toml")),
    (PresetKind::Friction, "friction", include_str!("frictions.toml")),
    (PresetKind::Pavement, "ground", include_str!("pavements.toml")),
];

/// All presets, by kind.
pub fn all() -> &'static [Preset] {
    static ALL: LazyLock<Vec<Preset>> = LazyLock::new(|| FILES.iter().flat_map(read).collect());
    &ALL
}

/// The presets that a section of a scene takes.
pub(crate) fn of_section(section: &str) -> impl Iterator<Item = &'static Preset> {
    let file = FILES.iter().find(|(_, of, _)| *of == section);
    let kind = file.map(|(kind, ..)| *kind);
    all().iter().filter(move |preset| Some(preset.kind) == kind)
}

/// The presets of a data file. The files are built in, and tests read them: there is nothing to report here.
fn read((kind, _, text): &(PresetKind, &str, &str)) -> Vec<Preset> {
    let Data { sources, mut presets } = toml::from_str(text).unwrap_or_default();
    for preset in &mut presets {
        preset.kind = *kind;
        if preset.sources.is_empty() {
            preset.sources.clone_from(&sources);
        }
    }
    presets
}
