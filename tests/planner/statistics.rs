//! Random scenes at several tolerances against far finer runs: how often the tolerance holds, how good the estimate is.

use creepage::scene::{GroundModel, SolverMethod};
use creepage::{PassRecord, Run, Scene};

use super::scenes;

const TOLERANCES: [f64; 3] = [0.05, 0.01, 0.002];
/// Forces below this share of the run's largest count as nothing, as in the estimate.
const SMALL: f64 = 0.1;

/// One scene at one tolerance.
struct Case {
    kind: &'static str,
    tolerance: f64,
    error: f64,
    estimate: f64,
    plan: String,
}

/// The scene on a mesh `refinement` times finer than six nodes a depth, with nothing left out of the ground, and inertia
/// where any of the runs to be judged has it.
fn reference(scene: &Scene, refinement: f64, inertia: bool) -> Run {
    let mut scene = scene.clone();
    let spacing = scene.duct.depth / (6.0 * refinement);
    scene.solver.node_spacing = Some(spacing);
    scene.solver.vehicle_step = Some(0.5 * spacing);
    scene.solver.method = if inertia {
        SolverMethod::Dynamic
    } else {
        SolverMethod::QuasiStatic
    };
    scene.ground.model = if scene.ground.profile.homogeneous().is_some() {
        GroundModel::Boussinesq
    } else {
        GroundModel::Burmister
    };
    creepage::run(&scene).expect("a reference")
}

/// Whether inertia is planned for at any of the tolerances.
fn has_inertia(scene: &Scene) -> bool {
    TOLERANCES.iter().any(|&tolerance| {
        let mut scene = scene.clone();
        scene.solver.tolerance = tolerance;
        creepage::plan(&scene).expect("a plan").report().cable == "dynamic"
    })
}

/// Largest difference of any force after any listed pass, as a share of the largest force after that pass, or of a tenth
/// of the run's largest.
fn difference(run: &Run, reference: &Run) -> f64 {
    let forces = |r: &PassRecord| [r.upstream_force_n, r.downstream_force_n, r.max_compression_n];
    let largest = |r: &PassRecord| {
        [r.upstream_peak_n, r.downstream_peak_n]
            .into_iter()
            .chain(forces(r))
            .map(f64::abs)
            .fold(0.0, f64::max)
    };
    let floor = SMALL * reference.passes.iter().map(largest).fold(0.0, f64::max);
    let mut worst = 0.0_f64;
    for record in &run.passes {
        let Ok(index) = reference.passes.binary_search_by_key(&record.pass, |r| r.pass) else {
            continue;
        };
        let exact = &reference.passes[index];
        let scale = forces(exact).into_iter().map(f64::abs).fold(floor, f64::max);
        // The law resolves the passes from the tenth on, and says so.
        if run.plan.cable == "pass-law" && record.pass < 10 {
            continue;
        }
        for (a, b) in forces(record).into_iter().zip(forces(exact)) {
            worst = worst.max((a - b).abs() / scale);
        }
    }
    worst
}

fn cases(kind: &'static str, seed: u64) -> Vec<Case> {
    let mut scene = Scene::from_toml("scene", &scenes::scene(kind, seed)).expect("a valid scene");
    // Enough passes for the force to build up, few enough for a reference of sixty times the work.
    let inertia = kind != "many" && has_inertia(&scene);
    let (passes, refinement) = match kind {
        "many" => (3000, 2.0),
        _ if inertia => (3, 8.0),
        "long" => (5, 16.0),
        _ => (10, 16.0),
    };
    scene.traffic.passes = passes.min(scene.traffic.passes);
    let exact = reference(&scene, refinement, inertia);
    let finest = 1.9 * exact.plan.node_spacing_m;
    let mut cases = Vec::new();
    for tolerance in TOLERANCES {
        // The law on three thousand passes is as good as its guards; a tighter tolerance goes by every pass.
        if tolerance < 0.01 && kind == "many" {
            continue;
        }
        scene.solver.tolerance = tolerance;
        // Where forces are small beside what passes through the cable there may be no answer within ten per cent.
        match creepage::run(&scene) {
            // The reference has to be better than what it judges.
            Ok(run) if run.plan.node_spacing_m < finest && run.plan.cable != "pass-law" => {
                println!("{kind} {seed}: as fine as its reference at {tolerance}");
            }
            Ok(run) => cases.push(Case {
                kind,
                tolerance,
                error: difference(&run, &exact),
                // A reference without inertia cannot tell what leaving it out costs.
                estimate: run.error_estimate.relative
                    - if inertia {
                        0.0
                    } else {
                        run.error_estimate.parts.inertia
                    },
                plan: format!(
                    "{} {} {:.3} m",
                    run.plan.ground, run.plan.cable, run.plan.node_spacing_m
                ),
            }),
            Err(creepage::Error::Inaccurate { reached, .. }) => {
                println!("{kind} {seed}: refused at {tolerance}, {reached:.3}");
            }
            Err(error) => panic!("{kind} {seed} at {tolerance}: {error}"),
        }
    }
    cases
}

#[test]
#[ignore = "minutes of references on two cores: cargo test --release --test main planner::statistics -- --ignored --nocapture"]
fn the_tolerance_holds_on_random_scenes_and_the_estimate_is_honest() {
    use rayon::prelude::*;
    let count: u64 = std::env::var("SCENES")
        .ok()
        .and_then(|n| n.parse().ok())
        .unwrap_or(72);
    let all: Vec<Case> = (0..count)
        .into_par_iter()
        .flat_map_iter(|seed| {
            let kind = scenes::KINDS[seed as usize % scenes::KINDS.len()];
            let cases = cases(kind, seed);
            for case in &cases {
                println!(
                    "{seed:>3} {:<12} {:>6} true {:.5} estimated {:.5} ratio {:.2} {}",
                    case.kind,
                    case.tolerance,
                    case.error,
                    case.estimate,
                    case.estimate / case.error,
                    case.plan
                );
            }
            cases
        })
        .collect();
    for tolerance in TOLERANCES {
        let cases: Vec<&Case> = all.iter().filter(|case| case.tolerance == tolerance).collect();
        let kept = cases.iter().filter(|case| case.error <= tolerance).count();
        let mut ratios: Vec<f64> = cases.iter().map(|case| case.estimate / case.error).collect();
        ratios.sort_by(f64::total_cmp);
        let median = ratios[ratios.len() / 2];
        let bounded = ratios.iter().filter(|ratio| **ratio >= 1.0).count();
        println!(
            "tolerance {tolerance}: {kept} of {} within it; estimate/true: median {median:.2}, least {:.2}; {bounded} bounded",
            cases.len(),
            ratios[0]
        );
        assert!(
            kept as f64 >= 0.95 * cases.len() as f64,
            "{kept} of {} within {tolerance}",
            cases.len()
        );
        assert!(
            (1.0..=5.0).contains(&median),
            "estimate is {median} times the error at {tolerance}"
        );
    }
}
