//! Clamps on the node of an end, and within its element: who carries what.

use cable_dem::{
    CableState, DuctedCable, End, Explicit, ExplicitOptions, Mesh, MovingDuct, Passage, Restraint,
};
use ground_field::Direction;

use super::full_newton::{FullChain, even_positions};
use super::scenes::{
    APPROACH, AXIAL_STIFFNESS, LIMITS, Run, assert_near, cable, clamp_springs, coulomb, reference_motion,
    sheathed,
};
use super::shared::slipping;

const LENGTH: f64 = 15.0;
const SPACING: f64 = 0.2;
const PASSES: usize = 4;
/// q L \[N\].
const HELD: f64 = LIMITS[0] * LENGTH;

fn clamped(ends: (End, End), clamps: &[(f64, f64)]) -> DuctedCable {
    let clamps = clamps
        .iter()
        .map(|&(position, stiffness)| Restraint::new(position, stiffness));
    cable(LENGTH, AXIAL_STIFFNESS, sheathed(LIMITS[0]), ends.0, ends.1)
        .with_restraints(clamps.collect())
        .expect("valid clamps")
}

/// Forces on ends and clamps \[N\]: as read from the cable's state, which balances its friction, and as the whole-chain Newton method has them.
fn readings(ends: (End, End), clamps: &[(f64, f64)]) -> Vec<f64> {
    let (cable, motion) = (clamped(ends, clamps), reference_motion());
    let (mut run, passage) = Run::under_truck(&cable, SPACING);
    let mesh = *run.solver.mesh();
    let mut oracle = FullChain::new(&cable, &mesh);
    let positions = even_positions(&mesh, Direction::Forward, APPROACH);
    for _ in 0..PASSES {
        run.pass(&passage);
        oracle.pass(&positions, |xi| motion.longitudinal(xi));
    }
    let pull = |(node, stiffness): &(usize, f64)| stiffness * oracle.displacement[*node];
    let springs = clamp_springs(&cable, &mesh);
    let of_clamps = springs.chunks(2).map(|springs| springs.iter().map(pull).sum());
    let exact = oracle.end_forces();
    let expected = [exact.upstream, exact.downstream].into_iter().chain(of_clamps);
    let at_ends = run.state.end_forces(&cable).expect("the state's mesh");
    let at_clamps = run.state.restraint_forces(&cable).expect("the state's mesh");
    let found = [&[at_ends.upstream, at_ends.downstream], &at_clamps[..]].concat();
    // What the windows leave out.
    for (one, other) in found.iter().zip(expected) {
        assert_near(*one, other, 1e-3 * HELD, (ends, clamps));
    }
    let friction = run.state.friction().iter().enumerate();
    let rubbed: f64 = friction.map(|(node, f)| mesh.tributary_length(node) * f).sum();
    let carried = at_ends.downstream - at_ends.upstream + at_clamps.iter().sum::<f64>();
    assert_near(carried, rubbed, 1e-5 * HELD, (ends, clamps));
    found
}

#[test]
fn ends_and_clamps_read_what_the_oracle_reads() {
    for stiffness in [1e5, 1e6, 1e9] {
        let spring = End::Spring(stiffness);
        for beside in [0.0, 0.5, 1.0].map(|share| share * SPACING) {
            for clamp in [0.3 * stiffness, 3.0 * stiffness] {
                readings((spring, spring), &[(beside, clamp), (LENGTH - beside, clamp)]);
            }
        }
    }
    let together = [(LENGTH, 2e6), (LENGTH - 0.3 * SPACING, 1e6), (0.5 * SPACING, 1e6)];
    for ends in [
        (End::Free, End::Fixed),
        (End::Spring(1e4), End::Fixed),
        (End::Spring(1e6), End::Spring(1e6)),
    ] {
        readings(ends, &together);
    }
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
        let mesh = Mesh::new(LENGTH, SPACING, 0.5 * SPACING).expect("a valid mesh");
        let duct = MovingDuct::new(&cable, &mesh, &reference_motion(), APPROACH).expect("a valid duct");
        let mut solver =
            Explicit::new(cable.clone(), mesh, 11.1, ExplicitOptions::default()).expect("a valid solver");
        let mut state = CableState::at_rest(&mesh);
        for pass in 0..PASSES {
            let moving = solver.pass(&duct, &mut state).expect("an answer").pass.force;
            let resting = state.end_forces(&cable).expect("the state's mesh");
            let allowed = 1e-4 * LIMITS[0] * SPACING;
            assert_near(moving.upstream, resting.upstream, allowed, pass);
            assert_near(moving.downstream, resting.downstream, allowed, pass);
        }
    }
}

#[test]
fn forces_on_clamps_during_a_pass_are_those_of_its_steps() {
    let cable = cable(40.0, 8e6, coulomb(27.2), End::Free, End::Fixed)
        .with_restraints(vec![Restraint::new(12.03, 5e6), slipping(25.0, 2e7, 150.0)])
        .expect("valid clamps");
    let mesh = Mesh::new(40.0, 0.2, 0.1).expect("a valid mesh");
    let shape = |xi: f64| 4e-5 * xi / (1.0 + xi * xi).powf(1.5);
    for direction in [Direction::Forward, Direction::Reverse] {
        let passage =
            Passage::from_shape(&cable, &mesh, direction, shape, APPROACH).expect("a valid passage");
        let mut run = Run::new(cable.clone(), mesh);
        let forces = |state: &CableState| state.restraint_forces(&cable).expect("its own cable");
        for _ in 0..3 {
            let mut seen = vec![forces(&run.state)];
            let outcome = run.watch(&passage, |_, state| seen.push(forces(state)));
            seen.push(outcome.restraints.clone());
            for (clamp, range) in outcome.restraint_ranges.iter().enumerate() {
                let of_steps = seen.iter().map(|forces| forces[clamp]);
                let least = of_steps.clone().fold(f64::INFINITY, f64::min);
                let largest = of_steps.fold(f64::NEG_INFINITY, f64::max);
                assert_near(range[0], least, 1e-6, direction);
                assert_near(range[1], largest, 1e-6, direction);
                // The clamp stands still while the duct moves by tens of micrometres.
                assert!(largest - least > 5.0, "{direction}: from {least} to {largest} N");
            }
        }
    }
}

/// Also where the window of one holds another: k (2 u_i − u_{i−1} − u_{i+1}) + S u_i = w f_i, with S the spring of a clamp, or none of it
/// beside the fixed end.
#[test]
fn clamps_and_the_fixed_end_are_in_balance_at_every_step() {
    for places in [&[14.0][..], &[14.6], &[0.4, 14.0], &[7.0, 8.0], &[0.8, 1.6, 13.8]] {
        for stiffness in [3e5, 1e7] {
            let clamps: Vec<(f64, f64)> = places.iter().map(|place| (*place, stiffness)).collect();
            let (mut run, passage) = Run::under_truck(&clamped((End::Free, End::Fixed), &clamps), SPACING);
            let node = |place: &f64| (place / SPACING).round() as usize;
            let beside_end = (node(&LENGTH) - 1, 0.0);
            let mut worst = 0.0_f64;
            for _ in 0..PASSES {
                run.watch(&passage, |_, state| {
                    let (u, f) = (state.displacement(), state.friction());
                    let clamped = places.iter().map(|place| (node(place), stiffness));
                    for (node, spring) in clamped.chain([beside_end]) {
                        let bend = 2.0 * u[node] - u[node - 1] - u[node + 1];
                        let force = AXIAL_STIFFNESS / SPACING * bend + spring * u[node];
                        worst = worst.max((force / SPACING - f[node]).abs());
                    }
                });
            }
            // What windows may leave out, and rounding.
            assert!(worst < 1.1e-3 * LIMITS[0], "{places:?} {stiffness}: {worst} N/m");
        }
    }
}
