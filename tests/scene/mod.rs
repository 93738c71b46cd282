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

use approx::assert_relative_eq;
use creepage::scene::{End, FrictionLaw, GroundModel, Location, Order, Scene, SceneError, SceneFile, Solver};
use ground_field::{Base, Direction};

use crate::scenes::scene_of;

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
    SceneFile::from_toml("bad.toml", FULL).and_then(|file| file.with(overrides)?.scene())
}

/// Asserts that the last of the overrides is refused under this key.
#[track_caller]
fn assert_override_refused(overrides: &[&str], key: &str) {
    let SceneError::Wrong(wrong) = read_with(overrides).expect_err(key) else {
        panic!("{overrides:?}")
    };
    let place = wrong.location.as_ref().map(|location| location.file().to_owned());
    let last = overrides.last().map(|set| format!("--set {set}"));
    assert_eq!((&*wrong.key, place), (key, last));
}

/// What the full scene comes to in SI.
const SI: &str = "title=Everything; duct.length=30.0 m; duct.depth=1.2 m; duct.lateral_offset=-0.5 m; duct.slope=-0.03; \
    duct.inner_diameter=0.2 m; ground.model=fem; ground.rigid_base_depth=12.0 m; ground.longitudinal_peak=3.57e-5 m; \
    ground.layers.0.thickness=0.05 m; ground.layers.0.young_modulus=4000000000.0 Pa; ground.layers.0.poisson_ratio=0.35; \
    ground.layers.1.thickness=1.0 m; ground.layers.1.young_modulus.top=60000000.0 Pa; \
    ground.layers.1.young_modulus.bottom=200000000.0 Pa; ground.layers.1.poisson_ratio=0.4; \
    ground.layers.2.young_modulus=800000000.0 Pa; ground.layers.2.poisson_ratio=0.5; cable.weight=108.8 N/m; \
    cable.axial_stiffness=8010000.0 N; cable.normal_load_factor=1.5; friction.law=sigmoid; friction.dynamic_coefficient=0.25; \
    friction.shape_factor=20000000.0 1/m; ends.upstream=free; ends.downstream.spring=3000000.0 N/m; restraints.0.position=20.0 m; \
    restraints.0.stiffness=1000000.0 N/m; vehicles.0.name=truck; vehicles.0.speed=10.0 m/s; vehicles.0.load=196133.0 N; \
    vehicles.0.share=3.0; vehicles.1.name=van; vehicles.1.speed=5.0 m/s; vehicles.1.wheels.0.y=0.9 m; \
    vehicles.1.wheels.0.load=5000.0 N; vehicles.1.wheels.0.contact_radius=0.15 m; vehicles.1.wheels.1.x=-2.5 m; \
    vehicles.1.wheels.1.y=-0.9 m; vehicles.1.wheels.1.load=7000.0 N; vehicles.1.lateral_offset=3.5 m; vehicles.1.direction=reverse; \
    traffic.passes=60; traffic.per_day=800.0; traffic.order=random; traffic.seed=7; solver.method=explicit; solver.tolerance=0.02; \
    solver.node_spacing=0.1 m; solver.vehicle_step=0.05 m; solver.time_step=0.0001 s; \
    uncertain.friction.dynamic_coefficient.0=0.2; uncertain.friction.dynamic_coefficient.1=0.5; \
    uncertain.ground.layers.1.young_modulus.top.0=50000000.0 Pa; uncertain.ground.layers.1.young_modulus.top.1=100000000.0 Pa; \
    measures.0.name=sprung; measures.0.upstream.spring=2000000.0 N/m; measures.0.downstream.spring=1000000.0 N/m; \
    measures.0.restraints.0.position=10.0 m; measures.0.restraints.0.stiffness=1000000.0 N/m; \
    measures.0.added_restraints.0.position=5.0 m; measures.0.added_restraints.0.stiffness=2000000.0 N/m; measures.0.cost=1200.0";

/// `KEY=VALUE` of everything at a key and below it.
fn leaves(key: &str, value: &toml::Value) -> Vec<String> {
    let below = |name: &str, value| leaves(&format!("{key}.{name}"), value);
    match value {
        toml::Value::Table(table) => table
            .iter()
            .flat_map(|(name, value)| below(name, value))
            .collect(),
        toml::Value::Array(list) => (0..)
            .zip(list)
            .flat_map(|(at, value): (u32, _)| below(&at.to_string(), value))
            .collect(),
        toml::Value::String(text) => vec![format!("{}={text}", &key[1..])],
        value => vec![format!("{}={value}", &key[1..])],
    }
}

#[test]
fn every_key_is_read() {
    let scene = read(FULL).unwrap();
    let text = scene.to_toml();
    assert_eq!(read(&text).unwrap(), scene, "{text}");
    let table: toml::Table = text.parse().expect("TOML");
    let mut found = leaves("", &table.into());
    let mut expected: Vec<&str> = SI.split("; ").collect();
    found.sort_unstable();
    expected.sort_unstable();
    assert_eq!(found, expected);
    // What follows from them.
    let held = scene.measures[0].applied(&scene);
    let springs = (End::Spring(2e6), End::Spring(1e6));
    assert_eq!((held.ends.upstream, held.ends.downstream), springs);
    assert!(held.restraints.iter().map(|clamp| clamp.position).eq([10.0, 5.0]));
    assert_relative_eq!(scene.normal_load(), 163.2, epsilon = 1e-12);
    assert_relative_eq!(scene.body_force(), 108.8 * 0.03_f64.atan().sin());
    assert_relative_eq!(scene.friction_limit(), 0.25 * 163.2 * 0.03_f64.atan().cos());
    let profile = scene.ground.profile().expect("layers");
    assert_eq!((profile.layers().len(), profile.base()), (3, Base::Rigid));
    assert_relative_eq!(profile.base_depth(), 12.0, epsilon = 1e-12);
    assert_eq!(scene.shares(), [0.75, 0.25]);
    assert_eq!(scene.order(), Order::Random { seed: 7 });
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

/// Table 1 of the paper; both phases have one slope before slipping.
#[test]
fn the_example_scenes_are_those_of_the_experiment() {
    for (name, coefficient, normal_load) in [("upper", 0.25, 108.8), ("lower", 0.27, 163.2)] {
        let scene = Scene::from_file(format!("examples/scenes/full-scale-{name}.toml")).unwrap();
        assert_eq!(scene.title, format!("Full-scale experiment, {name} phase"));
        assert_eq!(scene.friction.dynamic_coefficient, coefficient);
        assert_relative_eq!(scene.normal_load(), normal_load, max_relative = 1e-12);
        let FrictionLaw::ElasticPlastic { shape_factor } = scene.friction.law() else {
            panic!("elastic-plastic")
        };
        let slope = coefficient * normal_load * shape_factor / 2.0;
        assert_relative_eq!(slope, 1e8, max_relative = 1e-6);
        let soil = scene.ground.profile().expect("layers").homogeneous().unwrap();
        assert_eq!((soil.young_modulus(), soil.poisson_ratio()), (8e8, 0.4));
        assert_eq!((scene.duct.length, scene.duct.depth), (30.0, 1.2));
        assert_eq!(scene.traffic.passes, 200);
        let ends = (scene.ends.upstream, scene.ends.downstream);
        assert_eq!(ends, (End::Free, End::Fixed));
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
    let error = read(&text.replace("\"1.2 m\"", "\"1.2 kN\"")).unwrap_err();
    assert_eq!(error.location().and_then(Location::line), Some(4));
}

#[test]
fn a_stiffness_is_a_modulus_times_an_area() {
    let product = "young_modulus = \"1e-2 kgf/mm2\"\nconductor_area = \"800 mm2\"";
    let text = FULL.replace("axial_stiffness = 8.01e6", product);
    let stiffness = |set: &[&str]| scene_of(&text, set).cable.axial_stiffness;
    assert_relative_eq!(stiffness(&[]), 0.01 * 9.80665 * 800.0, max_relative = 1e-15);
    // Set later, the stiffness stands in their place.
    assert_eq!(stiffness(&["cable.axial_stiffness=5 MN"]), 5e6);
}

#[test]
fn a_mass_per_length_stands_for_its_weight() {
    let scene = read_with(&["cable.weight=11 kg/m"]).unwrap();
    assert_relative_eq!(scene.cable.weight, 11.0 * 9.80665, max_relative = 1e-14);
    assert!(read_with(&["restraints.0.stiffness=3 kg/m"]).is_err());
}
