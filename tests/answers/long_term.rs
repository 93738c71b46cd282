//! Jumps over passes against the simulation of every pass, on the same mesh: random scenes of every kind.

use creepage::scene::SolverMethod;
use creepage::{Error, PassRecord, RestraintRecord, Run, Scene};
use fastrand::Rng;
use rayon::prelude::*;

use super::common::{forces_after, largest_force, limit};
use crate::scenes::largest;

const TOLERANCE: f64 = 0.01;
/// Nodes a depth: the first with which the mesh is good enough for an answer.
const NODES: [f64; 3] = [6.0, 12.0, 24.0];

/// One to three vehicles, in 70 % of the scenes both ways; clamps, springs, layers, rock; 4 to 300 m; 600 to 3000 passes.
pub fn random(seed: u64) -> Scene {
    let mut rng = Rng::with_seed(seed);
    let mut between = |low: f64, high: f64| low + (high - low) * rng.f64();
    let depth = between(0.6, 2.5);
    let length = 4.0 * 75_f64.powf(between(0.0, 1.0));
    let mut lines = vec![format!("duct = {{ length = {length}, depth = {depth} }}")];
    let (mut base, mut top) = (String::new(), String::new());
    if between(0.0, 1.0) < 0.4 {
        base = format!("rigid_base_depth = {}, ", depth + between(1.0, 12.0));
    }
    if between(0.0, 1.0) < 0.4 {
        let (thickness, modulus) = (between(0.1, 0.5), 10_f64.powf(between(8.5, 9.6)));
        top = format!("{{ thickness = {thickness}, young_modulus = {modulus}, poisson_ratio = 0.35 }}, ");
    }
    let (modulus, poisson) = (10_f64.powf(between(7.7, 9.0)), between(0.2, 0.45));
    lines.push(format!(
        "ground = {{ {base}layers = [{top}{{ young_modulus = {modulus}, poisson_ratio = {poisson} }}] }}"
    ));
    let stiffness = 10_f64.powf(between(6.3, 8.3));
    let (weight, factor) = (between(50.0, 200.0), between(1.0, 1.6));
    lines.push(format!(
        "cable = {{ weight = {weight}, axial_stiffness = {stiffness}, normal_load_factor = {factor} }}"
    ));
    let coefficient = between(0.05, 0.8);
    lines.push(if between(0.0, 1.0) < 0.2 {
        format!("friction = {{ law = \"coulomb\", dynamic_coefficient = {coefficient} }}")
    } else {
        format!(
            "friction = {{ dynamic_coefficient = {coefficient}, shape_factor = {} }}",
            10_f64.powf(between(5.5, 8.0))
        )
    });
    let mut end = || match between(0.0, 3.0) as u8 {
        0 => "\"free\"".to_owned(),
        1 => "\"fixed\"".to_owned(),
        _ => format!("{{ spring = {} }}", 10_f64.powf(between(4.0, 7.0))),
    };
    let ends = [end(), end()];
    lines.push(format!(
        "ends = {{ upstream = {}, downstream = {} }}",
        ends[0], ends[1]
    ));
    let clamped = between(0.0, 1.0) < 0.5;
    let clamps = u8::from(clamped) * between(1.0, 2.99) as u8;
    let mut clamp = |_| {
        let (position, stiffness) = (between(0.0, length), 10_f64.powf(between(4.0, 7.0)));
        format!("{{ position = {position}, stiffness = {stiffness} }}")
    };
    let clamps: Vec<String> = (0..clamps).map(&mut clamp).collect();
    lines.push(format!("restraints = [{}]", clamps.join(", ")));
    let count = between(1.0, 3.99) as u8;
    let two_way = between(0.0, 1.0) < 0.7;
    let vehicle = |number: u8| {
        let back = two_way && (number == 1 || between(0.0, 1.0) < 0.3);
        let direction = if back { "reverse" } else { "forward" };
        let load = if between(0.0, 1.0) < 0.6 {
            format!("load = {}", between(3e4, 2.5e5))
        } else {
            let load = between(1e4, 6e4);
            let wheel = |x: f64, y: f64| format!("{{ x = {x}, y = {y}, load = {load} }}");
            let axle = |x: f64| [wheel(x, 0.9), wheel(x, -0.9)];
            format!("wheels = [{}]", [axle(0.0), axle(-4.0)].concat().join(", "))
        };
        let share = between(1.0, 4.99) as u8;
        format!(
            "{{ name = \"v{number}\", speed = 11.1, {load}, direction = \"{direction}\", share = {share} }}"
        )
    };
    let vehicles: Vec<String> = (0..count).map(vehicle).collect();
    lines.push(format!("vehicles = [{}]", vehicles.join(", ")));
    let passes = between(600.0, 3000.0) as u64;
    lines.push(format!("traffic = {{ passes = {passes} }}"));
    let mut scene = Scene::from_toml("scene", &lines.join("\n")).expect("a valid scene");
    scene.solver.tolerance = TOLERANCE;
    scene
}

/// Largest difference of a force on any listed pass, and on the last: in the cable and on its ends relative to the largest there then, on a
/// clamp to the largest on it; to a tenth of the largest of all, if that is more. The force in the cable changes at a clamp by what that
/// carries, so that on one side it is at least half as large.
pub fn difference(scene: &Scene, every: &Run, jumps: &Run) -> (f64, f64) {
    let on_clamp = |clamp: &RestraintRecord| largest(clamp.after_passes_n.iter().copied());
    let on_ends = every.passes.iter().map(largest_force);
    let floor = 0.1 * largest(on_ends.chain(every.restraints.iter().map(on_clamp)));
    let floor = floor.max(0.01 * limit(scene));
    let of_pass = |(place, found): (usize, &PassRecord)| {
        let same = every.passes.partition_point(|record| record.pass < found.pass);
        assert_eq!(every.passes[same].pass, found.pass);
        let (right, found) = (forces_after(&every.passes[same]), forces_after(found));
        let apart = largest(right.into_iter().zip(found).map(|(right, found)| right - found));
        let beside_clamps = every
            .restraints
            .iter()
            .map(|clamp| 0.5 * clamp.after_passes_n[same]);
        let in_cable = largest(right.into_iter().chain(beside_clamps)).max(floor);
        let clamps = every.restraints.iter().zip(&jumps.restraints);
        let clamps = clamps.map(|(right, found)| {
            let apart = right.after_passes_n[same] - found.after_passes_n[place];
            apart.abs() / on_clamp(right).max(floor)
        });
        clamps.fold(apart / in_cable, f64::max)
    };
    let apart: Vec<f64> = jumps.passes.iter().enumerate().map(of_pass).collect();
    (
        largest(apart.iter().copied()),
        apart.last().copied().unwrap_or_default(),
    )
}

/// What came out of one scene.
struct Found {
    seed: u64,
    worst: f64,
    last: f64,
    stated: f64,
}

/// The passes of a scene on a mesh of so many nodes a depth.
fn by(method: SolverMethod, nodes: f64, scene: &Scene) -> Result<Run, Error> {
    let mut scene = scene.clone();
    let spacing = (scene.duct.depth / nodes).min(scene.duct.length / 8.0);
    (scene.solver.node_spacing, scene.solver.vehicle_step) = (Some(spacing), Some(0.5 * spacing));
    scene.solver.method = method;
    creepage::run(&scene)
}

/// `None` if no mesh here is good enough, jumps or not.
fn compare(seed: u64) -> Option<Found> {
    let scene = random(seed);
    for nodes in NODES {
        let jumps = match by(SolverMethod::PassLaw, nodes, &scene) {
            Err(Error::Inaccurate { .. }) => continue,
            jumps => jumps.unwrap_or_else(|error| panic!("scene {seed}: {error}")),
        };
        let every = match by(SolverMethod::QuasiStatic, nodes, &scene) {
            Err(Error::Inaccurate { .. }) => continue,
            every => every.unwrap_or_else(|error| panic!("scene {seed}: {error}")),
        };
        let (worst, last) = difference(&scene, &every, &jumps);
        let stated = jumps.error_estimate.relative;
        let percent = [worst, last, stated, jumps.error_estimate.parts.passes].map(|share| 100.0 * share);
        let [simulated, passes] = [jumps.cost.simulated_passes, scene.traffic.passes];
        println!("{seed}: {simulated} of {passes}; worst, last, stated, passes: {percent:.3?} %");
        return Some(Found {
            seed,
            worst,
            last,
            stated,
        });
    }
    None
}

/// Forces within the tolerance on every listed pass in 97 of 100 scenes, on the last in all, and the stated error above the true one in
/// 95 of 100.
fn assert_right(seeds: Vec<u64>) {
    let count = seeds.len();
    let found: Vec<Found> = seeds.into_par_iter().filter_map(compare).collect();
    let share =
        |good: &dyn Fn(&&Found) -> bool| found.iter().filter(good).count() as f64 / found.len() as f64;
    let bad = found.iter().filter(|f| f.worst > TOLERANCE.min(f.stated));
    let bad: Vec<u64> = bad.map(|f| f.seed).collect();
    println!("{} of {count} scenes compared; not within: {bad:?}", found.len());
    assert!(20 * found.len() >= 17 * count, "few meshes were good enough");
    assert!(share(&|f| f.worst <= TOLERANCE) >= 0.97, "{bad:?}");
    assert!(share(&|f| f.last <= TOLERANCE) >= 1.0, "{bad:?}");
    assert!(share(&|f| f.worst <= f.stated) >= 0.95, "{bad:?}");
}

/// Hardly any friction, and nothing that holds the cable: each pass moves it as a whole, as far as the one before. What rounding makes of
/// its friction tells nothing about the next passes.
#[test]
fn a_cable_that_moves_as_a_whole_goes_on_evenly() {
    let scene = |passes: u64, method: &str| {
        let text = format!(
            "
            duct = {{ length = 5, depth = 1.9 }}
            ground = {{ layers = [{{ young_modulus = 3e8, poisson_ratio = 0.4 }}] }}
            cable = {{ weight = 0.5, axial_stiffness = 2.4e6 }}
            friction = {{ law = 'coulomb', dynamic_coefficient = 2e-4 }}
            ends = {{ upstream = 'free', downstream = 'free' }}
            vehicles = [
                {{ name = 'there', speed = 11, load = 3.5e4, share = 2 }},
                {{ name = 'back', speed = 6, load = 1.6e4, direction = 'reverse', share = 3 }},
            ]
            traffic = {{ passes = {passes} }}
            solver = {{ tolerance = 0.075, method = '{method}' }}"
        );
        Scene::from_toml("scene", &text).expect("a valid scene")
    };
    let movement = |passes: u64, method| {
        let run = creepage::run(&scene(passes, method)).expect("an answer");
        run.passes.last().expect("a pass").downstream_displacement_m / passes as f64
    };
    let every = movement(1000, "quasi-static");
    for passes in [7400, 100_000, 3_000_000] {
        let jumped = movement(passes, "auto");
        assert!((jumped / every - 1.0).abs() < 5e-3, "{passes}: {jumped} {every}");
    }
}

/// Every run with jumps begins with the shortest, which would put a force off by 1.4 %: one that begins later shows it.
#[test]
fn the_first_jump_is_measured_where_it_is_the_shortest() {
    let mut scene = random(35);
    scene.traffic.passes = 100;
    let methods = [SolverMethod::QuasiStatic, SolverMethod::PassLaw];
    let [every, jumps] = methods.map(|method| by(method, NODES[0], &scene).expect("an answer"));
    assert!(jumps.cost.simulated_passes < 90, "{:?}", jumps.cost);
    let (worst, last) = difference(&scene, &every, &jumps);
    assert!(worst.max(last) < 0.5 * TOLERANCE, "{worst} {last}");
}

/// A tenth of the scenes: those in which every pass is simulated soonest; and two that jumps once got wrong. In 1031 the first jump after
/// the passes simulated at the start was held to nothing; in 1077 a jump to the end left 1.5 % in the last pass.
#[test]
#[ignore = "ten seconds: .ci/run runs it"]
fn jumps_agree_with_every_pass() {
    assert_right(vec![3, 5, 6, 7, 8, 15, 16, 19, 20, 33, 1031, 1077]);
}

#[test]
#[ignore = "120 random scenes, every pass simulated: ten minutes; FIRST chooses other seeds"]
fn many_scenes_with_jumps_are_those_of_every_pass() {
    let first = std::env::var("FIRST").map_or(0, |text| text.parse().expect("a seed"));
    assert_right((first..first + 120).collect());
}
