//! The passes of a plan, every one simulated or few with jumps between them that are good enough,
//! on one mesh after the other.

mod draws;
mod jump_search;
mod random_spread;
mod scatter;
mod stand_ins;

use cycle_jump::Guide;

use crate::Progress;
use crate::answer::differences::{Scale, Shares, difference};
use crate::answer::error_estimate::ErrorParts;
use crate::answer::{FixedMesh, listed_passes};
use crate::passes::{Jumping, Passes, RunOptions, Task};
use crate::refine::{MeshLoop, OnMeshes, Solved, Work};
use crate::tuning::meshes::{FINDING, MANY, WEIGHT_ALONE, WEIGHTS, WEIGHTS_OF_MANY};
use creepage_plan::{Error, Levels, Plan};
use creepage_scene::{Scene, SolverMethod};
use jump_search::Found;

/// Simulates the passes of a plan.
#[derive(Clone, Copy)]
struct PassSimulator<'a> {
    plan: &'a Plan<'a>,
    scale: Scale,
    stages: &'a [u64],
    /// How jumps are taken on any level; none if every pass is simulated.
    jumping: Option<Jumping<'a>>,
    /// Where they were found: passes that are not simulated again.
    found: Option<&'a Found>,
    /// What all passes have cost.
    work: &'a Work,
}

/// Carries `plan` out by `method`, where `error` has what no mesh makes smaller.
pub fn solve(
    plan: &Plan<'_>,
    method: SolverMethod,
    options: &RunOptions<'_>,
    mut error: ErrorParts,
) -> Result<Solved, Error> {
    let work = Work::default();
    let mut simulator = PassSimulator {
        plan,
        scale: Scale::new(plan.scene, &plan.ground.motions),
        stages: options.stages,
        jumping: None,
        found: None,
        work: &work,
    };
    let jumps = method == SolverMethod::PassLaw;
    // The scatter of random orders is every run's own.
    let fits = |known: &FixedMesh| !jumps || known.jumps.is_some() && !plan.period.reordered;
    let known = options.mesh.filter(|_| plan.levels.named).filter(fits);
    let is_found = jumps && known.is_none();
    let begin = if is_found { FINDING } else { 0.0 };
    let search = || jump_search::find(simulator, options.progress.part(0.0, begin));
    let found = is_found.then(search).transpose()?;
    let known_jumps = known.and_then(|known| known.jumps).filter(|_| jumps);
    let good_enough = found
        .as_ref()
        .map(|found| (found.size, found.error_of(&found.passes)))
        .or(known_jumps);
    if let Some((size, left)) = good_enough {
        let mut jumping = Jumping::new(&plan.period, size);
        if let Some(found) = &found {
            jumping.guide = Guide::Follow(&found.passes.schedule);
        }
        (simulator.jumping, error.passes) = (Some(jumping), left);
    }
    simulator.found = found.as_ref();
    let meshes = MeshLoop {
        plan,
        options,
        simulation: &simulator,
        below: if known.is_some() { 0 } else { plan.levels.first },
        known_error: known.map(|known| known.error),
    };
    let mut solved = meshes.refine(plan.levels.first, options.progress.part(begin, 1.0), error)?;
    solved.shown = Some(FixedMesh {
        error: solved.error.mesh,
        jumps: good_enough.map(|(size, _)| (size, solved.error.passes)),
    });
    if let Some(found) = &found {
        if let Some(draws) = &found.draws {
            draws.correct(&mut solved.passes);
        }
        let task = Task::of(plan, plan.scene, plan.levels.mesh(found.level)?);
        solved.random = random_spread::spread(&task, &found.passes.state, &solved.passes, &work)?;
    }
    solved.statistics = work.into_inner();
    Ok(solved)
}

impl OnMeshes for PassSimulator<'_> {
    fn simulate(
        &self,
        scene: &Scene,
        level: usize,
        _: Option<&Passes>,
        progress: Progress<'_>,
        answer: bool,
    ) -> Result<Passes, Error> {
        let levels = &self.plan.levels;
        let is_plain = std::ptr::eq(scene, self.plan.scene);
        let is_same = |found: &&Found| is_plain && found.level == level && !found.passes.has_rejected;
        if let Some(found) = self.found.filter(is_same) {
            return Ok(found.passes.clone());
        }
        let mut task = Task::of(self.plan, scene, levels.mesh(level)?);
        task.stages = if answer { self.stages } else { &[] };
        task.progress = progress;
        let passes = match self.jumping {
            Some(mut jumping) => {
                jumping.max_passes = levels.affordable_passes(level);
                jumping.beyond = answer;
                task.with_jumps(&jumping, &listed_passes(scene, jumping.period))
            }
            None => task.every_pass(),
        }?;
        *self.work.borrow_mut() += passes.statistics;
        Ok(passes)
    }

    fn difference(&self, one: &Passes, other: &Passes) -> Shares {
        difference(&one.records, &other.records, self.scale)
    }

    fn passes_error(&self, passes: &Passes, found: Shares) -> Shares {
        self.found.map_or(found, |jumps| jumps.error_of(passes))
    }

    /// A scheme of second order leaves a third of the last difference and a twelfth of the one before.
    /// Friction that turns at a node or between two makes the sequence uneven, and two meshes may
    /// agree by chance. So more is counted: the largest of a share of each difference seen so far,
    /// and never less than what is typical of the level.
    fn mesh_error(&self, level: usize, meshes: &[Passes]) -> Shares {
        let passes = meshes.last().map_or(0, |finest| finest.records.len());
        let weights = match meshes.len() {
            2 => &[WEIGHT_ALONE][..],
            _ if passes < MANY => &WEIGHTS,
            _ => &WEIGHTS_OF_MANY,
        };
        let weighted = |(pair, &weight): (&[Passes], &f64)| self.difference(&pair[1], &pair[0]).times(weight);
        let error: Shares = meshes.windows(2).rev().zip(weights).map(weighted).collect();
        error.max(Shares::both(Levels::typical_error(level)))
    }
}
