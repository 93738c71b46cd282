//! Where fine meshes take half as many steps of the vehicle per node spacing as coarse ones, their stated error holds.

use creepage::Scene;

use crate::answers::long_term;

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

#[test]
fn half_as_many_steps_where_they_hardly_matter() {
    let mut scene = Scene::from_toml("scene", HALF).expect("a valid scene");
    let run = creepage::run(&scene).expect("an answer");
    let spacing = run.plan.node_spacing_m;
    let steps = spacing / run.plan.vehicle_step_m;
    assert!((steps - 1.0).abs() < 0.01, "{steps} steps per spacing");
    // On a mesh half as wide, with twice the usual steps.
    scene.solver.tolerance = 0.2;
    (scene.solver.node_spacing, scene.solver.vehicle_step) = (Some(0.5 * spacing), Some(0.125 * spacing));
    let finer = creepage::run(&scene).expect("an answer");
    let (worst, _) = long_term::difference(&scene, &finer, &run);
    let stated = run.error_estimate.relative;
    assert!(worst <= stated, "{worst}, stated {stated}");
}
