//! The scenes of examples/scenes, each computed and held against a law of its own.

use creepage::{PassRecord, Run, Scene, SceneFile};

use crate::answers::common::assert_within;
use crate::scenes::{assert_near, last};

/// The scene with other keys, and its run.
fn run(name: &str, overrides: &[&str]) -> (Scene, Run) {
    let file = SceneFile::read(format!("examples/scenes/{name}.toml")).and_then(|file| file.with(overrides));
    let scene = file.and_then(|file| file.scene()).expect("a scene");
    let run = creepage::run(&scene).unwrap_or_else(|error| panic!("{name}: {error}"));
    let stated = run.error_estimate.relative;
    assert!(stated <= scene.solver.tolerance, "{name}: {stated}");
    (scene, run)
}

/// Forces upstream and downstream after the last pass \[N\].
fn ends(run: &Run) -> [f64; 2] {
    [last(run).upstream_force_n, last(run).downstream_force_n]
}

/// Largest forces upstream and downstream of all passes \[N\].
fn largest(run: &Run) -> [f64; 2] {
    let most = |of: fn(&PassRecord) -> f64| run.passes.iter().map(of).fold(0.0, f64::max);
    [
        most(|pass| pass.upstream_peak_n),
        most(|pass| pass.downstream_peak_n),
    ]
}

/// Within the errors that both state, as shares of the larger one.
#[track_caller]
fn assert_agree(one: (&Run, f64), other: (&Run, f64)) {
    let stated = one.0.error_estimate.relative + other.0.error_estimate.relative;
    assert_within(one.1, other.1, stated * one.1.abs().max(other.1.abs()), "N");
}

/// Finite elements are an independent ground.
#[test]
fn layers_give_the_forces_of_finite_elements() {
    let few = "traffic.passes=5";
    let (_, transform) = run("layers", &[few]);
    let (_, elements) = run("layers", &[few, "ground.model=fem", "solver.tolerance=2 %"]);
    assert!(transform.plan.ground.starts_with("burmister"));
    assert_agree((&transform, ends(&transform)[1]), (&elements, ends(&elements)[1]));
}

/// A bar held at both ends cannot give: a day swings its force by EA α ΔT, but for what little traffic locks in and lets go.
#[test]
fn heat_swings_the_force_of_a_held_cable() {
    let (scene, run) = run("heat", &[]);
    let swing = scene.cable.axial_stiffness * 17e-6 * 10.0;
    let day = run.days.last().expect("a day");
    let found = day.downstream_max_n - day.downstream_min_n;
    assert_near(found, swing, 0.1, ());
}

/// Friction can hold back no more than μ N′ a metre: the fixed end bears at most that and the weight's part along the duct.
#[test]
fn a_slope_adds_at_most_its_part_of_the_weight() {
    let (scene, down) = run("slope", &[]);
    let (_, level) = run("slope", &["duct.slope=0"]);
    let [down, level] = [down, level].map(|run| ends(&run)[1]);
    let weight = scene.body_force().abs() * scene.duct.length;
    assert!(weight > 100.0 && down > level && down <= level + 1.05 * weight);
}

/// Seen from the other side, with the other lane first, ends change places.
#[test]
fn two_directions_have_a_mirror_image() {
    let (scene, run) = run("two-directions", &[]);
    let mut mirrored = scene.clone();
    (mirrored.ends.upstream, mirrored.ends.downstream) = (scene.ends.downstream, scene.ends.upstream);
    let [there, back] = [scene.vehicles[0].direction, scene.vehicles[1].direction];
    (mirrored.vehicles[0].direction, mirrored.vehicles[1].direction) = (back, there);
    let other = creepage::run(&mirrored).expect("an answer");
    let [found, mirror] = [&run, &other].map(largest);
    assert_agree((&run, found[1]), (&other, mirror[0]));
    assert_agree((&run, found[0]), (&other, mirror[1]));
    // Trucks the other way undo some of what the others did.
    mirrored.clone_from(&scene);
    mirrored.vehicles[1].direction = there;
    let one_way = creepage::run(&mirrored).expect("an answer");
    assert!(found[1] > 0.0 && found[1] < largest(&one_way)[1], "{found:?}");
}

/// The clamps take what the joint is spared, as far as friction lets them.
#[test]
fn clamps_spare_the_joint() {
    let (scene, held) = run("clamps", &[]);
    let (_, bare) = run("clamps", &["restraints=[]"]);
    assert!(ends(&held)[1] < 0.8 * ends(&bare)[1], "{} N", ends(&held)[1]);
    assert_eq!(held.restraints.len(), scene.restraints.len());
    let largest = scene.friction_limit() * scene.duct.length;
    for clamp in &held.restraints {
        assert!((1.0..largest).contains(&clamp.force_n.abs()), "{clamp:?}");
    }
}

/// Three kinds of axles, as often as they were counted; no force is above what friction holds.
#[test]
fn an_axle_table_is_traffic_in_its_shares() {
    let (scene, run) = run("axle-table", &[]);
    let loads = scene.vehicles.iter().map(|vehicle| vehicle.wheels()[0].load);
    assert!(loads.eq([20e3, 50e3, 100e3]));
    for (share, expected) in scene.shares().into_iter().zip([0.6, 0.3, 0.1]) {
        assert_near(share, expected, 1e-12, ());
    }
    let (force, limit) = (ends(&run)[1], scene.friction_limit() * scene.duct.length);
    assert!(force > 0.0 && force < limit, "{force} N");
}

/// The weight correction factor of pulling calculations for three cables in trefoil, 1/√(1 − (d/(D − d))²), is carried by the two lower
/// ones.
#[test]
fn a_bundle_presses_by_its_weight_correction_factor() {
    let (scene, bundled) = run("bundle", &[]);
    let factor = 1.5 / (1.0 - (60.0_f64 / 140.0).powi(2)).sqrt();
    assert_near(scene.normal_load() / scene.cable.weight, factor, 1e-6, ());
    // A cable alone that weighs as much more.
    let factor = scene.normal_load() / scene.cable.weight;
    let limit = format!("cable.normal_load_factor={factor}");
    let (_, alone) = run("bundle", &["cable.arrangement=single", &limit]);
    assert_agree((&bundled, ends(&bundled)[1]), (&alone, ends(&alone)[1]));
}

/// Feet, inches and kips are metres and newtons: 0.3048 m, 4.4482216152605 kN, 6.894757293168 kPa.
#[test]
fn imperial_units_are_converted_exactly() {
    const KIP: f64 = 4448.2216152605;
    let ksi = KIP / 0.0254 / 0.0254;
    let (scene, imperial) = run("imperial-units", &[]);
    let metric = [
        format!("duct.length={}", 98.0 * 0.3048),
        format!("duct.depth={}", 4.0 * 0.3048),
        format!("cable.weight={}", 7.5e-3 * KIP / 0.3048),
        format!("cable.axial_stiffness={}", 1800.0 * KIP),
        format!("ends.downstream.spring={}", 20.0 * KIP / 0.0254),
        format!("restraints.0.stiffness={}", 5.0 * KIP / 0.0254),
        format!("restraints.0.position={}", 50.0 * 0.3048),
        format!("vehicles.0.load={}", 44.0 * KIP),
        format!("vehicles.0.speed={}", 25.0 * 0.44704),
        format!("ground.layers.0.thickness={}", 4.0 * 0.0254),
        format!("ground.layers.0.young_modulus={}", 300.0 * ksi),
        format!("ground.layers.1.young_modulus={}", 116.0 * ksi),
    ];
    let metric: Vec<&str> = metric.iter().map(String::as_str).collect();
    let (other, run) = run("imperial-units", &metric);
    assert_near(scene.cable.weight, other.cable.weight, 1e-12, ());
    assert_near(ends(&imperial)[1], ends(&run)[1], 1e-6, ());
}
