//! Random scenes over the whole range that scene files allow in practice, against far finer runs: the stated error of forces after
//! passes and during them, of forces on clamps and of movements is an upper bound but for a few, and the tolerance is kept.

use std::time::{Duration, Instant};

use creepage::scene::{GroundModel, SolverMethod};
use creepage::{Run, Scene};
use creepage_validation::whole_range::differences::{Errors, KINDS, stated};
use creepage_validation::whole_range::twins::off_finer;
use rayon::prelude::*;

use super::ordinary_scenes;

const TOLERANCES: [f64; 3] = [0.05, 0.01, 0.002];
/// A run that takes longer counts as a miss \[s\].
const LONGEST: Duration = Duration::from_secs(60);
/// Nodes eliminated for a reference at most.
const REFERENCE_WORK: f64 = 4e8;
/// A mesh twice as fine takes so many times the work.
const REFINEMENT: f64 = 4.5;

/// One scene at one tolerance.
#[derive(Debug)]
enum Case {
    Judged {
        tolerance: f64,
        found: Errors,
        stated: Errors,
    },
    /// The run took too long.
    Cut,
    /// The run refused to answer.
    Refused,
    /// No reference can be had that is finer.
    Unjudged,
}

/// The finest run that can be had, at least as fine as `spacing` \[m\]; `work` is what a run at that spacing took.
fn reference(scene: &Scene, spacing: f64, work: f64, inertia: bool) -> Option<Run> {
    let refinements = ((REFERENCE_WORK / work).ln() / REFINEMENT.ln())
        .floor()
        .clamp(0.0, 3.0);
    let mut scene = scene.clone();
    let spacing = spacing / 2_f64.powf(refinements);
    scene.solver.node_spacing = Some(spacing);
    scene.solver.vehicle_step = Some(0.5 * spacing);
    // Nothing is left out of the ground, and no answer is refused.
    scene.ground.model = if scene.ground.profile().expect("layers").homogeneous().is_some() {
        GroundModel::Boussinesq
    } else {
        GroundModel::Burmister
    };
    scene.solver.tolerance = 0.5;
    scene.solver.method = if inertia {
        SolverMethod::Explicit
    } else {
        SolverMethod::QuasiStatic
    };
    creepage::run(&scene).ok()
}

fn cases(seed: u64) -> Vec<Case> {
    let mut scene = Scene::from_toml("scene", &ordinary_scenes::scene(seed)).expect("a valid scene");
    let runs: Vec<(f64, Duration, Result<Run, creepage::Error>)> = TOLERANCES
        .iter()
        .map(|&tolerance| {
            scene.solver.tolerance = tolerance;
            let start = Instant::now();
            let run = creepage::run(&scene);
            (tolerance, start.elapsed(), run)
        })
        .collect();
    let finest = runs
        .iter()
        .filter_map(|(_, _, run)| run.as_ref().ok())
        .min_by(|a, b| a.plan.node_spacing_m.total_cmp(&b.plan.node_spacing_m));
    let Some(finest) = finest else {
        return runs.iter().map(|_| Case::Refused).collect();
    };
    let inertia = finest.plan.cable == "explicit";
    let exact = reference(
        &scene,
        finest.plan.node_spacing_m,
        finest.cost.node_updates as f64,
        inertia,
    );
    runs.into_iter()
        .map(|(tolerance, time, run)| {
            let case = match (run, &exact) {
                (_, _) if time > LONGEST => Case::Cut,
                (Err(error), _) => {
                    println!("{seed}: {error}");
                    assert!(
                        matches!(error, creepage::Error::Inaccurate { .. }),
                        "{seed}: {error}"
                    );
                    Case::Refused
                }
                (Ok(run), Some(exact)) if exact.plan.node_spacing_m < 0.55 * run.plan.node_spacing_m => {
                    Case::Judged {
                        tolerance,
                        found: off_finer(&scene, &run, exact),
                        stated: stated(&run),
                    }
                }
                _ => Case::Unjudged,
            };
            println!("{seed} {tolerance} {:.1} s {case:?}", time.as_secs_f64());
            case
        })
        .collect()
}

#[test]
#[ignore = "half an hour of references on two cores: cargo test --release -p creepage-validation honest:: -- --ignored --nocapture"]
fn the_stated_error_is_above_the_true_one_and_the_tolerance_is_kept() {
    let number = |name: &str, default: u64| {
        std::env::var(name)
            .ok()
            .and_then(|n| n.parse().ok())
            .unwrap_or(default)
    };
    let (first, count) = (number("FIRST", 0), number("SCENES", 200));
    let all: Vec<Case> = (first..first + count)
        .into_par_iter()
        .flat_map_iter(cases)
        .collect();
    let runs = all.len() as f64;
    let share = |holds: &dyn Fn(&Case) -> bool| all.iter().filter(|case| holds(case)).count() as f64 / runs;
    let cut = share(&|case| matches!(case, Case::Cut));
    println!(
        "{runs} runs: cut {cut:.4}, refused {:.4}, unjudged {:.4}",
        share(&|case| matches!(case, Case::Refused)),
        share(&|case| matches!(case, Case::Unjudged)),
    );
    for wanted in TOLERANCES {
        let of_run = |case: &Case| match case {
            Case::Judged {
                tolerance,
                found,
                stated,
            } if *tolerance == wanted => Some(
                (0..KINDS.len())
                    .map(|kind| stated[kind] / found[kind].max(1e-9))
                    .fold(f64::INFINITY, f64::min),
            ),
            _ => None,
        };
        let mut ratios: Vec<f64> = all.iter().filter_map(of_run).collect();
        ratios.sort_by(f64::total_cmp);
        let above = ratios.iter().filter(|ratio| **ratio >= 1.0).count();
        if let (Some(least), Some(median)) = (ratios.first(), ratios.get(ratios.len() / 2)) {
            let count = ratios.len();
            println!(
                "{wanted}: {count} judged, {above} state enough; stated/true: median {median:.1}, least {least:.2}"
            );
        }
    }
    for (kind, name) in KINDS.into_iter().enumerate() {
        let understated =
            share(&|case| matches!(case, Case::Judged { found, stated, .. } if found[kind] > stated[kind]));
        // An answer that says itself that it exceeds the tolerance deceives nobody.
        let exceeded = share(
            &|case| matches!(case, Case::Judged { tolerance, found, stated } if found[kind] > *tolerance && stated[kind] <= *tolerance),
        );
        println!("{name}: understated {understated:.4}, beyond the tolerance {exceeded:.4}");
        assert!(understated + cut <= 0.02 && exceeded + cut <= 0.01, "{name}");
    }
}
