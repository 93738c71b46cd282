//! How far out a vehicle is followed: far enough by itself, and with an error that covers where the scene says less.

use creepage::scene::GroundModel;
use creepage::{PassRecord, Run, Scene, Stage};

use super::common::{LOWER_AXLES, UPPER, answer, forces_after, looked_at, scene};
use super::long_term;
use crate::scenes::largest;

/// As good as no end of the road \[m\].
const FAR: f64 = 300.0;
/// How far the plan's own road may be from that, as a share of the largest force.
const ALIKE: f64 = 2e-3;

const TRIAXIAL: &str = "vehicles = [{ speed = \"40 km/h\", wheels = [{ x = 0, y = 0.9, load = \"50 kN\", contact_radius = 0.15 }, \
                        { x = 0, y = -0.9, load = \"50 kN\", contact_radius = 0.15 }, { x = -1.3, y = 0.9, load = \"45 kN\", \
                        contact_radius = 0.15 }, { x = -5, y = -0.9, load = \"55 kN\", contact_radius = 0.15 }] }]";
const PAVEMENT: &str = "layers = [{ thickness = 0.15, young_modulus = 3e9, poisson_ratio = 0.35 }, \
                        { thickness = 0.4, young_modulus = 2e8, poisson_ratio = 0.35 }, \
                        { young_modulus = 6e7, poisson_ratio = 0.45 }]";
const SOIL: &str = "layers = [{ young_modulus = 8e8, poisson_ratio = 0.4 }]";

fn ground(base: &str, layers: &str) -> String {
    format!("ground = {{ {base}{layers} }}")
}

/// Half-space, layers, rock near and far, three axles near shakedown, two directions, a deep duct, Coulomb.
fn scenes() -> Vec<Scene> {
    let rock = |depth: &str| format!("rigid_base_depth = {depth}, ");
    let of = |lines: &[&str]| scene(&[&UPPER, &["duct = { length = 30, depth = 1.2 }"], lines]);
    let axles = |ground: &str| scene(&[&UPPER, &LOWER_AXLES, &[ground]]);
    let deep = [
        "duct = { length = 60, depth = 3 }",
        "friction = { dynamic_coefficient = 0.4, shape_factor = 4e6 }",
    ];
    let reverse = "vehicles = [{ name = \"a\", speed = \"40 km/h\", load = \"20 tf\", share = 2 }, \
                   { name = \"b\", speed = \"40 km/h\", load = \"12 tf\", direction = \"reverse\" }]";
    vec![
        of(&[]),
        of(&[&ground("", PAVEMENT)]),
        of(&[&ground(&rock("5"), SOIL)]),
        of(&[&ground(&rock("12"), SOIL)]),
        of(&[&ground(&rock("20"), PAVEMENT)]),
        axles(&ground("", SOIL)),
        axles(&ground(&rock("12"), SOIL)),
        of(&[reverse, "ends = { upstream = \"fixed\", downstream = \"fixed\" }"]),
        of(&deep),
        of(&[
            "duct = { length = 30, depth = 2 }",
            &ground(&rock("12"), SOIL),
            "friction = { dynamic_coefficient = 0.5, shape_factor = 3.7e6 }",
        ]),
        of(&["friction = { law = \"coulomb\", dynamic_coefficient = 0.25 }"]),
        of(&[
            TRIAXIAL,
            &ground(&rock("8"), PAVEMENT),
            "ends = { upstream = \"free\", downstream = { spring = 3e6 } }",
        ]),
    ]
}

/// The scene on a mesh that is the same whatever the road: twelve nodes a depth; errors of the mesh are no matter here.
fn meshed(mut scene: Scene, passes: u64) -> Scene {
    scene.traffic.passes = passes;
    scene.solver.node_spacing = Some(scene.duct.depth / 12.0);
    scene.solver.vehicle_step = Some(scene.duct.depth / 24.0);
    scene.solver.tolerance = 0.5;
    // Nor is any of the ground left out, however large the tolerance.
    let soil = scene.ground.profile().expect("layers").homogeneous();
    scene.ground.model = soil.map_or(GroundModel::Burmister, |_| GroundModel::Boussinesq);
    scene
}

fn with_approach(scene: &Scene, approach: f64) -> Scene {
    let mut scene = scene.clone();
    scene.solver.approach = Some(approach);
    scene
}

/// Largest difference of a force after `passes`, as a share of the largest of the run.
fn apart(run: &Run, other: &Run, passes: &[u64]) -> f64 {
    let pairs = run.passes.iter().zip(&other.passes);
    let pairs = pairs.filter(|(record, _)| passes.contains(&record.pass));
    let apart = pairs.map(|(a, b)| difference(a, b)).fold(0.0, f64::max);
    let scale = largest(other.passes.iter().flat_map(forces_after));
    if apart == 0.0 { 0.0 } else { apart / scale }
}

fn difference(one: &PassRecord, other: &PassRecord) -> f64 {
    let pairs = forces_after(one).into_iter().zip(forces_after(other));
    largest(pairs.map(|(a, b)| a - b))
}

/// The same as errors are stated, a share of the largest force or tension after that pass, over the passes that leave a fifth
/// of the run's largest force: a smaller one is held against a tenth of what passes through the cable, which no record shows.
fn error(run: &Run, other: &Run) -> f64 {
    let along = |stage: &Stage| largest(stage.force_profile.force_n.iter().copied());
    let scale = |(record, stage)| largest(forces_after(record)).max(along(stage));
    let scales: Vec<f64> = run.passes.iter().zip(&run.stages).map(scale).collect();
    let peaks = |record: &PassRecord| [record.upstream_peak_n, record.downstream_peak_n];
    let peaks = run.passes.iter().flat_map(peaks);
    let most = largest(peaks.chain(scales.iter().copied()));
    let pairs = run.passes.iter().zip(&other.passes).zip(scales);
    let pairs = pairs.filter(|(_, scale)| *scale >= 0.2 * most);
    largest(pairs.map(|((a, b), scale)| difference(a, b) / scale))
}

/// What the plan follows is as good as no end; returns the run without an end, if the mesh is good enough for one.
#[track_caller]
fn followed_far_enough(scene: &Scene, passes: &[u64]) -> Option<Run> {
    let far = answer(&with_approach(scene, FAR));
    let planned = answer(scene);
    assert_eq!(far.is_some(), planned.is_some());
    let (far, planned) = (far?, planned?);
    assert_eq!(planned.error_estimate.parts.road, 0.0);
    let apart = apart(&planned, &far, passes);
    assert!(apart <= ALIKE, "{apart} of the largest force\n{scene:?}");
    Some(far)
}

/// What a short road leaves out is stated, or is too much for an answer; true where there is an answer.
#[track_caller]
fn is_covered(scene: &Scene, far: &Run, approach: f64) -> bool {
    let every: Vec<u64> = (1..=scene.traffic.passes).collect();
    let Some(short) = looked_at(&with_approach(scene, approach), &every) else {
        return false;
    };
    let stated = short.error_estimate.parts.road;
    let found = error(&short, far);
    // The plan's own road stands for the endless one.
    assert!(
        found <= stated + ALIKE,
        "{approach} m: {found} {stated}\n{scene:?}"
    );
    true
}

/// How many of 48 short roads have an answer, after so many passes over each scene.
fn roads(passes: u64, compared: &[u64]) -> usize {
    let mut answered = 0;
    for scene in scenes() {
        let scene = meshed(scene, passes);
        let far = followed_far_enough(&scene, compared).expect("an answer");
        for approach in [3.0, 6.0, 10.0, 15.0] {
            answered += usize::from(is_covered(&scene, &far, approach));
        }
    }
    answered
}

#[test]
fn the_plan_follows_a_vehicle_far_enough_and_a_short_road_that_the_scene_names_is_stated_as_an_error() {
    let answered = roads(8, &[1, 8]);
    assert!(answered >= 24, "{answered} of 48 have an answer");
}

/// Tries random roads; the share of them that have an answer.
fn try_seeds(seeds: std::ops::Range<u64>, passes: u64) -> f64 {
    let (mut answered, count) = (0, seeds.end - seeds.start);
    for seed in seeds {
        let scene = meshed(long_term::random(seed), passes);
        let Some(far) = followed_far_enough(&scene, &[1, passes]) else {
            continue;
        };
        for approach in [3.0, 10.0] {
            is_covered(&scene, &far, approach);
        }
        answered += 1;
    }
    f64::from(answered) / count as f64
}

#[test]
fn so_does_it_on_random_roads() {
    assert!(try_seeds(0..14, 4) > 0.7);
}

/// A road that reaches beyond the outermost turn costs nothing and changes nothing, and nobody has to hear of it.
#[test]
fn a_road_beyond_the_outermost_turn_is_no_error_and_no_news() {
    let short = ["duct = { length = 30, depth = 1.2 }", "traffic = { passes = 5 }"];
    let scene = scene(&[&UPPER, &short]);
    let planned = answer(&scene).expect("an answer");
    let far = answer(&with_approach(&scene, 60.0)).expect("an answer");
    let roads = [&planned, &far].map(|run| run.error_estimate.parts.road);
    assert_eq!(roads, [0.0, 0.0]);
    assert!(apart(&planned, &far, &[1, 5]) <= ALIKE);
    let plan = creepage::plan(&scene).expect("a plan").report();
    let said = [planned.plan.reasons, planned.warnings].concat();
    let said = [said, plan.reasons, plan.warnings].concat().join("\n");
    assert!(!said.contains("approach") && !said.contains("beyond the duct"));
}
