//! Work is done near the vehicle only: its cost per step does not grow with the duct.

use cable_dem::{Friction, Mesh, Passage, Statistics};

use super::scenes::{APPROACH, LIMITS, Run, coulomb, reference_cable, reference_motion, sheathed};

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
fn an_elastic_sheath_never_needs_the_exact_step() {
    for limit in LIMITS {
        let cable = reference_cable(30.0, sheathed(limit));
        let mesh = Mesh::new(30.0, 0.1, 0.05).expect("a valid mesh");
        let passage = Passage::new(&cable, &mesh, &reference_motion(), APPROACH).expect("a valid passage");
        let mut run = Run::new(cable, mesh);
        for _ in 0..30 {
            assert_eq!(run.pass(&passage).statistics.exact_steps, 0);
        }
    }
}
