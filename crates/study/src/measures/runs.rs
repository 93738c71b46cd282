//! Runs of a scene with one measure and one combination of what is not known.

use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use rayon::prelude::*;

use super::answer::{Failure, Outcome};
use super::unknown::{Combination, MAX_COMBINATIONS};
use crate::shared_mesh::{SharedMesh, rough};
use creepage_plan::ground::KnownGrounds;
use creepage_plan::{plan_over, with_causes};
use creepage_run::answer::largest_movement_in_duct;
use creepage_run::run::run_over;
use creepage_run::{Error, Limits, Progress, Run, RunOptions};
use creepage_scene::{CableEnd, End, Measure, Scene, SceneFile};

/// What a run with the scene's own tolerance costs, in rough runs: 3 to 60. Both kinds are mixed, so
/// that the progress hardly depends on it.
const OWN_COST: usize = 20;

/// The limits of a scene, with whatever clamps it has.
pub type LimitsOf<'a> = &'a (dyn Fn(&Scene) -> Limits + Sync);

/// A run of a scene: what it comes to, or why it could not be made.
pub type Ran = Result<Outcome, Failure>;

/// All runs of a scene.
pub struct Runs<'a> {
    file: &'a SceneFile,
    limits: LimitsOf<'a>,
    progress: Progress<'a>,
    /// The mesh of rough runs.
    mesh: Option<SharedMesh>,
    grounds: KnownGrounds,
    /// How many there were, what they cost and what all will [rough runs].
    made: AtomicUsize,
    cost: AtomicUsize,
    expected: usize,
}

/// A measure, and what it comes to in some combinations.
pub struct Tried {
    pub measure: Measure,
    pub outcomes: Vec<Outcome>,
    pub failures: Vec<Failure>,
}

impl Tried {
    /// The largest share of a limit; a run that failed is worse than any.
    pub fn largest(&self) -> f64 {
        let failed = if self.failures.is_empty() {
            0.0
        } else {
            f64::INFINITY
        };
        let shares = self.outcomes.iter().map(Outcome::share);
        shares.fold(failed, f64::max)
    }

    /// Adds a run; whether it has an outcome.
    pub fn add(&mut self, ran: Ran) -> bool {
        let is_outcome = ran.is_ok();
        match ran {
            Ok(outcome) => self.outcomes.push(outcome),
            Err(failure) => self.failures.push(failure),
        }
        is_outcome
    }
}

impl<'a> Runs<'a> {
    /// Runs of which so many are expected, rough and with the scene's own tolerance. Rough ones are on
    /// the mesh with which a rough run begins, six nodes per depth as a rule, and take the jumps of one
    /// in the `middle` of what is not known, with fixed ends.
    pub fn new(
        file: &'a SceneFile,
        middle: &Combination,
        limits: LimitsOf<'a>,
        progress: Progress<'a>,
        expected: [usize; 2],
    ) -> Result<Self, Error> {
        let grounds = KnownGrounds::new(MAX_COMBINATIONS);
        let mut scene = rough(&with_values(file, middle)?);
        let ground = grounds.of(&with_values(file, middle)?)?;
        let levels = plan_over(&scene, Arc::clone(&ground))?.levels;
        let (spacing, step) = levels.spacing(levels.first);
        scene.solver.node_spacing.get_or_insert(spacing);
        scene.solver.vehicle_step.get_or_insert(step);
        (scene.ends.upstream, scene.ends.downstream) = (End::Fixed, End::Fixed);
        let mesh = match SharedMesh::of(&scene, &ground, progress) {
            Err(Error::Stopped) => return Err(Error::Stopped),
            mesh => mesh.ok(),
        };
        Ok(Self {
            file,
            limits,
            progress,
            mesh,
            grounds,
            made: AtomicUsize::new(0),
            cost: AtomicUsize::new(0),
            expected: expected[0] + OWN_COST * expected[1],
        })
    }

    /// Rough runs of the scene with `measure` in each of these combinations.
    ///
    /// # Errors
    ///
    /// [`Error::Stopped`] if the progress stops it. A run that fails is stated.
    pub fn tried(&self, measure: &Measure, all: &[Combination]) -> Result<Tried, Error> {
        let run = |at| self.run(measure, at, true);
        let runs: Vec<Ran> = all.par_iter().map(run).collect::<Result<_, _>>()?;
        let mut tried = Tried {
            measure: measure.clone(),
            outcomes: Vec::new(),
            failures: Vec::new(),
        };
        for ran in runs {
            tried.add(ran);
        }
        Ok(tried)
    }

    /// The same in one of them, rough or not.
    pub fn run(&self, measure: &Measure, at: &Combination, rough: bool) -> Result<Ran, Error> {
        let run = match self.computed(measure, at, rough) {
            Err(Error::Stopped) => return Err(Error::Stopped),
            Err(error) => Err((at.clone(), with_causes(&error))),
            Ok((scene, run)) => Ok(Outcome::of(&run, at, rough, &self.limits_in_duct(&scene))),
        };
        self.made.fetch_add(1, Ordering::Relaxed);
        let own = if rough { 1 } else { OWN_COST };
        let cost = own + self.cost.fetch_add(own, Ordering::Relaxed);
        let share = cost as f64 / self.expected as f64;
        self.progress.report(share.min(1.0))?;
        Ok(run)
    }

    fn computed(&self, measure: &Measure, at: &Combination, is_rough: bool) -> Result<(Scene, Run), Error> {
        let scene = with_values(self.file, at)?;
        let ground = self.grounds.of(&scene)?;
        let scene = measure.applied(&scene);
        scene.validate()?;
        let rough = if is_rough { rough(&scene) } else { scene.clone() };
        let mesh = self.mesh.as_ref().filter(|_| is_rough);
        // Where that mesh is too coarse, a run finds its own.
        let on_mesh = mesh.and_then(|mesh| mesh.run(&rough, &ground, false).ok());
        let run = match on_mesh {
            Some(run) => run,
            None => run_over(&rough, ground, &RunOptions::default())?,
        };
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

/// The scene in `file` with the values of this combination.
fn with_values(file: &SceneFile, at: &Combination) -> Result<Scene, Error> {
    let overrides: Vec<String> = at.iter().map(|(key, value)| format!("{key}={value:?}")).collect();
    Ok(file.with(&overrides)?.scene()?)
}
