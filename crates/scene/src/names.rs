//! The names of keys: what a misspelt one was meant to be, and what `creepage explain` lists.

use std::sync::LazyLock;

use crate::content::{joined, other_name, without_numbers};
use crate::key::{Key, Section};
use crate::nearest::nearest;
use crate::range::Quantity;
use crate::scene::Scene;

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
fn meanings(path: &str, keys: &[Key], found: &mut Vec<KeyMeaning>) {
    for key in keys {
        let path = joined(path, key.name);
        found.push(KeyMeaning {
            key: path.clone(),
            meaning: key.meaning,
            allowed: key.form.allowed(),
            unit: key.form.quantity().and_then(Quantity::unit),
            default: key.absent,
        });
        meanings(&path, key.form.keys(), found);
    }
}

static MEANINGS: LazyLock<Vec<KeyMeaning>> = LazyLock::new(|| {
    let mut found = Vec::new();
    meanings("", Scene::KEYS, &mut found);
    found
});

/// Every key of a scene, each section followed by its keys.
///
/// ```
/// let depth = creepage_scene::key_meanings().into_iter().find(|key| key.key == "duct.depth").unwrap();
/// assert!(depth.allowed.starts_with("a length greater than 0, from 1 cm to 1 km") && depth.default.is_none());
/// ```
pub fn key_meanings() -> Vec<KeyMeaning> {
    MEANINGS.clone()
}

fn known() -> impl Iterator<Item = &'static str> {
    MEANINGS.iter().map(|meaning| &*meaning.key)
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
    let path = without_numbers(key);
    let (section, name) = path.rsplit_once('.')?;
    let names = [Some(name), other_name(name)].into_iter().flatten();
    let keys: Vec<String> = names.map(|name| joined(section, name)).collect();
    MEANINGS.iter().find(|meaning| keys.contains(&meaning.key))?.unit
}

/// A key of another section that is called like an unknown one; and words if it belongs above all sections.
pub fn elsewhere(name: &str) -> (Option<&'static str>, &'static str) {
    let is_outermost = Scene::KEYS.iter().any(|other| other.name == name);
    let words = is_outermost.then_some("; it stands above the first section, or for itself");
    (
        known().find(|other| last(other) == name),
        words.unwrap_or_default(),
    )
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
