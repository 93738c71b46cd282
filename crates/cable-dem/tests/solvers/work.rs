//! How much work the solvers do, in counts that do not depend on the machine: a change that makes one of them slower shows
//! here, where times would only flicker.
//!
//! Every bound is what the method must need on the scene, with a margin of a tenth to a quarter, and with the reason.

use std::cell::Cell;

use cable_dem::{Explicit, ExplicitOptions, FrictionLaw, Mesh, MovingDuct, Passage, Statistics};
use ground_field::Direction;

use super::harness::{
    APPROACH, AXIAL_STIFFNESS, Bar, Kind, LIMITS, MASS, Outcome, Run, SHEATH, UPPER, sheathed, truck,
};

/// Asserts that `count` is at most `most` for each of `each`.
fn assert_at_most(name: &str, count: usize, most: f64, each: usize, work: Statistics) {
    let found = count as f64 / each as f64;
    assert!(found <= most, "{name}: {found:.3}, not {most}: {work:?}");
}

#[test]
fn a_quasi_static_pass() -> Outcome {
    let truck = truck();
    let spacing = 0.1;
    let [upper, lower] = LIMITS;
    for (law, limit, length) in [
        (sheathed(upper), upper, 30.0),
        (sheathed(lower), lower, 300.0),
        (FrictionLaw::Coulomb, upper, 300.0),
        (FrictionLaw::Coulomb, lower, 30.0),
    ] {
        let bar = Bar {
            length,
            law,
            limit,
            mesh: (spacing, 0.05),
            ..UPPER
        };
        let problem = bar.under(&truck)?;
        let has_sheath = law != FrictionLaw::Coulomb;
        // On either side 100 steps of the vehicle near the duct, and beyond them strides of 2 up to 150 steps from it, of 3 up to
        // 200, of 4 up to 250 and of 5 up to the 300 of the approach.
        let step = problem.mesh.vehicle_step();
        let outside = 100 + 50 / 2 + 51 / 3 + 52 / 4 + 50 / 5;
        let positions = (length / step).round() as usize + 2 * outside;
        let single_steps = ((length + 2.0 * APPROACH) / step).round() as usize;
        for passes in [1, 10] {
            let pass = Run::new(Kind::QuasiStatic, &problem)?.passes(passes)?;
            let work = pass.outcome.statistics;
            // One step a vehicle position, one from rest and one to it.
            assert_eq!(work.steps, positions + 2);
            // Where the vehicle is, at either end if it is elsewhere, and now and then once more for a window that has grown, or for
            // a second zone.
            assert_at_most("windows a step", work.windows, 3.4, work.steps, work);
            // One linear solve around a support, and two where the vehicle is: contact states are predicted from the step before, at the
            // same distance from the vehicle. A sheath needs one in most steps, but not near the ends.
            let solves = if has_sheath && length > 100.0 { 1.25 } else { 1.8 };
            assert_at_most("solves a window", work.sweeps, solves, work.windows, work);
            // The zones that slip are some 6 m long, with what the sheath carries along 10 m, whatever the duct, all along the road; and
            // where the iteration cycles, ten solves of them.
            let zone = if has_sheath { 14.0 } else { 11.5 } / spacing;
            assert_at_most("nodes a step", work.node_updates, zone, single_steps, work);
            assert!(work.widest_window < (19.0 / spacing) as usize, "{work:?}");
            // The iteration cycles where contact begins, and with an elastic sheath never.
            let cycles = if has_sheath { 0.0 } else { 0.035 };
            assert_at_most("cycles a step", work.cycles, cycles, work.steps, work);
        }
    }
    Ok(())
}

/// A cable so stiff that it slides as a whole, under Coulomb's law: half the duct is one window, and the iteration cycles
/// often. What it then costs is the failed iteration (8 solves), the exact step and one more.
#[test]
fn a_quasi_static_pass_of_a_stiff_cable() -> Outcome {
    let bar = Bar {
        length: 300.0,
        axial_stiffness: 1e10,
        law: FrictionLaw::Coulomb,
        ..UPPER
    };
    let problem = bar.under(&truck())?;
    let mut run = Run::new(Kind::QuasiStatic, &problem)?;
    for _ in 0..3 {
        let work = run.pass(0)?.outcome.statistics;
        assert_at_most("cycles a window", work.cycles, 0.08, work.windows, work);
        // One, and 8 and one more where it cycles.
        let solves = 1.25 + 9.0 * 0.08;
        assert_at_most("solves a window", work.sweeps, solves, work.windows, work);
        let nodes = 2.5 * problem.mesh.nodes() as f64;
        assert_at_most("nodes a step", work.node_updates, nodes, work.steps, work);
    }
    Ok(())
}

#[test]
fn an_explicit_pass() -> Outcome {
    let truck = truck();
    for law in [
        SHEATH,
        FrictionLaw::Coulomb,
        FrictionLaw::Sigmoid { shape_factor: 1e8 },
    ] {
        let problem = Bar { law, ..UPPER }.under(&truck)?;
        let work = Run::new(Kind::Explicit, &problem)?.passes(2)?.outcome.statistics;
        // 0.9 of what waves and half the friction limit allow together, from their formulas.
        let waves = problem.mesh.spacing() * (MASS / AXIAL_STIFFNESS).sqrt();
        let rate = LIMITS[0] * law.shape_factor() / MASS;
        let friction = match law {
            FrictionLaw::Coulomb => f64::INFINITY,
            FrictionLaw::ElasticPlastic { .. } => (8.0 / rate).sqrt(),
            _ => (4.0 / rate).sqrt(),
        };
        let time_step = 0.9 / (1.0 / waves).hypot(2.0 / friction);
        let duration = (30.0 + 2.0 * APPROACH) / truck.speed;
        assert!((work.steps as f64) < 1.001 * duration / time_step, "{work:?}");
        // And some ten linear solves each for the steps from rest and to it, which nothing predicts.
        assert!(work.sweeps <= 2 * 12, "{work:?}");
        let most = (work.steps + work.sweeps) * problem.mesh.nodes();
        assert!(work.node_updates <= most, "{work:?}");
        let solver = Explicit::new(problem.cable, problem.mesh, MASS, ExplicitOptions::default())?;
        assert!(duration / work.steps as f64 <= solver.limits().advised());
    }
    Ok(())
}

#[test]
fn evaluations_of_the_duct() -> Outcome {
    for length in [30.0, 300.0] {
        let cable = Bar { length, ..UPPER }.cable()?;
        let mesh = Mesh::new(length, 0.2, 0.05)?;
        let calls = Cell::new(0_usize);
        let shape = |xi: f64| {
            calls.set(calls.get() + 1);
            1e-5 * xi / (1.0 + xi * xi)
        };
        // Every distance that a node can have from the vehicle once, on lattices of 50 and 20 mm.
        let distances = 2.0 * (length + APPROACH);
        Passage::from_shape(&cable, &mesh, Direction::Forward, shape, APPROACH)?;
        assert!((calls.take() as f64) < 1.05 * distances / 0.05);
        MovingDuct::from_shape(&cable, &mesh, Direction::Forward, 10.0, shape, APPROACH)?;
        assert!((calls.take() as f64) < 1.05 * distances / 0.02);
    }
    Ok(())
}
