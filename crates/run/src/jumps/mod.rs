//! The passes of a plan, every one simulated or few with jumps between them that are good enough,
//! on one mesh after the other.

mod draws;
mod jump_search;
mod random_spread;

use cycle_jump::Guide;

use crate::Progress;
use crate::answer::differences::{Scale, Shares, difference};
use crate::answer::error_estimate::ErrorParts;
use crate::passes::{FixedMesh, JumpSize, Jumping, Passes, RunOptions, Task, listed_passes};
use crate::refine::{MeshLoop, OnMeshes, Solved, Work};
use crate::tuning::meshes::{FINDING, MANY, WEIGHT_ALONE, WEIGHTS, WEIGHTS_OF_MANY};
use creepage_plan::{Error, Levels, Period, Plan};
use creepage_scene::{Scene, SolverMethod};
use jump_search::Found;

/// A plan's passes, on whatever level.
#[derive(Clone, Copy)]
struct PassesOnMeshes<'a> {
    plan: &'a Plan<'a>,
    scale: Scale,
    /// Of the plan, or another one to compare it with.
    period: &'a Period,
    stages: &'a [u64],
    /// The jumps that are taken; none where every pass is simulated.
    jumps: Option<JumpSize>,
    /// Where they were found.
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
    let mut passes = PassesOnMeshes {
        plan,
        scale: Scale::new(plan.scene, &plan.ground.motions),
        period: &plan.period,
        stages: options.stages,
        jumps: None,
        found: None,
        work: &work,
    };
    let jumps = method == SolverMethod::PassLaw;
    // The scatter of random orders is every run's own.
    let fits = |known: &FixedMesh| !jumps || known.jumps.is_some() && !plan.period.reordered;
    let known = options.mesh.filter(|_| plan.levels.named).filter(fits);
    let is_found = jumps && known.is_none();
    let begin = if is_found { FINDING } else { 0.0 };
    let search = || jump_search::find(passes, options.progress.part(0.0, begin));
    let found = is_found.then(search).transpose()?;
    let known_jumps = known.and_then(|known| known.jumps).filter(|_| jumps);
    let good_enough = found.as_ref().map(|found| found.known).or(known_jumps);
    if let Some(jumps) = good_enough {
        (passes.jumps, error.passes) = (Some(jumps.size), jumps.error);
    }
    passes.found = found.as_ref();
    let meshes = MeshLoop {
        plan,
        options,
        simulation: &passes,
        below: if known.is_some() { 0 } else { plan.levels.first },
        known_error: known.map(|known| known.error),
    };
    let mut solved = meshes.refine(plan.levels.first, options.progress.part(begin, 1.0), error)?;
    solved.shown = Some(FixedMesh {
        error: solved.error.mesh,
        jumps: good_enough,
    });
    if let Some(found) = &found {
        if let Some(draws) = &found.draws {
            draws.correct(&mut solved.passes);
        }
        let task = Task::of(plan, plan.scene, plan.levels.mesh(found.level)?);
        let (spread, cost) = random_spread::spread(&task, &found.passes.state, &solved.passes)?;
        solved.random = spread;
        work.add(cost);
    }
    solved.statistics = work.get();
    Ok(solved)
}

impl OnMeshes for PassesOnMeshes<'_> {
    fn simulate(
        &self,
        scene: &Scene,
        level: usize,
        _: Option<&Passes>,
        progress: Progress<'_>,
        answer: bool,
    ) -> Result<Passes, Error> {
        let levels = &self.plan.levels;
        let is_plain = !answer && std::ptr::eq(scene, self.plan.scene);
        if let Some(found) = self.found.filter(|found| is_plain && found.level == level) {
            return Ok(found.passes.clone());
        }
        let task = Task {
            stages: if answer { self.stages } else { &[] },
            progress,
            ..Task::of(self.plan, scene, levels.mesh(level)?)
        };
        let jumping = self.jumps.map(|size| Jumping {
            period: self.period,
            size,
            most_passes: levels.affordable_passes(level),
            guide: self
                .found
                .map_or(Guide::Free, |found| Guide::Follow(&found.passes.schedule)),
            beyond: answer,
        });
        let passes = match jumping {
            Some(jumping) => task.with_jumps(&jumping, &listed_passes(scene, self.period)),
            None => task.every_pass(),
        }?;
        self.work.add(passes.statistics);
        Ok(passes)
    }

    fn difference(&self, one: &Passes, other: &Passes) -> Shares {
        difference(&one.records, &other.records, self.scale)
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
