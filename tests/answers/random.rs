//! Random scenes of every kind: each answer can be true and says how good it is, else there is a typed error.

use creepage::scene::SolverMethod;
use fastrand::Rng;

use super::common::{answer, by};
use super::long_term;

/// Runs that would take longer than this \[s\] are left out.
const LONGEST: f64 = 0.4;

/// Tries scenes with one of the tolerances; returns how many were answered by simulation and by the law, and how many were not.
fn try_seeds(seeds: std::ops::Range<u64>, tolerances: &[f64]) -> [usize; 3] {
    let mut count = [0; 3];
    for seed in seeds {
        let mut rng = Rng::with_seed(seed);
        let scene = long_term::random(seed);
        let tolerance = tolerances[rng.usize(..tolerances.len())];
        for (method, passes) in [
            (SolverMethod::Auto, rng.u64(1..12)),
            (SolverMethod::QuasiStatic, rng.u64(1..60)),
            (SolverMethod::PassLaw, 10_u64.pow(rng.u32(0..7))),
            // So many that none of these ducts is computed pass by pass.
            (SolverMethod::Auto, 100_000_000_000),
        ] {
            let mut scene = by(&scene, method);
            (scene.solver.tolerance, scene.traffic.passes) = (tolerance, passes);
            let quick = |plan: &creepage::PlanReport| plan.estimated_seconds <= LONGEST;
            if creepage::plan(&scene).is_ok_and(|plan| !quick(&plan.report())) {
                continue;
            }
            let place = match answer(&scene) {
                Some(run) if run.plan.cable == "pass-law" => 1,
                Some(_) => 0,
                None => 2,
            };
            count[place] += 1;
        }
    }
    println!("{count:?} by simulation, by the law, refused");
    count
}

#[test]
#[ignore = "half a minute: .ci/run runs it"]
fn every_answer_can_be_true_or_is_none() {
    let [simulated, ..] = try_seeds(0..10, &[0.2, 0.05]);
    assert!(simulated >= 15, "{simulated}");
}

#[test]
#[ignore = "forty random scenes at tight tolerances too: minutes"]
fn every_one_of_more_answers_can_be_true_or_is_none() {
    try_seeds(1000..1040, &[0.2, 0.05, 0.01]);
}
