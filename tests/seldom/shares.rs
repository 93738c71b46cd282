//! Shares of n to one.

use creepage::scene::SolverMethod;
use creepage::{Run, Scene};
use proptest::prelude::*;

use super::scenes::{by, difference, under};

const TOLERANCE: f64 = 0.01;

/// A light truck, and a special transport for every `n` of them.
fn scene(n: usize, passes: u64) -> Scene {
    let vehicles = format!(
        r#"{{ name = "truck", speed = 11, load = "40 kN", share = {n} }},
        {{ name = "special", speed = 5, load = "400 kN", share = 1 }}"#
    );
    under(&vehicles, &format!("passes = {passes}"))
}

/// The same with its order written out, every pass simulated.
fn written_out(scene: &Scene, n: usize) -> Run {
    let mut scene = scene.clone();
    let special = n.div_ceil(2);
    let name = |place| scene.vehicles[usize::from(place == special)].name.clone();
    scene.traffic.sequence = (0..=n).map(name).collect();
    by(&scene, SolverMethod::QuasiStatic).expect("an answer")
}

fn assert_written_out(n: usize, rounds: u64) -> Result<(), TestCaseError> {
    let scene = scene(n, rounds * (n as u64 + 1));
    let found = by(&scene, SolverMethod::PassLaw).expect("an answer");
    let right = written_out(&scene, n);
    let apart = difference(&scene, &right, &found);
    let worst = apart.force.max(apart.extreme).max(apart.movement);
    prop_assert!(worst <= TOLERANCE, "{n} : 1, {rounds} rounds: {apart:?}");
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 8, ..ProptestConfig::default() })]

    /// After whole rounds n to one is the sequence of n and one.
    #[test]
    fn n_to_one_is_the_sequence_of_n_and_one(n in 1..=300_usize, passes in 300..900_u64) {
        assert_written_out(n, (passes / (n as u64 + 1)).max(1))?;
    }
}

#[test]
#[ignore = "all n from 1 to 300, 2000 passes each: minutes"]
fn n_to_one_is_the_sequence_of_n_and_one_for_all_n() -> Result<(), TestCaseError> {
    for n in 1..=300 {
        assert_written_out(n, 2000 / (n as u64 + 1))?;
    }
    Ok(())
}
