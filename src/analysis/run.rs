//! A whole run: ground, motion, passes, and their discretisation error.
//!
//! The passes are computed on a mesh and on one twice as coarse. The difference, of which a convergent scheme's error
//! is the smaller part, estimates the error; where it exceeds the tolerance both meshes are halved.

use std::sync::atomic::{AtomicU64, Ordering};
use std::thread;

use cable_dem::{Mesh, PassOutcome, QuasiStatic};
use ground_field::DuctMotion;

use super::passes::{Passes, cable, simulate};
use super::result::{Cost, DuctMotionSummary, ErrorEstimate, PassRecord, PlanSummary, Run};
use super::saturation::saturation;
use super::{ground, motion};
use crate::scene::{End, SolverMethod};
use crate::{Error, Scene};

/// Nodes per depth of the duct at a tolerance of 1 %; the error falls with the square of the spacing.
const NODES_PER_DEPTH: f64 = 12.0;
/// Steps of the vehicle per node spacing.
const STEPS_PER_SPACING: f64 = 2.0;
/// Share of the difference to the mesh twice as coarse that counts as error. Second order leaves a third of it.
const ERROR_SHARE: f64 = 0.5;
/// Halvings of the mesh after which a run gives its best answer with a warning.
const MAX_HALVINGS: usize = 4;
/// Passes up to which every one is listed.
const ALL_LISTED: u64 = 10_000;
/// Forces below this share of the largest transient count as nothing when errors are compared.
const SMALL_FORCE: f64 = 0.02;

/// How to run.
#[derive(Default)]
pub struct RunOptions<'a> {
    /// Measure the error by a run on a mesh half as coarse instead of estimating it.
    pub verify: bool,
    /// Hears of the share of the work done so far, in \[0, 1\].
    pub progress: Option<&'a (dyn Fn(f64) + Sync)>,
}

/// Computes all passes of `scene`.
///
/// # Errors
///
/// [`Error`] when the scene asks for what does not fit together, or the computation fails.
pub fn run(scene: &Scene) -> Result<Run, Error> {
    run_with(scene, &RunOptions::default())
}

/// Computes all passes of `scene` with options.
///
/// # Errors
///
/// As for [`run`].
pub fn run_with(scene: &Scene, options: &RunOptions<'_>) -> Result<Run, Error> {
    check_method(scene)?;
    let ground = ground::choose(scene)?;
    let motions = motion::motions(scene, &ground)?;
    let mut warnings = Vec::new();
    let solved = solve(scene, &motions, options, &mut warnings)?;
    let passes = &solved.passes.outcomes;
    let (series, scale) = force_series(scene, passes);
    Ok(Run {
        title: scene.title.clone(),
        plan: PlanSummary {
            ground: ground.name.into(),
            cable: "quasi-static".into(),
            node_spacing_m: solved.mesh.spacing(),
            vehicle_step_m: solved.mesh.vehicle_step(),
            reasons: vec![
                format!("ground {}: {}", ground.name, ground.reason),
                "cable quasi-static: the cable's wave speed is far above the vehicle's".into(),
                solved.reason,
            ],
        },
        duct_motion: DuctMotionSummary {
            peak_longitudinal_m: motions[0].peak_longitudinal(),
            peak_vertical_m: motions[0].peak_vertical(),
        },
        passes: listed(passes),
        saturation: saturation(&series, scale),
        error_estimate: solved.error,
        cost: Cost::new(&solved.passes.statistics),
        warnings,
    })
}

/// Checks that the parts of `scene` fit together, without computing any pass.
///
/// # Errors
///
/// As for [`run`].
pub fn check(scene: &Scene) -> Result<(), Error> {
    check_method(scene)?;
    ground::choose(scene)?;
    let cable = cable(scene)?;
    QuasiStatic::new(cable, first_mesh(scene)?)?;
    Ok(())
}

fn check_method(scene: &Scene) -> Result<(), Error> {
    let unfit = |found| {
        Err(Error::Unfit {
            key: "solver.method",
            found,
            reason: "not in this version",
        })
    };
    match scene.solver.method {
        SolverMethod::Auto | SolverMethod::QuasiStatic => Ok(()),
        SolverMethod::Dynamic => unfit("dynamic"),
        SolverMethod::Explicit => unfit("explicit"),
        SolverMethod::PassLaw => unfit("pass-law"),
    }
}

/// Passes on the mesh that was good enough.
struct Solved {
    mesh: Mesh,
    passes: Passes,
    error: ErrorEstimate,
    reason: String,
}

/// Refines until the estimated error is within the tolerance, unless the scene says how fine to be.
fn solve(
    scene: &Scene,
    motions: &[DuctMotion],
    options: &RunOptions<'_>,
    warnings: &mut Vec<String>,
) -> Result<Solved, Error> {
    let tolerance = scene.solver.tolerance;
    let chosen = scene.solver.node_spacing.is_some() || scene.solver.vehicle_step.is_some();
    let mut mesh = first_mesh(scene)?;
    let (mut passes, mut coarse) = both(
        || simulate_on(scene, motions, mesh, options.progress),
        || {
            coarser(scene, mesh)
                .map(|mesh| simulate(scene, motions, mesh, || ()))
                .transpose()
        },
    )?;
    let mut halvings = 0;
    loop {
        let estimate = coarse
            .as_ref()
            .map(|coarse| ERROR_SHARE * difference(&passes, coarse));
        let enough = estimate.is_none_or(|estimate| estimate <= tolerance);
        if enough || chosen || halvings == MAX_HALVINGS {
            if !enough {
                let estimate = 100.0 * estimate.unwrap_or(f64::NAN);
                warnings.push(format!(
                    "the estimated error of {estimate:.2} % exceeds the tolerance of {:.2} %",
                    100.0 * tolerance
                ));
            }
            break;
        }
        let finer = halved(scene, mesh)?;
        coarse = Some(std::mem::replace(
            &mut passes,
            simulate_on(scene, motions, finer, options.progress)?,
        ));
        mesh = finer;
        halvings += 1;
    }
    let error = if options.verify {
        let finer = simulate_on(scene, motions, halved(scene, mesh)?, options.progress)?;
        ErrorEstimate {
            relative: difference(&passes, &finer),
            method: "measured against a run with half the node spacing and vehicle step".into(),
        }
    } else if let Some(coarse) = &coarse {
        ErrorEstimate {
            relative: ERROR_SHARE * difference(&passes, coarse),
            method: "half the difference to a run with twice the node spacing and vehicle step".into(),
        }
    } else {
        warnings.push("the node spacing is too coarse to estimate the error".into());
        ErrorEstimate {
            relative: 1.0,
            method: "none: the duct is too short for a mesh twice as coarse".into(),
        }
    };
    let reason = if chosen {
        "node spacing and vehicle step: as the scene asks".into()
    } else {
        format!(
            "node spacing and vehicle step: {:.0} nodes per depth of the duct keep the error within {} %",
            scene.duct.depth / mesh.spacing(),
            100.0 * tolerance
        )
    };
    Ok(Solved {
        mesh,
        passes,
        error,
        reason,
    })
}

/// Runs two computations side by side; the first error wins.
fn both<A: Send, B: Send>(
    first: impl FnOnce() -> Result<A, Error> + Send,
    second: impl FnOnce() -> Result<B, Error> + Send,
) -> Result<(A, B), Error> {
    thread::scope(|scope| {
        let handle = scope.spawn(second);
        let first = first();
        // A panic of the other thread goes on in this one.
        let second = handle
            .join()
            .unwrap_or_else(|panic| std::panic::resume_unwind(panic));
        Ok((first?, second?))
    })
}

fn simulate_on(
    scene: &Scene,
    motions: &[DuctMotion],
    mesh: Mesh,
    progress: Option<&(dyn Fn(f64) + Sync)>,
) -> Result<Passes, Error> {
    let done = AtomicU64::new(0);
    simulate(scene, motions, mesh, || {
        if let Some(progress) = progress {
            let done = done.fetch_add(1, Ordering::Relaxed) + 1;
            progress(done as f64 / scene.traffic.passes as f64);
        }
    })
}

fn first_mesh(scene: &Scene) -> Result<Mesh, Error> {
    let length = scene.duct.length;
    let natural =
        scene.duct.depth / NODES_PER_DEPTH * (scene.solver.tolerance / 0.01).sqrt().clamp(0.25, 2.0);
    let spacing = scene.solver.node_spacing.unwrap_or_else(|| {
        let step = scene.solver.vehicle_step.unwrap_or(0.0);
        natural.max(step).min(length / 8.0)
    });
    let step = scene.solver.vehicle_step.unwrap_or(spacing / STEPS_PER_SPACING);
    Ok(Mesh::new(length, spacing, step)?)
}

/// The mesh twice as coarse; `None` where the duct is too short for one.
fn coarser(scene: &Scene, mesh: Mesh) -> Option<Mesh> {
    Mesh::new(scene.duct.length, 2.0 * mesh.spacing(), 2.0 * mesh.vehicle_step()).ok()
}

fn halved(scene: &Scene, mesh: Mesh) -> Result<Mesh, Error> {
    Ok(Mesh::new(
        scene.duct.length,
        0.5 * mesh.spacing(),
        0.5 * mesh.vehicle_step(),
    )?)
}

/// Largest difference of a force after a pass, as a share of the largest force after that pass.
fn difference(a: &Passes, b: &Passes) -> f64 {
    let transient = a.outcomes.iter().fold(0.0_f64, |largest, outcome| {
        [
            outcome.peak.upstream,
            outcome.peak.downstream,
            outcome.lowest.upstream,
            outcome.lowest.downstream,
        ]
        .into_iter()
        .map(f64::abs)
        .fold(largest.max(outcome.max_compression.abs()), f64::max)
    });
    let forces = |outcome: &PassOutcome| {
        [
            outcome.force.upstream,
            outcome.force.downstream,
            outcome.max_compression,
        ]
    };
    let mut worst = 0.0_f64;
    for (a, b) in a.outcomes.iter().zip(&b.outcomes) {
        let scale = forces(a)
            .into_iter()
            .map(f64::abs)
            .fold(SMALL_FORCE * transient, f64::max);
        for (a, b) in forces(a).into_iter().zip(forces(b)) {
            if a != b {
                worst = worst.max((a - b).abs() / scale);
            }
        }
    }
    worst
}

/// The force that a load cell would show: at the end that is held, the larger one of two, and inside the cable where none
/// is; and its largest value while vehicles pass.
fn force_series(scene: &Scene, outcomes: &[PassOutcome]) -> (Vec<f64>, f64) {
    let pick = |force: fn(&PassOutcome) -> f64, peak: fn(&PassOutcome) -> f64| {
        let scale = outcomes
            .iter()
            .map(peak)
            .fold(0.0, |largest: f64, p| largest.max(p.abs()));
        (outcomes.iter().map(force).collect::<Vec<_>>(), scale)
    };
    let upstream = || {
        pick(
            |o| o.force.upstream,
            |o| o.peak.upstream.abs().max(o.lowest.upstream.abs()),
        )
    };
    let downstream = || {
        pick(
            |o| o.force.downstream,
            |o| o.peak.downstream.abs().max(o.lowest.downstream.abs()),
        )
    };
    match (scene.ends.upstream, scene.ends.downstream) {
        (End::Free, End::Free) => pick(|o| o.max_compression, |o| o.max_compression),
        (_, End::Free) => upstream(),
        (End::Free, _) => downstream(),
        _ => {
            let last = outcomes
                .last()
                .map_or((0.0, 0.0), |o| (o.force.upstream, o.force.downstream));
            if last.0.abs() > last.1.abs() {
                upstream()
            } else {
                downstream()
            }
        }
    }
}

/// All passes, or of very many the first ones and then evenly growing numbers, the last among them.
fn listed(outcomes: &[PassOutcome]) -> Vec<PassRecord> {
    let count = outcomes.len() as u64;
    let mut records = Vec::new();
    let mut next = 1;
    for (index, outcome) in outcomes.iter().enumerate() {
        let pass = index as u64 + 1;
        if count <= ALL_LISTED || pass == next || pass == count {
            records.push(PassRecord::new(pass, outcome));
            next = (pass + 1).max(pass * 101 / 100);
        }
    }
    records
}
