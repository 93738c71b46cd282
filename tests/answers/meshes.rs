//! Two meshes that agree by chance are no proof: what a run states covers its distance from a far finer one.

use creepage::scene::{GroundModel, SolverMethod};
use creepage::{PassRecord, Run, Scene};

use super::common::{answer, assert_within, forces_after, is_told, scene, upper};
use crate::scenes::largest;

/// A short duct over shallow rock, one pass of three axles: friction turns within the length of an element.
const SHORT: [&str; 8] = [
    "duct = { length = 8.8, depth = 2.09, lateral_offset = 1.0 }",
    "ground = { rigid_base_depth = 3.52, layers = [{ young_modulus = \"199 MPa\", poisson_ratio = 0.46 }] }",
    "cable = { weight = 251.7, axial_stiffness = 7.17135e6, normal_load_factor = 1.5 }",
    "friction = { dynamic_coefficient = 0.835, shape_factor = 2.97343e8 }",
    "ends = { upstream = { spring = 6.996e4 }, downstream = \"fixed\" }",
    "vehicles = [{ speed = \"40 km/h\", wheels = [\
     { x = 0, y = -0.9, load = \"22.8 kN\", contact_radius = 0.25 }, { x = -1.3, y = 0.9, load = \"73.5 kN\", contact_radius = 0.25 }, \
     { x = -3.6, y = -0.9, load = \"12.1 kN\", contact_radius = 0.25 }, { x = 0, y = 0.9, load = \"41.1 kN\", contact_radius = 0.15 }, \
     { x = -1.3, y = -0.9, load = \"13.9 kN\", contact_radius = 0.25 }, { x = -3.6, y = 0.9, load = \"20.7 kN\" }] }]",
    "traffic = { passes = 1 }",
    "solver = { method = \"quasi-static\" }",
];

/// The scene with 384 nodes a depth on the exact ground.
fn far_finer(scene: &Scene) -> Run {
    let mut scene = scene.clone();
    scene.ground.model = GroundModel::Burmister;
    scene.solver.method = SolverMethod::QuasiStatic;
    scene.solver.node_spacing = Some(scene.duct.depth / 384.0);
    scene.solver.vehicle_step = Some(scene.duct.depth / 768.0);
    creepage::run(&scene).expect("a reference")
}

/// Largest differences of a force, as a share of the largest after that pass, and of a movement, as a share of the largest of all.
fn off(run: &Run, exact: &Run) -> (f64, f64) {
    let movements = |r: &PassRecord| [r.upstream_displacement_m, r.downstream_displacement_m];
    let moved = largest(exact.passes.iter().flat_map(movements));
    let (mut force, mut movement) = (0.0_f64, 0.0_f64);
    for (a, b) in run.passes.iter().zip(&exact.passes) {
        let forces = forces_after(a).into_iter().zip(forces_after(b));
        let off = largest(forces.map(|(a, b)| a - b)) / largest(forces_after(b));
        force = force.max(off);
        let movements = movements(a).into_iter().zip(movements(b));
        movement = movement.max(largest(movements.map(|(a, b)| a - b)) / moved);
    }
    (force, movement)
}

#[track_caller]
fn assert_covered(scene: &Scene, exact: &Run, tolerance: f64) {
    let mut scene = scene.clone();
    scene.solver.tolerance = tolerance;
    let Some(run) = answer(&scene) else { return };
    let (force, movement) = off(&run, exact);
    let stated = &run.error_estimate;
    // What leaving out inertia costs no run without it can show.
    let of_force = stated.relative - stated.parts.inertia;
    assert!(force <= of_force, "{force} {tolerance} {stated:?}");
    assert!(movement <= stated.parts.movement, "{movement} {stated:?}");
    let within = stated.relative.max(stated.parts.movement) <= tolerance;
    assert_eq!(within, !is_told(&run, "above the tolerance"), "{stated:?}");
}

/// The same with other lengths, of which each puts the nodes elsewhere.
#[test]
fn a_short_duct_over_shallow_rock_is_within_what_is_stated() {
    for (length, tolerances) in [
        (8.8, &[0.1, 0.05, 0.02, 0.01, 0.005][..]),
        (8.5, &[0.05, 0.01]),
        (9.1, &[0.05, 0.01]),
        (9.7, &[0.05, 0.01]),
    ] {
        let mut scene = scene(&[&SHORT]);
        scene.duct.length = length;
        let exact = far_finer(&scene);
        for tolerance in tolerances {
            assert_covered(&scene, &exact, *tolerance);
        }
    }
}

/// A mesh that knows nothing of the duct's motion is refused as bad input, one as coarse as it may be is measured.
#[test]
fn a_mesh_that_the_scene_names_is_fine_enough_or_bad_input() {
    let named = |spacing: f64| {
        let mut scene = upper(&["traffic = { passes = 2 }"]);
        scene.solver.node_spacing = Some(spacing);
        scene.solver.tolerance = 0.5;
        creepage::run(&scene)
    };
    let depth = 1.2;
    assert!(named(depth / 3.0).is_ok());
    for spacing in [0.9 * depth, 2.0 * depth, 5.0 * depth] {
        let error = named(spacing).expect_err("a mesh that knows nothing of the duct");
        assert!(error.is_bad_input() && error.to_string().contains("elements or steps"));
    }
}

/// The meshes beneath a named one tell its error, and what a simpler ground leaves out: those that know nothing of the duct are passed
/// over.
#[test]
fn a_named_mesh_of_few_nodes_a_depth_is_answered_on_layers_too() {
    let mut scene = upper(&[
        "traffic = { passes = 40 }",
        "ground = { rigid_base_depth = 12.0, layers = [{ thickness = 0.05, young_modulus = 4e9, poisson_ratio = 0.35 }, \
         { young_modulus = 8e8, poisson_ratio = 0.4 }] }",
    ]);
    scene.solver.node_spacing = Some(1.2 / 6.0);
    scene.solver.tolerance = 0.05;
    let stated = creepage::run(&scene).expect("an answer").error_estimate;
    assert!(stated.relative < 0.1, "{stated:?}");
}

/// If nothing creeps the ends slip on a centimetre of cable, less than meshes resolve: forces of a fraction of a newton are answered all
/// the same, with the error that they have.
#[test]
fn forces_too_small_to_matter_are_answered_with_a_large_error() {
    let scene = upper(&[
        "duct = { length = 3.0, depth = 1.2 }",
        "ground = { vertical_peak = 0.2e-6, layers = [{ young_modulus = 8e8, poisson_ratio = 0.4 }] }",
        "friction = { law = \"coulomb\", dynamic_coefficient = 0.25 }",
        "ends = { upstream = \"free\", downstream = \"free\" }",
        "traffic = { passes = 3 }",
    ]);
    let named = |spacing: f64| {
        let mut scene = scene.clone();
        scene.solver.node_spacing = Some(spacing);
        answer(&scene).expect("an answer")
    };
    let exact = named(0.001);
    for spacing in [0.02, 0.005] {
        let run = named(spacing);
        let stated = run.error_estimate.relative;
        assert!(stated > 0.3, "{spacing} m: {stated}");
        assert!(is_told(&run, "so small"));
        // A share of what friction holds on a centimetre.
        let scale = 0.01 * scene.friction_limit();
        for (found, exact) in run.passes.iter().zip(&exact.passes) {
            let (found, exact) = (found.max_compression_n, exact.max_compression_n);
            assert_within(found, exact, stated * scale, spacing);
        }
    }
}
