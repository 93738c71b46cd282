//! What a misspelt key was meant to be.

use crate::nearest::nearest;

/// Words and symbols of the field for what a scene calls otherwise.
#[rustfmt::skip]
const SYNONYMS: &[(&str, &str)] = &[
    ("alpha", "expansion"), ("anchors", "restraints"), ("clamp", "restraints"), ("clamps", "restraints"),
    ("area", "conductor_area"), ("coefficient", "dynamic_coefficient"), ("conduit", "duct"), ("days", "years"),
    ("e", "young_modulus"), ("ea", "axial_stiffness"), ("end", "downstream"), ("friction_coefficient", "dynamic_coefficient"),
    ("gradient", "slope"), ("left", "upstream"), ("mass", "weight"), ("mu", "dynamic_coefficient"), ("nu", "poisson_ratio"),
    ("bend", "bend_radius"), ("pavement", "ground"), ("pipe", "duct"), ("radius", "bend_radius"), ("right", "downstream"), ("road", "ground"), ("sections", "route"), ("soil", "ground"),
    ("soils", "ground"), ("start", "upstream"), ("trucks", "vehicles"), ("velocity", "speed"),
];

/// What was probably meant by an unknown `key` in place of the `allowed` ones: another word for one of them, or a near miss.
pub fn meant_by<'k>(key: &str, allowed: &[&'k str]) -> Option<&'k str> {
    let word = key.to_lowercase();
    let is_synonym = |(other, name): &&(&str, &str)| *other == word && allowed.contains(name);
    let synonym = SYNONYMS
        .iter()
        .find(is_synonym)
        .and_then(|(_, name)| allowed.iter().find(|other| *other == name));
    synonym.copied().or_else(|| nearest(key, allowed.iter().copied()))
}
