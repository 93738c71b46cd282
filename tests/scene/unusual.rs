//! Valid scenes that are hardly meant are told; ordinary ones are not.

use creepage::presets::{PresetKind, all};
use creepage::scene::Scene;

use super::presets::section;
use crate::scenes::{last, run, scene_of};

const SCENE: &str = r#"
duct = { length = "30 m", depth = "1.5 m" }
ground.layers = [
    { thickness = "15 cm", young_modulus = "3000 MPa", poisson_ratio = 0.35 },
    { thickness = "40 cm", young_modulus = "200 MPa", poisson_ratio = 0.35 },
    { young_modulus = "60 MPa", poisson_ratio = 0.45 },
]
cable.preset = "xlpe-800-single-core"
friction = { law = "coulomb", dynamic_coefficient = 0.3 }
ends = { upstream = "free", downstream = "fixed" }
vehicles = [{ preset = "t-25" }]
traffic.passes = 2
solver.tolerance = 0.05
"#;

const DEEP: &str = "far above what is measured under roads";
const FALLING: &str = "on the falling side of a hill";

fn warnings_of(scene: &Scene) -> Vec<String> {
    creepage::plan(scene).expect("a plan").report().warnings
}

/// Warnings of values, not of what the duct does with them.
fn warnings(overrides: &[&str]) -> Vec<String> {
    let mut all = warnings_of(&scene_of(SCENE, overrides));
    all.retain(|warning| !warning.contains(DEEP) && !warning.contains(FALLING));
    all
}

/// A soft subgrade, and friction beyond that of the largest force: the force falls there, as runs say.
#[test]
fn a_duct_that_goes_down_far_and_friction_beyond_the_hill_are_told() {
    let has = |overrides: &[&str], words: &str| {
        let warnings = warnings_of(&scene_of(SCENE, overrides));
        warnings.iter().any(|warning| warning.contains(words))
    };
    assert!(has(&["ground.preset=n7-cbr6"], DEEP));
    assert!(has(&["ground.vertical_peak=301 um"], DEEP) && !has(&["ground.vertical_peak=299 um"], DEEP));
    let measured = |coefficient: &str| {
        let friction = format!("friction.dynamic_coefficient={coefficient}");
        scene_of(
            SCENE,
            &["ground.vertical_peak=120 um", "traffic.passes=50", &friction],
        )
    };
    let falls = |scene: &Scene| warnings_of(scene).iter().any(|warning| warning.contains(FALLING));
    let [before, after, beyond] = ["0.2", "0.4", "0.6"].map(measured);
    assert!(!falls(&before) && falls(&beyond));
    let [after, beyond] = [after, beyond].map(|scene| last(&run(&scene)).downstream_force_n);
    assert!(after > beyond);
}

/// Overrides, one after the other | part of a warning
const UNUSUAL: &str = r#"
ground.rigid_base_depth=1 m | `ground.rigid_base_depth` is 1 m and the duct lies at 1.5 m
ground.rigid_base_depth=1.5 m | within the rock
ground.layers.2.young_modulus=300 kPa | `ground.layers.2.young_modulus` (layer 3) is 0.3 MPa, softer than peat
ground.layers.1.young_modulus=3000 | `ground.layers.1.young_modulus` (layer 2) is 0.003 MPa, softer than peat
ground.layers.0.young_modulus=300 GPa | `ground.layers.0.young_modulus` (layer 1) is 300 GPa, stiffer than granite
ground.rigid_base_depth=12 m ; ground.layers.2.young_modulus={ top = "60 MPa", bottom = "600 GPa" } | `ground.layers.2.young_modulus.bottom` (layer 3) is 600 GPa
ground.layers.2.young_modulus=1.9 MPa | 105 times less than that of the layer on it
ground.layers.0.young_modulus=20 MPa ; ground.layers.2.young_modulus=3 GPa | layers stand from the top down
friction.dynamic_coefficient=2.5 | `friction.dynamic_coefficient` is 2.5
duct.lateral_offset=-50 m | `duct.lateral_offset`: the lane of "vehicle 1" is 50 m from the duct
vehicles.0.lateral_offset=20 m ; duct.lateral_offset=-5 m | the lane of "vehicle 1" is 25 m from the duct
ground.longitudinal_peak=30 um ; vehicles=[{ preset = "t-25" }, { preset = "t-14", lateral_offset = "3.5 m" }] | `ground.longitudinal_peak` is the peak under every vehicle, in whatever lane
"#;

#[test]
fn each_unusual_value_is_told_with_its_key() {
    for row in UNUSUAL.lines().filter(|row| !row.is_empty()) {
        let (overrides, wanted) = row.split_once(" | ").expect("a part");
        let overrides: Vec<&str> = overrides.split(" ; ").collect();
        let found = warnings(&overrides);
        let is_told = found.iter().any(|warning| warning.contains(wanted));
        assert!(is_told, "{overrides:?}: {found:#?}");
    }
}

#[test]
fn what_is_only_far_from_the_usual_is_not_told() {
    for overrides in [
        &["ground.rigid_base_depth=1.6 m"][..],
        &["ground.layers.2.young_modulus=2.1 MPa"],
        &["ground.layers.0.young_modulus=90 GPa"],
        &["friction.dynamic_coefficient=1.5"],
        &["duct.lateral_offset=15 m"],
        &["duct.lateral_offset=50 m", "vehicles.0.lateral_offset=50 m"],
        // Soil over rock that is a half-space.
        &[
            "ground.layers.0.young_modulus=60 MPa",
            "ground.layers.0.thickness=5 m",
            "ground.layers.2.young_modulus=20 GPa",
        ],
    ] {
        let found = warnings(overrides);
        let is_told = found.iter().any(|warning| warning.contains('`'));
        assert!(!is_told, "{overrides:?}: {found:#?}");
    }
}

#[test]
fn ordinary_scenes_have_no_warnings() {
    assert_eq!(warnings(&[]), [""; 0]);
    for preset in all().iter().filter(|preset| preset.kind != PresetKind::Friction) {
        let set = format!("{}.preset={}", section(preset.kind), preset.name);
        assert_eq!(warnings(&[&set]), [""; 0], "{set}");
    }
    for name in std::fs::read_dir("examples/scenes").expect("the examples") {
        let path = name.expect("a file").path();
        let scene = Scene::from_file(&path).expect("a scene");
        let mut found = warnings_of(&scene);
        // What is said of every scene with heat, and of grounds from CBR or settlement that no deflection scales.
        found.retain(|warning| {
            let is_of_heat = scene.heat.is_some() && warning.starts_with("forces of heat are upper bounds");
            let measured = scene.ground.longitudinal_peak.or(scene.ground.vertical_peak);
            let is_of_ground = measured.is_none() && warning.contains(DEEP);
            !is_of_heat && !is_of_ground
        });
        assert_eq!(found, [""; 0], "{}", path.display());
    }
}

/// A mesh that follows from the duct's length and depth is refused with these, not with a spacing that nobody wrote.
#[test]
fn too_long_a_duct_for_its_depth_is_told_with_both_keys() {
    let long = SCENE.replace("30 m", "100 km").replace("1.5 m", "0.1 m");
    // Under a concentrated load and no slab, which would spread it: the duct moves as sharply as it is deep.
    let even = long.replace("3000 MPa", "60 MPa").replace("200 MPa", "60 MPa");
    let text = even.replace("preset = \"t-25\"", "speed = \"40 km/h\", load = \"5 tf\"");
    let file = creepage::SceneFile::from_toml("long.toml", &text).expect("a file");
    let error = creepage::plan(&file.scene().expect("a scene")).expect_err("too many nodes");
    assert!(error.is_bad_input());
    let message = error.located(&file).to_string();
    assert!(message.starts_with("long.toml, line 2: duct.length = 100000 m and duct.depth = 0.1 m: "));
    assert!(!message.contains("node_spacing ="), "{message}");
}
