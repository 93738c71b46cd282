//! Jumps that are good enough: how large they may be, and what they leave wrong.
//!
//! Two runs that differ in the error of a single jump and in the length of the first one differ by
//! about the error of either. Each is compared with one whose jumps are half as large, and where
//! both begin with the same jump, with one that begins later.

use cycle_jump::STEADY;

use super::PassSimulator;
use super::draws::Draws;
use super::stand_ins::StandIns;
use crate::Progress;
use crate::answer::JumpSize;
use crate::answer::differences::Shares;
use crate::passes::{Jumping, Passes};
use crate::refine::{OnMeshes, on_coarse_level};
use crate::tuning::jumps::{
    FIRST, FIRST_PASSES, LARGEST, MAX_FIRST_PERIODS, MAX_GROWTH, MIN_FIRST_PERIODS, SHARE, SHORT,
};
use crate::tuning::meshes::REFINEMENT_COST;
use creepage_plan::tuning::meshes::MAX_NODE_UPDATES;
use creepage_plan::{Error, Period, Plan};

const FINEST: usize = 8;

/// Jumps that are good enough, where they were found.
pub struct Found {
    /// The level they were found on, and its passes.
    pub level: usize,
    pub passes: Passes,
    pub size: JumpSize,
    /// What they leave wrong on that level.
    jumps: Shares,
    /// What periods leave wrong that stand in for the traffic.
    stand_ins: Shares,
    /// What a random order changes.
    pub draws: Option<Draws>,
}

impl Found {
    /// What is wrong in `passes` by these jumps, on another mesh as many times as much as they have
    /// missed there.
    pub fn error_of(&self, passes: &Passes) -> Shares {
        // Jumps that missed less than their error say nothing of it.
        let least = self.passes.missed.max(self.jumps.worse());
        let times = (passes.missed / least.max(f64::MIN_POSITIVE)).clamp(1.0, MAX_GROWTH);
        self.jumps.times(times) + self.stand_ins
    }
}

/// Finds jumps for the passes of a plan that take at most their share of the tolerance, or the best
/// that are affordable.
pub fn find<'a>(simulator: PassSimulator<'a>, progress: Progress<'a>) -> Result<Found, Error> {
    let mut search = Search {
        allowed: Shares::both(SHARE * simulator.plan.scene.solver.tolerance),
        simulator,
        progress,
    };
    let mut found = search.jumps()?;
    let mut stand_ins = StandIns::new(search, &found);
    let mut error = stand_ins.mix_error()?;
    if simulator.plan.period.is_drawn {
        let draws = stand_ins.draws()?;
        error = error + draws.error;
        found.draws = Some(draws);
    }
    found.stand_ins = error;
    Ok(found)
}

impl JumpSize {
    /// The largest jumps over the passes of `plan` that are tried.
    fn largest(plan: &Plan<'_>) -> Self {
        let periods = (FIRST_PASSES / plan.period.len()) as u64;
        Self {
            tolerance: (FIRST.0 * plan.scene.solver.tolerance).min(LARGEST),
            first_periods: periods.clamp(MIN_FIRST_PERIODS, MAX_FIRST_PERIODS),
            first_jump: FIRST.1,
        }
    }

    /// With half the error of a jump and a first jump half as long.
    fn finer(self) -> Self {
        Self {
            tolerance: 0.5 * self.tolerance,
            first_jump: 0.5 * self.first_jump,
            ..self
        }
    }
}

/// The first jump of these passes: after how many more periods than at the start, and its length.
fn first_jump(passes: &Passes) -> Option<(usize, u64)> {
    let mut lengths = passes.schedule.iter().copied().enumerate();
    lengths.find(|(_, length)| *length > 0)
}

/// Runs with jumps of one plan, each compared with others.
pub(super) struct Search<'a> {
    pub(super) simulator: PassSimulator<'a>,
    /// Error that jumps may leave.
    pub(super) allowed: Shares,
    progress: Progress<'a>,
}

impl Search<'_> {
    /// The passes by jumps of this `size` over `period`.
    pub(super) fn simulate(
        &mut self,
        level: usize,
        size: JumpSize,
        period: &Period,
    ) -> Result<Passes, Error> {
        let simulator = PassSimulator {
            jumping: Some(Jumping::new(period, size)),
            ..self.simulator
        };
        let plan = simulator.plan;
        // The answer's first mesh is not simulated again.
        let answer = level == plan.levels.first && *period == plan.period;
        // How many runs it takes is not known: each is half of what is left.
        simulator.simulate(plan.scene, level, None, self.progress.next(0.5), answer)
    }

    /// The passes by jumps of this `size` that begin with twice as many periods as came before the
    /// `place` of the first jump; and that size.
    fn begun_later(
        &mut self,
        level: usize,
        size: JumpSize,
        place: usize,
    ) -> Result<(JumpSize, Passes), Error> {
        let first_periods = 2 * (size.first_periods + place as u64);
        let later = JumpSize {
            first_periods,
            ..size
        };
        let passes = self.simulate(level, later, &self.simulator.plan.period)?;
        Ok((later, passes))
    }

    /// Jumps with less error than `larger` ones of this `size`, their passes, and how far they lie
    /// apart.
    fn finer(
        &mut self,
        level: usize,
        size: JumpSize,
        larger: &Passes,
    ) -> Result<(JumpSize, Passes, Shares), Error> {
        let size = size.finer();
        let passes = self.simulate(level, size, &self.simulator.plan.period)?;
        let off = self.simulator.difference(&passes, larger);
        let same = first_jump(&passes).filter(|jump| Some(*jump) == first_jump(larger));
        let Some((place, _)) = same else {
            return Ok((size, passes, off));
        };
        // There both err alike, and finer ones would too.
        let (later, of_later) = self.begun_later(level, size, place)?;
        let off = off.max(self.simulator.difference(&passes, &of_later));
        Ok(if off.is_within(self.allowed) {
            (size, passes, off)
        } else {
            (later, of_later, off)
        })
    }

    /// The largest jumps whose error is allowed.
    fn jumps(&mut self) -> Result<Found, Error> {
        let (plan, allowed) = (self.simulator.plan, self.allowed);
        let (scene, levels, period) = (plan.scene, &plan.levels, &plan.period);
        let mut size = JumpSize::largest(plan);
        // A short duct costs little, and the few nodes of a coarser mesh behave differently.
        let below = usize::from(scene.duct.length > SHORT * scene.duct.depth);
        let (level, mut passes) = on_coarse_level(levels, levels.first, below, |level| {
            self.simulate(level, size, period)
        })?;
        let mut error = None;
        let is_alone = passes.schedule.iter().filter(|length| **length > 0).count() == 1;
        if let Some((place, _)) = first_jump(&passes).filter(|_| is_alone) {
            // It goes to the end whatever error is allowed: finer ones would be the same. Where it
            // changes nothing, the period simulated at its end has shown all that it can miss.
            size = size.finer();
            let off = passes.missed.max(passes.changed);
            error = Some(if off < STEADY {
                Shares::both(off)
            } else {
                let (_, later) = self.begun_later(level, size, place)?;
                self.simulator.difference(&passes, &later)
            });
        }
        let cost = 2 * REFINEMENT_COST.pow((levels.first - level) as u32);
        let is_costly = |passes: &Passes| cost * passes.statistics.work() > MAX_NODE_UPDATES;
        for _ in 0..FINEST {
            if error.is_some_and(|off: Shares| off.is_within(allowed) || is_costly(&passes)) {
                break;
            }
            let (finer, of_finer, off) = match self.finer(level, size, &passes) {
                Err(Error::Jumps(_)) if error.is_some() => break,
                finer => finer?,
            };
            (size, passes, error) = (finer, of_finer, Some(off));
        }
        let mut error = error.unwrap_or_default();
        // Both are of the same displacements, and movements are fewer: they may agree by chance.
        error.movement = error.worse();
        Ok(Found {
            level,
            passes,
            size,
            jumps: error,
            stand_ins: Shares::default(),
            draws: None,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::answer::differences::Scale;
    use crate::refine::Work;
    use crate::run;
    use creepage_plan::plan;
    use creepage_scene::Scene;
    use cycle_jump::Guide;

    /// A short duct between springs, whose cable lies still after ten passes: the first jump goes
    /// to the end, whatever error is asked for.
    const SETTLED: &str = "
[duct]
length = 12.6
depth = 1.13
[[ground.layers]]
young_modulus = 1.5e8
poisson_ratio = 0.42
[cable]
weight = 168
axial_stiffness = 1.35e7
[friction]
dynamic_coefficient = 0.305
shape_factor = 1.28e6
[ends]
upstream = { spring = 1e5 }
downstream = { spring = 5.35e6 }
[[vehicles]]
speed = 7
load = 1.6e5
[traffic]
passes = 120
";

    #[test]
    fn two_runs_that_take_the_same_jumps_do_not_make_them_exact() {
        let jumped = run(&Scene::from_toml("scene", SETTLED).unwrap()).unwrap();
        let stated = jumped.error_estimate.parts.passes;
        assert!(jumped.cost.simulated_passes < 20 && stated > 0.0, "{stated}");
        let every = SETTLED.to_owned() + "[solver]\nmethod = \"quasi-static\"";
        let every = run(&Scene::from_toml("scene", &every).unwrap()).unwrap();
        for (jumped, every) in jumped.passes.iter().zip(&every.passes) {
            let (force, exact) = (jumped.downstream_peak_n, every.downstream_peak_n);
            assert!((force - exact).abs() <= 0.01 * exact, "{force} {exact}");
        }
    }

    /// Jumps that miss more on the last mesh, which is four times as fine, than on the one where they were found.
    const ROUGH: &str = "
[duct]
length = 10.15
depth = 1.29
[[ground.layers]]
thickness = 0.205
young_modulus = 9.33e8
poisson_ratio = 0.266
[[ground.layers]]
thickness = 0.1975
young_modulus = 3.876e8
poisson_ratio = 0.362
[[ground.layers]]
young_modulus = 1.05e8
poisson_ratio = 0.2465
[cable]
weight = 21.3
axial_stiffness = 1.48e7
normal_load_factor = 1.3
[friction]
law = \"coulomb\"
dynamic_coefficient = 0.28
[ends]
upstream = { spring = 2.45e5 }
downstream = \"free\"
[[vehicles]]
speed = 18
direction = \"reverse\"
lateral_offset = 2.63
wheels = [
    { x = 0, y = 1.02, load = 37800, contact_radius = 0.1 },
    { x = 0, y = -1.02, load = 37800, contact_radius = 0.1 },
    { x = -5.03, y = 0.9, load = 35400, contact_radius = 0.117 },
    { x = -5.03, y = -0.9, load = 35400, contact_radius = 0.117 },
    { x = -8.57, y = 0.83, load = 30100, contact_radius = 0.1885 },
    { x = -8.57, y = -0.83, load = 30100, contact_radius = 0.1885 },
]
[traffic]
passes = 40
[solver]
tolerance = 0.0998
";

    /// Simulates every pass of a plan.
    fn simulator<'a>(plan: &'a Plan<'_>, work: &'a Work) -> PassSimulator<'a> {
        PassSimulator {
            scale: Scale::new(plan.scene, &plan.ground.motions),
            plan,
            stages: &[],
            jumping: None,
            found: None,
            work,
        }
    }

    #[test]
    fn jumps_that_begin_alike_are_made_finer_by_a_later_beginning() {
        let tolerance = 1e-5;
        let exact = ROUGH.replace("passes = 40", "passes = 4000");
        let exact = exact.replace("0.0998", &format!("{tolerance}\nnode_spacing = 0.4"));
        let scene = Scene::from_toml("scene", &exact).unwrap();
        let (plan, work) = (plan(&scene).unwrap(), Work::default());
        let found = find(simulator(&plan, &work), Progress::default()).unwrap();
        assert!(found.jumps.is_within(Shares::both(SHARE * tolerance)));
        assert!(found.size.first_periods > JumpSize::largest(&plan).first_periods);
    }

    #[test]
    fn what_jumps_miss_on_a_finer_mesh_is_stated() {
        let scene = Scene::from_toml("scene", ROUGH).unwrap();
        let (plan, work) = (plan(&scene).unwrap(), Work::default());
        let every = simulator(&plan, &work);
        let found = find(every, Progress::default()).unwrap();
        let mut jumping = Jumping::new(&plan.period, found.size);
        jumping.guide = Guide::Follow(&found.passes.schedule);
        let jumped = PassSimulator {
            jumping: Some(jumping),
            ..every
        };
        let on_finer = |simulator: PassSimulator<'_>| {
            let passes = simulator.simulate(&scene, found.level + 2, None, Progress::default(), true);
            passes.unwrap()
        };
        let (jumped, every_pass) = (on_finer(jumped), on_finer(every));
        let (off, error) = (every.difference(&jumped, &every_pass), found.error_of(&jumped));
        assert!(jumped.simulated < every_pass.simulated);
        assert!(off.is_within(error), "{off:?} {error:?}");
        // What they leave wrong on the coarse mesh would be too little.
        let coarse = found.error_of(&found.passes);
        assert!(off.movement > coarse.movement, "{off:?} {coarse:?}");
    }
}
