//! Many kinds of vehicles: shares that are whole numbers of up to 48 vehicles have a period of their own.

use creepage::Scene;

use super::common::staged;
use super::long_term::difference;

/// Nine kinds of very different loads, two of three one way: a round takes 17 vehicles.
fn scene() -> Scene {
    let forward = [(2, 3), (6, 2), (9, 1), (15, 1), (18, 2)].map(|kind| (kind, "forward"));
    let reverse = [(4, 2), (12, 3), (22, 1)].map(|kind| (kind, "reverse"));
    let others = forward.iter().chain(&reverse).map(|((load, share), direction)| {
        format!(
            ", {{ name = \"{load}\", load = \"{load} tf\", speed = \"40 km/h\", share = {share}, direction = \"{direction}\" }}"
        )
    });
    let others: String = others.collect();
    let text = format!(
        "duct = {{ length = 8, depth = 1.2 }}
ground = {{ layers = [{{ young_modulus = 5e7, poisson_ratio = 0.35 }}] }}
cable = {{ weight = 100, axial_stiffness = 8e6 }}
friction = {{ dynamic_coefficient = 0.3, shape_factor = 1e7 }}
ends = {{ upstream = \"free\", downstream = \"fixed\" }}
vehicles = [{{ name = \"first\", load = \"25 tf\", speed = \"30 km/h\", share = 2 }}{others}]
traffic = {{ passes = 1020 }}
solver = {{ tolerance = 0.01 }}"
    );
    Scene::from_toml("mix", &text).expect("a valid scene")
}

#[test]
fn whole_shares_of_many_kinds_leave_nothing_to_a_mix_that_stands_in() {
    let mut scene = scene();
    let spacing = scene.duct.depth / 6.0;
    (scene.solver.node_spacing, scene.solver.vehicle_step) = (Some(spacing), Some(0.5 * spacing));
    let mut run = |method| {
        scene.solver.method = method;
        creepage::run(&scene).expect("an answer")
    };
    let jumps = run(creepage::scene::SolverMethod::PassLaw);
    let every = run(creepage::scene::SolverMethod::QuasiStatic);
    assert!(jumps.cost.simulated_passes < 600, "{:?}", jumps.cost);
    let (worst, last) = difference(&scene, &every, &jumps);
    assert!(worst.max(last) < 0.01, "{worst} {last}");
    let stated = jumps.error_estimate.parts.passes;
    assert!(stated < 0.01, "{stated}");
}

#[test]
fn stages_are_looked_at_where_another_mix_stands_in() {
    let text = "duct = { length = 20, depth = 1.2 }
ground = { layers = [{ young_modulus = 8e8, poisson_ratio = 0.35 }] }
cable = { weight = 100, axial_stiffness = 8e6 }
friction = { dynamic_coefficient = 0.3, shape_factor = 1e7 }
ends = { upstream = \"free\", downstream = \"fixed\" }
vehicles = [
  { name = \"heavy\", load = \"20 tf\", speed = \"30 km/h\", share = 0.41 },
  { name = \"light\", load = \"8 tf\", speed = \"30 km/h\", share = 0.59 },
]
traffic = { passes = 4000 }
solver = { node_spacing = 0.2, method = \"pass-law\" }";
    let scene = Scene::from_toml("mix", text).expect("a valid scene");
    let stages: Vec<u64> = (1..200).map(|step| 20 * step - 1).collect();
    let run = staged(&scene, &stages);
    let found: Vec<u64> = run.stages.iter().map(|stage| stage.pass).collect();
    assert_eq!(found, stages);
    assert!(run.cost.simulated_passes < 1000, "{:?}", run.cost);
}
