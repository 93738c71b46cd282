//! How far out a vehicle is followed: far enough by itself, and with an error that covers where the scene says less.

use creepage::scene::GroundModel;
use creepage::{PassRecord, Run, Scene, Stage};

use super::common::{LOWER_AXLES, UPPER, answer, looked_at, scene};
use super::long_term;

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
    scene.ground.model = if scene.ground.profile().expect("layers").homogeneous().is_some() {
        GroundModel::Boussinesq
    } else {
        GroundModel::Burmister
    };
    scene
}

fn with_approach(scene: &Scene, approach: f64) -> Scene {
    let mut scene = scene.clone();
    scene.solver.approach = Some(approach);
    scene
}

fn forces(record: &PassRecord) -> [f64; 3] {
    [
        record.upstream_force_n,
        record.downstream_force_n,
        record.max_compression_n,
    ]
}

fn largest<'a>(records: impl IntoIterator<Item = &'a PassRecord>) -> f64 {
    records
        .into_iter()
        .flat_map(forces)
        .fold(0.0, |most, force| most.max(force.abs()))
}

/// Largest difference of a force after `passes`, as a share of the largest of the run.
fn apart(run: &Run, other: &Run, passes: &[u64]) -> f64 {
    let scale = largest(&other.passes);
    let pairs = run
        .passes
        .iter()
        .zip(&other.passes)
        .filter(|(record, _)| passes.contains(&record.pass));
    pairs
        .flat_map(|(a, b)| forces(a).into_iter().zip(forces(b)))
        .map(|(a, b)| (a - b).abs() / scale)
        .fold(0.0, f64::max)
}

/// The same as errors are stated, a share of the largest force or tension after that pass, over the passes that leave a fifth
/// of the run's largest force: a smaller one is held against a tenth of what passes through the cable, which no record shows.
fn error(run: &Run, other: &Run) -> f64 {
    let along = |stage: &Stage| {
        let forces = stage.force_profile.force_n.iter();
        forces.fold(0.0, |most: f64, force| most.max(force.abs()))
    };
    let scale = |(record, stage): (&PassRecord, &Stage)| largest([record]).max(along(stage));
    let scales: Vec<f64> = run.passes.iter().zip(&run.stages).map(scale).collect();
    let peaks = run
        .passes
        .iter()
        .flat_map(|record| [record.upstream_peak_n, record.downstream_peak_n]);
    let most = peaks
        .chain(scales.iter().copied())
        .fold(0.0, |most: f64, force| most.max(force.abs()));
    let pairs = run.passes.iter().zip(&other.passes).zip(scales);
    pairs
        .filter(|(_, scale)| *scale >= 0.2 * most)
        .flat_map(|((a, b), scale)| {
            forces(a)
                .into_iter()
                .zip(forces(b))
                .map(move |(a, b)| (a - b).abs() / scale)
        })
        .fold(0.0, f64::max)
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
        "{approach} m: {found}, stated {stated}\n{scene:?}"
    );
    true
}

#[test]
fn the_plan_follows_a_vehicle_far_enough() {
    for scene in scenes() {
        followed_far_enough(&meshed(scene, 20), &[1, 10, 20]).expect("an answer");
    }
}

#[test]
#[ignore = "two hundred passes of twelve scenes: a minute"]
fn the_plan_follows_a_vehicle_far_enough_for_two_hundred_passes() {
    for scene in scenes() {
        let scene = meshed(scene, 200);
        let far = followed_far_enough(&scene, &[1, 10, 200]).expect("an answer");
        for approach in [3.0, 6.0, 10.0, 15.0] {
            is_covered(&scene, &far, approach);
        }
    }
}

#[test]
fn a_short_road_that_the_scene_names_is_stated_as_an_error() {
    let mut answered = 0;
    for scene in scenes() {
        let scene = meshed(scene, 8);
        let far = answer(&with_approach(&scene, FAR)).expect("an answer");
        for approach in [3.0, 6.0, 10.0, 15.0] {
            answered += usize::from(is_covered(&scene, &far, approach));
        }
    }
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
    assert!(try_seeds(0..24, 4) > 0.7);
}

#[test]
#[ignore = "two hundred random roads: minutes"]
fn so_does_it_on_very_many_random_roads() {
    assert!(try_seeds(100..300, 12) > 0.7);
}

/// A road that reaches beyond the outermost turn costs nothing and changes nothing, and nobody has to hear of it.
#[test]
fn a_road_beyond_the_outermost_turn_is_no_error_and_no_news() {
    let scene = scene(&[
        &UPPER,
        &["duct = { length = 30, depth = 1.2 }", "traffic = { passes = 5 }"],
    ]);
    let planned = answer(&scene).expect("an answer");
    let far = answer(&with_approach(&scene, 60.0)).expect("an answer");
    assert_eq!(
        (planned.error_estimate.parts.road, far.error_estimate.parts.road),
        (0.0, 0.0)
    );
    assert!(apart(&planned, &far, &[1, 5]) <= ALIKE);
    let plan = creepage::plan(&scene).expect("a plan").report();
    let said = planned
        .plan
        .reasons
        .iter()
        .chain(&planned.warnings)
        .chain(&plan.reasons)
        .chain(&plan.warnings);
    for line in said {
        assert!(
            !line.contains("approach") && !line.contains("beyond the duct"),
            "{line}"
        );
    }
}
