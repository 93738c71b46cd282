//! Keys that exclude each other: what an override sets drops what has no meaning beside it; what a file gives together is an error.

use crate::document::{Content, Document, Entry, Node, joined, without_numbers};
use crate::error::{SceneError, WrongKind};

/// What is allowed of two rivals.
const ONE: &str = "only one of the two";
const THREE: &[&str] = &[
    "trefoil-upper",
    "trefoil-lower",
    "cradled-outer",
    "cradled-middle",
];

/// A table, a key of it, the values of that key with which another key has no meaning (none: whatever it is; an empty one: if it is left
/// out), that other key, and what is allowed.
type Rule = (
    &'static str,
    &'static str,
    &'static [&'static str],
    &'static str,
    &'static str,
);

#[rustfmt::skip]
const RULES: &[Rule] = &[
    ("ground", "longitudinal_peak", &[], "vertical_peak", ONE),
    ("cable", "arrangement", THREE, "normal_load_factor", ONE),
    ("cable", "diameter", &[], "normal_load_factor", ONE),
    ("cable", "axial_stiffness", &[], "young_modulus", ONE),
    ("cable", "axial_stiffness", &[], "conductor_area", ONE),
    ("restraints", "stiffness", &[], "spring", ONE),
    ("ends.upstream", "spring", &[], "stiffness", ONE),
    ("ends.downstream", "spring", &[], "stiffness", ONE),
    ("vehicles", "load", &[], "wheels", ONE),
    ("traffic", "order", &[], "sequence", ONE),
    ("traffic", "passes", &[], "years", ONE),
    ("heat", "daily_swing", &[], "profile", ONE),
    ("friction", "law", &["coulomb"], "shape_factor", "no `shape_factor` with the law \"coulomb\""),
    ("traffic", "sequence", &[], "seed", "`seed` only with order = \"random\""),
    ("traffic", "order", &["", "interleaved"], "seed", "`seed` only with order = \"random\""),
    ("traffic", "histogram", &[""], "speed", "no `speed`: every vehicle has its own"),
    ("solver", "method", &["quasi-static", "pass-law"], "time_step", "`time_step` only with the method \"auto\" or \"explicit\""),
];

/// The rivals among the keys of a table.
#[cfg(feature = "schema")]
pub fn rivals(table: &str) -> impl Iterator<Item = (&'static str, &'static str)> {
    let own = RULES
        .iter()
        .filter(move |rule| rule.0 == table && rule.2.is_empty());
    own.map(|(_, one, _, other, _)| (*one, *other))
}

/// Whether a rule holds for a key with this value; nothing if it is left out.
fn holds((_, _, values, ..): &Rule, value: Option<&Node>) -> bool {
    match value.map(|value| &value.content) {
        Some(_) if values.is_empty() => true,
        Some(Content::Text(text)) => values.contains(&&**text),
        Some(_) => false,
        None => values.contains(&""),
    }
}

/// Whether the entry `present` of the table at `path` has no meaning beside `set`, which is given later.
pub fn gives_way(path: &str, present: &Entry, set: &Entry) -> bool {
    let table = without_numbers(path);
    RULES.iter().filter(|rule| rule.0 == table).any(|rule| {
        let (_, key, _, other, allowed) = rule;
        let drops = *key == set.key && *other == present.key && holds(rule, Some(&set.value));
        let back = *key == present.key && *other == set.key && holds(rule, Some(&present.value));
        drops || back && *allowed == ONE
    })
}

/// The first two keys at or below `path` that exclude each other.
pub fn contradiction(document: &Document, path: &str, node: &Node) -> Result<(), SceneError> {
    let table = without_numbers(path);
    let value_at = |key: &str| match &node.content {
        Content::Table(entries) => Some(&entries.iter().find(|entry| entry.key == key)?.value),
        _ => None,
    };
    for rule @ (_, key, _, other, allowed) in RULES.iter().filter(|rule| rule.0 == table) {
        let (value, Some(rival)) = (value_at(key), value_at(other)) else {
            continue;
        };
        // The axles of a histogram come at random without a word, a sequence is an order.
        let random = *other == "seed" && value.is_none() && value_at("histogram").is_some();
        if !holds(rule, value) || random {
            continue;
        }
        let written = document.written(&rival.span);
        let found = match value {
            Some(_) if *allowed == ONE => format!("both `{key}` and `{other}`"),
            Some(value) => format!("{written} with `{key}` = {}", document.written(&value.span)),
            None => format!("{written} with no `{key}`"),
        };
        let key = joined(path, other);
        return Err(document.wrong(WrongKind::Value, &rival.span, &key, found, *allowed));
    }
    match &node.content {
        Content::List(items) => items
            .iter()
            .enumerate()
            .try_for_each(|(index, item)| contradiction(document, &joined(path, &index.to_string()), item))?,
        Content::Table(entries) => entries
            .iter()
            .try_for_each(|entry| contradiction(document, &joined(path, &entry.key), &entry.value))?,
        _ => {}
    }
    let key = "traffic.histogram";
    if let ("", (node, true), Some(_)) = (path, document.find(key), value_at("vehicles")) {
        let found = "both `traffic.histogram` and [[vehicles]]";
        return Err(document.wrong(WrongKind::Value, &node.span, key, found, ONE));
    }
    Ok(())
}
