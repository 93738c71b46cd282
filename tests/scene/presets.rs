//! `preset = "…"`: what it gives, what counts instead of it, and where its values are from.

use std::collections::BTreeSet;
use std::f64::consts::PI;

use creepage::presets::{PresetKind, all};
use ground_field::{Base, Modulus, Soil, SoilLayer};

use crate::scenes::{assert_near, scene_of};

/// A scene whose sections are presets if there is one.
const SCENE: &str = r#"duct = { length = "30 m", depth = "1.2 m" }
ground = { preset = "n6-cbr6" }
cable = { preset = "xlpe-800-single-core" }
friction = { preset = "sheath-on-sheath", law = "coulomb" }
ends = { upstream = "free", downstream = "fixed" }
vehicles = [{ preset = "t-25" }]
traffic = { passes = 10 }
"#;

pub fn section(kind: PresetKind) -> &'static str {
    match kind {
        PresetKind::Vehicle => "vehicles.0",
        PresetKind::Cable => "cable",
        PresetKind::Friction => "friction",
        PresetKind::Pavement => "ground",
    }
}

#[test]
fn every_preset_makes_a_scene_and_is_as_good_as_its_values() {
    let mut count = [0; 4];
    for preset in all() {
        let section = section(preset.kind);
        let named = scene_of(SCENE, &[&format!("{section}.preset={}", preset.name)]);
        // The same values written out in the file.
        let (heading, more) = match preset.kind {
            PresetKind::Vehicle => ("[[vehicles]]", ""),
            PresetKind::Friction => ("[friction]", "law = \"coulomb\""),
            PresetKind::Cable => ("[cable]", ""),
            PresetKind::Pavement => ("[ground]", ""),
        };
        let is_other = |line: &&str| !line.starts_with(&section[..5]);
        let others: Vec<&str> = SCENE.lines().filter(is_other).collect();
        let written = format!("{}\n{heading}\n{}\n{more}\n", others.join("\n"), preset.toml);
        assert_eq!(scene_of(&written, &[]), named, "{}", preset.name);
        count[preset.kind as usize] += 1;
    }
    assert_eq!(count, [12, 2, 4, 10]);
}

#[test]
fn every_value_has_a_source_or_is_marked_as_assumed() {
    let key_of = |text: &str| text.split(['.', ' ']).next().unwrap_or_default().to_owned();
    for preset in all() {
        let lines = preset.toml.lines().filter(|line| line.contains(" = "));
        let values: BTreeSet<String> = lines
            .filter(|line| !line.starts_with([' ', '{']))
            .map(key_of)
            .collect();
        let sourced: BTreeSet<String> = preset.sources.iter().map(|source| key_of(&source.key)).collect();
        assert_eq!(values, sourced, "{}", preset.name);
        assert!(preset.sources.iter().all(|source| source.source.len() > 10));
    }
    let truck = all().iter().find(|preset| preset.name == "t-25").unwrap();
    let mut sources = truck.sources.iter();
    assert!(sources.any(|source| source.key == "wheels.x" && source.assumed));
}

/// Japan's T loads, whose rear wheels have four times the load of front wheels; sums of EN 1991-2:2003, Table 4.7, and of AASHTO's
/// HS20-44: 8, 32 and 32 kip.
#[test]
fn lorries_weigh_what_their_codes_say() {
    for (name, gross, axles) in [
        ("t-25", 250e3, 2),
        ("t-20", 200e3, 2),
        ("t-14", 140e3, 2),
        ("en-lorry-1", 200e3, 2),
        ("en-lorry-2", 310e3, 3),
        ("en-lorry-3", 490e3, 5),
        ("en-lorry-4", 390e3, 4),
        ("en-lorry-5", 450e3, 5),
        ("hs20-44", 72.0 * 4448.2216152605, 3),
    ] {
        let scene = scene_of(SCENE, &[&format!("vehicles.0.preset={name}")]);
        let vehicle = &scene.vehicles[0];
        assert_near(vehicle.weight(), gross, 1e-12, name);
        assert_eq!(vehicle.wheels().len(), 2 * axles, "{name}");
        for wheel in vehicle.wheels().iter().filter(|_| name.starts_with("t-")) {
            assert_near(PI * wheel.contact_radius.powi(2), 0.2 * 0.5, 1e-3, name);
            let share = if wheel.x > 0.0 { 0.1 } else { 0.4 };
            assert_near(wheel.load, share * gross, 1e-9, name);
        }
    }
}

/// T_A = 3.84 N^0.16 / CBR^0.3 cm (Japanese design at 90 % reliability), with a centimetre of bituminous base worth 0.8 and of stone at
/// least 0.3 (graded) and 0.2 (crusher-run) centimetres of hot mix.
#[test]
fn pavements_have_the_equivalent_thickness_of_their_class() {
    for (class, passes) in [("n5", 1e6_f64), ("n6", 7e6), ("n7", 35e6)] {
        for cbr in [3.0_f64, 6.0, 12.0] {
            let name = format!("{class}-cbr{cbr}");
            let (layers, subgrade) = ground(&[&format!("ground.preset={name}")]);
            let worth = if layers.len() == 3 {
                &[1.0, 0.3, 0.2][..]
            } else {
                &[1.0, 0.8, 0.3, 0.2]
            };
            let worth = layers
                .iter()
                .zip(worth)
                .map(|(layer, worth)| 100.0 * layer.thickness() * worth);
            let found: f64 = worth.sum();
            assert!((subgrade.young_modulus() / 10e6 - cbr).abs() < 1e-9);
            let needed = 3.84 * passes.powf(0.16) / cbr.powf(0.3);
            let above = found - needed;
            assert!(above > -0.5 && above < 3.0, "{name}: {found} cm, needed {needed}");
        }
    }
}

/// The layers of the scene with overrides, and the subgrade below them.
fn ground(overrides: &[&str]) -> (Vec<SoilLayer>, Soil) {
    let profile = scene_of(SCENE, overrides).ground.profile().expect("layers");
    match profile.base() {
        Base::HalfSpace(subgrade) => (profile.layers().to_vec(), subgrade),
        Base::Rigid => panic!("a subgrade without end"),
    }
}

#[test]
fn what_stands_beside_a_preset_or_is_set_later_counts_instead_of_it() {
    let beside = |preset: &str, more: &str| {
        let preset = format!("preset = \"{preset}\"");
        SCENE.replace(&preset, &format!("{preset}, {more}"))
    };
    let cable = scene_of(&beside("xlpe-800-single-core", "weight = \"200 N/m\""), &[]).cable;
    assert_eq!((cable.weight, cable.axial_stiffness), (200.0, 8.01e6));
    // A load excludes wheels: the one that the scene gives itself stands.
    let loaded = beside("t-25", "load = \"15 tf\", speed = 5");
    let vehicle = &scene_of(&loaded, &[]).vehicles[0];
    assert_eq!((vehicle.wheels().len(), vehicle.speed), (1, 5.0));

    let weight = |set: &[&str]| scene_of(SCENE, set).vehicles[0].weight();
    assert_eq!(weight(&["vehicles.0.wheels.0.load=1 kN"]), 226e3);
    assert_eq!(scene_of(SCENE, &["cable.weight=150"]).cable.weight, 150.0);
    assert_eq!(
        ground(&["ground.layers.4.young_modulus=300 MPa"])
            .1
            .young_modulus(),
        300e6
    );
    // A preset named later wins over what was written before it, but not over what is set after it.
    let vehicle = &scene_of(&loaded, &["vehicles.0.preset=t-20", "vehicles.0.speed=7"]).vehicles[0];
    assert_eq!((vehicle.weight(), vehicle.speed), (200e3, 7.0));
    let (layers, _) = ground(&["ground.preset=n7-cbr12", "ground.layers.0.thickness=1 m"]);
    assert_eq!((layers[0].thickness(), layers.len()), (1.0, 4));
    assert_eq!(layers[0].modulus(), Modulus::Uniform(2411e6));
}
