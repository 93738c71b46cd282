//! Every key a scene file may hold.

use super::nearest::nearest;

/// Sections and their keys, as messages list them; a misplaced key is looked for here.
const SECTIONS: [(&str, &str); 11] = [
    ("duct", "length, depth, lateral_offset, slope, inner_diameter"),
    (
        "ground",
        "preset, model, rigid_base_depth, longitudinal_peak, vertical_peak, layers",
    ),
    ("ground.layers", "thickness, young_modulus, poisson_ratio"),
    (
        "cable",
        "preset, weight, axial_stiffness, normal_load_factor, diameter, arrangement",
    ),
    ("friction", "preset, law, dynamic_coefficient, shape_factor"),
    ("ends", "upstream, downstream"),
    ("restraints", "position, stiffness"),
    (
        "vehicles",
        "preset, name, speed, load, wheels, lateral_offset, direction, share",
    ),
    ("traffic", "passes, years, per_day, order, seed, sequence"),
    ("heat", "expansion, daily_swing, offset, profile"),
    (
        "solver",
        "method, tolerance, node_spacing, vehicle_step, time_step, approach",
    ),
];
/// The other tables: the top level, and those inside sections.
const OTHERS: [(&str, &str); 5] = [
    (
        "",
        "title, duct, ground, cable, friction, ends, restraints, vehicles, traffic, heat, solver",
    ),
    ("ground.layers.young_modulus", "top, bottom"),
    ("ends.upstream", "spring"),
    ("ends.downstream", "spring"),
    ("vehicles.wheels", "x, y, load, contact_radius"),
];
/// One thing with two names: an end has a `spring`, a clamp a `stiffness`.
const OTHER_NAMES: [(&str, &str); 2] = [("stiffness", "spring"), ("spring", "stiffness")];

/// The keys of the table at `path`, such as `vehicles.0.wheels.1`.
pub fn of(path: &str) -> &'static str {
    let is_name = |part: &&str| part.parse::<usize>().is_err();
    let table = path.split('.').filter(is_name).collect::<Vec<_>>().join(".");
    let mut tables = SECTIONS.iter().chain(&OTHERS);
    let found = tables.find(|(name, _)| *name == table);
    found.map_or("", |(_, keys)| keys)
}

pub fn holds(keys: &str, key: &str) -> bool {
    keys.split(", ").any(|known| known == key)
}

/// The key that was probably meant where only `known` ones are: a near miss, another name for it, or a key of another section.
pub fn suggestion(key: &str, known: &'static str) -> Option<String> {
    let other_name = || {
        let (_, name) = OTHER_NAMES.iter().find(|(other, _)| *other == key)?;
        holds(known, name).then_some(*name)
    };
    let elsewhere = || {
        let (section, _) = SECTIONS.iter().find(|(_, keys)| holds(keys, key))?;
        Some(format!("{section}.{key}"))
    };
    nearest(key, known.split(", "))
        .or_else(other_name)
        .map(str::to_owned)
        .or_else(elsewhere)
}

/// A key with those of the tables around it.
pub fn joined(path: &str, key: &str) -> String {
    if path.is_empty() {
        key.to_owned()
    } else {
        format!("{path}.{key}")
    }
}
