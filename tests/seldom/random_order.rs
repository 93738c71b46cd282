//! Long traffic in random order shows the mean over random orders.

use creepage::scene::{Following, SolverMethod};
use creepage::{CableEnd, PassRecord, Run, Scene};
use rayon::prelude::*;

use super::scenes::by;
use crate::answers::common::assert_within;
use crate::scenes;

/// Random runs of which every pass is simulated, the passes before which they still remember that nothing had passed, and after which the
/// forces on both ends hardly depend on which pass it is.
const RUNS: u64 = 6;
const PASSES: u64 = 1400;
const FORGOTTEN: u64 = 400;

/// Two kinds of vehicle that drive both ways or one, by their shares, over a cable between a fixed end and one that is free or sprung.
fn scene(reverse: bool, shares: (f64, f64), loads: (f64, f64), passes: u64) -> Scene {
    let direction = if reverse { "reverse" } else { "forward" };
    let text = format!(
        r#"
        duct = {{ length = 8, depth = 1.2 }}
        ground = {{ layers = [{{ young_modulus = "200 MPa", poisson_ratio = 0.4 }}] }}
        cable = {{ weight = 108.8, axial_stiffness = 8.01e6 }}
        friction = {{ dynamic_coefficient = 0.25, shape_factor = 6e6 }}
        ends = {{ upstream = {{ spring = 1e6 }}, downstream = "fixed" }}
        vehicles = [
            {{ name = "one", speed = 11, load = "{} kN", share = {} }},
            {{ name = "other", speed = 9, load = "{} kN", share = {}, direction = "{direction}" }},
        ]
        traffic = {{ passes = {passes}, order = "random", seed = 1 }}
        "#,
        loads.0, shares.0, loads.1, shares.1
    );
    Scene::from_toml("scene", &text).expect("a valid scene")
}

fn force(record: &PassRecord) -> [f64; 2] {
    [record.upstream_force_n, record.downstream_force_n]
}

/// Mean force on both ends over the late passes of a run.
fn late_mean(run: &Run) -> [f64; 2] {
    let late = run.passes.iter().filter(|pass| pass.pass > FORGOTTEN);
    let late: Vec<[f64; 2]> = late.map(force).collect();
    [0, 1].map(|end| late.iter().map(|force| force[end]).sum::<f64>() / late.len() as f64)
}

#[test]
#[ignore = "half a minute: .ci/run runs it"]
fn long_traffic_in_random_order_shows_the_mean_over_random_orders() {
    assert_mean(true, (0.83, 0.17), (60.0, 120.0));
    assert_mean(true, (0.517, 0.483), (80.0, 80.0));
    assert_mean(false, (0.9, 0.1), (50.0, 150.0));
}

/// The answer after a million passes lies within its stated error of the mean over random runs of which every pass is simulated.
fn assert_mean(reverse: bool, shares: (f64, f64), loads: (f64, f64)) {
    let every = |seed: u64| {
        let mut scene = scene(reverse, shares, loads, PASSES);
        (scene.traffic.order, scene.traffic.seed) = (Following::Random, seed);
        late_mean(&by(&scene, SolverMethod::QuasiStatic).expect("an answer"))
    };
    let runs: Vec<[f64; 2]> = (0..RUNS).into_par_iter().map(every).collect();
    let found = by(&scene(reverse, shares, loads, 1_000_000), SolverMethod::Auto).expect("an answer");
    let last = force(scenes::last(&found));
    let stated = found.error_estimate.relative * scenes::largest(last);
    for end in [0, 1] {
        let mean = runs.iter().map(|run| run[end]).sum::<f64>() / RUNS as f64;
        let square = runs.iter().map(|run| (run[end] - mean).powi(2)).sum::<f64>();
        // Three standard errors of the mean of the runs.
        let scatter = 3.0 * (square / (RUNS * (RUNS - 1)) as f64).sqrt();
        assert_within(last[end], mean, scatter + stated, (end, scatter));
    }
    let random = found.random.expect("a spread");
    for end in CableEnd::ALL {
        let spread = random.of(end);
        assert!(spread.q05_n <= spread.q50_n && spread.q50_n <= spread.q95_n);
    }
}

/// Where all of the traffic is shorter than two periods of its shares, what its order changes is stated all the same.
#[test]
fn a_random_order_of_few_passes_is_compared_too() {
    let scene = scene(true, (0.517, 0.483), (80.0, 80.0), 150);
    match by(&scene, SolverMethod::PassLaw) {
        Ok(run) if run.plan.cable == "pass-law" => {
            let stated = run.error_estimate.parts.passes;
            assert!(stated > 0.005, "{stated}");
        }
        Ok(run) => assert_eq!(run.cost.simulated_passes, 150),
        Err(error) => assert!(matches!(error, creepage::Error::Inaccurate { .. }), "{error}"),
    }
}
