//! Keys that exclude each other: what an override sets drops what has no meaning with it; what a file gives together is an error.

use crate::content::{Content, Node, joined, without_numbers};
use crate::error::{Result, SceneError};

/// What is allowed of two rivals.
const ONE: &str = "only one of the two";
const AT_RANDOM: &str = "order = \"random\", or none: the axles of a histogram come at random";
const SEED: &str = "`seed` only with order = \"random\"";
#[rustfmt::skip]
const THREE: &[&str] = &["trefoil-upper", "trefoil-lower", "cradled-outer", "cradled-middle"];

type Word = &'static str;

/// A table, a key of it, the values of that key with which another key has no meaning (none: whatever it is; an empty one: if it is left
/// out), that other key, and what is allowed.
type Rule = (Word, Word, &'static [Word], Word, Word);

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
    ("traffic", "sequence", &[], "histogram", AT_RANDOM),
    ("traffic", "order", &["interleaved"], "histogram", AT_RANDOM),
    ("traffic", "sequence", &[], "seed", SEED),
    ("traffic", "order", &["", "interleaved"], "seed", SEED),
    ("traffic", "histogram", &[""], "speed", "no `speed`: every vehicle has its own"),
    ("", "vehicles", &[], "traffic.histogram", ONE),
    ("", "ground.longitudinal_peak", &[], "traffic.histogram", "`ground.vertical_peak`, which is that of the first row"),
    ("solver", "method", &["quasi-static", "pass-law"], "time_step", "`time_step` only with the method \"auto\" or \"explicit\""),
];

/// The rules of a table.
fn rules(table: &str) -> impl Iterator<Item = &'static Rule> {
    RULES.iter().filter(move |rule| rule.0 == table)
}

/// The rivals among the keys of a table.
#[cfg(feature = "schema")]
pub fn rivals(table: &str) -> impl Iterator<Item = (&'static str, &'static str)> {
    let own = rules(table).filter(|rule| rule.2.is_empty() && !rule.0.is_empty());
    own.map(|(_, one, _, other, _)| (*one, *other))
}

/// Whether a rule holds for a key with this value; nothing if it is left out.
fn holds((_, _, values, ..): &Rule, value: Option<&Content>) -> bool {
    match value {
        Some(_) if values.is_empty() => true,
        Some(value) => value.as_text().is_some_and(|text| values.contains(&text)),
        None => values.contains(&""),
    }
}

/// Whether the entry `present` of the table at `path` has no meaning with `set`, which is given later.
pub fn gives_way(path: &str, present: &Node, set: &Node) -> bool {
    rules(&without_numbers(path)).any(|rule| {
        let (_, key, _, other, allowed) = rule;
        let drops = *key == set.key && *other == present.key && holds(rule, Some(&set.content));
        let back = *key == present.key && *other == set.key && holds(rule, Some(&present.content));
        drops && *allowed != AT_RANDOM || back && *allowed == ONE
    })
}

/// The first two keys of the table at `path` that exclude each other.
pub fn contradiction(path: &str, table: &Node) -> Result<()> {
    // Each by its own name: a spring is not a stiffness here.
    let value_at = |key: &str| {
        let mut keys = key.split('.');
        keys.try_fold(table, |node, key| node.content.entry(key))
    };
    for rule @ (_, key, _, other, allowed) in rules(&without_numbers(path)) {
        let (value, Some(rival)) = (value_at(key), value_at(other)) else {
            continue;
        };
        // The axles of a histogram come at random without a word, a sequence is an order.
        let random = *other == "seed" && value.is_none() && value_at("histogram").is_some();
        if !holds(rule, value.map(|value| &value.content)) || random {
            continue;
        }
        let found = match value {
            Some(_) if *allowed == ONE => format!("both `{key}` and `{other}`"),
            Some(value) => format!("{} with `{key}` = {}", rival.written(), value.written()),
            None => format!("{} with no `{key}`", rival.written()),
        };
        return Err(SceneError::value(&joined(path, other), found, *allowed));
    }
    Ok(())
}
