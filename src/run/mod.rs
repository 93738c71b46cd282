//! Carrying a plan out: the passes on meshes or by the pass law, and the answer.

mod assemble;
pub mod law;
pub mod passes;
mod refine;
mod solver;

use ground_field::GroundField;

use crate::plan::{PassMethod, Plan, plan, plan_on};
use crate::{Error, Progress, Run, Scene, finite};
use assemble::RunBuilder;
use refine::Refinement;

/// How to run.
#[derive(Default, Clone, Copy)]
pub struct RunOptions<'a> {
    /// Measure the error by a run on a mesh twice as fine instead of estimating it.
    pub verify: bool,
    /// Called after each pass; it may stop the run.
    pub progress: Progress<'a>,
    /// A ground model of one's own, in place of the scene's.
    pub ground: Option<&'a dyn GroundField>,
    /// Passes at which to look at the cable, for [`Run::stages`]; those beyond the scene's are left out.
    pub stages: &'a [u64],
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
    run_plan(&plan_on(scene, options.ground)?, options)
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
    let run = answer(plan, options)?;
    finite::check(&run)?;
    Ok(run)
}

fn answer(plan: &Plan<'_>, options: &RunOptions<'_>) -> Result<Run, Error> {
    let mut answer = RunBuilder::new(plan);
    if plan.scene.friction_limit() == 0.0 {
        return answer.without_friction(options.stages);
    }
    if plan.choice.method == PassMethod::Law {
        let law = law::run(plan, options.stages);
        match law.and_then(|law| answer.trusted(law)) {
            Ok(law) => return Ok(answer.by_law(law)),
            Err(error) if !plan.choice.may_simulate => return Err(error),
            Err(error) => answer.gives_up_the_law(&error),
        }
    }
    let refinement = Refinement {
        plan,
        method: plan.choice.method.cable_method(),
        progress: options.progress,
        stages: options.stages,
    };
    let solved = refinement.solve(options.verify, &mut answer.warnings)?;
    answer.by_simulation(&solved)
}
