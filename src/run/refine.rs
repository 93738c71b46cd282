//! The passes of a scene on one mesh after the other, until their error is within the tolerance.

use cable_dem::{CableError, Mesh, Statistics};
use cycle_jump::Record;

use super::budget::{MAX_NODE_UPDATES, REFINEMENT_COST, allowed, max_node_updates};
use super::judge::{judge, mesh_reason};
use super::jumps::{self, Found};
use super::options::{FixedMesh, RunOptions};
use super::passes::{Jumping, Passes, Task, seldom_passes};
use super::random;
use crate::answer::error_estimate::{self, ErrorParts, Scale, Shares, difference, measured, of_mesh};
use crate::answer::{DayExtremes, HeatRecord, RandomSpread};
use crate::ground::{peak, road};
use crate::plan::{Levels, PassMethod, Plan};
use crate::{Error, Progress, Scene};

/// Share of the work that finding jumps is taken for.
pub const FINDING: f64 = 0.3;
/// The coarsest level on which it is seen whether anything slips: 24 nodes a depth.
const SHARP: usize = 3;

/// A plan's passes, on whatever level.
#[derive(Clone, Copy)]
pub struct Refinement<'a> {
    pub plan: &'a Plan<'a>,
    pub method: PassMethod,
    pub options: &'a RunOptions<'a>,
}

/// Passes on the mesh that was good enough.
pub struct Solved {
    pub mesh: Mesh,
    pub passes: Passes,
    pub error: ErrorParts,
    /// What was found on the way.
    pub reasons: Vec<String>,
    /// Work on all meshes together.
    pub statistics: Statistics,
    pub random: Option<RandomSpread>,
    /// One more pass of each vehicle that comes too seldom for the period; in random order, passes of draws that show more.
    pub seldom: Vec<(usize, Record)>,
    /// What it has shown of its mesh.
    pub shown: Option<FixedMesh>,
    /// Of a cable that is heated every day.
    pub heat: Option<(Vec<DayExtremes>, HeatRecord)>,
}

impl Refinement<'_> {
    /// Refines until the estimated error is within the tolerance, unless the scene says how fine to be.
    pub fn solve(self, warnings: &mut Vec<String>) -> Result<Solved, Error> {
        let Plan {
            scene,
            ground,
            choice,
            levels,
            ..
        } = self.plan;
        let tolerance = scene.solver.tolerance;
        let mut statistics = Statistics::default();
        let mut error = ErrorParts::new(ground.accuracy, choice.inertia);
        // What no mesh makes smaller.
        error_estimate::judge(&error, tolerance)?;
        let known = self.known_mesh();
        let found = match self.method {
            PassMethod::Jumps(_) if known.is_some() => None,
            PassMethod::Jumps(_) => Some(self.jumps(&mut statistics)?),
            PassMethod::EveryPass(_) => None,
        };
        let left = found.as_ref().map_or(0.0, |_| FINDING);
        let mut parts = self.options.progress.part(left, 1.0).refining();
        let (level, mut passes) = self.meshes(found.as_ref(), &mut error, &mut parts)?;
        let way = self.way(found.as_ref());
        let way = way.as_ref();
        statistics += work_of(&passes);
        // One mesh alone does not show its error; and no mesh that the scene names is refused for what coarser ones show.
        let alone = passes.len() == 1 && known.is_none();
        let doubtful = levels.named() && error_estimate::is_doubtful(error.total().force, tolerance);
        let mesh = levels.mesh(level)?;
        let mut finest = passes.pop().expect("the first level was computed");
        error.road = self.road_error(&finest, mesh, way, &mut statistics)?;
        if self.options.verify || alone || doubtful {
            let finer = self.simulate(level + 1, way, parts(), true)?;
            statistics += finer.statistics;
            error.mesh = measured(&finest.records, &finer.records, self.scale());
            error.measured = true;
        }
        if let Some(draws) = found.as_ref().and_then(|found| found.draws.as_ref()) {
            draws.correct(&mut finest);
        }
        judge(&error, self.plan, &mesh, warnings)?;
        let mut random = None;
        if let Some(found) = &found {
            let task = self.task(scene, levels.mesh(found.level)?);
            let (spread, work) = random::spread(&task, &found.passes.state, &finest)?;
            statistics += work;
            random = spread;
        }
        let mut seldom = match self.method {
            PassMethod::Jumps(_) => {
                seldom_passes(&self.task(scene, mesh), &self.plan.period.absent, &finest.state)?
            }
            PassMethod::EveryPass(_) => Vec::new(),
        };
        let jumps = found.as_ref().map(|found| found.known);
        seldom.extend(
            found
                .and_then(|found| found.draws)
                .into_iter()
                .flat_map(|draws| draws.peaks),
        );
        Ok(Solved {
            reasons: vec![mesh_reason(self.plan, &mesh)],
            mesh,
            passes: finest,
            error,
            statistics,
            random,
            seldom,
            shown: Some(FixedMesh {
                error: error.mesh,
                jumps: jumps.or_else(|| known?.jumps),
            }),
            heat: None,
        })
    }

    /// The passes on mesh after mesh, up to one that is good enough or the last that is affordable, and its level.
    fn meshes<'p>(
        &self,
        found: Option<&Found>,
        error: &mut ErrorParts,
        parts: &mut impl FnMut() -> Progress<'p>,
    ) -> Result<(usize, Vec<Passes>), Error> {
        let levels = &self.plan.levels;
        let way = self.way(found);
        let way = way.as_ref();
        let jumps = found
            .map(|found| found.known)
            .or_else(|| self.known_mesh()?.jumps);
        error.passes = jumps.map_or(Shares::default(), |jumps| jumps.error);
        let mut level = levels.first();
        let progress = parts();
        if let Some(known) = self.known_mesh() {
            error.mesh = known.error;
            return Ok((level, vec![self.simulate(level, way, progress, true)?]));
        }
        let mut passes = self.coarser(level, way, found, progress)?;
        passes.push(self.simulate(level, way, progress.part(share_below(level, level), 1.0), true)?);
        loop {
            if passes.len() > 1 {
                let records: Vec<&[Record]> = passes.iter().map(|passes| &passes.records[..]).collect();
                error.mesh = of_mesh(&records, Levels::typical_error(level), self.scale());
            }
            if self.is_good_enough(level, &passes, error) || !self.may_refine(level, &passes, error) {
                return Ok((level, passes));
            }
            match self.simulate(level + 1, way, parts(), true) {
                // Jumps that fail on this mesh leave the answer of the coarser one.
                Err(Error::Jumps(_)) if self.error_is_known(&passes) => return Ok((level, passes)),
                finer => passes.push(finer?),
            }
            level += 1;
        }
    }

    /// Whether `passes` on all meshes up to `level` leave an `error` of the last that the tolerance allows.
    fn is_good_enough(&self, level: usize, passes: &[Passes], error: &ErrorParts) -> bool {
        // Where nothing slips coarse meshes agree, but they see too little of how sharply the duct bends.
        let still = self.scale().is_still(&passes[passes.len() - 1].records);
        let others = error.passes + Shares::both(error.inertia);
        let of_mesh = error.total().less(others);
        let allowed = allowed(self.plan.scene.solver.tolerance, others);
        self.error_is_known(passes) && (!still || level >= SHARP) && of_mesh.is_within(allowed)
    }

    /// Whether there is a mesh after `level` that is not too costly.
    fn may_refine(&self, level: usize, passes: &[Passes], error: &ErrorParts) -> bool {
        let tolerance = self.plan.scene.solver.tolerance;
        let last = &passes[passes.len() - 1].statistics;
        // A corner of an exact step is about as much work as a node.
        let next = REFINEMENT_COST.saturating_mul(last.node_updates);
        // A run whose error is above 10 % is refused: spend more before that.
        let most = if error_estimate::is_doubtful(error.total().force, tolerance) {
            MAX_NODE_UPDATES
        } else {
            max_node_updates(tolerance)
        };
        next <= most && level < self.plan.levels.finest()
    }

    /// Whether `passes` show their error: on one mesh alone they do not.
    fn error_is_known(&self, passes: &[Passes]) -> bool {
        passes.len() > 1 || self.plan.levels.named()
    }

    /// Jumps that take at most their share of the tolerance.
    fn jumps(&self, statistics: &mut Statistics) -> Result<Found, Error> {
        let progress = self.options.progress.part(0.0, FINDING);
        let simulate =
            |level, jumping: &Jumping<'_>, progress| self.simulate(level, Some(jumping), progress, false);
        let (found, work) = jumps::find(self.plan, self.scale(), progress, simulate)?;
        *statistics += work;
        Ok(found)
    }

    /// What another run has shown of the mesh that the scene names. The scatter of random orders is every run's own.
    fn known_mesh(&self) -> Option<FixedMesh> {
        let known = self.options.mesh.filter(|_| self.plan.levels.named())?;
        let fits = match self.method {
            PassMethod::EveryPass(_) => true,
            PassMethod::Jumps(_) => known.jumps.is_some() && !self.plan.period.reordered,
        };
        fits.then_some(known)
    }

    /// The jumps that were found, or that are known.
    fn way<'f>(&'f self, found: Option<&'f Found>) -> Option<Jumping<'f>> {
        let period = &self.plan.period;
        let found = found.map(|found| found.jumping(period));
        let is_jumps = matches!(self.method, PassMethod::Jumps(_));
        found.or_else(|| Some(self.known_mesh().filter(|_| is_jumps)?.jumps?.jumping(period)))
    }

    /// What counts as nothing in this scene.
    fn scale(&self) -> Scale {
        Scale::new(self.plan.scene.friction_limit(), peak(&self.plan.ground.motions))
    }

    /// What an approach that the scene names leaves out: the passes once more on the same mesh, with the vehicles followed far
    /// enough. Where it is far enough already, nothing.
    fn road_error(
        &self,
        passes: &Passes,
        mesh: Mesh,
        way: Option<&Jumping<'_>>,
        statistics: &mut Statistics,
    ) -> Result<Shares, Error> {
        let motions = &self.plan.ground.motions;
        let Some(approach) = self.plan.scene.solver.approach else {
            return Ok(Shares::default());
        };
        if approach >= road::needed(self.plan.scene, motions)? {
            return Ok(Shares::default());
        }
        let mut scene: Scene = self.plan.scene.clone();
        scene.solver.approach = None;
        let farther = self.task(&scene, mesh).carry_out(way)?;
        *statistics += farther.statistics;
        Ok(difference(&passes.records, &farther.records, self.scale()))
    }

    /// The passes on all levels below `level` that the duct is long enough for, and that are fine enough for its motion.
    fn coarser(
        &self,
        level: usize,
        way: Option<&Jumping<'_>>,
        found: Option<&Found>,
        progress: Progress<'_>,
    ) -> Result<Vec<Passes>, Error> {
        (0..level)
            .filter(|&coarser| self.plan.levels.mesh(coarser).is_ok())
            .map(|coarser| match found {
                Some(found) if found.level == coarser => Ok(Passes {
                    // Their work is counted already.
                    statistics: Statistics::default(),
                    ..found.passes.clone()
                }),
                _ => {
                    let (begin, end) = (share_below(coarser, level), share_below(coarser + 1, level));
                    self.simulate(coarser, way, progress.part(begin, end), false)
                }
            })
            .filter(|passes| !matches!(passes, Err(Error::Cable(CableError::CoarseMesh { .. }))))
            .collect()
    }

    /// All passes of `scene` on `mesh`, without stages and progress.
    fn task<'b>(&'b self, scene: &'b Scene, mesh: Mesh) -> Task<'b> {
        Task {
            scene,
            method: self.method.cable_method(),
            motions: &self.plan.ground.motions,
            mesh,
            stages: &[],
            progress: Progress::default(),
        }
    }

    /// All passes on `level`; those that may be the `answer` report their stages and where they lead.
    fn simulate(
        &self,
        level: usize,
        way: Option<&Jumping<'_>>,
        progress: Progress<'_>,
        answer: bool,
    ) -> Result<Passes, Error> {
        let levels = &self.plan.levels;
        let mut task = self.task(self.plan.scene, levels.mesh(level)?);
        task.progress = progress;
        if answer {
            task.stages = self.options.stages;
        }
        let affordable = MAX_NODE_UPDATES as f64 / levels.node_updates(level, 1);
        let way = way.map(|way| Jumping {
            beyond: answer,
            most_passes: affordable as u64,
            ..*way
        });
        task.carry_out(way.as_ref())
    }
}

/// The work on all levels below `coarser` as a share of that on all up to `level`, each of which costs four times the one before.
fn share_below(coarser: usize, level: usize) -> f64 {
    let all_below = |level: usize| (REFINEMENT_COST as f64).powi(level as i32) - 1.0;
    all_below(coarser) / all_below(level + 1)
}

fn work_of(passes: &[Passes]) -> Statistics {
    let mut work = Statistics::default();
    for passes in passes {
        work += passes.statistics;
    }
    work
}
