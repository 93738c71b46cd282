//! Largest forces of vehicles that come seldom, for verdicts.

use creepage::scene::SolverMethod;
use creepage::{CableEnd, Limited, Limits, Run, Scene};

use super::scenes::{by, under};
use crate::answers::common::is_told;
use crate::scenes::{assert_near, last};

/// Vehicles by their share and load \[kN\], over a duct whose downstream end is fixed.
fn scene(vehicles: &[(f64, f64)], traffic: &str) -> Scene {
    let vehicle = |(kind, (share, load)): (usize, &(f64, f64))| {
        format!("{{ name = \"v{kind}\", speed = 11, load = \"{load} kN\", share = {share} }}")
    };
    let vehicles: Vec<String> = vehicles.iter().enumerate().map(vehicle).collect();
    under(&vehicles.join(", "), traffic)
}

fn largest(run: &Run) -> f64 {
    run.largest(CableEnd::Downstream, Limited::Force)
}

/// A long sequence of which few passes are listed: its one special transport decides the verdict, and when the limit is exceeded.
#[test]
fn a_limit_is_judged_by_all_passes_of_a_long_sequence() {
    let mut sequence = vec!["\"v0\""; 97];
    sequence[61] = "\"v1\"";
    let traffic = |passes: u64| format!("passes = {passes}, sequence = [{}]", sequence.join(", "));
    let scene = |passes| scene(&[(1.0, 40.0), (1.0, 400.0)], &traffic(passes));
    let every = by(&scene(4000), SolverMethod::QuasiStatic).expect("an answer");
    let found = by(&scene(1_000_000), SolverMethod::PassLaw).expect("an answer");
    let stated = found.error_estimate.relative;
    assert_near(largest(&found), largest(&every), stated, "N");

    let limits = Limits::both(Some(0.98 * largest(&every)), None);
    let reached = |run: &Run| {
        let verdicts = limits.verdicts(run);
        let mut reached = verdicts.iter().filter_map(|verdict| verdict.reached_after);
        reached.next().expect("a limit that is exceeded").pass as f64
    };
    assert_near(reached(&found), reached(&every), 0.2, "passes");
}

/// A vehicle that is too seldom for any period is judged by one pass of its own; one that never comes is named.
#[test]
fn vehicles_that_are_too_seldom_for_a_period_are_judged() {
    let of = |passes: u64| scene(&[(1.0, 40.0), (1e-5, 400.0)], &format!("passes = {passes}"));
    let run = by(&of(1_000_000), SolverMethod::Auto).expect("an answer");
    let alone = by(&scene(&[(1.0, 40.0)], "passes = 1000000"), SolverMethod::Auto).expect("an answer");
    assert!(largest(&run) > 1.2 * largest(&alone), "{}", largest(&run));
    assert!(run.extremes.iter().any(|extreme| extreme.vehicle == "v1"));
    assert!(!is_told(&run, "\"v1\""));
    let few = by(&of(1000), SolverMethod::Auto).expect("an answer");
    assert!(is_told(&few, "\"v1\""), "{:?}", few.warnings);
}

/// The common vehicle drives the other way: the seldom one decides where the cable goes.
#[test]
fn a_seldom_vehicle_against_the_common_direction_counts() {
    let mut scene = scene(&[(100.0, 40.0), (1.0, 400.0)], "passes = 1500");
    scene.vehicles[0].direction = ground_field::Direction::Reverse;
    let every = by(&scene, SolverMethod::QuasiStatic).expect("an answer");
    let found = by(&scene, SolverMethod::PassLaw).expect("an answer");
    let right = last(&every).downstream_force_n;
    assert!(right.abs() > 50.0, "{right}");
    let stated = found.error_estimate.relative;
    assert_near(last(&found).downstream_force_n, right, stated, "N");
}
