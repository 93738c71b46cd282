//! Runs of a scene with one measure and one combination of what is not known.

use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use rayon::prelude::*;

use super::answer::Outcome;
use super::unknown::{Combination, MOST_COMBINATIONS};
use crate::design;
use creepage_plan::ground::KnownGrounds;
use creepage_plan::plan_over;
use creepage_run::answer::largest_movement_in_duct;
use creepage_run::run::run_over;
use creepage_run::{Error, FixedMesh, Limited, Limits, Place, Progress, Run, RunOptions};
use creepage_scene::{CableEnd, End, Measure, Scene, SceneFile};

/// What a run with the scene's own tolerance costs, in rough runs: 3 to 60. Both kinds are mixed, so that the progress hardly depends on it.
const OWN_COST: usize = 20;

/// The limits of a scene, with whatever clamps it has.
pub type LimitsOf<'a> = &'a (dyn Fn(&Scene) -> Limits + Sync);

/// All runs of a scene.
pub struct Runs<'a> {
    file: &'a SceneFile,
    limits: LimitsOf<'a>,
    progress: Progress<'a>,
    /// Node spacing and vehicle step of rough runs \[m\], and what one of them has shown.
    mesh: (f64, f64),
    shown: Option<FixedMesh>,
    grounds: KnownGrounds,
    /// How many there were, what they cost and what all will [rough runs].
    made: AtomicUsize,
    cost: AtomicUsize,
    expected: usize,
}

impl<'a> Runs<'a> {
    /// Runs of which so many are expected, rough and with the scene's own tolerance. Rough ones take the jumps of a run in the `middle` of
    /// what is not known, with fixed ends.
    pub fn new(
        file: &'a SceneFile,
        middle: &Combination,
        limits: LimitsOf<'a>,
        progress: Progress<'a>,
        expected: [usize; 2],
    ) -> Result<Self, Error> {
        let mut runs = Self {
            file,
            limits,
            progress,
            mesh: (0.0, 0.0),
            shown: None,
            grounds: KnownGrounds::new(MOST_COMBINATIONS),
            made: AtomicUsize::new(0),
            cost: AtomicUsize::new(0),
            expected: expected[0] + OWN_COST * expected[1],
        };
        let mut scene = runs.scene(middle)?;
        let ground = runs.grounds.of(&scene)?;
        scene = design::rough(&scene);
        let levels = plan_over(&scene, Arc::clone(&ground))?.levels;
        runs.mesh = levels.spacing(levels.first);
        scene.ends.upstream = End::Fixed;
        scene.ends.downstream = End::Fixed;
        // It may be stopped, but its share of the work is not counted.
        let options = RunOptions {
            progress: progress.part(0.0, 0.0),
            ..RunOptions::default()
        };
        runs.shown = match run_over(&runs.rough(&scene), ground, &options) {
            Err(Error::Stopped) => return Err(Error::Stopped),
            run => run.ok().and_then(|run| run.shown),
        };
        Ok(runs)
    }

    /// The scene on the mesh that is shared: the one with which a rough run begins, six nodes per depth as a rule.
    fn rough(&self, scene: &Scene) -> Scene {
        let mut scene = design::rough(scene);
        scene.solver.node_spacing.get_or_insert(self.mesh.0);
        scene.solver.vehicle_step.get_or_insert(self.mesh.1);
        scene
    }

    /// The scene with this combination.
    fn scene(&self, at: &Combination) -> Result<Scene, Error> {
        let overrides: Vec<String> = at.iter().map(|(key, value)| format!("{key}={value:?}")).collect();
        Ok(self.file.with(&overrides)?.scene()?)
    }

    /// What the scene comes to with `measure` in each of these combinations. A run that fails is an outcome with its error.
    ///
    /// # Errors
    ///
    /// [`Error::Stopped`] where the progress stops it.
    pub fn rough_runs(&self, measure: &Measure, all: &[Combination]) -> Result<Vec<Outcome>, Error> {
        all.par_iter().map(|at| self.run(measure, at, true)).collect()
    }

    /// The same in one of them, rough or not.
    pub fn run(&self, measure: &Measure, at: &Combination, rough: bool) -> Result<Outcome, Error> {
        let mut outcome = Outcome {
            at: at.clone(),
            rough,
            ..Outcome::default()
        };
        match self.computed(measure, at, rough) {
            Err(Error::Stopped) => return Err(Error::Stopped),
            Err(error) => outcome.failure = Some(creepage_plan::with_causes(&error)),
            Ok((scene, run)) => {
                let of_ends = |quantity| CableEnd::ALL.map(|end| run.largest(end, quantity));
                let [forces, movements] = [Limited::Force, Limited::Movement].map(of_ends);
                let clamps = run.restraints.iter().map(|clamp| Place::Clamp(clamp.position_m));
                let clamps = clamps.map(|clamp| run.largest(clamp, Limited::Force));
                outcome.verdicts = self.limits_in_duct(&scene).verdicts(&run);
                outcome.force_n = forces[0].max(forces[1]);
                outcome.movement_m = movements[0].max(movements[1]);
                outcome.clamp_force_n = clamps.reduce(f64::max);
            }
        }
        self.made.fetch_add(1, Ordering::Relaxed);
        let own = if rough { 1 } else { OWN_COST };
        let cost = own + self.cost.fetch_add(own, Ordering::Relaxed);
        self.progress
            .report((cost as f64 / self.expected as f64).min(1.0))?;
        Ok(outcome)
    }

    fn computed(&self, measure: &Measure, at: &Combination, rough: bool) -> Result<(Scene, Run), Error> {
        let mut scene = self.scene(at)?;
        let ground = self.grounds.of(&scene)?;
        scene = measure.applied(&scene);
        scene.validate()?;
        let run = |scene: &Scene, mesh| {
            let options = RunOptions {
                mesh,
                ..RunOptions::default()
            };
            run_over(scene, Arc::clone(&ground), &options)
        };
        if !rough {
            return Ok((scene.clone(), run(&scene, None)?));
        }
        if let Ok(run) = run(&self.rough(&scene), self.shown) {
            return Ok((scene, run));
        }
        // Where that mesh is too coarse, a run finds its own.
        let run = run(&design::rough(&scene), None)?;
        Ok((scene, run))
    }

    /// The limits of a scene, and that the cable stays in its duct.
    fn limits_in_duct(&self, scene: &Scene) -> Limits {
        let mut limits = (self.limits)(scene);
        for end in CableEnd::ALL {
            let own = &mut limits.of_mut(end).movement_m;
            *own = Some(own.unwrap_or(f64::INFINITY).min(largest_movement_in_duct(scene)));
        }
        limits
    }

    /// How many were made.
    pub fn made(&self) -> usize {
        self.made.load(Ordering::Relaxed)
    }
}
