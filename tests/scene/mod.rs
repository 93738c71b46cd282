//! Scene files: what is read from them, and what is said about each kind of bad input.

mod arrangement;
mod bad_input;
mod edited;
pub mod histogram;
mod keys;
mod overrides;
mod presets;
mod traffic;
mod unusual;
mod written;

use std::path::Path;

use approx::assert_relative_eq;
use creepage::scene::{
    End, FrictionLaw, GroundModel, Order, Restraint, Scene, SceneError, Solver, SolverMethod,
};
use ground_field::{Base, Direction, Modulus};

/// A scene that uses every key.
pub const FULL: &str = r#"title = "Everything"
[duct]
length = "30 m"
depth = "1.2 m"
lateral_offset = "-0.5 m"
slope = "-3 %"
inner_diameter = "20 cm"
[ground]
model = "fem"
rigid_base_depth = "12 m"
longitudinal_peak = "35.7 um"
[[ground.layers]]
thickness = "50 mm"
young_modulus = "4000 MPa"
poisson_ratio = 0.35
[[ground.layers]]
thickness = 1
young_modulus = { top = "60 MPa", bottom = "200 MPa" }
poisson_ratio = 0.4
[[ground.layers]]
young_modulus = "800 MPa"
poisson_ratio = 0.5
[cable]
weight = "108.8 N/m"
axial_stiffness = 8.01e6
normal_load_factor = 1.5
[friction]
law = "sigmoid"
dynamic_coefficient = 0.25
shape_factor = "2e7 1/m"
[ends]
upstream = "free"
downstream = { spring = "3 MN/m" }
[[restraints]]
position = "20 m"
stiffness = "1 MN/m"
[[vehicles]]
name = "truck"
speed = "36 km/h"
load = "20 tf"
share = 3
[[vehicles]]
name = "van"
speed = 5
wheels = [
  { x = "0 m", y = "0.9 m", load = "5 kN", contact_radius = "0.15 m" },
  { x = "-2.5 m", y = "-0.9 m", load = "7 kN" },
]
lateral_offset = "3.5 m"
direction = "reverse"
[traffic]
passes = 60
per_day = 800
order = "random"
seed = 7
[solver]
method = "explicit"
tolerance = "2 %"
node_spacing = "0.1 m"
vehicle_step = "5 cm"
time_step = "0.1 ms"
[uncertain]
"friction.dynamic_coefficient" = [0.2, 0.5]
ground.layers.1.young_modulus.top = ["50 MPa", "100 MPa"]
[[measures]]
name = "sprung"
upstream = { spring = "2 MN/m" }
downstream = { spring = "1 MN/m" }
restraints = [{ position = "10 m", stiffness = "1 MN/m" }]
added_restraints = [{ position = "5 m", stiffness = "2 MN/m" }]
cost = 1200
"#;

fn read(text: &str) -> Result<Scene, SceneError> {
    Scene::from_toml("bad.toml", text)
}

fn read_with(overrides: &[&str]) -> Result<Scene, SceneError> {
    creepage::SceneFile::from_toml("bad.toml", FULL).and_then(|file| file.with(overrides)?.scene())
}

#[track_caller]
fn assert_override_refused(overrides: &[&str], parts: &[&str]) {
    let message = read_with(overrides)
        .expect_err("the override is wrong")
        .to_string();
    for part in parts {
        assert!(message.contains(part), "{part} is not in\n{message}");
    }
}

#[test]
fn every_key_is_read() {
    let scene = read(FULL).unwrap();
    assert_eq!(scene.title, "Everything");
    let uncertain = scene
        .uncertain
        .iter()
        .map(|known| (&*known.key, known.low, known.high));
    let expected = [
        ("friction.dynamic_coefficient", 0.2, 0.5),
        ("ground.layers.1.young_modulus.top", 50e6, 100e6),
    ];
    assert_eq!(uncertain.collect::<Vec<_>>(), expected);
    let held = scene.measures[0].applied(&scene);
    assert_eq!(
        (held.ends.upstream, held.ends.downstream),
        (End::Spring(2e6), End::Spring(1e6))
    );
    assert!(held.restraints.iter().map(|clamp| clamp.position).eq([10.0, 5.0]));
    let text = scene.to_toml();
    assert_eq!(read(&text).unwrap(), scene, "{text}");
    assert_eq!(
        (scene.duct.length, scene.duct.depth, scene.duct.lateral_offset),
        (30.0, 1.2, -0.5)
    );
    assert_eq!((scene.duct.slope, scene.duct.inner_diameter), (-0.03, Some(0.2)));
    assert_relative_eq!(scene.body_force(), 108.8 * 0.03_f64.atan().sin());
    assert_relative_eq!(scene.friction_limit(), 0.25 * 163.2 * 0.03_f64.atan().cos());
    assert_eq!(scene.ground.model, GroundModel::FiniteElements);
    assert_eq!(scene.ground.longitudinal_peak, Some(35.7e-6));
    let profile = scene.ground.profile().expect("layers");
    let layers = profile.layers();
    assert_eq!(layers.len(), 3);
    assert_eq!(layers[0].modulus(), Modulus::Uniform(4e9));
    assert_eq!(layers[0].thickness(), 0.05);
    let (top, bottom) = (60e6, 200e6);
    assert_eq!(layers[1].modulus(), Modulus::Linear { top, bottom });
    assert_eq!(profile.base(), Base::Rigid);
    assert_relative_eq!(profile.base_depth(), 12.0, epsilon = 1e-12);
    assert_eq!(layers[2].poisson_ratio(), 0.5);
    assert_eq!((scene.cable.weight, scene.cable.axial_stiffness), (108.8, 8.01e6));
    assert_relative_eq!(scene.normal_load(), 163.2, epsilon = 1e-12);
    assert_eq!(scene.friction.law(), FrictionLaw::Sigmoid { shape_factor: 2e7 });
    assert_eq!(scene.friction.dynamic_coefficient, 0.25);
    assert_eq!(
        (scene.ends.upstream, scene.ends.downstream),
        (End::Free, End::Spring(3e6))
    );
    let clamp = Restraint::new(20.0, 1e6);
    assert_eq!(scene.restraints, [clamp]);
    let [truck, van] = &scene.vehicles[..] else {
        panic!("two vehicles")
    };
    assert_eq!((truck.share, van.share), (3.0, 1.0));
    assert_eq!(scene.shares(), [0.75, 0.25]);
    assert_eq!(
        (&*truck.name, truck.speed, truck.weight()),
        ("truck", 10.0, 196_133.0)
    );
    assert_eq!((van.direction, van.speed), (Direction::Reverse, 5.0));
    let wheels = van.wheels();
    assert_eq!(
        (wheels[0].y, wheels[0].contact_radius, wheels[1].x),
        (0.9, 0.15, -2.5)
    );
    assert_eq!(wheels[1].contact_radius, 0.0);
    assert_eq!(scene.traffic.passes, 60);
    assert_eq!(scene.order(), Order::Random { seed: 7 });
    assert_eq!(
        scene.solver,
        Solver {
            method: SolverMethod::Explicit,
            tolerance: 0.02,
            node_spacing: Some(0.1),
            vehicle_step: Some(0.05),
            time_step: Some(1e-4),
            approach: None,
        }
    );
}

#[test]
fn what_may_be_left_out_has_a_default() {
    let text = r#"
        duct = { length = 30, depth = 1.2 }
        cable = { weight = 108.8, axial_stiffness = 8.01e6 }
        friction = { dynamic_coefficient = 0, shape_factor = 2e7 }
        ends = { upstream = "free", downstream = "fixed" }
        vehicles = [{ speed = 10, load = 2e5 }, { speed = 10, load = 1e5 }]
        traffic.passes = 1e3
        ground.layers = [{ young_modulus = 8e8, poisson_ratio = 0 }]
    "#;
    let scene = Scene::from_toml("somewhere/short.toml", text).unwrap();
    assert_eq!(scene.title, "short");
    assert_eq!((scene.duct.lateral_offset, scene.duct.slope), (0.0, 0.0));
    assert_eq!(scene.ground.model, GroundModel::Auto);
    let peaks = [scene.ground.longitudinal_peak, scene.ground.vertical_peak];
    assert_eq!(peaks, [None; 2]);
    let profile = scene.ground.profile().expect("layers");
    assert_eq!(profile.homogeneous().unwrap().young_modulus(), 8e8);
    assert_eq!(scene.normal_load_factor(), 1.0);
    assert_eq!(
        scene.friction.law(),
        FrictionLaw::ElasticPlastic { shape_factor: 2e7 }
    );
    assert!(scene.restraints.is_empty());
    assert_eq!(scene.vehicles[1].name, "vehicle 2");
    assert_eq!(scene.vehicles[1].direction, Direction::Forward);
    assert_eq!(scene.shares(), [0.5, 0.5]);
    assert_eq!((scene.traffic.passes, scene.order()), (1000, Order::Interleaved));
    assert_eq!(scene.solver, Solver::default());
}

#[test]
fn the_example_scenes_have_the_same_slope_before_slipping() {
    for (name, coefficient, normal_load) in [("upper", 0.25, 108.8), ("lower", 0.27, 163.2)] {
        let path = format!(
            "{}/examples/scenes/full-scale-{name}.toml",
            env!("CARGO_MANIFEST_DIR")
        );
        let scene = Scene::from_file(Path::new(&path)).unwrap();
        assert_eq!(scene.title, format!("Full-scale experiment, {name} phase"));
        assert_eq!(scene.friction.dynamic_coefficient, coefficient);
        assert_relative_eq!(scene.normal_load(), normal_load, max_relative = 1e-12);
        let FrictionLaw::ElasticPlastic { shape_factor } = scene.friction.law() else {
            panic!("elastic-plastic")
        };
        assert_relative_eq!(
            coefficient * normal_load * shape_factor / 2.0,
            1e8,
            max_relative = 1e-6
        );
        let soil = scene.ground.profile().expect("layers").homogeneous().unwrap();
        assert_eq!((soil.young_modulus(), soil.poisson_ratio()), (8e8, 0.4));
        assert_eq!(
            (scene.duct.length, scene.duct.depth, scene.traffic.passes),
            (30.0, 1.2, 200)
        );
        assert_eq!(
            (scene.ends.upstream, scene.ends.downstream),
            (End::Free, End::Fixed)
        );
        assert_relative_eq!(scene.vehicles[0].weight(), 196_133.0);
        assert_relative_eq!(scene.vehicles[0].speed, 40.0 / 3.6);
    }
}

#[test]
fn shares_and_the_order_of_vehicles_are_said_in_several_ways() {
    let scene = read_with(&["traffic.sequence=['van', 'truck', 'van', 'van']"]).unwrap();
    assert_eq!(scene.order(), Order::Sequence(vec![1, 0, 1, 1]));
    assert_eq!(scene.shares(), [0.25, 0.75]);
    let scene = read_with(&["vehicles.0.share=20 %", "vehicles.1.share=80 %"]).unwrap();
    assert_eq!(scene.shares(), [0.2, 0.8]);
    let scene = read(&FULL.replace("seed = 7\n", "")).unwrap();
    assert_eq!(scene.order(), Order::Random { seed: 1 });
}

#[test]
fn a_byte_order_mark_and_carriage_returns_change_nothing() {
    let text = format!("\u{feff}{}", FULL.replace('\n', "\r\n"));
    assert_eq!(read(&text).unwrap(), read(FULL).unwrap());
    let message = read(&text.replace("\"1.2 m\"", "\"1.2 kN\""))
        .unwrap_err()
        .to_string();
    let start = "bad.toml, line 4: `duct.depth`: found \"1.2 kN\": `kN` is the unit of a force";
    assert!(message.starts_with(start), "{message}");
}

#[test]
fn a_stiffness_is_a_modulus_times_an_area() {
    let cable = "axial_stiffness = 8.01e6";
    let product = "young_modulus = \"1e-2 kgf/mm2\"\nconductor_area = \"800 mm2\"";
    let scene = read(&FULL.replace(cable, product)).unwrap();
    assert_relative_eq!(
        scene.cable.axial_stiffness,
        0.01 * 9.80665 * 800.0,
        max_relative = 1e-15
    );
    // Set later, the stiffness stands in their place.
    let later = crate::scenes::scene_of(&FULL.replace(cable, product), &["cable.axial_stiffness=5 MN"]);
    assert_eq!(later.cable.axial_stiffness, 5e6);
}

#[test]
fn a_mass_per_length_stands_for_its_weight() {
    for (text, weight) in [
        ("11 kg/m", 11.0 * 9.80665),
        ("11000 kg/km", 11.0 * 9.80665),
        ("7392 lb/1000ft", 7.392 * 4.4482216152605 / 0.3048),
    ] {
        let scene = read_with(&[&format!("cable.weight={text}")]).unwrap();
        assert_relative_eq!(scene.cable.weight, weight, max_relative = 1e-14);
    }
    let message = read_with(&["restraints.0.stiffness=3 kg/m"])
        .unwrap_err()
        .to_string();
    assert!(message.contains("is the unit of a weight"), "{message}");
}
