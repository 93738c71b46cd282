//! Carrying a plan out: the passes on ever finer meshes, and the answer.

mod assemble;

use std::sync::Arc;

use crate::error_source::ErrorSource;
use crate::ground::{Ground, road};
use crate::passes::{FixedMesh, RunOptions};
use crate::plan::{PassMethod, Plan, plan, plan_over};
use crate::{Error, Run, Scene, days, finite, passes};
use assemble::RunBuilder;

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
    scene.validate()?;
    let ground = Ground::new(scene, options.ground, road::reach(scene))?;
    run_over(scene, Arc::new(ground), options)
}

/// Computes all passes of a valid `scene` over a `ground` that is known to be its own.
pub fn run_over(scene: &Scene, ground: Arc<Ground>, options: &RunOptions<'_>) -> Result<Run, Error> {
    run_shown(scene, ground, options).map(|(run, _)| run)
}

/// The same with what it has shown of its mesh.
pub fn run_shown(
    scene: &Scene,
    ground: Arc<Ground>,
    options: &RunOptions<'_>,
) -> Result<(Run, Option<FixedMesh>), Error> {
    let mut plan = plan_over(scene, ground)?;
    plan.start = options.start;
    let (run, shown) = answer(&plan, options)?;
    finite::check(&run)?;
    Ok((run, shown))
}

/// Checks that `scene` can be computed, without computing its passes.
///
/// # Errors
///
/// As for [`run`].
pub fn check(scene: &Scene) -> Result<(), Error> {
    plan(scene).map(|_| ())
}

/// Carries `plan` out; its ground is that of the plan.
///
/// # Errors
///
/// [`Error`] when the computation fails.
pub fn run_plan(plan: &Plan<'_>, options: &RunOptions<'_>) -> Result<Run, Error> {
    let (run, _) = answer(plan, options)?;
    finite::check(&run)?;
    Ok(run)
}

/// Whether there may be an answer where every pass is simulated.
fn may_help(error: &Error) -> bool {
    match error {
        Error::Jumps(_) => true,
        Error::Inaccurate { cause, .. } => matches!(cause, ErrorSource::Passes | ErrorSource::Days),
        _ => false,
    }
}

fn answer(plan: &Plan<'_>, options: &RunOptions<'_>) -> Result<(Run, Option<FixedMesh>), Error> {
    if let Some(start) = plan.start {
        start.check(plan.scene)?;
    }
    let mut answer = RunBuilder::new(plan);
    if plan.scene.friction_limit() == 0.0 {
        return Ok((answer.without_friction(options.stages)?, None));
    }
    let solve = |method, answer: &mut RunBuilder<'_>| {
        let warnings = &mut answer.warnings;
        if let Some(heat) = plan.scene.warming() {
            return days::solve(plan, heat, method, options, warnings);
        }
        passes::solve(plan, method, options, warnings)
    };
    let solved = match solve(plan.choice.method, &mut answer) {
        Err(error)
            if may_help(&error)
                && plan.choice.may_simulate
                && matches!(plan.choice.method, PassMethod::Jumps(_)) =>
        {
            answer.gives_up_jumps(&error);
            let every_pass = PassMethod::EveryPass(plan.choice.method.cable_method());
            solve(every_pass, &mut answer)?
        }
        solved => solved?,
    };
    Ok((answer.by_simulation(&solved)?, solved.shown))
}
