//! Traffic and daily heat: how many real periods a day, on which mesh, and what both leave wrong.
//!
//! Every pass finds the cable at the temperature of its hour, so that the cable never comes to rest as it does without heat: days are jumped
//! over, not passes ([`cycle_jump::days`]). The number of real periods a day is doubled on a coarse mesh until twice as many change little;
//! then meshes are refined as for every run.

use cable_dem::{CableError, Statistics};

use super::budget::{MAX_NODE_UPDATES, REFINEMENT_COST, allowed, max_node_updates};
use super::judge::{judge, mesh_reason};
use super::lived::{Jumping, Lived, Living};
use super::options::RunOptions;
use super::refine::{FINDING, Solved};
use crate::answer::error_estimate::{self, ErrorParts, Shares, VERIFIED, is_doubtful};
use crate::ground::road;
use crate::plan::{PassMethod, Period, Plan};
use crate::scene::{Heat, Scene};
use crate::{Error, Progress};

/// Real periods a day to begin with.
const FIRST_KNOTS: u64 = 16;
/// They are looked for so many levels below the first, where a pass costs a sixteenth.
const COARSER: usize = 2;
/// What half as many real periods a day change, times this, is the error of as many: of fifteen scenes with 24 and 48 or more it covers all, but a
/// movement that was off by 0.18 %.
const CAUTION: f64 = 2.0;
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
        let jumping = Jumping::with(knots);
        let known = coarse.clone().filter(|(coarse, _)| coarse + 1 == level);
        let mut parts = self.progress.part(FINDING, 1.0).refining();
        let mut below = match (known, level.checked_sub(1)) {
            (None, Some(below)) => self
                .on_coarse(below, jumping)?
                .inspect(|lived| statistics += lived.passes.statistics),
            (known, _) => known.map(|(_, lived)| lived),
        };
        let as_below = below.as_ref().map_or(jumping, |below| jumping.as_in(below));
        let mut finest = self.live(level, as_below, parts())?;
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
            let finer = self.live(level, jumping.as_in(&finest), parts())?;
            below = Some(std::mem::replace(&mut finest, finer));
        }
        // No mesh that the scene names is refused for what coarser ones show.
        let doubtful = levels.named() && is_doubtful(error.total().force, tolerance);
        if below.is_none() || verify || doubtful {
            let finer = self.live(level + 1, jumping.as_in(&finest), parts())?;
            statistics += finer.passes.statistics;
            error.mesh = self.difference(&finest, &finer).times(VERIFIED);
            error.measured = true;
        }
        let jumps = finest.days.schedule.iter().any(|length| *length > 0);
        if jumps || self.breaks_sequence() || self.stands_in() {
            let coarse = if let Some(known) = coarse {
                known
            } else {
                let made = self.coarse(level, jumping)?;
                statistics += made.1.passes.statistics;
                made
            };
            let days = self.days_error(&coarse, jumping, jumps, &mut statistics)?;
            error.temperature = error.temperature + days;
        }
        error.road = self.road_error(level, jumping, &mut statistics)?;
        let mesh = levels.mesh(level)?;
        judge(&error, self.plan, &mesh, warnings)?;
        warnings.extend(self.broken_sequence());
        let seldom = if self.every_pass {
            Vec::new()
        } else {
            self.seldom(mesh, &finest.passes.state)?
        };
        Ok(Solved {
            reasons: vec![mesh_reason(self.plan, &mesh), self.reason(&finest, knots)?],
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

    /// Whether the period stands in for the traffic.
    fn stands_in(&self) -> bool {
        !self.every_pass && !self.period.others.is_empty()
    }

    /// What jumps over days leave wrong, another beginning of the sequence, and a period that stands in for the traffic: what they change in days
    /// on a `coarse` level.
    fn days_error(
        &self,
        (level, own): &(usize, Lived),
        jumping: Jumping<'_>,
        jumps: bool,
        statistics: &mut Statistics,
    ) -> Result<Shares, Error> {
        let mut live = |living: &Living<'_>, jumping: Jumping<'_>| {
            let lived = living.live(*level, jumping, Progress::default())?;
            *statistics += lived.passes.statistics;
            Ok::<_, Error>(lived)
        };
        let (same, finer) = (jumping.as_in(own), true);
        let mut error = Shares::default();
        if jumps {
            error = self.difference(&live(self, Jumping { finer, ..jumping })?, own);
        }
        if self.breaks_sequence() {
            error = error + self.difference_of_days(own, &live(&self.begun_later(), same)?);
        }
        if !self.stands_in() {
            return Ok(error);
        }
        for (vehicles, share) in &self.period.others {
            let period = Period {
                vehicles: vehicles.clone(),
                ..self.period.clone()
            };
            let period = &period;
            let other = live(&Living { period, ..*self }, same)?;
            error = error + self.difference_of_days(own, &other).times(*share);
        }
        // Nor does the traffic keep the hours at which the period's seldom vehicles come.
        let mut hours = Shares::default();
        for quarter in 1..QUARTERS {
            let begin = quarter * self.period.len() / QUARTERS;
            let other = live(&Living { begin, ..*self }, same)?;
            hours = hours.max(self.difference_of_days(own, &other));
        }
        Ok(error + hours)
    }

    /// What an approach that the scene names leaves out, on `level`: the days once more with vehicles followed far enough.
    fn road_error(
        &self,
        level: usize,
        jumping: Jumping<'_>,
        statistics: &mut Statistics,
    ) -> Result<Shares, Error> {
        let Plan { scene, ground, .. } = self.plan;
        let enough = road::needed(scene, &ground.motions)?;
        if scene.solver.approach.is_none_or(|approach| approach >= enough) {
            return Ok(Shares::default());
        }
        let near = self.coarse(level, jumping)?;
        let mut scene: Scene = (*scene).clone();
        scene.solver.approach = None;
        let far = self.live_in(&scene, near.0, jumping.as_in(&near.1), Progress::default())?;
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
    fn on_coarse(&self, level: usize, jumping: Jumping<'_>) -> Result<Option<Lived>, Error> {
        if self.plan.levels.mesh(level).is_err() {
            return Ok(None);
        }
        match self.live(level, jumping, Progress::default()) {
            Err(Error::Cable(CableError::CoarseMesh { .. })) => Ok(None),
            lived => lived.map(Some),
        }
    }

    /// The same on a level that is coarse beside `level`, where there is one, and that level.
    fn coarse(&self, level: usize, jumping: Jumping<'_>) -> Result<(usize, Lived), Error> {
        for coarser in level.saturating_sub(COARSER)..level {
            if let Some(lived) = self.on_coarse(coarser, jumping)? {
                return Ok((coarser, lived));
            }
        }
        Ok((level, self.live(level, jumping, Progress::default())?))
    }

    /// Real periods a day that are enough for `level`, found on a coarser one, and what they leave wrong.
    fn knots(&self, level: usize, statistics: &mut Statistics) -> Result<Found, Error> {
        let all = self.day(u64::MAX)?.periods();
        if self.every_pass || self.day(FIRST_KNOTS)?.is_simulated() {
            return Ok(Found::exact(all));
        }
        let allowed = Shares::both(SHARE * self.plan.scene.solver.tolerance);
        let mut knots = FIRST_KNOTS;
        let (level, mut fewer) = self.coarse(level, Jumping::with(knots))?;
        let mut parts = self.progress.part(0.0, FINDING).halving();
        *statistics += fewer.passes.statistics;
        loop {
            knots *= 2;
            let more = self.live(level, Jumping::with(knots).as_in(&fewer), parts())?;
            *statistics += more.passes.statistics;
            let left = self.difference(&more, &fewer).times(CAUTION);
            let next = REFINEMENT_COST.saturating_mul(more.passes.statistics.node_updates);
            if left.is_within(allowed) || 4 * next > MAX_NODE_UPDATES {
                let coarse = Some((level, more));
                return Ok(Found { knots, left, coarse });
            }
            if self.day(2 * knots)?.is_simulated() {
                return Ok(Found::exact(all));
            }
            fewer = more;
        }
    }
}
