//! Hostile parameters: a right answer or a typed error, never a panic and never a doubtful number.

use boussinesq::HalfSpace;
use cable_dem::{CableError, CableState, End, Mesh, Passage, Restraint};
use ground_field::{Direction, DuctLine, DuctMotion, Soil, Vehicle};

use super::full_newton::{FullChain, even_positions};
use super::scenes::{
    APPROACH, AXIAL_STIFFNESS, LIMITS, Run, cable, coulomb, elastic_plastic, largest_difference,
    reference_cable, reference_motion, unjudged_passage,
};

/// Friction and equilibrium hold to this share of the friction limit, where rounding does not set a wider bound.
const ACCURACY: f64 = 1e-6;

/// What rounding of the elastic forces may leave, as a share of the friction limit.
fn rounding(run: &Run) -> f64 {
    let (cable, mesh) = (run.solver.cable(), run.solver.mesh());
    let largest = run
        .state
        .displacement()
        .iter()
        .fold(1e-4, |m: f64, u| m.max(u.abs()));
    64.0 * f64::EPSILON * cable.axial_stiffness() / mesh.spacing().powi(2) * largest
        / cable.friction().limit()
}

/// Drives a truck over the cable: either every pass leaves an equilibrium within the friction bounds, or an error leaves
/// the state as it was. Whether all passes succeeded.
fn survives(run: &mut Run, passage: &Passage, passes: usize) -> bool {
    for _ in 0..passes {
        let before = run.state.clone();
        match run.try_pass(passage) {
            Ok(outcome) => {
                let allowed = ACCURACY + rounding(run);
                assert!(run.utilisation() <= 1.0 + ACCURACY, "{}", run.utilisation());
                assert!(
                    run.imbalance() <= 2.0 * allowed,
                    "{} of {allowed} in {:?} on {:?}",
                    run.imbalance(),
                    run.solver.cable(),
                    run.solver.mesh()
                );
                assert!(outcome.force.upstream.is_finite() && outcome.force.downstream.is_finite());
                assert!(outcome.peak.downstream >= outcome.force.downstream);
                assert!(outcome.lowest.downstream <= outcome.force.downstream);
            }
            Err(CableError::Precision { share, .. }) => {
                assert!(share > 1e-3);
                assert_eq!(run.state, before);
                return false;
            }
            Err(error) => panic!("{error} in {:?} on {:?}", run.solver.cable(), run.solver.mesh()),
        }
    }
    true
}

#[test]
fn every_shape_factor_gives_the_oracles_answer() {
    let motion = reference_motion();
    let mesh = Mesh::new(15.0, 0.2, 0.1).expect("a valid mesh");
    for limit in LIMITS {
        for (upstream, downstream) in [(End::Free, End::Fixed), (End::Spring(1e6), End::Free)] {
            let mut forces = Vec::new();
            for exponent in 3..=14 {
                let friction = elastic_plastic(10.0_f64.powi(exponent), limit);
                let cable = cable(15.0, AXIAL_STIFFNESS, friction, upstream, downstream);
                let passage = Passage::new(&cable, &mesh, &motion, APPROACH).expect("a valid passage");
                let mut run = Run::new(cable.clone(), mesh);
                assert!(survives(&mut run, &passage, 3));
                let force = |u: &[f64]| -> Vec<f64> {
                    u.windows(2)
                        .map(|pair| AXIAL_STIFFNESS / mesh.spacing() * (pair[0] - pair[1]))
                        .collect()
                };
                let found = force(run.state.displacement());
                // Beyond, Newton's method is lost.
                if exponent <= 10 {
                    let mut oracle = FullChain::new(&cable, &mesh);
                    let positions = even_positions(&mesh, Direction::Forward, APPROACH);
                    for _ in 0..3 {
                        oracle.pass(&positions, |xi| motion.longitudinal(xi));
                    }
                    let difference = largest_difference(&found, &force(&oracle.displacement));
                    assert!(
                        difference < 2e-4 * limit * 15.0,
                        "b = 1e{exponent}: {difference} N"
                    );
                }
                forces.push(found);
            }
            // b → ∞ is Coulomb's law: the sheath's slip of 2/b is nothing beside the duct's 15 µm.
            let cable = cable(15.0, AXIAL_STIFFNESS, coulomb(limit), upstream, downstream);
            let passage = Passage::new(&cable, &mesh, &motion, APPROACH).expect("a valid passage");
            let mut run = Run::new(cable.clone(), mesh);
            assert!(survives(&mut run, &passage, 3));
            let rigid: Vec<f64> = run
                .state
                .element_forces(&cable)
                .expect("the state's mesh")
                .collect();
            for forces in &forces[8..] {
                assert!(largest_difference(&rigid, forces) < 1e-3 * limit * 15.0);
            }
        }
    }
}

#[test]
fn every_axial_stiffness_is_solved_or_refused() {
    let motion = reference_motion();
    for friction in [
        coulomb(LIMITS[0]),
        elastic_plastic(7e6, LIMITS[0]),
        elastic_plastic(1e11, LIMITS[0]),
    ] {
        let mesh = Mesh::new(12.0, 0.2, 0.1).expect("a valid mesh");
        let solved = (3..=20)
            .filter(|&exponent| {
                let cable = cable(12.0, 10.0_f64.powi(exponent), friction, End::Free, End::Fixed);
                let passage = Passage::new(&cable, &mesh, &motion, APPROACH).expect("a valid passage");
                survives(&mut Run::new(cable, mesh), &passage, 3)
            })
            .count();
        // 1e3 to 1e12 N without loss of precision; far above it rounding is refused.
        assert!((10..18).contains(&solved), "{solved}");
    }
}

#[test]
fn every_spacing_is_solved_or_refused() {
    let motion = reference_motion();
    for friction in [coulomb(LIMITS[0]), elastic_plastic(7e6, LIMITS[0])] {
        for (length, spacing, step) in [
            (0.25, 1e-3, 1e-3),
            (0.25, 1e-3, 0.05),
            (2.0, 0.01, 0.003),
            (30.0, 1.0, 0.1),
            (30.0, 5.0, 5.0),
            (30.0, 5.0, 0.05),
            (30.0, 0.1, 7.0),
            (30.0, 15.0, 100.0),
        ] {
            let cable = reference_cable(length, friction);
            let mesh = Mesh::new(length, spacing, step).expect("a valid mesh");
            let passage = unjudged_passage(&cable, &mesh, &motion);

            assert!(
                survives(&mut Run::new(cable, mesh), &passage, 3),
                "{spacing} m, {step} m"
            );
        }
    }
}

#[test]
fn every_spring_and_clamp_is_solved() {
    let motion = reference_motion();
    let mesh = Mesh::new(12.0, 0.2, 0.1).expect("a valid mesh");
    for friction in [coulomb(LIMITS[1]), elastic_plastic(4.5e6, LIMITS[1])] {
        let run_with = |upstream: End, downstream: End, clamps: Vec<Restraint>| {
            let cable = cable(12.0, AXIAL_STIFFNESS, friction, upstream, downstream)
                .with_restraints(clamps)
                .expect("valid clamps");
            let passage = Passage::new(&cable, &mesh, &motion, APPROACH).expect("a valid passage");
            let mut run = Run::new(cable.clone(), mesh);
            assert!(survives(&mut run, &passage, 5));
            run.state.end_forces(&cable).expect("the state's mesh").downstream
        };
        let fixed = run_with(End::Free, End::Fixed, Vec::new());
        let mut last = 0.0;
        for exponent in 0..=12 {
            let stiffness = 10.0_f64.powi(exponent);
            let force = run_with(End::Free, End::Spring(stiffness), Vec::new());
            // Not monotone in the stiffness: a reading includes the end node's own friction, of either sign.
            assert!(force > 0.0 && force < LIMITS[1] * 12.0);
            last = force;
            for position in [0.0, 0.05, 6.0, 6.1, 12.0] {
                let clamp = Restraint::new(position, stiffness);
                run_with(End::Free, End::Fixed, vec![clamp]);
                run_with(End::Spring(stiffness), End::Free, vec![clamp, clamp]);
            }
        }
        // On a spring, however stiff, Coulomb friction on the last half element turns over with the least slip; on a fixed
        // end, where the slip is known, it does so bit by bit.
        let turning = if friction.compliance() == 0.0 {
            LIMITS[1] * mesh.spacing()
        } else {
            0.0
        };
        assert!(
            (last - fixed).abs() < 1e-3 * fixed + turning,
            "the stiffest, {last} N, is as good as fixed, {fixed} N"
        );
    }
}

#[test]
fn three_nodes_are_enough() {
    let motion = reference_motion();
    let ends = [End::Free, End::Fixed, End::Spring(1e6)];
    for (upstream, downstream) in ends.iter().flat_map(|&a| ends.map(|b| (a, b))) {
        for friction in [
            coulomb(27.2),
            elastic_plastic(7e6, 27.2),
            elastic_plastic(1e3, 27.2),
        ] {
            let cable = cable(2.0, AXIAL_STIFFNESS, friction, upstream, downstream);
            let mesh = Mesh::new(2.0, 1.0, 0.05).expect("a valid mesh");
            assert_eq!(mesh.nodes(), 3);
            let passage = unjudged_passage(&cable, &mesh, &motion);
            assert!(survives(&mut Run::new(cable, mesh), &passage, 20));
        }
    }
}

#[test]
fn without_friction_nothing_pulls() {
    let motion = reference_motion();
    let mesh = Mesh::new(12.0, 0.2, 0.1).expect("a valid mesh");
    for friction in [coulomb(0.0), elastic_plastic(1e7, 0.0)] {
        let cable = reference_cable(12.0, friction);
        let passage = Passage::new(&cable, &mesh, &motion, APPROACH).expect("a valid passage");
        let mut run = Run::new(cable, mesh);
        let outcome = run.passes(3, &passage);
        assert_eq!((outcome.force.upstream, outcome.force.downstream), (0.0, 0.0));
        assert_eq!((outcome.peak.downstream, outcome.max_compression), (0.0, 0.0));
        assert_eq!(run.state, CableState::at_rest(&mesh));
    }
}

#[test]
fn without_motion_of_the_duct_nothing_happens() {
    let mesh = Mesh::new(12.0, 0.2, 0.1).expect("a valid mesh");
    for friction in [
        coulomb(27.2),
        elastic_plastic(1e7, 27.2),
        elastic_plastic(1e14, 27.2),
    ] {
        let cable = reference_cable(12.0, friction);
        let passage = Passage::from_shape(&cable, &mesh, Direction::Forward, |_| 0.0, APPROACH)
            .expect("a valid passage");
        let mut run = Run::new(cable, mesh);
        let outcome = run.passes(3, &passage);
        assert_eq!(outcome.force.downstream, 0.0);
        assert_eq!(run.state, CableState::at_rest(&mesh));
    }
}

#[test]
fn a_rigid_shift_of_the_duct_carries_a_free_cable_along() {
    let mesh = Mesh::new(12.0, 0.2, 0.1).expect("a valid mesh");
    for friction in [coulomb(27.2), elastic_plastic(1e7, 27.2)] {
        let cable = cable(12.0, AXIAL_STIFFNESS, friction, End::Free, End::Free);
        // Everywhere the same: there with the first step, and back with the last.
        let passage = Passage::from_shape(&cable, &mesh, Direction::Forward, |_| 1e-3, APPROACH)
            .expect("a valid passage");
        let mut run = Run::new(cable, mesh);
        for _ in 0..2 {
            let (_, last) = run.pass_and_last(&passage);
            assert!(last.displacement().iter().all(|u| (u - 1e-3).abs() < 1e-15));
            assert!(run.state.displacement().iter().all(|u| u.abs() < 1e-15));
        }
    }
}

#[test]
fn a_hundred_thousand_passes_settle() {
    let motion = reference_motion();
    // One step a node: what counts is how many passes there are.
    let mesh = Mesh::new(3.0, 0.3, 0.3).expect("a valid mesh");
    for friction in [coulomb(LIMITS[0]), elastic_plastic(7e6, LIMITS[0])] {
        let cable = reference_cable(3.0, friction);
        let passage = Passage::new(&cable, &mesh, &motion, APPROACH).expect("a valid passage");
        let mut run = Run::new(cable, mesh);
        run.passes(99_990, &passage);
        let settled = run.state.clone();
        let force = run.pass(&passage).force.downstream;
        assert!(survives(&mut run, &passage, 9));
        let size = settled.displacement()[0].abs();
        assert!(largest_difference(settled.displacement(), run.state.displacement()) < 1e-9 * size);
        assert!(force > 0.0 && force <= LIMITS[0] * 3.0);
    }
}

#[test]
fn a_duct_that_moves_by_metres_or_by_atoms_is_solved_or_refused() {
    for friction in [coulomb(27.2), elastic_plastic(1e7, 27.2)] {
        let cable = reference_cable(12.0, friction);
        let mesh = Mesh::new(12.0, 0.2, 0.1).expect("a valid mesh");
        for exponent in -300..=6 {
            if exponent < -20 && exponent % 40 != 0 {
                continue;
            }
            let peak = 10.0_f64.powi(exponent);
            let shape = |xi: f64| peak * xi / (1.0 + xi * xi).powf(1.5);
            let passage = Passage::from_shape(&cable, &mesh, Direction::Forward, shape, APPROACH)
                .expect("a valid passage");
            let solved = survives(&mut Run::new(cable.clone(), mesh), &passage, 3);
            assert!(solved || peak > 1.0, "{peak} m");
        }
    }
}

#[test]
fn a_saw_tooth_motion_is_solved() {
    // No ground is like this: full reversal from node to node, and jumps.
    for friction in [
        coulomb(27.2),
        elastic_plastic(1e5, 27.2),
        elastic_plastic(1e8, 27.2),
    ] {
        let cable = reference_cable(6.0, friction);
        let mesh = Mesh::new(6.0, 0.2, 0.1).expect("a valid mesh");
        let shape = |xi: f64| {
            let tooth = if (xi / 0.2).round().rem_euclid(2.0) == 0.0 {
                1e-5
            } else {
                -1e-5
            };
            if xi.abs() < 2.0 { tooth } else { 0.0 }
        };
        let passage =
            Passage::from_shape(&cable, &mesh, Direction::Forward, shape, APPROACH).expect("a valid passage");
        assert!(survives(&mut Run::new(cable, mesh), &passage, 10));
    }
}

#[test]
fn shallow_and_deep_ducts_are_solved() {
    let ground = HalfSpace::new(Soil::new(800e6, 0.4).expect("a valid soil"));
    let truck = Vehicle::point("truck", 196_133.0, 11.1).expect("a valid vehicle");
    for depth in [0.05, 0.3, 5.0, 50.0] {
        let line = DuctLine::new(depth, 0.0).expect("a valid line");
        let motion = DuctMotion::new(&ground, &truck, line, 60.0, 1e-6).expect("a smooth field");
        for friction in [coulomb(LIMITS[0]), elastic_plastic(7e6, LIMITS[0])] {
            let cable = reference_cable(12.0, friction);
            let mesh = Mesh::new(12.0, 0.2, 0.1).expect("a valid mesh");
            let passage = unjudged_passage(&cable, &mesh, &motion);
            assert!(survives(&mut Run::new(cable, mesh), &passage, 5), "{depth} m");
        }
    }
}
