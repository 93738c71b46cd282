//! Carrying a plan out: the passes on ever finer meshes, and the answer.

mod assemble;

use std::sync::Arc;

use crate::answer::error_estimate::{self, ErrorParts};
use crate::passes::{PassSolver, RunOptions, Task};
use crate::refine::{Solved, judge};
use crate::{Run, days, jumps};
use assemble::{assemble, without_friction};
use creepage_plan::{
    Error, Plan, finite,
    ground::{Ground, road},
    plan_over,
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
    let mut plan = plan_over(scene, ground)?;
    plan.start = options.start;
    run_plan(&plan, options)
}

/// Carries `plan` out; its ground is that of the plan.
///
/// # Errors
///
/// [`Error`] when the computation fails.
pub fn run_plan(plan: &Plan<'_>, options: &RunOptions<'_>) -> Result<Run, Error> {
    if let Some(start) = plan.start {
        start.check(plan.scene)?;
    }
    let every_pass = match plan.method {
        SolverMethod::PassLaw => SolverMethod::QuasiStatic,
        own => own,
    };
    let is_free = plan.scene.friction_limit() == 0.0;
    let mut method = if is_free { every_pass } else { plan.method };
    let mut reason = plan.reason.clone();
    let mut solved = solve(plan, method, options);
    if let Err(error) = &solved
        && may_help(error)
        && plan.may_simulate_all()
    {
        reason = format!("{reason}; jumps gave no answer here ({error}): every pass was simulated after all");
        method = every_pass;
        solved = solve(plan, method, options);
    }
    let run = assemble(plan, method, &reason, solved?)?;
    finite::check(&run)?;
    Ok(run)
}

/// Whether there may be an answer where every pass is simulated.
fn may_help(error: &Error) -> bool {
    match error {
        Error::Jumps(_) => true,
        Error::Inaccurate { cause, .. } => cause.is_skipping(),
        _ => false,
    }
}

fn solve(plan: &Plan<'_>, method: SolverMethod, options: &RunOptions<'_>) -> Result<Solved, Error> {
    let scene = plan.scene;
    let error = ErrorParts::new(plan.ground.accuracy, plan.inertia());
    // What no mesh makes smaller.
    error_estimate::judge(&error, scene.solver.tolerance)?;
    if scene.friction_limit() == 0.0 {
        return without_friction(plan, options.stages);
    }
    let mut solved = match scene.warming() {
        Some(heat) => days::solve(plan, heat, method, options, error),
        None => jumps::solve(plan, method, options, error),
    }?;
    if method == SolverMethod::Explicit {
        let solver = PassSolver::new(&Task::of(plan, scene, solved.mesh))?;
        solver.time_steps(&mut solved.reasons, &mut solved.warnings)?;
    }
    judge(&solved.error, plan, &solved.passes, &mut solved.warnings)?;
    Ok(solved)
}
