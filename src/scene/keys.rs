//! Every key a scene file may hold.

/// Top level.
pub const SCENE: &[&str] = &[
    "title",
    "duct",
    "ground",
    "cable",
    "friction",
    "ends",
    "restraints",
    "vehicles",
    "traffic",
    "solver",
];
/// `[duct]`
pub const DUCT: &[&str] = &["length", "depth", "lateral_offset"];
/// `[ground]`
pub const GROUND: &[&str] = &[
    "preset",
    "model",
    "rigid_base_depth",
    "longitudinal_peak",
    "vertical_peak",
    "layers",
];
/// `[[ground.layers]]`
pub const LAYER: &[&str] = &["thickness", "young_modulus", "poisson_ratio"];
/// `young_modulus = { … }`
pub const GRADED: &[&str] = &["top", "bottom"];
/// `[cable]`
pub const CABLE: &[&str] = &["preset", "weight", "axial_stiffness", "normal_load_factor"];
/// `[friction]`
pub const FRICTION: &[&str] = &["preset", "law", "dynamic_coefficient", "shape_factor"];
/// `[ends]`
pub const ENDS: &[&str] = &["upstream", "downstream"];
/// `upstream = { … }`
pub const SPRING: &[&str] = &["spring"];
/// `[[restraints]]`
pub const RESTRAINT: &[&str] = &["position", "stiffness"];
/// `[[vehicles]]`
pub const VEHICLE: &[&str] = &["preset", "name", "speed", "load", "wheels", "direction", "share"];
/// `wheels = [ { … } ]`
pub const WHEEL: &[&str] = &["x", "y", "load", "contact_radius"];
/// `[traffic]`
pub const TRAFFIC: &[&str] = &["passes", "order", "seed", "sequence"];
/// `[solver]`
pub const SOLVER: &[&str] = &[
    "method",
    "tolerance",
    "node_spacing",
    "vehicle_step",
    "time_step",
    "approach",
];

/// Sections and their keys, to find where a misplaced key belongs.
pub const SECTIONS: &[(&str, &[&str])] = &[
    ("duct", DUCT),
    ("ground", GROUND),
    ("ground.layers", LAYER),
    ("cable", CABLE),
    ("friction", FRICTION),
    ("ends", ENDS),
    ("restraints", RESTRAINT),
    ("vehicles", VEHICLE),
    ("traffic", TRAFFIC),
    ("solver", SOLVER),
];

/// One thing with two names: an end has a `spring`, a clamp a `stiffness`.
pub const OTHER_NAMES: &[(&str, &str)] = &[("stiffness", "spring"), ("spring", "stiffness")];

/// A key with those of the tables around it.
pub fn joined(path: &str, key: &str) -> String {
    if path.is_empty() {
        key.to_owned()
    } else {
        format!("{path}.{key}")
    }
}
