//! The names of keys: what a misspelt one was meant to be, and what `creepage explain` lists.

use std::sync::LazyLock;

use crate::content::joined;
use crate::key::{Key, number_at};
use crate::nearest::nearest;
use crate::range::Quantity;
use crate::scene::Scene;
use crate::stored::Stored;

/// What a key of a scene means.
#[derive(Debug, Clone, PartialEq, Eq, serde::Serialize)]
#[non_exhaustive]
pub struct KeyMeaning {
    /// The key with its section, without the numbers of list items: `vehicles.speed`.
    pub key: String,
    /// What it means.
    pub meaning: &'static str,
    /// What may stand there: range and units, or words.
    pub allowed: String,
    /// The SI unit of its numbers, if they have one.
    pub unit: Option<&'static str>,
    /// What counts if it is left out; `None` if it is required.
    pub default: Option<&'static str>,
}

/// The meanings of these keys and of all below them.
fn meanings(path: &str, keys: &[Key]) -> Vec<KeyMeaning> {
    let meaning = |key: &Key| {
        let of_key = KeyMeaning {
            key: joined(path, key.name),
            meaning: key.meaning,
            allowed: key.form.allowed(),
            unit: key.form.quantity().and_then(Quantity::unit),
            default: key.absent,
        };
        let below = meanings(&of_key.key, key.form.keys());
        std::iter::once(of_key).chain(below)
    };
    keys.iter().flat_map(meaning).collect()
}

/// Every key of a scene, each section followed by its keys.
///
/// ```
/// let depth = creepage_scene::key_meanings().iter().find(|key| key.key == "duct.depth").unwrap();
/// assert!(depth.allowed.starts_with("a length greater than 0, from 1 cm to 1 km") && depth.default.is_none());
/// ```
pub fn key_meanings() -> &'static [KeyMeaning] {
    static MEANINGS: LazyLock<Vec<KeyMeaning>> = LazyLock::new(|| meanings("", Scene::KEYS));
    &MEANINGS
}

fn known() -> impl Iterator<Item = &'static str> {
    key_meanings().iter().map(|meaning| &*meaning.key)
}

fn last(key: &str) -> &str {
    key.rsplit('.').next().unwrap_or(key)
}

/// The key nearest to `text`, by its last word if that has no section.
pub fn nearest_key(text: &str) -> Option<String> {
    if text.contains('.') {
        return nearest(text, known()).map(str::to_owned);
    }
    let name = nearest(text, known().map(last))?;
    known().find(|key| last(key) == name).map(str::to_owned)
}

/// The SI unit of a key, `vehicles.0.speed`; none for what is no number or has no unit.
pub fn si_unit(key: &str) -> Option<&'static str> {
    number_at(Scene::KEYS, "", key).ok()?.quantity()?.unit()
}

/// A key of another section that is called like an unknown one; and words if it belongs above all sections.
pub fn elsewhere(name: &str) -> (Option<&'static str>, &'static str) {
    let is_outermost = Scene::KEYS.iter().any(|other| other.name == name);
    let words = is_outermost.then_some("; it stands above the first section, or for itself");
    let other = known().find(|other| last(other) == name);
    (other, words.unwrap_or_default())
}

#[cfg(test)]
mod tests {
    use super::si_unit;

    #[test]
    fn keys_have_the_unit_of_their_dimension() {
        for (key, unit) in [
            ("duct.depth", Some("m")),
            ("vehicles.0.wheels.1.load", Some("N")),
            ("ends.downstream.spring", Some("N/m")),
            ("restraints.0.spring", Some("N/m")),
            ("ground.layers.2.young_modulus", Some("Pa")),
            ("ground.layers.2.young_modulus.top", Some("Pa")),
            ("duct.slope", None),
            ("traffic.passes", None),
            ("friction.law", None),
            ("no.key", None),
        ] {
            assert_eq!(si_unit(key), unit, "{key}");
        }
    }
}
