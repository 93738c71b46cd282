//! The passes of a plan, every one simulated or few with jumps between them, on one mesh after the
//! other.

use cycle_jump::Guide;

use super::jump_search::{self, Found};
use super::random_spread;
use crate::Progress;
use crate::answer::differences::{Scale, Shares, difference};
use crate::answer::error_estimate::{ErrorParts, mesh_error};
use crate::passes::{FixedMesh, Jumping, KnownJumps, Passes, RunOptions, Task};
use crate::refine::{MeshLoop, OnMeshes, Solved};
use crate::tuning::meshes::FINDING;
use creepage_plan::{Error, Levels, Plan};
use creepage_scene::{Scene, SolverMethod};

/// A plan's passes, on whatever level.
struct PassesOnMeshes<'a> {
    plan: &'a Plan<'a>,
    options: &'a RunOptions<'a>,
    scale: Scale,
    /// The jumps that are taken; none where every pass is simulated.
    known: Option<KnownJumps>,
    /// What was found with them, unless another run has shown them.
    found: Option<Found>,
}

/// Carries `plan` out by `method`, where `error` has what no mesh makes smaller.
pub fn solve(
    plan: &Plan<'_>,
    method: SolverMethod,
    options: &RunOptions<'_>,
    mut error: ErrorParts,
) -> Result<Solved, Error> {
    let mut passes = PassesOnMeshes {
        plan,
        options,
        scale: Scale::new(plan.scene, &plan.ground.motions),
        found: None,
        known: None,
    };
    let jumps = method == SolverMethod::PassLaw;
    // The scatter of random orders is every run's own.
    let fits = |known: &FixedMesh| !jumps || known.jumps.is_some() && !plan.period.reordered;
    let known = options.mesh.filter(|_| plan.levels.named).filter(fits);
    let mut begin = 0.0;
    if jumps && known.is_none() {
        begin = FINDING;
        let progress = options.progress.part(0.0, begin);
        passes.found = Some(jump_search::find(plan, passes.scale, progress)?);
    }
    if jumps {
        let found = passes.found.as_ref().map(|found| found.known);
        passes.known = found.or(known.and_then(|known| known.jumps));
    }
    error.passes = passes.known.map_or(Shares::default(), |jumps| jumps.error);
    let meshes = MeshLoop {
        plan,
        options,
        simulation: &passes,
        known_error: known.map(|known| known.error),
    };
    let mut solved = meshes.refine(plan.levels.first, options.progress.part(begin, 1.0), error)?;
    solved.shown = Some(FixedMesh {
        error: solved.error.mesh,
        jumps: passes.known,
    });
    if let Some(found) = &passes.found {
        if let Some(draws) = &found.draws {
            draws.correct(&mut solved.passes);
        }
        let task = Task::of(plan, plan.scene, plan.levels.mesh(found.level)?);
        let (spread, work) = random_spread::spread(&task, &found.passes.state, &solved.passes)?;
        solved.random = spread;
        solved.statistics += found.statistics;
        solved.statistics += work;
    }
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
        let Plan { period, levels, .. } = self.plan;
        let stages = if answer { self.options.stages } else { &[] };
        let task = Task {
            stages,
            progress,
            ..Task::of(self.plan, scene, levels.mesh(level)?)
        };
        let jumping = self.known.map(|known| Jumping {
            period,
            size: known.size,
            most_passes: levels.affordable_passes(level),
            guide: self
                .found
                .as_ref()
                .map_or(Guide::Free, |found| Guide::Follow(&found.passes.schedule)),
            beyond: answer,
        });
        task.carry_out(jumping.as_ref())
    }

    fn levels_below(&self) -> usize {
        self.plan.levels.first
    }

    fn difference(&self, one: &Passes, other: &Passes) -> Shares {
        difference(&one.records, &other.records, self.scale)
    }

    fn mesh_error(&self, level: usize, meshes: &[Passes]) -> Shares {
        let pairs = meshes.windows(2).rev();
        let differences: Vec<Shares> = pairs.map(|pair| self.difference(&pair[1], &pair[0])).collect();
        let passes = meshes.last().map_or(0, |finest| finest.records.len());
        mesh_error(&differences, passes, Levels::typical_error(level))
    }
}
