//! Chains under Coulomb's law, soft and stiff: every step ends in equilibrium, with slip in the direction of friction.

use cable_dem::{End, Mesh, Passage, QuasiStatic, Restraint, Statistics};
use ground_field::Direction;
use proptest::prelude::*;

use super::scenes::{APPROACH, any_end, any_wheels, cable, coulomb, wheeled};

const LENGTH: f64 = 40.0;
/// What may stay unbalanced outside the windows, as a share of the friction limit: 1e-3 beside each, and several meet at an end.
const UNBALANCED: f64 = 4e-3;
/// Slip that counts \[m\], a ten-millionth of what the duct moves.
const SLIP: f64 = 1e-11;

proptest! {
    #![proptest_config(ProptestConfig::with_cases(40))]

    #[test]
    fn every_step_is_in_equilibrium_and_slips_along_its_friction(
        wheels in any_wheels(1e-5..6e-5),
        (exponent, limit, spacing) in (5.0..11.0_f64, 5.0..60.0_f64, 0.1..0.3_f64),
        ends in (any_end(1e4..1e8), any_end(1e4..1e8)),
        clamps in prop::collection::vec((0.0..LENGTH, 4.0..8.0_f64), 0..3),
    ) {
        let clamps = clamps.iter().map(|&(position, exponent)| Restraint::new(position, 10_f64.powf(exponent)));
        let cable = cable(LENGTH, 10_f64.powf(exponent), coulomb(limit), ends.0, ends.1)
            .with_restraints(clamps.collect())
            .expect("valid clamps");
        let mesh = Mesh::new(LENGTH, spacing, 0.5 * spacing).expect("a valid mesh");
        let shape = |xi: f64| wheeled(&wheels, xi, |t| 2.6 * t / (1.0 + t * t).powf(1.5));
        let passage = Passage::from_shape(&cable, &mesh, Direction::Forward, shape, APPROACH).expect("a valid passage");
        let mut solver = QuasiStatic::new(cable.clone(), mesh).expect("a valid problem");
        let mut state = solver.at_rest();
        let mut work = Statistics::default();
        for _ in 0..2 {
            let mut before = (state.displacement().to_vec(), vec![0.0; mesh.nodes()]);
            let mut wrong = None;
            let observed = solver.pass_observed(&passage, &mut state, |position, state| {
                let state = state();
                let needed = state.friction_share(&cable).expect("a cable as long as its mesh");
                if needed > 1.0 + UNBALANCED {
                    wrong = Some(format!("friction of {needed} of its limit at {position} m"));
                }
                let (u, duct) = (state.displacement(), |node: usize| shape(mesh.spacing() * node as f64 - position));
                let duct: Vec<f64> = (0..mesh.nodes()).map(duct).collect();
                for node in 0..mesh.nodes() {
                    let slip = (duct[node] - before.1[node]) - (u[node] - before.0[node]);
                    let along = state.friction()[node] * slip.signum();
                    let fixed = [(0, ends.0), (mesh.elements(), ends.1)].contains(&(node, End::Fixed));
                    if slip.abs() > SLIP && along < (1.0 - UNBALANCED) * limit && !fixed {
                        wrong = Some(format!("slip of {slip:e} m along {along} N/m at node {node}, {position} m"));
                    }
                }
                before = (u.to_vec(), duct);
            });
            work += observed.expect("an equilibrium").statistics;
            prop_assert!(wrong.is_none(), "{wrong:?} of {limit}");
        }
        // Sixteen solves that cycle and one that does not.
        prop_assert!(work.sweeps < 18 * work.windows, "{work:?}");
    }
}
