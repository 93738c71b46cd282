//! Clamps on the node of an end, and within its element: who carries what.

use approx::assert_abs_diff_eq;
use cable_dem::{
    CableState, DuctedCable, End, Explicit, ExplicitOptions, Mesh, MovingDuct, Passage, QuasiStatic,
    Restraint,
};
use ground_field::Direction;

use super::full_newton::{FullChain, even_positions};
use super::scenes::{
    APPROACH, AXIAL_STIFFNESS, LIMITS, Run, cable, clamp_springs, coulomb, reference_motion, sheathed,
};

const LENGTH: f64 = 15.0;
const SPACING: f64 = 0.2;
const PASSES: usize = 4;
/// Of q L: what the windows leave out.
const ACCURACY: f64 = 1e-3;

fn clamped(ends: (End, End), clamps: &[(f64, f64)]) -> DuctedCable {
    let clamps = clamps
        .iter()
        .map(|&(position, stiffness)| Restraint::new(position, stiffness));
    cable(LENGTH, AXIAL_STIFFNESS, sheathed(LIMITS[0]), ends.0, ends.1)
        .with_restraints(clamps.collect())
        .expect("valid clamps")
}

fn mesh() -> Mesh {
    Mesh::new(LENGTH, SPACING, 0.5 * SPACING).expect("a valid mesh")
}

/// Forces on ends and clamps \[N\]: as read from the cable's state, which balances its friction, and as the whole-chain Newton method has them.
fn readings(ends: (End, End), clamps: &[(f64, f64)]) -> Vec<f64> {
    let (cable, mesh, motion) = (clamped(ends, clamps), mesh(), reference_motion());
    let passage = Passage::new(&cable, &mesh, &motion, APPROACH).expect("a valid passage");
    let mut run = Run::new(cable.clone(), mesh);
    let mut oracle = FullChain::new(&cable, &mesh);
    let positions = even_positions(&mesh, Direction::Forward, APPROACH);
    for _ in 0..PASSES {
        run.pass(&passage);
        oracle.pass(&positions, |xi| motion.longitudinal(xi));
    }
    let bears = |springs: &[(usize, f64)]| {
        springs
            .iter()
            .map(|(node, k)| k * oracle.displacement[*node])
            .sum()
    };
    let (at_ends, exact) = (
        run.state.end_forces(&cable).expect("the state's mesh"),
        oracle.end_forces(),
    );
    let at_clamps = run.state.restraint_forces(&cable).expect("the state's mesh");
    let expected = clamp_springs(&cable, &mesh);
    let expected = [exact.upstream, exact.downstream]
        .into_iter()
        .chain(expected.chunks(2).map(bears));
    let found = [&[at_ends.upstream, at_ends.downstream], &at_clamps[..]].concat();
    for (one, other) in found.iter().zip(expected) {
        let off = (one - other).abs();
        assert!(
            off < ACCURACY * LIMITS[0] * LENGTH,
            "{ends:?} {clamps:?}: {found:.3?}, {other:.3} N"
        );
    }
    let friction = run.state.friction().iter().enumerate();
    let rubbed: f64 = friction.map(|(node, f)| mesh.tributary_length(node) * f).sum();
    let unbalanced = at_ends.downstream - at_ends.upstream + at_clamps.iter().sum::<f64>() - rubbed;
    assert!(
        unbalanced.abs() < 1e-5 * LIMITS[0] * LENGTH,
        "{ends:?} {clamps:?}: {unbalanced} N"
    );
    found
}

#[test]
fn ends_and_clamps_read_what_the_oracle_reads() {
    for spring in [1e5, 1e6, 1e9].map(End::Spring) {
        for (beside, share) in [0.0, 0.5, 1.0]
            .into_iter()
            .flat_map(|beside| [(beside, 0.3), (beside, 3.0)])
        {
            let (place, clamp) = (beside * SPACING, share * spring.stiffness().unwrap_or(0.0));
            readings((spring, spring), &[(place, clamp), (LENGTH - place, clamp)]);
        }
    }
    let together = [(LENGTH, 2e6), (LENGTH - 0.3 * SPACING, 1e6), (0.5 * SPACING, 1e6)];
    for upstream in [End::Free, End::Spring(1e4)] {
        readings((upstream, End::Fixed), &together);
    }
    readings((End::Spring(1e6), End::Spring(1e6)), &together);
}

#[test]
fn a_clamp_beside_a_fixed_end_takes_its_part_and_one_on_it_none() {
    for beside in [0.0, 0.5 * SPACING, SPACING] {
        let found = readings((End::Fixed, End::Fixed), &[(beside, 1e8), (LENGTH - beside, 1e8)]);
        for clamp in &found[2..] {
            assert_eq!(*clamp == 0.0, beside == 0.0, "{found:?}");
        }
    }
    // What does not move cannot feel the clamp: the joint carries all, to the last digit.
    let with = readings((End::Free, End::Fixed), &[(LENGTH, 1e8)]);
    assert_eq!(with[..2], readings((End::Free, End::Fixed), &[]));
}

#[test]
fn a_free_end_reads_nothing_and_its_clamp_all() {
    for beside in [0.0, 0.5 * SPACING] {
        let found = readings((End::Free, End::Free), &[(LENGTH - beside, 1e7)]);
        assert_eq!(found[..2], [0.0, 0.0]);
        assert!(found[2] > 20.0, "{found:?}");
    }
}

#[test]
fn a_cable_that_has_come_to_rest_reads_the_same_by_balance_and_by_its_springs() {
    for (spring, clamp) in [(1e5, 1e6), (1e7, 1e7)] {
        let ends = (End::Spring(spring), End::Spring(spring));
        let cable = clamped(ends, &[(0.5 * SPACING, clamp), (LENGTH, clamp)]);
        let mesh = mesh();
        let duct = MovingDuct::new(&cable, &mesh, &reference_motion(), APPROACH).expect("a valid duct");
        let mut solver =
            Explicit::new(cable.clone(), mesh, 11.1, ExplicitOptions::default()).expect("a valid solver");
        let mut state = CableState::at_rest(&mesh);
        for _ in 0..PASSES {
            let moving = solver.pass(&duct, &mut state).expect("an answer").pass.force;
            let resting = state.end_forces(&cable).expect("the state's mesh");
            for (one, other) in [
                (moving.upstream, resting.upstream),
                (moving.downstream, resting.downstream),
            ] {
                assert!(
                    (one - other).abs() < 1e-4 * LIMITS[0] * SPACING,
                    "{moving:?} {resting:?}"
                );
            }
        }
    }
}

#[test]
fn forces_on_clamps_during_a_pass_are_those_of_its_steps() {
    let clamps = vec![
        Restraint::new(12.03, 5e6),
        Restraint {
            holds: Some(150.0),
            ..Restraint::new(25.0, 2e7)
        },
    ];
    let cable = cable(40.0, 8e6, coulomb(27.2), End::Free, End::Fixed)
        .with_restraints(clamps)
        .expect("valid clamps");
    let mesh = Mesh::new(40.0, 0.2, 0.1).expect("a valid mesh");
    let shape = |xi: f64| 4e-5 * xi / (1.0 + xi * xi).powf(1.5);
    for direction in [Direction::Forward, Direction::Reverse] {
        let passage =
            Passage::from_shape(&cable, &mesh, direction, shape, APPROACH).expect("a valid passage");
        let mut solver = QuasiStatic::new(cable.clone(), mesh).expect("a valid problem");
        let mut state = solver.at_rest();
        let forces = |state: &CableState| state.restraint_forces(&cable).expect("its own cable");
        for _ in 0..3 {
            let mut seen = vec![forces(&state)];
            let outcome = solver.pass_observed(&passage, &mut state, |_, at| seen.push(forces(&at())));
            let outcome = outcome.expect("an equilibrium");
            seen.push(outcome.restraints.clone());
            for (clamp, range) in outcome.restraint_ranges.iter().enumerate() {
                let of_steps = seen.iter().map(|forces| forces[clamp]);
                let least = of_steps.clone().fold(f64::INFINITY, f64::min);
                let largest = of_steps.fold(f64::NEG_INFINITY, f64::max);
                assert_abs_diff_eq!(range[0], least, epsilon = 1e-6);
                assert_abs_diff_eq!(range[1], largest, epsilon = 1e-6);
                // The clamp stands still while the duct moves by tens of micrometres.
                assert!(
                    largest - least > 5.0,
                    "{direction}: clamp {clamp} from {least} to {largest} N"
                );
            }
        }
    }
}

/// Also where the window of one holds another: k (2 u_i − u_{i−1} − u_{i+1}) + S u_i = w f_i, with S the spring of a clamp, or none of it
/// beside the fixed end.
#[test]
fn clamps_and_the_fixed_end_are_in_balance_at_every_step() {
    let mesh = mesh();
    for places in [&[14.0][..], &[14.6], &[0.4, 14.0], &[7.0, 8.0], &[0.8, 1.6, 13.8]] {
        for stiffness in [3e5, 1e7] {
            let clamps: Vec<(f64, f64)> = places.iter().map(|place| (*place, stiffness)).collect();
            let cable = clamped((End::Free, End::Fixed), &clamps);
            let passage =
                Passage::new(&cable, &mesh, &reference_motion(), APPROACH).expect("a valid passage");
            let mut solver = QuasiStatic::new(cable.clone(), mesh).expect("a valid problem");
            let mut state = solver.at_rest();
            let mut worst = 0.0_f64;
            for _ in 0..PASSES {
                let outcome = solver.pass_observed(&passage, &mut state, |_, at| {
                    let state = at();
                    let (u, f) = (state.displacement(), state.friction());
                    let clamped = places
                        .iter()
                        .map(|place| ((place / SPACING).round() as usize, stiffness));
                    for (node, spring) in clamped.chain([(mesh.elements() - 1, 0.0)]) {
                        let bend = 2.0 * u[node] - u[node - 1] - u[node + 1];
                        let force = AXIAL_STIFFNESS / SPACING * bend + spring * u[node];
                        worst = worst.max((force / SPACING - f[node]).abs());
                    }
                });
                outcome.expect("an equilibrium");
            }
            // What windows may leave out, and rounding.
            assert!(worst < 1.1e-3 * LIMITS[0], "{places:?} {stiffness}: {worst} N/m");
        }
    }
}
