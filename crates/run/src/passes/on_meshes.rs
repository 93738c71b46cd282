//! The passes of a plan, every one simulated or few with jumps between them, on one mesh after the
//! other.

use cable_dem::{Mesh, Statistics};
use cycle_jump::Record;

use super::jump_search::{self, Found, KnownJumps};
use super::options::{FixedMesh, RunOptions};
use super::random_spread;
use super::simulation::{Jumping, Passes, seldom_passes};
use super::solved::Solved;
use crate::answer::differences::{Scale, Shares, difference};
use crate::answer::error_estimate::{self, ErrorParts, mesh_error};
use crate::ground::road;
use crate::plan::{Levels, PassMethod, Plan};
use crate::refine::{MeshLoop, OnMeshes, Refined, judge, mesh_reason};
use crate::tuning::meshes::{FINDING, MAX_NODE_UPDATES};
use crate::{Error, Progress, Scene};

/// A plan's passes, on whatever level.
pub struct PassesOnMeshes<'a> {
    plan: &'a Plan<'a>,
    method: PassMethod,
    options: &'a RunOptions<'a>,
    /// What another run has shown of the mesh that the scene names.
    known: Option<FixedMesh>,
    /// Jumps that were found for this run.
    found: Option<Found>,
}

/// Carries `plan` out by `method`.
pub fn solve(
    plan: &Plan<'_>,
    method: PassMethod,
    options: &RunOptions<'_>,
    warnings: &mut Vec<String>,
) -> Result<Solved, Error> {
    let mut error = ErrorParts::new(plan.ground.accuracy, plan.choice.inertia);
    // What no mesh makes smaller.
    error_estimate::judge(&error, plan.scene.solver.tolerance)?;
    let mut passes = PassesOnMeshes::new(plan, method, options);
    let mut statistics = passes.find_jumps()?;
    error.passes = passes
        .known_jumps()
        .map_or(Shares::default(), |jumps| jumps.error);
    let begin = passes.found.as_ref().map_or(0.0, |_| FINDING);
    let meshes = MeshLoop {
        plan,
        verify: options.verify,
        progress: options.progress.part(begin, 1.0),
        known_error: passes.known.map(|known| known.error),
    };
    let Refined {
        mesh,
        outcome: mut finest,
        statistics: work,
        ..
    } = meshes.refine(&passes, plan.levels.first(), &mut error)?;
    statistics += work;
    error.road = passes.road_error(&finest, mesh, &mut statistics)?;
    if let Some(draws) = passes.found.as_ref().and_then(|found| found.draws.as_ref()) {
        draws.correct(&mut finest);
    }
    refuse_leaks(&finest)?;
    judge(&error, plan, &mesh, warnings)?;
    let random = match &passes.found {
        None => None,
        Some(found) => {
            let task = plan.task(plan.scene, plan.levels.mesh(found.level)?);
            let (spread, work) = random_spread::spread(&task, &found.passes.state, &finest)?;
            statistics += work;
            spread
        }
    };
    Ok(Solved {
        reasons: vec![mesh_reason(plan, &mesh)],
        shown: Some(FixedMesh {
            error: error.mesh,
            jumps: passes.known_jumps(),
        }),
        seldom: passes.seldom(&finest, mesh)?,
        mesh,
        passes: finest,
        error,
        statistics,
        random,
        heat: None,
    })
}

/// A friction law that loses more than this share of the stored force in one pass gives no answer.
const LARGEST_LEAK: f64 = 0.9;

/// Refuses a friction law that loses too much of the stored force in a pass.
fn refuse_leaks(passes: &Passes) -> Result<(), Error> {
    let mut leaks = passes.leaks.iter().filter(|leak| leak.matters());
    match leaks.find(|leak| leak.loss_per_pass > LARGEST_LEAK) {
        Some(leak) => Err(Error::Unfit {
            key: "friction.law",
            found: "sigmoid",
            reason: leak.to_string().into(),
        }),
        None => Ok(()),
    }
}

impl<'a> PassesOnMeshes<'a> {
    fn new(plan: &'a Plan<'a>, method: PassMethod, options: &'a RunOptions<'a>) -> Self {
        // The scatter of random orders is every run's own.
        let fits = |known: &FixedMesh| match method {
            PassMethod::EveryPass(_) => true,
            PassMethod::Jumps(_) => known.jumps.is_some() && !plan.period.reordered,
        };
        let known = options.mesh.filter(|_| plan.levels.named());
        Self {
            plan,
            method,
            options,
            known: known.filter(fits),
            found: None,
        }
    }

    /// Looks for jumps that take at most their share of the tolerance, unless they are known; the
    /// work that it takes.
    fn find_jumps(&mut self) -> Result<Statistics, Error> {
        if matches!(self.method, PassMethod::EveryPass(_)) || self.known.is_some() {
            return Ok(Statistics::default());
        }
        let progress = self.options.progress.part(0.0, FINDING);
        let simulate =
            |level, jumping: &Jumping<'_>, progress| self.on_level(level, Some(jumping), progress, false);
        let (found, work) = jump_search::find(self.plan, self.scale(), progress, simulate)?;
        self.found = Some(found);
        Ok(work)
    }

    /// The jumps that were found, or that are known.
    fn known_jumps(&self) -> Option<KnownJumps> {
        let found = self.found.as_ref().map(|found| found.known);
        found.or_else(|| self.known?.jumps)
    }

    /// How they are taken.
    fn jumping(&self) -> Option<Jumping<'_>> {
        let period = &self.plan.period;
        if let Some(found) = &self.found {
            return Some(found.jumping(period));
        }
        let is_jumps = matches!(self.method, PassMethod::Jumps(_));
        Some(self.known_jumps().filter(|_| is_jumps)?.jumping(period))
    }

    /// Forces and movements that are too small to count.
    fn scale(&self) -> Scale {
        Scale::new(self.plan.scene, &self.plan.ground.motions)
    }

    /// What an approach that the scene names leaves out: the passes once more on the same mesh,
    /// with the vehicles followed far enough. If it is far enough already, nothing.
    fn road_error(&self, passes: &Passes, mesh: Mesh, statistics: &mut Statistics) -> Result<Shares, Error> {
        if road::is_followed_enough(self.plan.scene, &self.plan.ground.motions)? {
            return Ok(Shares::default());
        }
        let mut scene: Scene = self.plan.scene.clone();
        scene.solver.approach = None;
        let farther = self.plan.task(&scene, mesh).carry_out(self.jumping().as_ref())?;
        *statistics += farther.statistics;
        Ok(difference(&passes.records, &farther.records, self.scale()))
    }

    /// One more pass of each vehicle that is too seldom for the period, and single passes of draws
    /// that show more.
    fn seldom(&self, finest: &Passes, mesh: Mesh) -> Result<Vec<(usize, Record)>, Error> {
        let mut seldom = match self.method {
            PassMethod::Jumps(_) => {
                let task = self.plan.task(self.plan.scene, mesh);
                seldom_passes(&task, &self.plan.period.absent, &finest.state)?
            }
            PassMethod::EveryPass(_) => Vec::new(),
        };
        let draws = self.found.as_ref().and_then(|found| found.draws.as_ref());
        seldom.extend(draws.into_iter().flat_map(|draws| draws.peaks.iter().cloned()));
        Ok(seldom)
    }

    /// All passes on `level`; those that may be the `answer` report their stages and where they
    /// lead.
    fn on_level(
        &self,
        level: usize,
        jumping: Option<&Jumping<'_>>,
        progress: Progress<'_>,
        answer: bool,
    ) -> Result<Passes, Error> {
        let levels = &self.plan.levels;
        let mut task = self.plan.task(self.plan.scene, levels.mesh(level)?);
        task.progress = progress;
        if answer {
            task.stages = self.options.stages;
        }
        let affordable = MAX_NODE_UPDATES as f64 / levels.node_updates(level, 1);
        let jumping = jumping.map(|jumping| Jumping {
            beyond: answer,
            most_passes: affordable as u64,
            ..*jumping
        });
        task.carry_out(jumping.as_ref())
    }
}

impl OnMeshes for PassesOnMeshes<'_> {
    type Outcome = Passes;

    fn simulate(
        &self,
        level: usize,
        _: Option<&Passes>,
        progress: Progress<'_>,
        answer: bool,
    ) -> Result<Passes, Error> {
        self.on_level(level, self.jumping().as_ref(), progress, answer)
    }

    fn known(&self, level: usize) -> Option<Passes> {
        let found = self.found.as_ref().filter(|found| found.level == level)?;
        Some(found.passes.clone())
    }

    fn levels_below(&self, first: usize) -> usize {
        first
    }

    fn difference(&self, one: &Passes, other: &Passes) -> Shares {
        difference(&one.records, &other.records, self.scale())
    }

    fn mesh_error(&self, level: usize, outcomes: &[Passes]) -> Shares {
        let pairs = outcomes.windows(2).rev();
        let differences = pairs.map(|pair| self.difference(&pair[1], &pair[0]));
        let passes = outcomes.last().map_or(0, |finest| finest.records.len());
        mesh_error(
            &differences.collect::<Vec<_>>(),
            passes,
            Levels::typical_error(level),
        )
    }

    fn is_still(&self, outcome: &Passes) -> bool {
        self.scale().is_still(&outcome.records)
    }

    fn work(outcome: &Passes) -> Statistics {
        outcome.statistics
    }
}
