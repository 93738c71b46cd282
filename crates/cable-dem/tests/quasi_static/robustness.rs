//! Hostile parameters: a right answer or a typed error, never a panic and never a doubtful number.

use boussinesq::HalfSpace;
use cable_dem::{CableError, DuctedCable, End, Mesh, Passage};
use ground_field::{Direction, DuctLine, DuctMotion, Vehicle};

use super::scenes::{
    APPROACH, AXIAL_STIFFNESS, LIMITS, Run, assert_near, cable, coulomb, elastic_plastic, largest_difference,
    reference_cable, reference_motion,
};

/// Friction and equilibrium hold to this share of the friction limit, where rounding does not set a wider bound.
const ACCURACY: f64 = 1e-6;

/// What rounding of the elastic forces may leave, as a share of the friction limit.
fn rounding(run: &Run) -> f64 {
    let (cable, mesh) = (run.solver.cable(), run.solver.mesh());
    let displacement = run.state.displacement().iter();
    let largest = displacement.fold(1e-4, |m: f64, u| m.max(u.abs()));
    64.0 * f64::EPSILON * cable.axial_stiffness() / mesh.spacing().powi(2) * largest
        / cable.friction().limit()
}

/// Drives a truck over the cable: either every pass leaves an equilibrium within the friction bounds, or an error leaves
/// the state as it was. Whether all passes succeeded.
fn passes(run: &mut Run, passage: &Passage, passes: usize) -> bool {
    for _ in 0..passes {
        let before = run.state.clone();
        match run.try_pass(passage) {
            Ok(outcome) => {
                assert!(run.utilisation() <= 1.0 + ACCURACY, "{}", run.utilisation());
                let allowed = 2.0 * (ACCURACY + rounding(run));
                assert_near(run.imbalance(), 0.0, allowed, &run.solver);
                assert!(outcome.force.upstream.is_finite() && outcome.force.downstream.is_finite());
                assert!(outcome.peak.downstream >= outcome.force.downstream);
                assert!(outcome.lowest.downstream <= outcome.force.downstream);
            }
            Err(CableError::Precision { share, .. }) => {
                assert!(share > 1e-3);
                assert_eq!(run.state, before);
                return false;
            }
            Err(error) => panic!("{error} in {:?}", run.solver),
        }
    }
    true
}

/// Passes of a vehicle that moves the duct in this `shape`; the cable after them, unless one was refused.
fn survivor(
    cable: &DuctedCable,
    (spacing, step): (f64, f64),
    shape: impl Fn(f64) -> f64,
    number: usize,
) -> Option<Run> {
    let mesh = Mesh::new(cable.length(), spacing, step).expect("a valid mesh");
    // The shape itself: also on a mesh too coarse to say anything of the duct.
    let passage =
        Passage::from_shape(cable, &mesh, Direction::Forward, shape, APPROACH).expect("a valid passage");
    let mut run = Run::new(cable.clone(), mesh);
    passes(&mut run, &passage, number).then_some(run)
}

const MESH: (f64, f64) = (0.2, 0.1);

/// Elements and vehicle steps of any length, also relative to each other; three nodes; ducts just below the road and far below it.
#[test]
fn every_mesh_and_depth_is_solved() {
    let ground = HalfSpace::new(testkit::soil(800e6, 0.4));
    let truck = Vehicle::point("truck", testkit::TRUCK, 11.1).expect("a valid vehicle");
    let ends = [End::Free, End::Fixed, End::Spring(1e6)];
    let pairs = ends
        .iter()
        .flat_map(|&upstream| ends.map(|downstream| (upstream, downstream)));
    let three_nodes = pairs.map(|ends| (1.2, 2.0, (1.0, 0.05), ends, 20));
    let others = [
        (1.2, 0.25, (1e-3, 1e-3)),
        (1.2, 0.25, (1e-3, 0.05)),
        (1.2, 2.0, (0.01, 0.003)),
        (1.2, 30.0, (1.0, 0.1)),
        (1.2, 30.0, (5.0, 5.0)),
        (1.2, 30.0, (5.0, 0.05)),
        (1.2, 30.0, (0.1, 7.0)),
        (1.2, 30.0, (15.0, 100.0)),
        (0.05, 12.0, MESH),
        (0.3, 12.0, MESH),
        (5.0, 12.0, MESH),
        (50.0, 12.0, MESH),
    ];
    let others = others.map(|(depth, length, mesh)| (depth, length, mesh, (End::Free, End::Fixed), 5));
    let sheathed = |shape_factor| elastic_plastic(shape_factor, LIMITS[0]);
    for (depth, length, mesh, ends, number) in three_nodes.chain(others) {
        let line = DuctLine::new(depth, 0.0).expect("a valid line");
        let motion = DuctMotion::new(&ground, &truck, line, 60.0, 1e-6).expect("a smooth field");
        for friction in [coulomb(LIMITS[0]), sheathed(7e6), sheathed(1e3)] {
            let cable = cable(length, AXIAL_STIFFNESS, friction, ends.0, ends.1);
            let run = survivor(&cable, mesh, |xi| motion.longitudinal(xi), number);
            assert!(run.is_some(), "{depth} m, {length} m, {mesh:?}, {friction:?}");
        }
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
            let shifted = last.displacement().iter().map(|u| u - 1e-3);
            let back = run.state.displacement().iter().copied();
            assert!(shifted.chain(back).all(|off| off.abs() < 1e-15));
        }
    }
}

#[test]
fn six_thousand_passes_settle() {
    // One step a node: what counts is how many passes there are.
    let mesh = Mesh::new(3.0, 0.3, 0.3).expect("a valid mesh");
    for friction in [coulomb(LIMITS[0]), elastic_plastic(7e6, LIMITS[0])] {
        let cable = reference_cable(3.0, friction);
        let passage = Passage::new(&cable, &mesh, &reference_motion(), APPROACH).expect("a valid passage");
        let mut run = Run::new(cable, mesh);
        let force = run.passes(5_990, &passage).force.downstream;
        let settled = run.state.displacement().to_vec();
        assert!(passes(&mut run, &passage, 10));
        assert!(largest_difference(&settled, run.state.displacement()) < 1e-9 * settled[0].abs());
        assert!(force > 0.0 && force <= LIMITS[0] * 3.0);
    }
}

#[test]
fn a_duct_that_moves_by_metres_or_by_atoms_is_solved_or_refused() {
    for friction in [coulomb(27.2), elastic_plastic(1e7, 27.2)] {
        let cable = reference_cable(12.0, friction);
        for exponent in (-300..-20).step_by(40).chain(-20..=6) {
            let peak = 10.0_f64.powi(exponent);
            let solved = survivor(&cable, MESH, |xi| peak * xi / (1.0 + xi * xi).powf(1.5), 3);
            assert!(solved.is_some() || peak > 1.0, "{peak} m");
        }
    }
}

#[test]
fn a_saw_tooth_motion_is_solved() {
    // No ground is like this: full reversal from node to node, and jumps.
    let tooth = |xi: f64| match (xi / 0.2).round().rem_euclid(2.0) {
        _ if xi.abs() >= 2.0 => 0.0,
        0.0 => 1e-5,
        _ => -1e-5,
    };
    let sheathed = |shape_factor| elastic_plastic(shape_factor, 27.2);
    for friction in [coulomb(27.2), sheathed(1e5), sheathed(1e8)] {
        let cable = reference_cable(6.0, friction);
        assert!(survivor(&cable, MESH, tooth, 10).is_some());
    }
}
