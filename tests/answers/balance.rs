//! However many passes, whatever the method: no force that friction cannot carry, or an error that names a way out.

use creepage::Scene;
use creepage::scene::{Law, SolverMethod};

use super::common::{UPPER, answer, by, limit, scene, upper};
use crate::scenes::{assert_near, forces, largest, last};

/// A million passes by the automatic choice and by the law, six hundred also by the law.
fn many(scene: &Scene) {
    for (passes, method) in [
        (1_000_000, SolverMethod::Auto),
        (1_000_000, SolverMethod::PassLaw),
        (600, SolverMethod::PassLaw),
    ] {
        let mut scene = by(scene, method);
        (scene.traffic.passes, scene.solver.tolerance) = (passes, 0.03);
        answer(&scene);
    }
}

/// A heavy cable under a light vehicle follows its duct; what six hundred passes leave is the first ones' 18.8 N.
#[test]
fn a_cable_that_follows_its_duct_is_dragged_by_nothing() {
    let scene = upper(&[
        "cable = { weight = 108.8, axial_stiffness = 8.01e6, normal_load_factor = 1.5 }",
        "friction = { dynamic_coefficient = 1, shape_factor = 1225490.2 }",
        "vehicles = [{ speed = \"40 km/h\", load = \"5 tf\" }]",
    ]);
    many(&scene);
    let mut every = by(&scene, SolverMethod::QuasiStatic);
    every.traffic.passes = 20;
    every.solver.tolerance = 0.05;
    let simulated = answer(&every).expect("an answer").passes[19].downstream_force_n;
    let mut many = scene;
    many.traffic.passes = 1_000_000;
    if let Some(run) = answer(&many) {
        assert_near(last(&run).downstream_force_n, simulated, 0.15, "N");
    }
}

#[test]
fn a_soft_sheath_traffic_in_two_directions_clamps_and_springs_are_carried_by_friction() {
    let soft = "friction = { dynamic_coefficient = 0.25, shape_factor = 1e5 }";
    let springs = "ends = { upstream = { spring = 1e4 }, downstream = { spring = 1e4 } }";
    let both_ways = "vehicles = [{ name = \"a\", speed = \"40 km/h\", load = \"20 tf\" }, \
                     { name = \"b\", speed = \"40 km/h\", load = \"12 tf\", direction = \"reverse\" }]";
    for line in [soft, springs, both_ways] {
        many(&upper(&[line]));
    }
    let mut clamped = upper(&[
        "ends = { upstream = \"free\", downstream = \"free\" }",
        "restraints = [{ position = 59, stiffness = 1e7 }]",
    ]);
    clamped.traffic.passes = 600;
    answer(&by(&clamped, SolverMethod::PassLaw));
}

/// Neither a pass nor a million, neither a law nor a solver drags a cable without friction, clamps and springs or not.
#[test]
fn without_friction_nothing_is_dragged() {
    let ducts: [&[&str]; 4] = [
        &[],
        &["restraints = [{ position = 60, stiffness = 4e12 }]"],
        &[
            "duct = { length = 2000, depth = 0.75, lateral_offset = -0.24 }",
            "cable = { weight = 0.001, axial_stiffness = 5e6 }",
            "ends = { upstream = { spring = 2.9e5 }, downstream = \"fixed\" }",
        ],
        &["ends = { upstream = { spring = 1e6 }, downstream = \"free\" }"],
    ];
    let smooth = "friction = { dynamic_coefficient = 0, shape_factor = 7352941.0 }";
    for duct in ducts {
        for (passes, method) in [
            (5, SolverMethod::Auto),
            (100_000, SolverMethod::Auto),
            (1_000_000_000_000, SolverMethod::Auto),
            (200, SolverMethod::PassLaw),
            (200, SolverMethod::QuasiStatic),
        ] {
            for coulomb in [false, true] {
                let mut scene = by(&scene(&[&UPPER, duct, &[smooth]]), method);
                if coulomb {
                    (scene.friction.law, scene.friction.shape_factor) = (Law::Coulomb, None);
                }
                scene.traffic.passes = passes;
                let run = answer(&scene).expect("nothing is an answer");
                for record in &run.passes {
                    assert_eq!((record.downstream_force_n, record.upstream_force_n), (0.0, 0.0));
                    assert_eq!(record.downstream_displacement_m, 0.0);
                }
                assert_eq!(run.saturation, None);
                assert_eq!(run.error_estimate.relative, 0.0);
            }
        }
    }
}

/// Friction that is next to nothing drags next to nothing, and takes no minutes to say so.
#[test]
fn hardly_any_friction_carries_hardly_any_force() {
    for coefficient in [1e-9, 1e-5, 0.003] {
        for (passes, method) in [(100_000, SolverMethod::Auto), (200, SolverMethod::PassLaw)] {
            let mut scene = by(&upper(&[]), method);
            scene.friction.dynamic_coefficient = coefficient;
            scene.solver.tolerance = 0.1;
            scene.traffic.passes = passes;
            if let Some(run) = answer(&scene) {
                let most = 1.01 * limit(&scene) * scene.duct.length;
                assert!(largest(forces(&run)) <= most);
            }
        }
    }
}
