//! Whatever the input: an answer or an error, never a panic.

use proptest::prelude::*;

use super::{FULL, read, read_with};

fn characters() -> impl Strategy<Value = char> {
    prop_oneof![
        prop::sample::select(
            "\n\"'[]{}=.,#-+eE019 mNµ²長\r\t\u{0}\u{feff}"
                .chars()
                .collect::<Vec<_>>()
        ),
        any::<char>(),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn no_mutation_of_a_scene_panics(
        edits in prop::collection::vec((any::<prop::sample::Index>(), 0usize..12, prop::collection::vec(characters(), 0..4)), 1..6),
    ) {
        let mut text: Vec<char> = FULL.chars().collect();
        for (at, removed, inserted) in edits {
            let start = at.index(text.len() + 1);
            let end = (start + removed).min(text.len());
            text.splice(start..end, inserted);
        }
        let text: String = text.into_iter().collect();
        if let Err(error) = read(&text) {
            prop_assert!(error.to_string().starts_with("bad.toml, line "), "{error}");
        }
    }

    #[test]
    fn no_exchange_of_lines_panics(lines in prop::collection::vec(any::<prop::sample::Index>(), 0..60)) {
        let all: Vec<&str> = FULL.lines().collect();
        let text: Vec<&str> = lines.iter().map(|line| all[line.index(all.len())]).collect();
        if let Err(error) = read(&text.join("\n")) {
            prop_assert!(error.to_string().starts_with("bad.toml, line "), "{error}");
        }
    }

    #[test]
    fn no_value_panics(key in 0usize..KEYS.len(), value in prop::collection::vec(characters(), 0..12)) {
        let value: String = value.into_iter().collect();
        if let Err(error) = read_with(&[&format!("{}={value}", KEYS[key])]) {
            prop_assert!(!error.to_string().is_empty());
        }
    }

    #[test]
    fn any_number_is_taken_or_refused_with_its_key(key in 0usize..KEYS.len(), value in any::<f64>()) {
        if let Err(error) = read_with(&[&format!("{}={value:e}", KEYS[key])]) {
            let message = error.to_string();
            prop_assert!(message.contains(" found ") && message.contains(" allowed: "), "{message}");
        }
    }
}

const KEYS: &[&str] = &[
    "title",
    "duct",
    "duct.length",
    "ground.rigid_base_depth",
    "ground.layers",
    "ground.layers.0.thickness",
    "ground.layers.1.young_modulus",
    "ground.layers.2.poisson_ratio",
    "cable.weight",
    "friction.law",
    "friction.shape_factor",
    "ends.upstream",
    "ends.upstream.spring",
    "restraints.0",
    "restraints.0.position",
    "vehicles",
    "vehicles.0.speed",
    "vehicles.0.share",
    "vehicles.1.wheels.0.x",
    "traffic.passes",
    "traffic.seed",
    "traffic.sequence",
    "solver.tolerance",
    "solver.node_spacing",
];
