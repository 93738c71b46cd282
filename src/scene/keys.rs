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

/// The key that was probably meant where only `known` ones are: a near miss, or a key of another section.
pub fn suggestion(key: &str, known: &'static str) -> Option<String> {
    let elsewhere = || {
        // Keys inside a value are not looked for.
        let sections = KEYS
            .iter()
            .filter(|found| !found.section.is_empty() && of_sections(found.section));
        let found = sections.into_iter().find(|found| found.name == key)?;
        Some(joined(found.section, key))
    };
    nearest(key, known.split(", "))
        .map(str::to_owned)
        .or_else(elsewhere)
}

/// Whether a table is a section of a file: tables inside a value are not.
fn of_sections(table: &str) -> bool {
    !table.contains('.') || table == "ground.layers"
}
