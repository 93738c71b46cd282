//! The names of keys: what a misspelt one was meant to be, and what `creepage explain` lists.

use std::sync::LazyLock;

use crate::document::without_numbers;
use crate::key::{Form, Key, KeyMeaning, Keys, meanings};
use crate::keys::SceneKeys;
use crate::nearest::nearest;
use crate::rivals::other_name;

/// Words and symbols of the field for what a scene calls otherwise.
#[rustfmt::skip]
const SYNONYMS: &[(&str, &str)] = &[
    ("alpha", "expansion"), ("anchors", "restraints"), ("clamp", "restraints"), ("clamps", "restraints"),
    ("area", "conductor_area"), ("coefficient", "dynamic_coefficient"), ("conduit", "duct"), ("days", "years"),
    ("e", "young_modulus"), ("ea", "axial_stiffness"), ("end", "downstream"), ("friction_coefficient", "dynamic_coefficient"),
    ("gradient", "slope"), ("left", "upstream"), ("mass", "weight"), ("mu", "dynamic_coefficient"), ("nu", "poisson_ratio"),
    ("pavement", "ground"), ("pipe", "duct"), ("right", "downstream"), ("road", "ground"), ("soil", "ground"),
    ("soils", "ground"), ("start", "upstream"), ("trucks", "vehicles"), ("velocity", "speed"),
];

static MEANINGS: LazyLock<Vec<KeyMeaning>> = LazyLock::new(|| {
    let mut found = Vec::new();
    meanings("", SceneKeys::keys(), &mut found);
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

/// The key nearest to `text`, by its last word if that has no section.
pub fn nearest_key(text: &str) -> Option<String> {
    let keys = || MEANINGS.iter().map(|meaning| &*meaning.key);
    if text.contains('.') {
        return nearest(text, keys()).map(str::to_owned);
    }
    let name = nearest(text, keys().map(last))?;
    keys().find(|key| last(key) == name).map(str::to_owned)
}

fn last(key: &str) -> &str {
    key.rsplit('.').next().unwrap_or(key)
}

/// The SI unit of a key, `vehicles.0.speed`; none for what is no number or has no unit.
pub fn si_unit(key: &str) -> Option<&'static str> {
    let mut keys = SceneKeys::keys();
    let path = without_numbers(key);
    let mut names = path.split('.').peekable();
    while let Some(name) = names.next() {
        let is_meant = |key: &Key| key.name == name || Some(key.name) == other_name(name);
        let form = keys.into_iter().find(is_meant)?.form;
        let form = match form {
            Form::Either(form, ..) if names.peek().is_none() => *form,
            form => form,
        };
        keys = match form {
            Form::Quantity(quantity) if names.peek().is_none() => return quantity.dimension?.si(),
            Form::Table(keys) | Form::Either(_, keys, _) => keys,
            Form::List(form, ..) => match *form {
                Form::Table(keys) => keys,
                _ => return None,
            },
            _ => return None,
        };
    }
    None
}

/// The key that was probably meant if only `known` ones are, and where else `key` belongs if it is one of the top level: a near miss,
/// another word for it, the same name with another beginning, or a key of another section.
pub fn suggestion(key: &str, known: &[&str]) -> (Option<String>, String) {
    let word = key.to_lowercase();
    let synonym = SYNONYMS
        .iter()
        .find(|(other, name)| *other == word && known.contains(name));
    let ends = |long: &str, short: &str| long.strip_suffix(short).is_some_and(|head| head.ends_with('_'));
    let ends_alike = || known.iter().find(|name| ends(name, key) || ends(key, name));
    // Keys of a section, not of a table inside a value.
    let elsewhere = || {
        MEANINGS.iter().find(|found| {
            let sections = found.key.matches('.').count();
            last(&found.key) == key
                && (sections == 1 || sections == 2 && found.key.starts_with("ground.layers."))
        })
    };
    let here = synonym
        .map(|(_, name)| *name)
        .or_else(|| nearest(key, known.iter().copied()));
    let here = here.or_else(|| ends_alike().copied()).map(str::to_owned);
    let top = MEANINGS.iter().any(|found| found.key == key) && !known.contains(&key);
    let where_else = match key {
        "title" => "; `title` stands above the first section".to_owned(),
        _ if top => format!("; `{key}` stands for itself, not in a section"),
        _ => String::new(),
    };
    (
        here.or_else(|| elsewhere().map(|found| found.key.clone())),
        where_else,
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
