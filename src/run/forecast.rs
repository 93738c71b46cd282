//! How long a run will take, before it is made.
//!
//! What a run costs depends on how many passes are simulated and on the mesh it ends with, and neither follows from the scene by a
//! formula: near shakedown it may be a hundred times that of another scene of the same size. So the run itself is made on meshes so coarse
//! that they cost little, and its first passes on finer ones; the rest follows from how the differences between them fall
//! ([`Outlook`]). How much is spent on that is bounded by what the run is expected to take, and counted in work, not in time, so that a
//! forecast does not depend on what else the machine does.

use std::cell::Cell;
use std::ops::ControlFlow;

use cable_dem::CableError;

use super::days_outlook;
use super::jumps::{self, Found};
use super::listing::listed_passes;
use super::outlook::{Known, Level, Outlook};
use super::passes::{Jumping, Passes, Task};
use super::random;
use super::underway::Underway;
use super::work::{Work, tabulated};
use super::worth::MAX_NODE_UPDATES;
use crate::answer::error_estimate::{Scale, Shares, is_doubtful};
use crate::ground::{peak, road};
use crate::plan::{CableMethod, PassMethod, Plan};
use crate::scene::Order;
use crate::{Error, Progress, Scene};

/// What a forecast may cost: this share of the run, or as many seconds if that is more.
const SHARE: f64 = 0.08;
const SECONDS: f64 = 2.0;
/// Jumps are looked for on the level where the run does it if that takes no longer than this \[s\], with so many periods; else on the coarsest.
const SECONDS_OF_JUMPS: f64 = 0.1;
const PERIODS: f64 = 100.0;
/// The first passes, by which two meshes are compared: so many periods, and passes at most.
const EARLY_PERIODS: u64 = 8;
const EARLY_PASSES: u64 = 16;
/// A run with inertia that is to take longer than this on one mesh \[s\] is not tried: even its first passes take long. It is expected to take
/// so many times that, on two meshes and where its jumps are looked for.
const LONGEST_PROBE: f64 = 10.0;
const MESHES: f64 = 2.0;
/// Periods after which jumps do not get on.
const PATIENCE: u64 = 400;
/// Nodes eliminated on one mesh at most: some six seconds.
const MOST_UPDATES: f64 = 1e9;
/// What a process takes besides \[s\].
const START: f64 = 4e-3;

/// What a run is expected to take.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Forecast {
    /// Processor time of the run \[s\] on one core of about 3 GHz.
    pub seconds: f64,
    /// Nodes that it eliminates, on all meshes together: [`Cost::node_updates`](crate::Cost::node_updates).
    pub node_updates: f64,
    /// Node spacing with which it most likely ends \[m\].
    pub node_spacing_m: f64,
    /// What jumps over passes, and few vehicles that stand in for many, leave wrong: a share of the force. With heat it is not foreseen.
    pub passes_error: f64,
    /// Processor time where every pass is simulated \[s\], on the same meshes.
    pub every_pass_seconds: f64,
}

/// Predicts what the run of `plan` will take, without `verify`: in nine of ten scenes its processor time is at most twice
/// [`Forecast::seconds`]. The prediction itself takes a tenth of that, or two seconds: on meshes that
/// take no longer the run is made. With heat the days of a coarse mesh are computed once, unless they take long themselves.
///
/// # Errors
///
/// [`Error`] when the cable cannot be computed on a coarse mesh.
///
/// ```
/// let scene = creepage::Scene::from_file("examples/scenes/full-scale-upper.toml")?;
/// let forecast = creepage::forecast(&creepage::plan(&scene)?)?;
/// let run = creepage::run(&scene)?;
/// let share = run.cost.node_updates as f64 / forecast.node_updates;
/// assert!((0.5..2.0).contains(&share), "{share}");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn forecast(plan: &Plan<'_>) -> Result<Forecast, Error> {
    let method = plan.choice.method;
    let told = |outlook: Outlook| {
        let tables = tabulated(plan.levels.table_points(outlook.level), &plan.scene.vehicles);
        let besides = START + plan.took.as_secs_f64() + tables;
        let seconds = |work: Work| besides + work.seconds(method.cable_method());
        Forecast {
            seconds: seconds(outlook.work),
            node_updates: outlook.work.0[0],
            node_spacing_m: plan.levels.spacing(outlook.level).0,
            passes_error: outlook.passes.force,
            every_pass_seconds: seconds(outlook.every_pass),
        }
    };
    if let Some(heat) = plan.scene.warming() {
        return days_outlook::outlook(plan, heat, method).map(told);
    }
    let cable = method.cable_method();
    let expected = plan.choice.estimates.seconds(method);
    if cable != CableMethod::QuasiStatic && expected > LONGEST_PROBE {
        let of_time = |seconds| Work::of_time(MESHES * seconds, cable);
        let work = of_time(expected);
        return Ok(told(Outlook {
            level: plan.levels.first(),
            work,
            mean: work,
            every_pass: of_time(plan.choice.estimates.seconds(PassMethod::EveryPass(cable))),
            passes: Shares::default(),
            certain: false,
        }));
    }
    let outlook = match Probe::new(plan, method).outlook() {
        // The run simulates every pass then.
        Err(Error::Jumps(_)) if plan.choice.may_simulate && matches!(method, PassMethod::Jumps(_)) => {
            Probe::new(plan, PassMethod::EveryPass(cable)).outlook()?
        }
        Ok(outlook)
            if plan.choice.may_simulate && is_doubtful(outlook.passes.force, plan.scene.solver.tolerance) =>
        {
            let every_pass = Probe::new(plan, PassMethod::EveryPass(cable)).outlook()?;
            Outlook {
                work: outlook.work + every_pass.work,
                ..every_pass
            }
        }
        outlook => outlook?,
    };
    Ok(told(outlook))
}

/// A run on coarse meshes.
struct Probe<'a> {
    plan: &'a Plan<'a>,
    method: PassMethod,
    /// The scene with its first passes alone.
    early: Scene,
    /// Work so far \[s\].
    spent: Cell<f64>,
}

impl<'a> Probe<'a> {
    fn new(plan: &'a Plan<'a>, method: PassMethod) -> Self {
        let mut early = plan.scene.clone();
        let few = (EARLY_PERIODS * plan.period.len() as u64).min(EARLY_PASSES);
        // Without friction every pass is as the first.
        let few = if early.friction_limit() == 0.0 { 1 } else { few };
        early.traffic.passes = few.min(early.traffic.passes);
        Self {
            plan,
            method,
            early,
            spent: Cell::new(0.0),
        }
    }

    fn outlook(&self) -> Result<Outlook, Error> {
        let levels = &self.plan.levels;
        let first = levels.first();
        let mut coarsest = (0..first)
            .find(|&level| levels.mesh(level).is_ok())
            .unwrap_or(first);
        let early = loop {
            match self.early(coarsest) {
                Err(Error::Cable(CableError::CoarseMesh { .. })) if coarsest < first => coarsest += 1,
                Err(Error::Stopped) => {
                    let work = |passes: f64| {
                        let mut work = Work::default();
                        work.0[0] = levels.whole_cable_updates(first, 1) * passes;
                        work
                    };
                    return Ok(self.long(work));
                }
                early => break early?,
            }
        };
        if self.plan.scene.friction_limit() == 0.0 {
            let work = early.work.refined(first - coarsest);
            return Ok(Outlook {
                level: first,
                work,
                mean: work,
                every_pass: work,
                passes: Shares::default(),
                certain: true,
            });
        }
        let mut known = Known {
            plan: self.plan,
            scale: Scale::new(self.plan.scene.friction_limit(), peak(&self.plan.ground.motions)),
            coarsest,
            early: vec![early],
            full: Vec::new(),
            besides: Work::default(),
            passes: Shares::default(),
            simulated: self.plan.scene.traffic.passes as f64,
            stuck: None,
        };
        let found = match self.method {
            PassMethod::Jumps(_) => match self.jumps(&mut known) {
                Err(Error::Stopped) => {
                    let early = &known.early[0];
                    let pass = early.work.times(1.0 / self.early.traffic.passes as f64);
                    return Ok(self.long(|passes| pass.times(passes).refined(first - coarsest)));
                }
                found => Some(found?),
            },
            PassMethod::EveryPass(_) => None,
        };
        let way = found.as_ref().map(|found| found.jumping(&self.plan.period));
        loop {
            let outlook = Outlook::new(&known);
            let next = known.next();
            if outlook.certain || known.stuck.is_some() || levels.mesh(next).is_err() {
                return self.with_extras(outlook, &known);
            }
            let left = (SHARE * self.seconds(outlook.mean)).max(SECONDS) - self.spent.get();
            if self.seconds(known.level_work(next)) < left {
                match self.simulate(self.plan.scene, next, way) {
                    Ok((passes, work)) => known.add(passes.records, work),
                    // What is known of coarser meshes counts.
                    Err(Error::Jumps(_)) if next > first => {
                        let pass = known
                            .early_work(next)
                            .times(1.0 / self.early.traffic.passes as f64);
                        known.stuck = Some(pass.times(self.affordable(next)));
                    }
                    Err(Error::Stopped) => return self.with_extras(outlook, &known),
                    Err(error) => return Err(error),
                }
            } else if known.next_early() <= next + 1
                && self.seconds(known.early_work(known.next_early())) < left
                && levels.mesh(known.next_early()).is_ok()
            {
                let early = self.early(known.next_early())?;
                known.early.push(early);
            } else {
                return self.with_extras(outlook, &known);
            }
        }
    }

    /// What a run takes that is not even made on a coarse mesh in time, where so many passes on its first mesh take this `work`.
    fn long(&self, work: impl Fn(f64) -> Work) -> Outlook {
        let all = self.plan.scene.traffic.passes as f64;
        let jumps = matches!(self.method, PassMethod::Jumps(_));
        let simulated = if jumps {
            all.min(PERIODS * self.plan.period.len() as f64)
        } else {
            all
        };
        Outlook {
            level: self.plan.levels.first(),
            work: work(simulated),
            mean: work(simulated),
            every_pass: work(all),
            passes: Shares::default(),
            certain: false,
        }
    }

    /// Looks for jumps, on a mesh coarser than that of the run where this would take long.
    fn jumps(&self, known: &mut Known<'_>) -> Result<Found, Error> {
        let first = self.plan.levels.first();
        let pass = known.early[0].work.times(1.0 / self.early.traffic.passes as f64);
        let periods = PERIODS.min(known.simulated / self.plan.period.len() as f64);
        let passes = pass.times(periods * self.plan.period.len() as f64);
        let cheap = |level: usize| self.seconds(passes.refined(level)) < SECONDS_OF_JUMPS;
        let lowered = (0..first - known.coarsest)
            .find(|lowered| cheap(first - known.coarsest - lowered))
            .unwrap_or(first.saturating_sub(known.coarsest + 1));
        let total = Cell::new(Work::default());
        let (found, _) = jumps::find(
            self.plan,
            known.scale,
            jumps::share(self.plan),
            None,
            Progress::default(),
            |level, jumping: &Jumping<'_>, _| {
                // Higher than `level`, if that is refused as too coarse.
                let lower = level.saturating_sub(lowered).max(known.coarsest);
                let simulated = self.simulate(self.plan.scene, lower, Some(*jumping));
                if let Err(Error::Jumps(_)) = simulated {
                    let pass = pass.refined(level.saturating_sub(known.coarsest));
                    total.set(total.get() + pass.times(self.affordable(level)));
                }
                let (mut passes, work) = simulated?;
                let work = work.refined(level.saturating_sub(lower));
                passes.statistics.node_updates = work.0[0] as usize;
                passes.statistics.corners = work.0[2] as usize;
                total.set(total.get() + work);
                Ok(passes)
            },
        )?;
        let own = found.passes.statistics.node_updates as f64 / total.get().0[0].max(1.0);
        // Its level does not count twice.
        known.besides = total.get().times(if found.level < first {
            1.0 - own.min(1.0)
        } else {
            1.0
        });
        known.passes = found.error;
        known.simulated = found.passes.simulated as f64;
        Ok(found)
    }

    /// The first passes on `level`.
    fn early(&self, level: usize) -> Result<Level, Error> {
        let (passes, work) = self.simulate(&self.early, level, None)?;
        Ok(Level {
            records: passes.records,
            work,
        })
    }

    /// All passes of `scene` on `level`, and their work.
    fn simulate(
        &self,
        scene: &Scene,
        level: usize,
        way: Option<Jumping<'_>>,
    ) -> Result<(Passes, Work), Error> {
        let underway = Underway::default();
        let watch = |_: f64| {
            if underway.node_updates() > MOST_UPDATES {
                ControlFlow::Break(())
            } else {
                ControlFlow::Continue(())
            }
        };
        let mesh = self.plan.levels.mesh(level)?;
        let task = Task {
            scene,
            method: self.method.cable_method(),
            motions: &self.plan.ground.motions,
            mesh,
            stages: &[],
            progress: Progress::new(&watch),
            seen: Some(underway.on_mesh(mesh, false)),
        };
        let period = self.plan.period.len() as u64;
        let passes = match way {
            Some(way) => {
                let way = Jumping {
                    beyond: level >= self.plan.levels.first() || way.guide != cycle_jump::Guide::Free,
                    most_passes: (self.affordable(level) as u64).min(PATIENCE * period),
                    ..way
                };
                task.with_jumps(&way, &listed_passes(scene, way.period))?
            }
            None => task.every_pass()?,
        };
        let periods = way.map_or(0.0, |_| passes.simulated as f64 / period as f64);
        let within_jumps = passes.records.iter().filter(|record| record.interpolated).count();
        let beyond = passes.beyond.as_ref().map_or(0, |beyond| beyond.records.len());
        let listed = (within_jumps + beyond) as f64;
        let work = Work::new(&passes.statistics, task.mesh.nodes(), periods, listed);
        self.spent.set(self.spent.get() + self.seconds(work));
        Ok((passes, work))
    }

    /// Passes after which the run gives up.
    fn affordable(&self, level: usize) -> f64 {
        MAX_NODE_UPDATES as f64 / self.plan.levels.node_updates(level, 1)
    }

    fn seconds(&self, work: Work) -> f64 {
        work.seconds(self.method.cable_method())
    }

    /// With what a run does besides on the level it ends with.
    fn with_extras(&self, outlook: Outlook, known: &Known<'_>) -> Result<Outlook, Error> {
        let Plan {
            scene,
            ground,
            levels,
            ..
        } = self.plan;
        let mut work = outlook.work;
        let passes = known.level_work(outlook.level);
        // One mesh alone does not show its error; one that the scene names may be far too coarse.
        let next = outlook.level + 1;
        if outlook.level == known.coarsest
            || levels.named() && is_doubtful(known.error(outlook.level).0.force, scene.solver.tolerance)
        {
            work += known.level_work(next);
        }
        if let Some(approach) = scene.solver.approach
            && approach < road::needed(scene, &ground.motions)?
        {
            work += passes;
        }
        if matches!(scene.traffic.order, Order::Random { .. }) && matches!(self.method, PassMethod::Jumps(_))
        {
            work += passes.times(random::PASSES_IN_ALL / known.simulated);
        }
        Ok(Outlook { work, ..outlook })
    }
}
