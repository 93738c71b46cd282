//! The passes of a scene on one mesh after the other, until their error is within the tolerance.

use cable_dem::{CableError, Mesh, Statistics};
use cycle_jump::Record;

use super::both::both;
use super::judge::{judge, mesh_reason};
use super::jumps::{self, Found};
use super::options::RunOptions;
use super::passes::{Jumping, Passes, Task, seldom_passes};
use super::random;
use super::seen::{SHARP, Seen, is_known};
use super::vehicle_steps::{SEEN_BELOW, VehicleSteps};
use super::worth::MAX_NODE_UPDATES;
use crate::answer::error_estimate::{self, ErrorParts, Scale, Shares, difference, measured};
use crate::answer::{DayExtremes, HeatRecord, RandomSpread, listed};
use crate::ground::{peak, road};
use crate::plan::{CableMethod, Levels, PassMethod, Plan};
use crate::{Error, Progress, Scene};

/// Share of the work that finding jumps is taken for.
pub const FINDING: f64 = 0.3;

/// A plan's passes, on whatever level.
#[derive(Clone, Copy)]
pub struct Refinement<'a> {
    pub plan: &'a Plan<'a>,
    /// The plan's, but for the vehicle's steps on fine meshes.
    pub levels: Levels,
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
    /// One more pass of each vehicle that comes too seldom for the period.
    pub seldom: Vec<(usize, Record)>,
    /// Of a cable that is heated every day.
    pub heat: Option<(Vec<DayExtremes>, HeatRecord)>,
}

impl Refinement<'_> {
    /// Refines until the estimated error is within the tolerance, unless the scene says how fine to be.
    pub fn solve(mut self, warnings: &mut Vec<String>) -> Result<Solved, Error> {
        let Plan {
            scene,
            ground,
            choice,
            ..
        } = self.plan;
        let tolerance = scene.solver.tolerance;
        let mut statistics = Statistics::default();
        let mut error = ErrorParts::new(ground.accuracy, choice.inertia);
        // What no mesh makes smaller.
        error_estimate::judge(&error, tolerance)?;
        let mut found = match self.method {
            PassMethod::Jumps(_) if self.levels.known().is_none() => {
                Some(self.jumps(jumps::share(self.plan), None, &mut statistics)?)
            }
            _ => None,
        };
        let left = found.as_ref().map_or(0.0, |_| FINDING);
        let mut parts = self.options.progress.part(left, 1.0).refining();
        let known = self.levels.known();
        let (level, mut passes) = match known {
            Some(known) => {
                error.mesh = Shares::both(known);
                (self.levels.first(), vec![self.on_known_mesh(parts())?])
            }
            None => self.meshes(&mut found, &mut error, &mut statistics, &mut parts)?,
        };
        let way = found.as_ref().map(|found| found.jumping(&self.plan.period));
        let way = way.as_ref();
        statistics += work_of(&passes);
        // One mesh alone does not show its error; and no mesh that the scene names is refused for what coarser ones show.
        let alone = passes.len() == 1 && known.is_none();
        let doubtful = self.levels.named() && error_estimate::is_doubtful(error.total().force, tolerance);
        let mesh = self.levels.mesh(level)?;
        let finest = passes.pop().expect("the first level was computed");
        error.road = self.road_error(&finest, mesh, way, &mut statistics)?;
        if self.options.verify || alone || doubtful {
            let finer = self.simulate(level + 1, way, parts(), true)?;
            statistics += finer.statistics;
            error.mesh = measured(&finest.records, &finer.records, self.scale());
            error.measured = true;
        }
        judge(&error, self.plan, &mesh, warnings)?;
        let mut random = None;
        if let Some(found) = &found {
            let task = self.task(scene, self.levels.mesh(found.level)?);
            let (spread, work) = random::spread(&task, &found.passes.state, &finest)?;
            statistics += work;
            random = spread;
        }
        let seldom = match self.method {
            PassMethod::Jumps(_) => {
                seldom_passes(&self.task(scene, mesh), &self.plan.period.absent, &finest.state)?
            }
            PassMethod::EveryPass(_) => Vec::new(),
        };
        Ok(Solved {
            reasons: vec![mesh_reason(self.plan, &mesh)],
            mesh,
            passes: finest,
            error,
            statistics,
            random,
            seldom,
            heat: None,
        })
    }

    /// The passes on mesh after mesh, up to one that is good enough, and its level; with smaller jumps than those `found` where these
    /// spare a finer mesh.
    fn meshes<'p>(
        &mut self,
        found: &mut Option<Found>,
        error: &mut ErrorParts,
        statistics: &mut Statistics,
        parts: &mut impl FnMut() -> Progress<'p>,
    ) -> Result<(usize, Vec<Passes>), Error> {
        let tolerance = self.plan.scene.solver.tolerance;
        let mut level = self.levels.first();
        let mut steps = VehicleSteps::default();
        let mut may_be_smaller = true;
        // The passes with larger jumps, until there are some with smaller ones.
        let mut before: Option<(Found, Vec<Passes>)> = None;
        'jumps: loop {
            error.passes = found.as_ref().map_or(Shares::default(), |found| found.error);
            let way = found.as_ref().map(|found| found.jumping(&self.plan.period));
            let way = way.as_ref();
            let known = found.as_ref().map(|found| (found.level, &found.passes));
            let now = parts();
            let made = both(
                || self.simulate(level, way, now, true),
                || self.coarser(level, way, known),
            );
            let mut passes = match (made, before.take()) {
                // Smaller jumps do not get on.
                (Err(Error::Jumps(_)), Some((larger, passes))) => {
                    error.passes = found.insert(larger).error;
                    passes
                }
                (made, before) => {
                    if let Some((_, passes)) = before {
                        *statistics += work_of(&passes);
                    }
                    let (finest, mut passes) = made?;
                    passes.push(finest);
                    passes
                }
            };
            loop {
                let scale = (tolerance, self.scale());
                let seen = Seen::on(&passes, &self.levels, (level, steps), scale, error);
                if seen.is_within {
                    return Ok((level, passes));
                }
                if seen.would_be_with_smaller_jumps
                    && std::mem::take(&mut may_be_smaller)
                    && let Some(smaller) = self.smaller_jumps(found.as_ref(), statistics)?
                {
                    before = found.replace(smaller).map(|larger| (larger, passes));
                    continue 'jumps;
                }
                if seen.more == 0 {
                    return Ok((level, passes));
                }
                let way = found.as_ref().map(|found| found.jumping(&self.plan.period));
                let progress = parts();
                let chooses = self.method.cable_method() == CableMethod::QuasiStatic;
                let may_choose = chooses && level >= SHARP;
                if may_choose && steps == VehicleSteps::Unknown {
                    steps = self.choose_steps(level, way.as_ref(), &passes, statistics)?;
                    if let VehicleSteps::Half { from, .. } = steps {
                        self.levels = self.levels.with_half_as_many_steps_from(from);
                    }
                }
                let is_chosen = !chooses || steps != VehicleSteps::Unknown;
                if seen.more == 2 && is_chosen && way.is_none() {
                    // The coarser one may be stopped, but does not count in the progress shown.
                    let (finest, finer) = both(
                        || self.simulate(level + 2, None, progress, true),
                        || self.simulate(level + 1, None, progress.part(0.0, 0.0), true),
                    )?;
                    passes.extend([finer, finest]);
                    level += 2;
                    continue;
                }
                match self.simulate(level + 1, way.as_ref(), progress, true) {
                    // What is known of coarser meshes counts.
                    Err(Error::Jumps(_)) if is_known(&passes, &self.levels) => return Ok((level, passes)),
                    finer => passes.push(finer?),
                }
                level += 1;
            }
        }
    }

    /// The vehicle's steps on levels beyond `level`, from the `passes` up to it and a run with half the step on a coarser one.
    fn choose_steps(
        &self,
        level: usize,
        way: Option<&Jumping<'_>>,
        passes: &[Passes],
        statistics: &mut Statistics,
    ) -> Result<VehicleSteps, Error> {
        let [.., coarse, fine, _] = passes else {
            return Ok(VehicleSteps::default());
        };
        let levels = self.levels.with_half_the_step();
        let halved = Self { levels, ..*self };
        let half_step = match halved.simulate(level - SEEN_BELOW, way, Progress::default(), false) {
            // No reason to refuse what goes on without.
            Err(Error::Jumps(_) | Error::Cable(_)) => return Ok(VehicleSteps::Usual),
            half_step => half_step?,
        };
        let from_coarse = |passes: &Passes| difference(&coarse.records, &passes.records, self.scale());
        *statistics += half_step.statistics;
        Ok(VehicleSteps::new(
            level,
            from_coarse(fine),
            from_coarse(&half_step),
        ))
    }

    /// All passes on the only mesh, with jumps as large as they usually may be: what they leave wrong is part of the mesh's known error.
    fn on_known_mesh(&self, progress: Progress<'_>) -> Result<Passes, Error> {
        let way = matches!(self.method, PassMethod::Jumps(_)).then(|| jumps::usual(self.plan));
        self.simulate(self.levels.first(), way.as_ref(), progress, true)
    }

    /// Smaller jumps than those of `found`, if there are any with a smaller error.
    fn smaller_jumps(
        &self,
        found: Option<&Found>,
        statistics: &mut Statistics,
    ) -> Result<Option<Found>, Error> {
        let Some(found) = found else {
            return Ok(None);
        };
        match self.jumps(jumps::SMALLER_SHARE, Some(found), statistics) {
            Err(Error::Jumps(_)) => Ok(None),
            smaller => Ok(Some(smaller?)
                .filter(|smaller| smaller.error != found.error && smaller.error.is_within(found.error))),
        }
    }

    /// Jumps that take at most the `share` of the tolerance; smaller ones than those found `before`.
    fn jumps(&self, share: f64, before: Option<&Found>, statistics: &mut Statistics) -> Result<Found, Error> {
        let progress = if before.is_none() {
            self.options.progress.part(0.0, FINDING)
        } else {
            // It may be stopped, but its share of the work is not counted.
            self.options.progress.part(FINDING, FINDING)
        };
        let simulate =
            |level, jumping: &Jumping<'_>, progress| self.simulate(level, Some(jumping), progress, false);
        let (found, work) = jumps::find(self.plan, self.scale(), share, before, progress, simulate)?;
        *statistics += work;
        Ok(found)
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
        known: Option<(usize, &Passes)>,
    ) -> Result<Vec<Passes>, Error> {
        (0..level)
            .filter(|&coarser| self.levels.mesh(coarser).is_ok())
            .map(|coarser| match known {
                Some((level, passes)) if level == coarser => Ok(Passes {
                    // Their work is counted already.
                    statistics: Statistics::default(),
                    ..passes.clone()
                }),
                _ => self.simulate(coarser, way, Progress::default(), false),
            })
            .filter(|passes| !matches!(passes, Err(Error::Cable(CableError::CoarseMesh { .. }))))
            .collect()
    }

    /// All passes of `scene` on `mesh`, unseen.
    fn task<'b>(&'b self, scene: &'b Scene, mesh: Mesh) -> Task<'b> {
        Task {
            scene,
            method: self.method.cable_method(),
            motions: &self.plan.ground.motions,
            mesh,
            stages: &[],
            progress: Progress::default(),
            seen: None,
        }
    }

    /// All passes on `level`; `shown` ones report their stages and where they lead.
    fn simulate(
        &self,
        level: usize,
        way: Option<&Jumping<'_>>,
        progress: Progress<'_>,
        shown: bool,
    ) -> Result<Passes, Error> {
        let mut task = self.task(self.plan.scene, self.levels.mesh(level)?);
        task.progress = progress;
        task.seen = self
            .options
            .underway
            .map(|underway| underway.on_mesh(task.mesh, shown));
        if shown {
            task.stages = self.options.stages;
        }
        let affordable = MAX_NODE_UPDATES as f64 / self.levels.node_updates(level, 1);
        let way = way.map(|way| Jumping {
            beyond: shown,
            most_passes: affordable as u64,
            ..*way
        });
        if let (Some(_), Some(way)) = (self.levels.known(), &way) {
            // Nobody looks at every pass.
            return task.with_jumps(way, &listed(task.scene.traffic.passes));
        }
        task.carry_out(way.as_ref())
    }
}

fn work_of(passes: &[Passes]) -> Statistics {
    let mut work = Statistics::default();
    for passes in passes {
        work += passes.statistics;
    }
    work
}
