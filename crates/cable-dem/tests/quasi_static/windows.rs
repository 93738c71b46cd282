//! Work is done where the cable moves only: its cost per step does not grow with the duct, and nothing slips unseen.

use cable_dem::{End, Friction, FrictionLaw, Mesh, Passage, QuasiStatic, Statistics};
use ground_field::Direction;
use proptest::prelude::*;

use super::scenes::{APPROACH, LIMITS, Run, cable, coulomb, reference_cable, reference_motion, sheathed};

/// Counts of the tenth pass over a duct of `length`, and its number of nodes.
fn tenth_pass(length: f64, friction: Friction) -> (Statistics, usize) {
    let cable = reference_cable(length, friction);
    let mesh = Mesh::new(length, 0.1, 0.05).expect("a valid mesh");
    let passage = Passage::new(&cable, &mesh, &reference_motion(), APPROACH).expect("a valid passage");
    let mut run = Run::new(cable, mesh);
    (run.passes(10, &passage).statistics, mesh.nodes())
}

fn updates_per_step(statistics: Statistics) -> f64 {
    statistics.node_updates as f64 / statistics.steps as f64
}

#[test]
fn a_duct_ten_times_as_long_costs_no_more_a_step() {
    for limit in LIMITS {
        for friction in [sheathed(limit), coulomb(limit)] {
            let (short, _) = tenth_pass(30.0, friction);
            let (long, nodes) = tenth_pass(300.0, friction);
            assert!(long.steps > 5 * short.steps);
            let growth = updates_per_step(long) / updates_per_step(short);
            assert!(growth < 1.2, "{short:?}, {long:?}");
            // Measured: windows of 100 to 145 of 3001 nodes, about the longest zone that slips.
            assert!(long.widest_window < nodes / 16, "{long:?}");
            assert!(updates_per_step(long) < nodes as f64 / 16.0, "{long:?}");
        }
    }
}

#[test]
fn most_steps_need_one_linear_solve() {
    for limit in LIMITS {
        let (statistics, _) = tenth_pass(300.0, sheathed(limit));
        assert!(statistics.sweeps < statistics.windows * 5 / 4, "{statistics:?}");
    }
}

#[test]
fn an_elastic_sheath_never_cycles() {
    for limit in LIMITS {
        let cable = reference_cable(30.0, sheathed(limit));
        let mesh = Mesh::new(30.0, 0.1, 0.05).expect("a valid mesh");
        let passage = Passage::new(&cable, &mesh, &reference_motion(), APPROACH).expect("a valid passage");
        let mut run = Run::new(cable, mesh);
        for _ in 0..30 {
            assert_eq!(run.pass(&passage).statistics.cycles, 0);
        }
    }
}

/// Wheels of a vehicle: where each stands \[m\], how far it moves the duct \[m\], and over which width \[m\].
fn any_wheels() -> impl Strategy<Value = Vec<(f64, f64, f64)>> {
    prop::collection::vec((-12.0..12.0_f64, -6e-5..6e-5_f64, 0.6..2.5_f64), 1..6)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(800))]

    /// Zones that slip begin, end and meet wherever wheels lead and follow: on coarse meshes within the same few nodes.
    #[test]
    fn friction_keeps_its_limit_outside_the_windows_too(
        wheels in any_wheels(),
        (exponent, limit) in (6.3..9.3_f64, 5.0..50.0_f64),
        law in prop_oneof![Just(FrictionLaw::Coulomb), Just(FrictionLaw::ElasticPlastic { shape_factor: 1e7 })],
        (spacing, steps) in (0.1..0.6_f64, 1..4_u32),
    ) {
        let friction = Friction::new(law, limit).expect("valid friction");
        let cable = cable(30.0, 10.0_f64.powf(exponent), friction, End::Free, End::Fixed);
        let mesh = Mesh::new(30.0, spacing, spacing / f64::from(steps)).expect("a valid mesh");
        let shape = |xi: f64| -> f64 {
            let wheel = |&(x, peak, width): &(f64, f64, f64)| {
                let t = (xi - x) / width;
                peak * t / (1.0 + t * t).powi(2)
            };
            wheels.iter().map(wheel).sum()
        };
        let mut solver = QuasiStatic::new(cable.clone(), mesh).expect("a valid problem");
        let mut state = solver.at_rest();
        for direction in [Direction::Forward, Direction::Reverse, Direction::Forward] {
            let passage = Passage::from_shape(&cable, &mesh, direction, shape, APPROACH).expect("a valid passage");
            let mut largest = 0.0_f64;
            solver
                .pass_observed(&passage, &mut state, |_, state| {
                    let state = state();
                    largest = state.friction().iter().fold(largest, |most, friction| most.max(friction.abs()));
                })
                .expect("an equilibrium");
            // What may stay unbalanced outside the windows.
            prop_assert!(largest <= 1.001_000_001 * limit, "{largest} of {limit} N/m");
        }
    }
}
