//! A whole run: ground, motion, passes, and their discretisation error.
//!
//! The passes are computed on a mesh, on one twice and on one four times as coarse. From the differences between them the
//! error is estimated; where it exceeds the tolerance all meshes are halved. A scheme of second order leaves a third of the
//! first difference and a twelfth of the second; more than twice that is counted, and the larger of both, as two meshes
//! may agree by chance.

use std::sync::atomic::{AtomicU64, Ordering};
use std::thread;

use cable_dem::{Mesh, PassOutcome};
use ground_field::{DuctMotion, GroundField};

use super::cable::{self, CableMethod, PassMethod};
use super::passes::{Passes, simulate};
use super::result::{
    Cost, DuctMotionSummary, ErrorEstimate, ForceProfile, PassRecord, PlanSummary, RestraintRecord, Run,
    SlipRecord,
};
use super::saturation::saturation;
use super::{ground, law, motion};
use crate::scene::End;
use crate::{Error, Scene};

/// Nodes per depth of the duct at a tolerance of 1 %; the error falls with the square of the spacing.
const NODES_PER_DEPTH: f64 = 12.0;
/// Steps of the vehicle per node spacing.
const STEPS_PER_SPACING: f64 = 2.0;
/// Shares of the differences to the mesh twice as coarse, and between that and the one four times as coarse, that count as
/// error.
const ERROR_SHARES: [f64; 2] = [0.75, 0.3];
/// What the error is beside the difference to a mesh half as coarse, at second order.
const VERIFIED_SHARE: f64 = 4.0 / 3.0;
/// Halvings of the mesh after which a run gives its best answer with a warning, and nodes eliminated in all passes beyond
/// which it halves no more: about ten seconds.
const MAX_HALVINGS: usize = 4;
const MAX_NODE_UPDATES: usize = 500_000_000;
/// A mesh half as coarse takes about this many times the node updates.
const HALVING_COST: usize = 4;
/// A larger error than this, or the tolerance if that is larger still, is no answer.
const DOUBTFUL: f64 = 0.1;
/// A law that loses more than this share of the stored force in one pass gives no answer.
const LARGEST_LEAK: f64 = 0.9;
/// Most passes that are computed one by one.
const MAX_PASSES: u64 = 1_000_000;
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
    /// A ground model of one's own, in place of the scene's.
    pub ground: Option<&'a dyn GroundField>,
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
    let (method, reason) = cable::choose(scene)?;
    let ground = match options.ground {
        Some(field) => ground::own(field),
        None => ground::choose(scene)?,
    };
    let motions = motion::motions(scene, &ground, motion::reach(scene))?;
    let duct_motion = DuctMotionSummary {
        peak_longitudinal_m: motions[0].peak_longitudinal(),
        peak_vertical_m: motions[0].peak_vertical(),
    };
    let mut plan = PlanSummary {
        ground: ground.name.into(),
        cable: method.name().into(),
        node_spacing_m: 0.0,
        vehicle_step_m: 0.0,
        reasons: vec![
            format!("ground {}: {}", ground.name, ground.reason),
            format!("cable {}: {reason}", method.name()),
            approach_reason(scene, &motions),
        ],
    };
    let title = scene.title.clone();
    let method = match method {
        PassMethod::EveryPass(method) => method,
        PassMethod::Law => {
            let law = law::run(scene, &motions)?;
            (plan.node_spacing_m, plan.vehicle_step_m) = (law.node_spacing, law.vehicle_step);
            return Ok(Run {
                title,
                plan,
                duct_motion,
                passes: law.passes,
                saturation: law.saturation,
                force_profile: law.force_profile,
                restraints: law.restraints,
                slip_lengths: None,
                error_estimate: law.error,
                cost: law.cost,
                warnings: law.warnings,
            });
        }
    };
    let task = Task {
        scene,
        method,
        motions: &motions,
        progress: options.progress,
    };
    let mut warnings = Vec::new();
    let solved = task.solve(options.verify, &mut warnings)?;
    for leak in solved.passes.leaks.iter().filter(|leak| leak.matters()) {
        if leak.loss_per_pass > LARGEST_LEAK {
            return Err(Error::Unfit {
                key: "friction.law",
                found: "sigmoid",
                reason: leak.to_string().into(),
            });
        }
        warnings.push(leak.to_string());
    }
    (plan.node_spacing_m, plan.vehicle_step_m) = (solved.mesh.spacing(), solved.mesh.vehicle_step());
    plan.reasons.push(solved.reason.clone());
    plan.reasons.extend(solved.passes.step_limits.clone());
    let passes = &solved.passes.outcomes;
    let (series, scale) = force_series(scene, passes);
    Ok(Run {
        title,
        plan,
        duct_motion,
        passes: listed(passes),
        saturation: saturation(&series, scale),
        force_profile: force_profile(&solved),
        restraints: restraints(&solved),
        slip_lengths: solved.passes.slip.map(|slip| SlipRecord {
            forward_m: slip.forward,
            backward_m: slip.backward,
        }),
        error_estimate: solved.error.clone(),
        cost: Cost::new(&solved.passes.statistics),
        warnings,
    })
}

/// From where vehicles come, and what is left out of account by that.
fn approach_reason(scene: &Scene, motions: &[DuctMotion]) -> String {
    let approach = motion::approach(scene);
    let left = motions.iter().fold(0.0_f64, |left, motion| {
        let far = motion
            .longitudinal(approach)
            .abs()
            .max(motion.longitudinal(-approach).abs());
        if far > 0.0 {
            left.max(far / motion.peak_longitudinal())
        } else {
            left
        }
    });
    format!(
        "vehicles come from and leave to {approach} m beyond the duct (solver.approach), where its end is {:.1} % of the peak \
         from its place",
        100.0 * left
    )
}

/// Checks that the parts of `scene` fit together, without computing any pass.
///
/// # Errors
///
/// As for [`run`].
pub fn check(scene: &Scene) -> Result<(), Error> {
    ground::choose(scene)?;
    cable::cable(scene)?;
    first_mesh(scene)?;
    match cable::choose(scene)?.0 {
        PassMethod::EveryPass(_) => check_passes(scene),
        PassMethod::Law => Ok(()),
    }
}

/// Passes are computed one by one, and all are kept.
fn check_passes(scene: &Scene) -> Result<(), Error> {
    if scene.traffic.passes > MAX_PASSES {
        return Err(Error::Unfit {
            key: "traffic.passes",
            found: "more than a million passes",
            reason: "one by one they would take days, and the pass law does not apply here".into(),
        });
    }
    Ok(())
}

/// Passes on the mesh that was good enough.
struct Solved {
    mesh: Mesh,
    passes: Passes,
    error: ErrorEstimate,
    reason: String,
}

/// What is to be computed on whatever mesh.
#[derive(Clone, Copy)]
struct Task<'a> {
    scene: &'a Scene,
    method: CableMethod,
    motions: &'a [DuctMotion],
    progress: Option<&'a (dyn Fn(f64) + Sync)>,
}

impl Task<'_> {
    /// Refines until the estimated error is within the tolerance, unless the scene says how fine to be.
    fn solve(&self, verify: bool, warnings: &mut Vec<String>) -> Result<Solved, Error> {
        let Self { scene, .. } = *self;
        check_passes(scene)?;
        let tolerance = scene.solver.tolerance;
        // A law without memory is one of the time step: there is no limit to refine towards.
        let chosen = scene.solver.node_spacing.is_some()
            || scene.solver.vehicle_step.is_some()
            || (self.method == CableMethod::Explicit && scene.solver.time_step.is_some())
            || !scene.friction.law.has_memory();
        let mut mesh = first_mesh(scene)?;
        let (mut passes, (mut coarse, mut coarser)) = both(
            || self.simulate(mesh, true),
            || {
                let simulate = |mesh: Option<Mesh>| mesh.map(|mesh| self.simulate(mesh, false)).transpose();
                let twice = self.coarser(mesh);
                Ok((
                    simulate(twice)?,
                    simulate(twice.and_then(|mesh| self.coarser(mesh)))?,
                ))
            },
        )?;
        let mut halvings = 0;
        let mut estimate;
        loop {
            estimate = coarse.as_ref().map(|coarse| {
                let second = coarser
                    .as_ref()
                    .map_or(0.0, |coarser| difference(coarse, coarser));
                (ERROR_SHARES[0] * difference(&passes, coarse)).max(ERROR_SHARES[1] * second)
            });
            let enough = estimate.is_none_or(|estimate| estimate <= tolerance);
            let costly = HALVING_COST.saturating_mul(passes.statistics.node_updates) > MAX_NODE_UPDATES;
            if enough || chosen || costly || halvings == MAX_HALVINGS {
                break;
            }
            let finer = halved(scene, mesh)?;
            coarser = coarse;
            coarse = Some(std::mem::replace(&mut passes, self.simulate(finer, true)?));
            mesh = finer;
            halvings += 1;
        }
        let error = if verify {
            let finer = self.simulate(halved(scene, mesh)?, true)?;
            ErrorEstimate {
                relative: VERIFIED_SHARE * difference(&passes, &finer),
                method: "measured against a run with half the node spacing and vehicle step".into(),
            }
        } else if let Some(relative) = estimate {
            ErrorEstimate {
                relative,
                method: if scene.friction.law.has_memory() {
                    "from runs with two and four times the node spacing and vehicle step".into()
                } else {
                    "of the node spacing alone: the sigmoid's answer is one of its time step".into()
                },
            }
        } else {
            warnings.push("the node spacing is too coarse to estimate the error".into());
            ErrorEstimate {
                relative: 1.0,
                method: "none: the duct is too short for a mesh twice as coarse".into(),
            }
        };
        if !chosen && error.relative > tolerance.max(DOUBTFUL) {
            return Err(Error::Inaccurate {
                reached: error.relative,
                asked: tolerance,
            });
        }
        if error.relative > tolerance {
            warnings.push(format!(
                "the estimated error of {:.2} % exceeds the tolerance of {:.2} %",
                100.0 * error.relative,
                100.0 * tolerance
            ));
        }
        let depths = format!(
            "node spacing and vehicle step: {:.0} nodes per depth of the duct",
            scene.duct.depth / mesh.spacing()
        );
        let reason = if scene.solver.node_spacing.is_some() || scene.solver.vehicle_step.is_some() {
            format!("{depths}, as the scene asks")
        } else {
            format!("{depths}; {} % asked", 100.0 * tolerance)
        };
        Ok(Solved {
            mesh,
            passes,
            error,
            reason,
        })
    }

    /// All passes on `mesh`; `shown` ones report their progress.
    fn simulate(&self, mesh: Mesh, shown: bool) -> Result<Passes, Error> {
        let done = AtomicU64::new(0);
        simulate(self.scene, self.method, self.motions, mesh, || {
            if let (true, Some(progress)) = (shown, self.progress) {
                let done = done.fetch_add(1, Ordering::Relaxed) + 1;
                progress(done as f64 / self.scene.traffic.passes as f64);
            }
        })
    }

    /// The mesh twice as coarse; `None` where the duct is too short for one.
    fn coarser(&self, mesh: Mesh) -> Option<Mesh> {
        let step = if self.scene.friction.law.has_memory() {
            2.0
        } else {
            1.0
        };
        Mesh::new(
            self.scene.duct.length,
            2.0 * mesh.spacing(),
            step * mesh.vehicle_step(),
        )
        .ok()
    }
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

fn force_profile(solved: &Solved) -> ForceProfile {
    let Passes { state, cable, .. } = &solved.passes;
    let force_n: Vec<f64> = state.element_forces(cable, &solved.mesh).collect();
    ForceProfile {
        positions_m: (0..force_n.len())
            .map(|i| solved.mesh.spacing() * (i as f64 + 0.5))
            .collect(),
        force_n,
    }
}

fn restraints(solved: &Solved) -> Vec<RestraintRecord> {
    let Passes { state, cable, .. } = &solved.passes;
    let forces = state.restraint_forces(cable, &solved.mesh);
    cable
        .restraints()
        .iter()
        .zip(forces)
        .map(|(restraint, force_n)| RestraintRecord {
            position_m: restraint.position,
            stiffness_n_per_m: restraint.stiffness,
            force_n,
        })
        .collect()
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
