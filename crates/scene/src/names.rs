//! The names of keys: what a misspelt one was meant to be, and what `creepage explain` lists.

use std::sync::LazyLock;

use crate::content::joined;
use crate::error::{Result, SceneError};
use crate::key::{Form, Key, names};
use crate::nearest::{meant_by, nearest};
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
    number_at("", key).ok()?.quantity()?.unit()
}

/// The error of a name that is none of these keys of the table at `path`: what it was meant to be among them, or a key of another
/// section that is called so.
pub fn unknown_key(path: &str, name: &str, keys: &[Key]) -> SceneError {
    let elsewhere = || known().find(|other| last(other) == last(name));
    let meant = meant_by(name, keys.iter().map(|key| key.name)).or_else(elsewhere);
    let is_outermost = Scene::KEYS.iter().any(|other| other.name == last(name));
    let words = is_outermost.then_some("; it stands above the first section, or for itself");
    let allowed = names(keys) + words.unwrap_or_default();
    SceneError::unknown(&joined(path, name), meant, allowed)
}

/// The form of the number at a key of a scene, such as `vehicles.0.load`, which the table at `path` names.
pub fn number_at(path: &str, key: &str) -> Result<Form> {
    const ALLOWED: &str = "a key of the scene that takes a number, such as \"friction.dynamic_coefficient\" (`creepage explain` lists \
                           them)";
    let (mut form, mut place) = (Form::Table(Scene::KEYS), path.to_owned());
    for part in key.split('.') {
        let keys = form.keys();
        let known = keys.iter().find(|key| key.is_named(part));
        form = match (form, known) {
            (Form::List([item, ..], ..), _) if part.parse::<usize>().is_ok() => *item,
            (Form::List(..), _) => break,
            (_, Some(key)) => key.form,
            _ if keys.is_empty() => break,
            _ => return Err(unknown_key(&place, part, keys)),
        };
        place = joined(&place, part);
    }
    let wrong = || SceneError::value(&place, format!("`{key}`"), ALLOWED);
    form.quantity().map(|_| form).ok_or_else(wrong)
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
