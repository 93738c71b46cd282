//! Traffic and daily heat: how many real periods a day, on which mesh, and what both leave wrong.
//!
//! Every pass finds the cable at the temperature of its hour, so that the cable never comes to rest as it does without heat: jumps over
//! passes are not for it, and crate `cycle-jump` lives its days otherwise ([`cycle_jump::days`]). The number of real periods a day is
//! doubled on a coarse mesh until twice as many change little; then meshes are refined as for every run.

use cable_dem::{CableError, Statistics};
use cycle_jump::JumpError;

use super::budget::{MAX_NODE_UPDATES, REFINEMENT_COST, allowed, max_node_updates};
use super::judge::{judge, mesh_reason};
use super::lived::{Lived, Living};
use super::options::RunOptions;
use super::refine::{FINDING, Solved};
use crate::answer::error_estimate::{self, ErrorParts, Shares, VERIFIED, is_doubtful};
use crate::ground::road;
use crate::plan::{PassMethod, Period, Plan};
use crate::scene::{Heat, Scene};
use crate::{Error, Progress};

/// Real periods a day to begin with.
const FIRST_KNOTS: u64 = 16;
/// More than so many make no days settle that fewer do not, of 52 random scenes.
const MOST_KNOTS: u64 = 2048;
/// They are looked for so many levels below the first, where a pass costs a sixteenth.
const COARSER: usize = 2;
/// What twice as many real periods a day change, times this, is the error of as many: it halves, or nearly so.
const CAUTION: f64 = 3.0;
/// Share of the tolerance that days with few real periods may take.
const SHARE: f64 = 0.5;
/// Typical errors of the forces with 3, 6, 12, … nodes a depth, below which none is stated, and what is left of the difference to a mesh
/// half as fine: measured on nine scenes up to 24 nodes. From 12 on differences fall by a factor of 4 to 14.
const TYPICAL: [f64; 4] = [5e-2, 1.2e-2, 1.5e-3, 4e-4];
const COARSEST: f64 = 3.0;
const RESOLVED: usize = 2;
const LEFT: f64 = 0.4;
const LEFT_UNRESOLVED: f64 = 2.0;
/// Parts of a period with which days begin that are compared.
const QUARTERS: usize = 4;

/// Real periods a day that are enough, what they leave wrong, and the days they were found on, with their level.
struct Found {
    knots: u64,
    left: Shares,
    coarse: Option<(usize, Lived)>,
}

impl Found {
    /// Every period of a day.
    fn exact(knots: u64) -> Self {
        Self {
            knots,
            left: Shares::default(),
            coarse: None,
        }
    }
}

/// Carries `plan`, whose scene has `heat`, out.
pub fn solve(
    plan: &Plan<'_>,
    heat: &Heat,
    method: PassMethod,
    options: &RunOptions<'_>,
    warnings: &mut Vec<String>,
) -> Result<Solved, Error> {
    let every_pass = matches!(method, PassMethod::EveryPass(_));
    let living = Living::new(plan, heat, every_pass, options.progress);
    living.solve(options.verify, warnings)
}

impl Living<'_> {
    fn solve(&self, verify: bool, warnings: &mut Vec<String>) -> Result<Solved, Error> {
        let Plan {
            scene,
            ground,
            choice,
            levels,
            ..
        } = self.plan;
        let tolerance = scene.solver.tolerance;
        let mut error = ErrorParts::new(ground.accuracy, choice.inertia);
        // What no mesh makes smaller.
        error_estimate::judge(&error, tolerance)?;
        let mut statistics = Statistics::default();
        let mut level = self.first_level();
        let Found { knots, left, coarse } = self.knots(level, &mut statistics)?;
        error.temperature = left;
        let mut coarse = coarse
            .filter(|(coarse, _)| coarse + 1 == level)
            .map(|(_, lived)| lived);
        let known = coarse.is_some();
        let mut parts = self.progress.part(FINDING, 1.0).refining();
        let found = knots;
        let (knots, (mut below, mut finest)) = self.settling(knots, |knots| {
            // With as many real periods a day as they were found with.
            let below = match (coarse.take(), level.checked_sub(1)) {
                (None, Some(below)) => self.on_coarse(below, knots)?,
                (known, _) => known,
            };
            Ok((below, self.live(level, knots, parts())?))
        })?;
        if let Some(below) = below.as_ref().filter(|_| !known || knots != found) {
            statistics += below.passes.statistics;
        }
        loop {
            statistics += finest.passes.statistics;
            if let Some(coarse) = &below {
                let typical = Shares::both(TYPICAL[self.fineness(level)]);
                let difference = self.difference(&finest, coarse);
                error.mesh = difference.times(self.left(level)).max(typical);
            }
            let finer = REFINEMENT_COST.saturating_mul(finest.passes.statistics.node_updates);
            let costly = finer > max_node_updates(tolerance);
            let others = error.total().less(error.mesh);
            let within = error.mesh.is_within(allowed(tolerance, others));
            if costly || level >= levels.finest() || below.is_some() && within {
                break;
            }
            level += 1;
            let finer = self.live(level, knots, parts())?;
            below = Some(std::mem::replace(&mut finest, finer));
        }
        // No mesh that the scene names is refused for what coarser ones show.
        let doubtful = levels.named() && is_doubtful(error.total().force, tolerance);
        if below.is_none() || verify || doubtful {
            let finer = self.live(level + 1, knots, parts())?;
            statistics += finer.passes.statistics;
            error.mesh = self.difference(&finest, &finer).times(VERIFIED);
            error.measured = true;
        }
        error.temperature = error.temperature
            + Shares {
                force: finest.days.surprise.0,
                movement: finest.days.surprise.1,
            };
        error.temperature = error.temperature + self.sequence_error(level, knots, &mut statistics)?;
        error.temperature = error.temperature + self.mix_error(level, knots, &mut statistics)?;
        error.road = self.road_error(level, knots, &mut statistics)?;
        let mesh = levels.mesh(level)?;
        judge(&error, self.plan, &mesh, warnings)?;
        warnings.extend(self.broken_sequence());
        let seldom = if self.every_pass {
            Vec::new()
        } else {
            self.seldom(mesh, &finest.passes.state)?
        };
        Ok(Solved {
            reasons: vec![mesh_reason(self.plan, &mesh), self.reason(&finest, knots)],
            shown: None,
            heat: Some(self.record(&finest)?),
            mesh,
            passes: finest.passes,
            error,
            statistics,
            random: None,
            seldom,
        })
    }

    /// What `days` come to with so many real periods a day, from `knots` on, that each becomes like the one before: too few never settle.
    fn settling<T>(
        &self,
        mut knots: u64,
        mut days: impl FnMut(u64) -> Result<T, Error>,
    ) -> Result<(u64, T), Error> {
        loop {
            let may_double = 2 * knots <= MOST_KNOTS && !self.day(knots).is_simulated();
            match days(knots) {
                Err(Error::Jumps(JumpError::NeverPeriodic { .. })) if may_double => {
                    knots *= 2;
                }
                days => return Ok((knots, days?)),
            }
        }
    }

    /// Share of the difference to a mesh half as fine that the mesh of `level` leaves wrong.
    fn left(&self, level: usize) -> f64 {
        if self.fineness(level) < RESOLVED {
            LEFT_UNRESOLVED
        } else {
            LEFT
        }
    }

    /// Place in [`TYPICAL`] of the mesh of `level`.
    fn fineness(&self, level: usize) -> usize {
        let (spacing, _) = self.plan.levels.spacing(level);
        let nodes = 1.001 * self.plan.levels.length_scale() / spacing;
        ((nodes / COARSEST).log2() as usize).min(TYPICAL.len() - 1)
    }

    /// What days change that begin the sequence of vehicles where another has left it, on a level that is coarse beside `level`.
    fn sequence_error(&self, level: usize, knots: u64, statistics: &mut Statistics) -> Result<Shares, Error> {
        if !self.breaks_sequence() {
            return Ok(Shares::default());
        }
        let (level, own) = self.coarse(level, knots)?;
        let other = self.begun_later().live(level, knots, Progress::default())?;
        *statistics += own.passes.statistics;
        *statistics += other.passes.statistics;
        Ok(self.difference_of_days(&own, &other))
    }

    /// What a period changes that stands in for the traffic: its share of what others do, on a level that is coarse beside `level`.
    fn mix_error(&self, level: usize, knots: u64, statistics: &mut Statistics) -> Result<Shares, Error> {
        let mut error = Shares::default();
        if self.every_pass || self.period.others.is_empty() {
            return Ok(error);
        }
        let (level, own) = self.coarse(level, knots)?;
        *statistics += own.passes.statistics;
        for (vehicles, share) in &self.period.others {
            let period = Period {
                vehicles: vehicles.clone(),
                ..self.period.clone()
            };
            let living = Living {
                period: &period,
                ..*self
            };
            let other = living.live(level, knots, Progress::default())?;
            *statistics += other.passes.statistics;
            error = error + self.difference_of_days(&own, &other).times(*share);
        }
        // Nor does the traffic keep the hours at which the period's seldom vehicles come.
        let mut hours = Shares::default();
        for quarter in 1..QUARTERS {
            let living = Living {
                begin: quarter * self.period.len() / QUARTERS,
                ..*self
            };
            let other = living.live(level, knots, Progress::default())?;
            *statistics += other.passes.statistics;
            hours = hours.max(self.difference_of_days(&own, &other));
        }
        Ok(error + hours)
    }

    /// What an approach that the scene names leaves out, on `level`: the days once more with vehicles followed far enough.
    fn road_error(&self, level: usize, knots: u64, statistics: &mut Statistics) -> Result<Shares, Error> {
        let Plan { scene, ground, .. } = self.plan;
        let enough = road::needed(scene, &ground.motions)?;
        if scene.solver.approach.is_none_or(|approach| approach >= enough) {
            return Ok(Shares::default());
        }
        let near = self.coarse(level, knots)?;
        let mut scene: Scene = (*scene).clone();
        scene.solver.approach = None;
        let far = self.live_in(&scene, near.0, knots, Progress::default())?;
        *statistics += near.1.passes.statistics;
        *statistics += far.passes.statistics;
        Ok(self.difference(&far, &near.1))
    }

    /// The level to begin with: the first whose typical error leaves room for the other parts.
    fn first_level(&self) -> usize {
        let levels = &self.plan.levels;
        if levels.named() {
            return levels.first();
        }
        let allowed = (1.0 - SHARE) * self.plan.scene.solver.tolerance;
        let fine = TYPICAL.iter().position(|&error| error <= allowed);
        fine.unwrap_or(TYPICAL.len()).max(1)
    }

    /// The same on a level that may be too coarse for the duct or its motion.
    fn on_coarse(&self, level: usize, knots: u64) -> Result<Option<Lived>, Error> {
        if self.plan.levels.mesh(level).is_err() {
            return Ok(None);
        }
        match self.live(level, knots, Progress::default()) {
            Err(Error::Cable(CableError::CoarseMesh { .. })) => Ok(None),
            lived => lived.map(Some),
        }
    }

    /// The same on a level that is coarse beside `level`, where there is one, and that level.
    fn coarse(&self, level: usize, knots: u64) -> Result<(usize, Lived), Error> {
        for coarser in level.saturating_sub(COARSER)..level {
            if let Some(lived) = self.on_coarse(coarser, knots)? {
                return Ok((coarser, lived));
            }
        }
        Ok((level, self.live(level, knots, Progress::default())?))
    }

    /// Real periods a day that are enough for `level`, found on a coarser one, and what they leave wrong.
    fn knots(&self, level: usize, statistics: &mut Statistics) -> Result<Found, Error> {
        let all = self.day(u64::MAX).periods();
        if self.every_pass || self.day(FIRST_KNOTS).is_simulated() {
            return Ok(Found::exact(all));
        }
        let allowed = Shares::both(SHARE * self.plan.scene.solver.tolerance);
        let (mut knots, (level, mut fewer)) =
            self.settling(FIRST_KNOTS, |knots| self.coarse(level, knots))?;
        let mut parts = self.progress.part(0.0, FINDING).halving();
        *statistics += fewer.passes.statistics;
        loop {
            let (doubled, more) = self.settling(2 * knots, |knots| self.live(level, knots, parts()))?;
            *statistics += more.passes.statistics;
            let difference = self.difference(&more, &fewer);
            if difference.times(CAUTION).is_within(allowed) {
                return Ok(Found {
                    knots,
                    left: difference.times(CAUTION),
                    coarse: Some((level, fewer)),
                });
            }
            knots = doubled;
            if self.day(knots).is_simulated() {
                return Ok(Found::exact(knots));
            }
            let costly =
                4 * REFINEMENT_COST.saturating_mul(more.passes.statistics.node_updates) > MAX_NODE_UPDATES;
            if difference.is_within(allowed) || costly {
                return Ok(Found {
                    knots,
                    left: difference,
                    coarse: Some((level, more)),
                });
            }
            fewer = more;
        }
    }
}
