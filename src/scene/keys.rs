//! The keys of a table, and what a wrong one was meant to be.

use std::sync::LazyLock;

use super::key::KEYS;
pub use super::key::joined;
use super::nearest::nearest;

/// Each table with its keys, as messages list them.
static TABLES: LazyLock<Vec<(&str, String)>> = LazyLock::new(|| {
    let tables = KEYS.chunk_by(|a, b| a.section == b.section);
    let names = |keys: &[super::key::Key]| keys.iter().map(|key| key.name).collect::<Vec<_>>().join(", ");
    tables.map(|keys| (keys[0].section, names(keys))).collect()
});
/// One thing with two names: an end has a `spring`, a clamp a `stiffness`. Each is understood where the other is meant.
const OTHER_NAMES: [(&str, &str); 2] = [("stiffness", "spring"), ("spring", "stiffness")];

/// The keys of the table at `path`, such as `vehicles.0.wheels.1`.
pub fn of(path: &str) -> &'static str {
    let table = without_numbers(path);
    let found = TABLES.iter().find(|(name, _)| *name == table);
    found.map_or("", |(_, keys)| keys)
}

/// The SI unit of a key, `vehicles.0.speed`; none for what is no number or has no unit.
#[cfg(feature = "sweep")]
pub fn si_unit(key: &str) -> Option<&'static str> {
    let path = without_numbers(key);
    let (section, name) = path.rsplit_once('.')?;
    let other = OTHER_NAMES.iter().find(|(other, _)| *other == name);
    let is_name = |known: &str| known == name || other.is_some_and(|(_, meant)| *meant == known);
    KEYS.iter()
        .find(|key| key.section == section && is_name(key.name))?
        .si_unit()
}

/// A key without the numbers of list items.
pub fn without_numbers(path: &str) -> String {
    let is_name = |part: &&str| part.parse::<usize>().is_err();
    path.split('.').filter(is_name).collect::<Vec<_>>().join(".")
}

/// Whether `key` is one of the `keys`, by whichever name.
pub fn holds(keys: &str, key: &str) -> bool {
    keys.split(", ")
        .any(|known| known == key || other_name(known) == Some(key))
}

/// The other name of a key, if it has one.
pub fn other_name(key: &str) -> Option<&'static str> {
    let found = OTHER_NAMES.iter().find(|(other, _)| *other == key);
    found.map(|(_, name)| *name)
}

/// Words and symbols of the field for what a scene calls otherwise.
const SYNONYMS: [(&str, &str); 25] = [
    ("alpha", "expansion"),
    ("anchors", "restraints"),
    ("clamp", "restraints"),
    ("clamps", "restraints"),
    ("coefficient", "dynamic_coefficient"),
    ("conduit", "duct"),
    ("days", "years"),
    ("e", "young_modulus"),
    ("ea", "axial_stiffness"),
    ("end", "downstream"),
    ("friction_coefficient", "dynamic_coefficient"),
    ("gradient", "slope"),
    ("left", "upstream"),
    ("mass", "weight"),
    ("mu", "dynamic_coefficient"),
    ("nu", "poisson_ratio"),
    ("pavement", "ground"),
    ("pipe", "duct"),
    ("right", "downstream"),
    ("road", "ground"),
    ("soil", "ground"),
    ("soils", "ground"),
    ("start", "upstream"),
    ("trucks", "vehicles"),
    ("velocity", "speed"),
];

/// The key that was probably meant where only `known` ones are: a near miss, another word for it, the same name with another
/// beginning, or a key of another section.
pub fn suggestion(key: &str, known: &'static str) -> Option<String> {
    let synonym = || {
        let word = key.to_lowercase();
        let found = SYNONYMS.iter().find(|(other, _)| *other == word);
        found.map(|(_, name)| *name).filter(|name| holds(known, name))
    };
    let ends_alike = || {
        let ends = |long: &str, short: &str| long.strip_suffix(short).is_some_and(|head| head.ends_with('_'));
        known.split(", ").find(|name| ends(name, key) || ends(key, name))
    };
    let elsewhere = || {
        // Keys inside a value are not looked for.
        let sections = KEYS
            .iter()
            .filter(|found| !found.section.is_empty() && of_sections(found.section));
        let found = sections.into_iter().find(|found| found.name == key)?;
        Some(joined(found.section, key))
    };
    synonym()
        .or_else(|| nearest(key, known.split(", ")))
        .or_else(ends_alike)
        .map(str::to_owned)
        .or_else(elsewhere)
}

/// The `known` keys, and where else `key` belongs if it is one of the top level.
pub fn and_where_else(key: &str, known: &'static str) -> String {
    match key {
        "title" => format!("{known}; `title` stands above the first section"),
        _ if !holds(known, key) && holds(of(""), key) => {
            format!("{known}; `{key}` stands for itself, not in a section")
        }
        _ => known.to_owned(),
    }
}

/// Whether a table is a section of a file: tables inside a value are not.
fn of_sections(table: &str) -> bool {
    !table.contains('.') || table == "ground.layers"
}
