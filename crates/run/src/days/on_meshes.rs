//! Traffic and daily heat: how many simulated periods a day, on which mesh, and what both leave
//! wrong.
//!
//! Every pass finds the cable at the temperature of its hour, so that the cable never comes to rest
//! as it does without heat: days are jumped over, not passes ([`cycle_jump::days`]). The number of
//! simulated periods a day is doubled on a coarse mesh until twice as many change little; then
//! meshes are refined as for every run.

use cable_dem::{CableError, Statistics};

use super::heated_days::{DayJumps, DaySimulator, DaysOnMesh};
use crate::answer::differences::Shares;
use crate::answer::error_estimate::{self, ErrorParts};
use crate::ground::road;
use crate::passes::{RunOptions, Solved};
use crate::plan::{PassMethod, Period, Plan};
use crate::refine::{MeshLoop, OnMeshes, Refined, judge, mesh_reason};
use crate::scene::{Heat, Scene};
use crate::tuning::days::{
    CAUTION, COARSER, COARSEST, FIRST_PERIODS, QUARTERS, RESOLVED, SHARE, TYPICAL, WEIGHT, WEIGHT_UNRESOLVED,
};
use crate::tuning::meshes::{FINDING, MAX_NODE_UPDATES, REFINEMENT_COST};
use crate::{Error, Progress};

/// The days of a plan, on whatever level.
struct DaysOnMeshes<'a> {
    days: DaySimulator<'a>,
    /// Simulated periods a day that are enough, and the error that they leave.
    periods_a_day: u64,
    error: Shares,
    /// The days that they were found on, and their level.
    coarse: Option<(usize, DaysOnMesh)>,
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
    let mut error = ErrorParts::new(plan.ground.accuracy, plan.choice.inertia);
    // What no mesh makes smaller.
    error_estimate::judge(&error, plan.scene.solver.tolerance)?;
    let mut statistics = Statistics::default();
    let days = DaySimulator::new(plan, heat, every_pass);
    let first = first_level(plan);
    let days = DaysOnMeshes::new(days, first, options.progress.part(0.0, FINDING), &mut statistics)?;
    error.temperature = days.error;
    let meshes = MeshLoop {
        plan,
        verify: options.verify,
        progress: options.progress.part(FINDING, 1.0),
        known_error: None,
    };
    let Refined {
        level,
        mesh,
        outcome: finest,
        statistics: work,
    } = meshes.refine(&days, first, &mut error)?;
    statistics += work;
    error.temperature = error.temperature + days.error_of_days(level, &finest, &mut statistics)?;
    error.road = days.road_error(level, &mut statistics)?;
    judge(&error, plan, &mesh, warnings)?;
    let DaysOnMeshes {
        days, periods_a_day, ..
    } = days;
    warnings.extend(days.broken_sequence());
    Ok(Solved {
        reasons: vec![mesh_reason(plan, &mesh), days.reason(&finest, periods_a_day)?],
        shown: None,
        heat: Some(days.record(&finest)?),
        seldom: days.seldom(mesh, &finest.passes.state)?,
        mesh,
        passes: finest.passes,
        error,
        statistics,
        random: None,
    })
}

/// The level to begin with: the first whose typical error leaves room for the other parts.
fn first_level(plan: &Plan<'_>) -> usize {
    if plan.levels.named() {
        return plan.levels.first();
    }
    let allowed = (1.0 - SHARE) * plan.scene.solver.tolerance;
    let fine = TYPICAL.iter().position(|&error| error <= allowed);
    fine.unwrap_or(TYPICAL.len()).max(1)
}

/// Place in [`TYPICAL`] of the mesh of `level`.
fn fineness(plan: &Plan<'_>, level: usize) -> usize {
    let (spacing, _) = plan.levels.spacing(level);
    let nodes = 1.001 * plan.levels.length_scale() / spacing;
    ((nodes / COARSEST).log2() as usize).min(TYPICAL.len() - 1)
}

impl<'a> DaysOnMeshes<'a> {
    /// With as many simulated periods a day as are enough for `level`, found on a coarser one.
    fn new(
        days: DaySimulator<'a>,
        level: usize,
        progress: Progress<'_>,
        statistics: &mut Statistics,
    ) -> Result<Self, Error> {
        let whole = |days| -> Result<Self, Error> {
            Ok(Self {
                periods_a_day: DaySimulator::day(&days, u64::MAX)?.periods(),
                days,
                error: Shares::default(),
                coarse: None,
            })
        };
        if days.every_pass || days.day(FIRST_PERIODS)?.is_simulated() {
            return whole(days);
        }
        let allowed = Shares::both(SHARE * days.plan.scene.solver.tolerance);
        let mut periods_a_day = FIRST_PERIODS;
        let (level, mut fewer) = coarse(&days, level, DayJumps::with(periods_a_day))?;
        let mut parts = progress.halving();
        *statistics += fewer.passes.statistics;
        loop {
            periods_a_day *= 2;
            let jumps = DayJumps::with(periods_a_day).as_in(&fewer);
            let more = days.simulate(level, jumps, parts())?;
            *statistics += more.passes.statistics;
            let error = days.difference(&more, &fewer).times(CAUTION);
            let next = REFINEMENT_COST.saturating_mul(more.passes.statistics.node_updates);
            if error.is_within(allowed) || 4 * next > MAX_NODE_UPDATES {
                return Ok(Self {
                    days,
                    periods_a_day,
                    error,
                    coarse: Some((level, more)),
                });
            }
            if days.day(2 * periods_a_day)?.is_simulated() {
                return whole(days);
            }
            fewer = more;
        }
    }

    fn jumps(&self) -> DayJumps<'static> {
        DayJumps::with(self.periods_a_day)
    }

    /// Whether the period stands in for the traffic.
    fn stands_in(&self) -> bool {
        !self.days.every_pass && !self.days.period.others.is_empty()
    }

    /// What jumps over days leave wrong in those of `finest`, another beginning of the sequence,
    /// and a period that stands in for the traffic: what they change in days on a mesh that is
    /// coarse relative to `level`.
    fn error_of_days(
        &self,
        level: usize,
        finest: &DaysOnMesh,
        statistics: &mut Statistics,
    ) -> Result<Shares, Error> {
        let days = &self.days;
        let are_jumped = finest.days.schedule.iter().any(|length| *length > 0);
        if !(are_jumped || days.breaks_sequence() || self.stands_in()) {
            return Ok(Shares::default());
        }
        let found;
        let (level, own) = if let Some(known) = &self.coarse {
            known
        } else {
            found = coarse(days, level, self.jumps())?;
            *statistics += found.1.passes.statistics;
            &found
        };
        let mut simulate = |days: &DaySimulator<'_>, jumps: DayJumps<'_>| {
            let simulated = days.simulate(*level, jumps, Progress::default())?;
            *statistics += simulated.passes.statistics;
            Ok::<_, Error>(simulated)
        };
        let same = self.jumps().as_in(own);
        let mut error = Shares::default();
        if are_jumped {
            let finer = DayJumps {
                finer: true,
                ..self.jumps()
            };
            error = days.difference(&simulate(days, finer)?, own);
        }
        if days.breaks_sequence() {
            error = error + days.difference_of_days(own, &simulate(&days.begun_later(), same)?);
        }
        if !self.stands_in() {
            return Ok(error);
        }
        for (vehicles, share) in &days.period.others {
            let period = &Period {
                vehicles: vehicles.clone(),
                ..days.period.clone()
            };
            let other = simulate(&DaySimulator { period, ..*days }, same)?;
            error = error + days.difference_of_days(own, &other).times(*share);
        }
        // Nor does the traffic keep the hours at which the period's seldom vehicles come.
        let mut hours = Shares::default();
        for quarter in 1..QUARTERS {
            let begin = quarter * days.period.len() / QUARTERS;
            let other = simulate(&DaySimulator { begin, ..*days }, same)?;
            hours = hours.max(days.difference_of_days(own, &other));
        }
        Ok(error + hours)
    }

    /// What an approach that the scene names leaves out, on `level`: the days once more with
    /// vehicles followed far enough.
    fn road_error(&self, level: usize, statistics: &mut Statistics) -> Result<Shares, Error> {
        let Plan { scene, ground, .. } = self.days.plan;
        if road::is_followed_enough(scene, &ground.motions)? {
            return Ok(Shares::default());
        }
        let near = coarse(&self.days, level, self.jumps())?;
        let mut scene: Scene = (*scene).clone();
        scene.solver.approach = None;
        let jumps = self.jumps().as_in(&near.1);
        let far = self
            .days
            .simulate_scene(&scene, near.0, jumps, Progress::default())?;
        *statistics += near.1.passes.statistics;
        *statistics += far.passes.statistics;
        Ok(self.days.difference(&far, &near.1))
    }
}

/// The days on a level that is coarse relative to `level`, if there is one, and that level.
fn coarse(days: &DaySimulator<'_>, level: usize, jumps: DayJumps<'_>) -> Result<(usize, DaysOnMesh), Error> {
    for coarser in level.saturating_sub(COARSER)..level {
        if days.plan.levels.mesh(coarser).is_err() {
            continue;
        }
        match days.simulate(coarser, jumps, Progress::default()) {
            Err(Error::Cable(CableError::CoarseMesh { .. })) => {}
            simulated => return Ok((coarser, simulated?)),
        }
    }
    Ok((level, days.simulate(level, jumps, Progress::default())?))
}

impl OnMeshes for DaysOnMeshes<'_> {
    type Outcome = DaysOnMesh;

    fn simulate(
        &self,
        level: usize,
        below: Option<&DaysOnMesh>,
        progress: Progress<'_>,
        _: bool,
    ) -> Result<DaysOnMesh, Error> {
        let jumps = below.map_or(self.jumps(), |below| self.jumps().as_in(below));
        self.days.simulate(level, jumps, progress)
    }

    fn known(&self, level: usize) -> Option<DaysOnMesh> {
        let known = self.coarse.clone().filter(|(coarse, _)| *coarse == level);
        known.map(|(_, days)| days)
    }

    fn levels_below(&self, first: usize) -> usize {
        first.min(1)
    }

    fn difference(&self, one: &DaysOnMesh, other: &DaysOnMesh) -> Shares {
        self.days.difference(one, other)
    }

    fn mesh_error(&self, level: usize, outcomes: &[DaysOnMesh]) -> Shares {
        let [.., coarse, fine] = outcomes else {
            return Shares::default();
        };
        let fineness = fineness(self.days.plan, level);
        let weight = if fineness < RESOLVED {
            WEIGHT_UNRESOLVED
        } else {
            WEIGHT
        };
        let typical = Shares::both(TYPICAL[fineness]);
        self.difference(fine, coarse).times(weight).max(typical)
    }

    fn is_still(&self, _: &DaysOnMesh) -> bool {
        false
    }

    fn work(outcome: &DaysOnMesh) -> Statistics {
        outcome.passes.statistics
    }
}
