//! The iteration against the exact step: two ways to solve every window, one answer.

use cable_dem::{Mesh, PassOutcome, Passage};
use ground_field::Direction;

use super::scenes::{
    APPROACH, LIMITS, Run, coulomb, largest_difference, reference_cable, reference_motion, sheathed,
};

/// Both accept a contact state that holds to 1e-9 of the friction limit; over thousands of steps that adds up.
const AGREEMENT: f64 = 1e-6;

#[test]
fn every_step_by_dynamic_programming_gives_the_same_cable() {
    let motion = reference_motion();
    let mesh = Mesh::new(30.0, 0.2, 0.1).expect("a valid mesh");
    for friction in [sheathed(LIMITS[0]), coulomb(LIMITS[1])] {
        let cable = reference_cable(30.0, friction);
        let forward = Passage::new(&cable, &mesh, &motion, APPROACH).expect("a valid passage");
        let shape = |xi: f64| motion.longitudinal(xi);
        let reverse =
            Passage::from_shape(&cable, &mesh, Direction::Reverse, shape, APPROACH).expect("a valid passage");
        let mut iterated = Run::new(cable.clone(), mesh);
        let mut exact = iterated.clone();
        exact.solver = exact.solver.without_iteration();
        for passage in [&forward, &forward, &reverse, &forward] {
            let outcomes: [PassOutcome; 2] = [iterated.pass(passage), exact.pass(passage)];
            let [force, by_exact] = outcomes.clone().map(|outcome| outcome.force.downstream);
            assert!(
                (force - by_exact).abs() <= AGREEMENT * force.abs(),
                "{force} and {by_exact}"
            );
            let [usual, without] = outcomes.map(|outcome| outcome.statistics);
            assert_eq!(without.exact_steps, without.windows, "{without:?}");
            assert!(without.corners > without.node_updates, "{without:?}");
            assert!(10 * usual.exact_steps < usual.windows, "{usual:?}");
        }
        let limit = cable.friction().limit();
        let difference = largest_difference(iterated.state.friction(), exact.state.friction());
        assert!(difference <= AGREEMENT * limit, "{difference} N/m of {limit}");
    }
}
