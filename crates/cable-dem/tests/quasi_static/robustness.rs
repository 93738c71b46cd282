//! Hostile parameters: a right answer or a typed error, never a panic and never a doubtful number.

use boussinesq::HalfSpace;
use cable_dem::{CableError, DuctedCable, End, Mesh, Passage, Restraint};
use ground_field::{Direction, DuctLine, DuctMotion, Vehicle};

use super::full_newton::{FullChain, even_positions};
use super::scenes::{
    APPROACH, AXIAL_STIFFNESS, LIMITS, Run, cable, coulomb, elastic_plastic, largest_difference,
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

#[test]
fn every_shape_factor_gives_the_oracles_answer() {
    let motion = reference_motion();
    let shape = |xi: f64| motion.longitudinal(xi);
    let length = 15.0;
    for (limit, (upstream, downstream)) in LIMITS
        .into_iter()
        .flat_map(|limit| [(End::Free, End::Fixed), (End::Spring(1e6), End::Free)].map(|ends| (limit, ends)))
    {
        let of = |friction| cable(length, AXIAL_STIFFNESS, friction, upstream, downstream);
        // b → ∞ is Coulomb's law: the sheath's slip of 2/b is nothing beside the duct's 15 µm.
        let rigid = survivor(&of(coulomb(limit)), MESH, shape, 3).expect("an equilibrium");
        for exponent in 3..=14 {
            let cable = of(elastic_plastic(10.0_f64.powi(exponent), limit));
            let run = survivor(&cable, MESH, shape, 3).expect("an equilibrium");
            // Beyond, Newton's method is lost.
            if exponent <= 10 {
                let mesh = run.solver.mesh();
                let mut oracle = FullChain::new(&cable, mesh);
                for _ in 0..3 {
                    oracle.pass(&even_positions(mesh, Direction::Forward, APPROACH), shape);
                }
                let apart = largest_difference(&run.forces(), &oracle.forces());
                assert!(apart < 2e-4 * limit * length, "b = 1e{exponent}: {apart} N");
            }
            // But for the friction on the last half elements, which Coulomb's law leaves open.
            let inner = 1..run.solver.mesh().nodes();
            let apart = largest_difference(&rigid.forces()[inner.clone()], &run.forces()[inner]);
            assert!(
                exponent < 11 || apart < 1e-3 * limit * length,
                "b = 1e{exponent}: {apart} N"
            );
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
        let solved = (3..=20).filter(|&exponent| {
            let cable = cable(12.0, 10.0_f64.powi(exponent), friction, End::Free, End::Fixed);
            survivor(&cable, MESH, |xi| motion.longitudinal(xi), 3).is_some()
        });
        let solved = solved.count();
        // 1e3 to 1e12 N without loss of precision; far above it rounding is refused.
        assert!((10..18).contains(&solved), "{solved}");
    }
}

/// Elements and vehicle steps of any length, also beside the other; three nodes; ducts just below the road and far below it.
#[test]
fn every_mesh_and_depth_is_solved() {
    let ground = HalfSpace::new(testkit::soil(800e6, 0.4));
    let truck = Vehicle::point("truck", testkit::TRUCK, 11.1).expect("a valid vehicle");
    let ends = [End::Free, End::Fixed, End::Spring(1e6)];
    let three_nodes = ends
        .iter()
        .flat_map(|&upstream| ends.map(|downstream| (upstream, downstream)));
    let three_nodes = three_nodes.map(|ends| (1.2, 2.0, (1.0, 0.05), ends, 20));
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
    for (depth, length, mesh, ends, number) in three_nodes.chain(others) {
        let line = DuctLine::new(depth, 0.0).expect("a valid line");
        let motion = DuctMotion::new(&ground, &truck, line, 60.0, 1e-6).expect("a smooth field");
        for friction in [
            coulomb(LIMITS[0]),
            elastic_plastic(7e6, LIMITS[0]),
            elastic_plastic(1e3, LIMITS[0]),
        ] {
            let cable = cable(length, AXIAL_STIFFNESS, friction, ends.0, ends.1);
            let run = survivor(&cable, mesh, |xi| motion.longitudinal(xi), number);
            assert!(run.is_some(), "{depth} m, {length} m, {mesh:?}, {friction:?}");
        }
    }
}

#[test]
fn every_spring_and_clamp_is_solved() {
    let motion = reference_motion();
    for friction in [coulomb(LIMITS[1]), elastic_plastic(4.5e6, LIMITS[1])] {
        let run_with = |upstream: End, downstream: End, clamps: Vec<Restraint>| {
            let cable = cable(12.0, AXIAL_STIFFNESS, friction, upstream, downstream)
                .with_restraints(clamps)
                .expect("valid clamps");
            let run = survivor(&cable, MESH, |xi| motion.longitudinal(xi), 5).expect("an equilibrium");
            run.state.end_forces(&cable).expect("the state's mesh").downstream
        };
        let fixed = run_with(End::Free, End::Fixed, Vec::new());
        let mut last = 0.0;
        for exponent in 0..=12 {
            let stiffness = 10.0_f64.powi(exponent);
            last = run_with(End::Free, End::Spring(stiffness), Vec::new());
            // Not monotone in the stiffness: a reading includes the end node's own friction, of either sign.
            assert!(last > 0.0 && last < LIMITS[1] * 12.0);
            for position in [0.0, 0.05, 6.0, 6.1, 12.0] {
                let clamp = Restraint::new(position, stiffness);
                run_with(End::Free, End::Fixed, vec![clamp]);
                run_with(End::Spring(stiffness), End::Free, vec![clamp, clamp]);
            }
        }
        // On a spring, however stiff, Coulomb friction on the last half element turns over with the least slip; on a fixed
        // end, where the slip is known, it does so bit by bit.
        let is_rigid = friction.compliance() == 0.0;
        let turning = if is_rigid { LIMITS[1] * MESH.0 } else { 0.0 };
        assert!(
            (last - fixed).abs() < 1e-3 * fixed + turning,
            "the stiffest, {last} N, is as good as fixed, {fixed} N"
        );
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
fn twenty_thousand_passes_settle() {
    // One step a node: what counts is how many passes there are.
    let mesh = Mesh::new(3.0, 0.3, 0.3).expect("a valid mesh");
    for friction in [coulomb(LIMITS[0]), elastic_plastic(7e6, LIMITS[0])] {
        let cable = reference_cable(3.0, friction);
        let passage = Passage::new(&cable, &mesh, &reference_motion(), APPROACH).expect("a valid passage");
        let mut run = Run::new(cable, mesh);
        let force = run.passes(19_990, &passage).force.downstream;
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
    let tooth = |xi: f64| {
        if (xi / 0.2).round().rem_euclid(2.0) == 0.0 {
            1e-5
        } else {
            -1e-5
        }
    };
    for friction in [
        coulomb(27.2),
        elastic_plastic(1e5, 27.2),
        elastic_plastic(1e8, 27.2),
    ] {
        let cable = reference_cable(6.0, friction);
        let solved = survivor(
            &cable,
            MESH,
            |xi| if xi.abs() < 2.0 { tooth(xi) } else { 0.0 },
            10,
        );
        assert!(solved.is_some());
    }
}
