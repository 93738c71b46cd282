//! The word someone probably meant.

use std::cmp::Reverse;

use strsim::osa_distance;

/// Words and symbols of the field for what a scene calls otherwise.
#[rustfmt::skip]
const SYNONYMS: &[(&str, &str)] = &[
    ("alpha", "expansion"), ("anchors", "restraints"), ("clamp", "restraints"), ("clamps", "restraints"),
    ("area", "conductor_area"), ("coefficient", "dynamic_coefficient"), ("conduit", "duct"), ("days", "years"),
    ("e", "young_modulus"), ("ea", "axial_stiffness"), ("end", "downstream"),
    ("friction_coefficient", "dynamic_coefficient"), ("gradient", "slope"), ("left", "upstream"),
    ("mass", "weight"), ("mu", "dynamic_coefficient"), ("nu", "poisson_ratio"), ("bend", "bend_radius"),
    ("pavement", "ground"), ("pipe", "duct"), ("radius", "bend_radius"), ("right", "downstream"),
    ("road", "ground"), ("sections", "route"), ("soil", "ground"), ("soils", "ground"), ("start", "upstream"),
    ("trucks", "vehicles"), ("velocity", "speed"),
];

/// What an unknown `key` was meant to be among the `allowed` ones: another word for one of them, or
/// a near miss.
pub fn meant_by<'k>(key: &str, allowed: impl Iterator<Item = &'k str> + Clone) -> Option<&'k str> {
    let word = key.to_lowercase();
    let is_named = |name: &str| SYNONYMS.contains(&(&word, name));
    let synonym = allowed.clone().find(|name| is_named(name));
    synonym.or_else(|| nearest(key, allowed))
}

/// The one of `known` nearest to `word`, if one is near enough to be suggested.
pub fn nearest<'k>(word: &str, known: impl IntoIterator<Item = &'k str>) -> Option<&'k str> {
    let plain = |text: &str| text.to_lowercase().replace(['_', ' '], "-");
    let word = plain(word);
    let rank = |candidate: &str| {
        let other = plain(candidate);
        let letters = [&word, &other].map(|text| text.chars().count());
        let (least, most) = (letters[0].min(letters[1]), letters[0].max(letters[1]));
        let holds = least >= 3 && least < most && (word.contains(&other) || other.contains(&word));
        let distance = if holds { 1 } else { osa_distance(&word, &other) };
        // A single letter that differs altogether is no near miss.
        let is_near = distance <= (most / 3).max(1) && distance < most;
        // Of equally near words the one that begins alike.
        let pairs = word.chars().zip(other.chars());
        let same = pairs.take_while(|(a, b)| a == b).count();
        is_near.then_some((distance, Reverse(same)))
    };
    let ranked = |candidate| Some((rank(candidate)?, candidate));
    let near = known.into_iter().filter_map(ranked);
    near.min_by_key(|(rank, _)| *rank).map(|(_, candidate)| candidate)
}

#[cfg(test)]
mod tests {
    use super::nearest;

    #[test]
    fn near_misses_are_found_and_others_are_not() {
        let known = ["length", "depth", "lateral_offset"];
        assert_eq!(nearest("lenght", known), Some("length"));
        assert_eq!(nearest("Depth", known), Some("depth"));
        assert_eq!(nearest("lateral-offset", known), Some("lateral_offset"));
        assert_eq!(nearest("lateral", known), Some("lateral_offset"));
        assert_eq!(nearest("lwa", ["low", "law"]), Some("law"));
        assert_eq!(nearest("Mpa", ["Pa", "MPa"]), Some("MPa"));
        assert_eq!(nearest("kg/m", ["kN/m", "kgf/m"]), Some("kgf/m"));
        assert_eq!(nearest("colour", known), None);
        assert_eq!(nearest("", known), None);
        assert_eq!(nearest("z", ["x", "y"]), None);
        assert_eq!(nearest("長さ", known), None);
    }
}
