//! Every key a scene file may hold.

/// Top level.
pub(super) const SCENE: &[&str] = &[
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
pub(super) const DUCT: &[&str] = &["length", "depth", "lateral_offset"];
/// `[ground]`
pub(super) const GROUND: &[&str] = &[
    "preset",
    "model",
    "rigid_base_depth",
    "longitudinal_peak",
    "vertical_peak",
    "layers",
];
/// `[[ground.layers]]`
pub(super) const LAYER: &[&str] = &["thickness", "young_modulus", "poisson_ratio"];
/// `young_modulus = { … }`
pub(super) const GRADED: &[&str] = &["top", "bottom"];
/// `[cable]`
pub(super) const CABLE: &[&str] = &["preset", "weight", "axial_stiffness", "normal_load_factor"];
/// `[friction]`
pub(super) const FRICTION: &[&str] = &["preset", "law", "dynamic_coefficient", "shape_factor"];
/// `[ends]`
pub(super) const ENDS: &[&str] = &["upstream", "downstream"];
/// `upstream = { … }`
pub(super) const SPRING: &[&str] = &["spring"];
/// `[[restraints]]`
pub(super) const RESTRAINT: &[&str] = &["position", "stiffness"];
/// `[[vehicles]]`
pub(super) const VEHICLE: &[&str] = &["preset", "name", "speed", "load", "wheels", "direction", "share"];
/// `wheels = [ { … } ]`
pub(super) const WHEEL: &[&str] = &["x", "y", "load", "contact_radius"];
/// `[traffic]`
pub(super) const TRAFFIC: &[&str] = &["passes", "order", "seed", "sequence"];
/// `[solver]`
pub(super) const SOLVER: &[&str] = &[
    "method",
    "tolerance",
    "node_spacing",
    "vehicle_step",
    "time_step",
    "approach",
];

/// Sections and their keys, to find where a misplaced key belongs.
pub(super) const SECTIONS: &[(&str, &[&str])] = &[
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
pub(super) const OTHER_NAMES: &[(&str, &str)] = &[("stiffness", "spring"), ("spring", "stiffness")];
