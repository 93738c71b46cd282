//! `preset = "…"`: what it gives, what counts instead of it, and where its values are from.

use std::f64::consts::PI;

use creepage::presets::{Preset, PresetKind, all};
use creepage::scene::End;
use ground_field::{Base, Modulus};

use crate::scenes::{assert_near, scene_of};

/// A scene whose sections are presets where there is one.
const SCENE: &str = r#"
[duct]
length = "30 m"
depth = "1.2 m"
[ground]
preset = "n6-cbr6"
[cable]
preset = "xlpe-800-single-core"
[friction]
preset = "sheath-on-sheath"
law = "coulomb"
[ends]
upstream = "free"
downstream = "fixed"
[[vehicles]]
preset = "t-25"
[traffic]
passes = 10
"#;

fn section(kind: PresetKind) -> &'static str {
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
        let heading = format!("[{section}]").replace("[vehicles.0]", "[[vehicles]]");
        let start = SCENE.find(&heading).unwrap() + heading.len();
        let length = SCENE[start + 1..].find('\n').unwrap() + 1;
        let law = if preset.kind == PresetKind::Friction {
            ""
        } else {
            "\n"
        };
        let (before, after) = (&SCENE[..start], &SCENE[start + length..]);
        let written = format!("{before}\n{}{law}{after}", preset.toml);
        assert_eq!(scene_of(&written, &[]), named, "{}", preset.name);
        count[preset.kind as usize] += 1;
    }
    assert_eq!(count, [12, 2, 4, 10]);
}

#[test]
fn every_value_has_a_source_or_is_marked_as_assumed() {
    for preset in all() {
        let keys = |key: &str| {
            preset
                .sources
                .iter()
                .any(|s| s.key.split(['.', ' ']).next() == Some(key))
        };
        for line in preset.toml.lines() {
            if let Some((key, _)) = line
                .split_once(" = ")
                .filter(|(key, _)| !key.starts_with([' ', '{']))
            {
                assert!(keys(key), "{}: {key} has no source", preset.name);
            }
        }
        for source in &preset.sources {
            let key = source.key.split(['.', ' ']).next().unwrap();
            assert!(
                preset.toml.contains(&format!("{key} = ")),
                "{}: {key}",
                preset.name
            );
            assert!(source.source.len() > 10);
        }
    }
    let wheelbase = |s: &&creepage::presets::Source| s.key == "wheels.x";
    let truck = all().iter().find(|p| p.name == "t-25").unwrap();
    assert!(truck.sources.iter().find(wheelbase).unwrap().assumed);
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

#[test]
fn pavements_have_the_equivalent_thickness_of_their_class() {
    // T_A = 3.84 N^0.16 / CBR^0.3 cm (Japanese design at 90 % reliability), with a centimetre of bituminous base worth 0.8 and of
    // stone at least 0.3 (graded) and 0.2 (crusher-run) centimetres of hot mix.
    let worth = |preset: &Preset| {
        let scene = scene_of(SCENE, &[&format!("ground.preset={}", preset.name)]);
        let layers = scene.ground.profile().expect("layers").layers().to_vec();
        let bituminous = layers.len() - 2;
        let factors = if bituminous == 1 {
            vec![1.0, 0.3, 0.2]
        } else {
            vec![1.0, 0.8, 0.3, 0.2]
        };
        let sum: f64 = layers
            .iter()
            .zip(factors)
            .map(|(layer, factor)| 100.0 * layer.thickness() * factor)
            .sum();
        let Base::HalfSpace(subgrade) = scene.ground.profile().expect("layers").base() else {
            panic!("a subgrade without end")
        };
        (sum, subgrade.young_modulus() / 10e6)
    };
    for (class, passes) in [("n5", 1e6_f64), ("n6", 7e6), ("n7", 35e6)] {
        for cbr in [3.0_f64, 6.0, 12.0] {
            let name = format!("{class}-cbr{cbr}");
            let preset = all().iter().find(|p| p.name == name).unwrap();
            let (found, found_cbr) = worth(preset);
            assert!((found_cbr - cbr).abs() < 1e-9);
            let needed = 3.84 * passes.powf(0.16) / cbr.powf(0.3);
            assert!(
                found > needed - 0.5 && found < needed + 3.0,
                "{name}: {found} cm where {needed} are needed"
            );
        }
    }
}

#[test]
fn what_stands_beside_a_preset_counts_instead_of_it() {
    let text = SCENE.replace(
        "preset = \"xlpe-800-single-core\"",
        "weight = \"200 N/m\"\npreset = \"xlpe-800-single-core\"",
    );
    let text = text.replace(
        "preset = \"t-25\"",
        "preset = \"t-25\"\nload = \"15 tf\"\nspeed = 5",
    );
    let scene = scene_of(&text, &[]);
    assert_eq!((scene.cable.weight, scene.cable.axial_stiffness), (200.0, 8.01e6));
    // A load excludes wheels: the one that the scene gives itself stands.
    assert_eq!(scene.vehicles[0].wheels().len(), 1);
    assert_eq!(scene.vehicles[0].speed, 5.0);
}

#[test]
fn overrides_change_presets_and_what_is_in_them() {
    let scene = scene_of(
        SCENE,
        &[
            "vehicles.0.wheels.0.load=1 kN",
            "ground.layers.4.young_modulus=300 MPa",
            "cable.weight=150",
            "ends.upstream=fixed",
        ],
    );
    assert_eq!(scene.vehicles[0].weight(), 226e3);
    assert_eq!(scene.cable.weight, 150.0);
    assert_eq!(scene.ends.upstream, End::Fixed);
    let Base::HalfSpace(subgrade) = scene.ground.profile().expect("layers").base() else {
        panic!("a subgrade without end")
    };
    assert_eq!(subgrade.young_modulus(), 300e6);

    // A preset named later wins over what was written before it, but not over what is set after it.
    let text = SCENE.replace("preset = \"t-25\"", "load = \"15 tf\"\nspeed = 5");
    let scene = scene_of(&text, &["vehicles.0.preset=t-20", "vehicles.0.speed=7"]);
    assert_eq!(scene.vehicles[0].weight(), 200e3);
    assert_eq!(scene.vehicles[0].speed, 7.0);
    let set = ["ground.preset=n7-cbr12", "ground.layers.0.thickness=1 m"];
    let profile = scene_of(SCENE, &set).ground.profile().expect("layers");
    let first = profile.layers()[0];
    assert_eq!((first.thickness(), profile.layers().len()), (1.0, 4));
    assert_eq!(first.modulus(), Modulus::Uniform(2411e6));
}
