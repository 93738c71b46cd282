//! What a run makes of a scene, and whether that can be true.

use std::ops::ControlFlow;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::{Duration, Instant};

use creepage::cable_dem::CableError;
use creepage::scene::End;
use creepage::{Error, ErrorSource, PassRecord, Progress, Run, RunOptions, Scene};

use crate::largest;

/// Scenes whose plan states a longer time \[s\] are not run.
const LONGEST: f64 = 0.5;
/// Time after which a run that was to take less than [`LONGEST`] is given up.
const GIVEN_UP: Duration = Duration::from_secs(100);
/// An error that is allowed.
const SMALL: f64 = 0.1;
/// Interpolation of forces within jumps, as a share of the largest.
const ROUNDING: f64 = 0.01;
/// A fixed end stays where it is \[m\].
const STILL: f64 = 1e-9;

/// What comes of a scene.
#[derive(Debug, Clone, PartialEq)]
pub enum Outcome {
    /// An answer that can be true.
    Right,
    /// An answer that cannot, or a panic.
    Wrong(String),
    /// The scene is wrong, names a mesh that is too coarse or a road that is too short, or has inertia that its method leaves out.
    Input(String),
    /// No answer within 10 %, or none that jumps find.
    Refused(String),
    /// Given up.
    Late(String),
    /// Planned to take too long for this test.
    Long(f64),
}

impl Outcome {
    pub fn name(&self) -> &'static str {
        match self {
            Self::Right => "right",
            Self::Wrong(_) => "wrong",
            Self::Input(_) => "input",
            Self::Refused(_) => "refused",
            Self::Late(_) => "late",
            Self::Long(_) => "long",
        }
    }
}

/// What comes of the scene `text`, and its answer if there is one.
pub fn judged(text: &str) -> (Outcome, Option<Run>) {
    match catch_unwind(AssertUnwindSafe(|| outcome(text))) {
        Ok(judged) => judged,
        Err(_) => (Outcome::Wrong("panic".to_owned()), None),
    }
}

fn outcome(text: &str) -> (Outcome, Option<Run>) {
    let scene = match Scene::from_toml("scene.toml", text) {
        Ok(scene) => scene,
        Err(error) => return (Outcome::Input(error.to_string()), None),
    };
    let seconds = match creepage::plan(&scene) {
        Ok(plan) => plan.report().estimated_seconds,
        Err(error) => return (refused(&scene, &error), None),
    };
    if seconds > LONGEST {
        return (Outcome::Long(seconds), None);
    }
    let run = match run(&scene) {
        Ok(run) => run,
        Err(Error::Stopped) => return (Outcome::Late(format!("planned {seconds:.1} s")), None),
        Err(error) => return (refused(&scene, &error), None),
    };
    let outcome = possible(&scene, &run).map_or_else(Outcome::Wrong, |()| Outcome::Right);
    (outcome, Some(run))
}

/// The run of a scene, unless it takes longer than `GIVEN_UP`.
pub fn run(scene: &Scene) -> Result<Run, Error> {
    let begun = Instant::now();
    let watch = |_: f64| {
        if begun.elapsed() > GIVEN_UP {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    };
    let options = RunOptions {
        progress: Progress::new(&watch),
        ..RunOptions::default()
    };
    creepage::run_with(scene, &options)
}

fn refused(scene: &Scene, error: &Error) -> Outcome {
    let solver = &scene.solver;
    let has_own_mesh = solver.node_spacing.is_some() || solver.vehicle_step.is_some();
    let is_due_to_scene = match error {
        Error::Scene(_) | Error::Unfit { .. } | Error::TooManyNodes { .. } => true,
        Error::Inaccurate { cause, .. } => match cause {
            ErrorSource::Inertia => true,
            ErrorSource::Mesh => has_own_mesh,
            ErrorSource::Road => solver.approach.is_some(),
            _ => false,
        },
        Error::Cable(CableError::CoarseMesh { .. }) => has_own_mesh,
        Error::Cable(CableError::UnstableStep { .. }) => solver.time_step.is_some(),
        _ => false,
    };
    if is_due_to_scene {
        Outcome::Input(error.to_string())
    } else {
        Outcome::Refused(error.to_string())
    }
}

/// Whether an answer can be true; else why not.
fn possible(scene: &Scene, run: &Run) -> Result<(), String> {
    let (first, last) = (&run.passes[0], &run.passes[run.passes.len() - 1]);
    if (first.pass, last.pass) != (1, scene.traffic.passes) {
        return Err("passes are missing".to_owned());
    }
    let of_passes = run.passes.iter().flat_map(|record| {
        let ends = [record.upstream_force_n, record.downstream_force_n];
        ends.into_iter().chain([record.max_compression_n])
    });
    let along = run.force_profile.force_n.iter().copied();
    let largest = largest(of_passes.chain(along)).max(1e-9);
    // Any error is allowed of forces that are small relative to friction on a length as the duct is deep.
    let small = SMALL * scene.duct.depth * scene.friction_limit() / largest;
    let (stated, allowed) = (run.error_estimate.relative, scene.solver.tolerance.max(SMALL));
    let is_told = run.warnings.iter().any(|warning| warning.contains("so small"));
    if !(0.0..=allowed.max(small)).contains(&stated) || is_told != (stated > allowed) {
        return Err(format!("an error of {stated}"));
    }
    for (index, record) in run.passes.iter().enumerate() {
        let clamps = run
            .restraints
            .iter()
            .map(|clamp| clamp.after_passes_n[index].abs());
        let clamps: Vec<f64> = clamps.collect();
        can_be(scene, record, clamps.iter().sum(), largest)
            .map_err(|why| format!("pass {}: {why}", record.pass))?;
        for (clamp, force) in scene.restraints.iter().zip(clamps) {
            if force > (1.0 + ROUNDING) * clamp.holds.unwrap_or(f64::INFINITY) + ROUNDING * largest {
                return Err(format!(
                    "pass {}: {force} N on a clamp that holds {:?} N",
                    record.pass, clamp.holds
                ));
            }
        }
    }
    Ok(())
}

/// Each end carries what holds it, and both together no more than friction, weight and `clamps` leave between them.
fn can_be(scene: &Scene, record: &PassRecord, clamps: f64, largest: f64) -> Result<(), String> {
    let numbers = [
        record.upstream_force_n,
        record.downstream_force_n,
        record.max_compression_n,
        clamps,
        record.upstream_peak_n,
        record.downstream_peak_n,
        record.upstream_least_n,
        record.downstream_least_n,
        record.upstream_displacement_m,
        record.downstream_displacement_m,
    ];
    if numbers.iter().any(|number| !number.is_finite()) {
        return Err("what is not finite".to_owned());
    }
    let ends = [
        (
            scene.ends.upstream,
            record.upstream_force_n,
            -record.upstream_displacement_m,
        ),
        (
            scene.ends.downstream,
            record.downstream_force_n,
            record.downstream_displacement_m,
        ),
    ];
    for (end, force, inward) in ends {
        let holds = match end {
            End::Free => force.abs() <= ROUNDING * largest,
            End::Fixed => inward.abs() <= STILL,
            End::Spring(stiffness) => (force - stiffness * inward).abs() <= ROUNDING * largest,
        };
        if !holds {
            return Err(format!("{end:?} with {force} N at {inward} m"));
        }
    }
    // In a bend friction grows with the force in the cable, here the largest of all that are known.
    let of_sections = scene
        .sections()
        .into_iter()
        .map(|section| (section.limit_under(largest) + section.body_force.abs()) * section.length);
    let carried = of_sections.sum::<f64>() + clamps;
    let between = (record.downstream_force_n - record.upstream_force_n).abs();
    if between > (1.0 + ROUNDING) * carried {
        return Err(format!("{between} N between the ends, {carried} N at most"));
    }
    Ok(())
}
