//! Where fine meshes take half as many steps of the vehicle per node spacing as coarse ones, their stated error holds.

use creepage::{Run, Scene};

/// A deep duct beside the lane, whose cable moves far beside its clamps: only the spacing counts.
const HALF: &str = r#"
    duct = { length = 77.2, depth = 1.47, lateral_offset = -3.52, slope = 0.079 }
    ground = { layers = [{ young_modulus = 92e6, poisson_ratio = 0.277 }] }
    cable = { weight = 78.7, axial_stiffness = 3.94e6 }
    friction = { dynamic_coefficient = 0.293, shape_factor = 1.55e6 }
    ends = { upstream = "free", downstream = "fixed" }
    restraints = [{ position = 67.0, stiffness = 5.73e6 }, { position = 43.7, stiffness = 8.9e5 }]
    vehicles = [{ name = "lorry", speed = 13.7, wheels = [{ x = 0, y = 1, load = 1e4 }, { x = -4.2, y = 1, load = 4e4 }] }]
    traffic = { passes = 2 }
    solver = { tolerance = 0.02 }
"#;

/// Runs `text` and asserts that the vehicle takes so many steps per node spacing, and that the forces agree with those on a mesh half as
/// wide, with twice the usual steps, within the stated errors.
fn assert_right(text: &str, steps_per_spacing: f64) {
    let mut scene = Scene::from_toml("scene", text).expect("a valid scene");
    let run = creepage::run(&scene).expect("an answer");
    let spacing = run.plan.node_spacing_m;
    let steps = spacing / run.plan.vehicle_step_m;
    assert!(
        (steps / steps_per_spacing - 1.0).abs() < 0.01,
        "{steps} steps per spacing"
    );
    scene.solver.tolerance = 0.2;
    (scene.solver.node_spacing, scene.solver.vehicle_step) = (Some(0.5 * spacing), Some(0.125 * spacing));
    let finer = creepage::run(&scene).expect("an answer");
    let forces = |run: &Run| {
        run.passes
            .iter()
            .map(|pass| {
                [
                    pass.upstream_force_n,
                    pass.downstream_force_n,
                    pass.max_compression_n,
                ]
            })
            .collect::<Vec<_>>()
    };
    let largest = |forces: &[f64; 3]| forces.iter().fold(0.0_f64, |most, force| most.max(force.abs()));
    let (found, right) = (forces(&run), forces(&finer));
    let floor = 0.1 * right.iter().map(largest).fold(0.0, f64::max);
    for (pass, (found, right)) in found.iter().zip(&right).enumerate() {
        let scale = largest(right).max(floor);
        for (found, right) in found.iter().zip(right) {
            let off = (found - right).abs() / scale;
            assert!(
                off <= run.error_estimate.relative,
                "pass {}: {found} N, {right} N",
                pass + 1
            );
        }
    }
}

#[test]
fn half_as_many_steps_where_they_hardly_matter() {
    assert_right(HALF, 1.0);
}
