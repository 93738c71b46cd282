//! Carrying a plan out: the passes on ever finer meshes, and the answer.

mod assemble;

use std::sync::Arc;

use crate::answer::error_estimate::{self, ErrorParts};
use crate::passes::{FixedMesh, PassSolver, RunOptions, Task};
use crate::refine::{Solved, judge};
use crate::{Run, days, jumps};
use assemble::{assemble, without_friction};
use creepage_plan::{
    Error, Plan, finite,
    ground::{Ground, road},
    plan, plan_over,
};
use creepage_scene::{Scene, SolverMethod};

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
    carry_out(&plan, options)
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
    carry_out(plan, options).map(|(run, _)| run)
}

/// Whether there may be an answer where every pass is simulated.
fn may_help(error: &Error) -> bool {
    match error {
        Error::Jumps(_) => true,
        Error::Inaccurate { cause, .. } => cause.is_skipping(),
        _ => false,
    }
}

/// A friction law that loses more than this share of the stored force in one pass gives no answer.
const LARGEST_LEAK: f64 = 0.9;

/// Says what limits the time step of an explicit solver; warns of a friction law that loses some of
/// the stored force, and refuses one that loses too much.
fn time_steps(plan: &Plan<'_>, solved: &mut Solved) -> Result<(), Error> {
    let solver = PassSolver::new(&Task::of(plan, plan.scene, solved.mesh))?;
    let Some((limits, leaks)) = solver.time_steps() else {
        return Ok(());
    };
    solved.reasons.push(limits);
    for leak in leaks.iter().filter(|leak| leak.matters()) {
        if leak.loss_per_pass > LARGEST_LEAK {
            return Err(Error::unfit("friction.law", "sigmoid", leak.to_string()));
        }
        solved.warnings.push(leak.to_string());
    }
    Ok(())
}

fn carry_out(plan: &Plan<'_>, options: &RunOptions<'_>) -> Result<(Run, Option<FixedMesh>), Error> {
    let scene = plan.scene;
    if let Some(start) = plan.start {
        start.check(scene)?;
    }
    let error = ErrorParts::new(plan.ground.accuracy, plan.inertia());
    // What no mesh makes smaller.
    error_estimate::judge(&error, scene.solver.tolerance)?;
    let solve = |method| {
        if scene.friction_limit() == 0.0 {
            return without_friction(plan, options.stages);
        }
        let mut solved = match scene.warming() {
            Some(heat) => days::solve(plan, heat, method, options, error),
            None => jumps::solve(plan, method, options, error),
        }?;
        if method == SolverMethod::Explicit {
            time_steps(plan, &mut solved)?;
        }
        judge(&solved.error, plan, &mut solved.warnings)?;
        Ok(solved)
    };
    let every_pass = match plan.method {
        SolverMethod::PassLaw => SolverMethod::QuasiStatic,
        own => own,
    };
    let is_free = scene.friction_limit() == 0.0;
    let mut method = if is_free { every_pass } else { plan.method };
    let mut reason = plan.reason.clone();
    let solved = match solve(method) {
        Err(error) if may_help(&error) && plan.may_simulate_all() => {
            method = every_pass;
            reason =
                format!("{reason}; jumps gave no answer here ({error}): every pass was simulated after all");
            solve(method)
        }
        solved => solved,
    }?;
    let run = assemble(plan, method, &reason, &solved)?;
    finite::check(&run)?;
    Ok((run, solved.shown))
}
