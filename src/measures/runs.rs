//! Runs of a scene with one measure and one combination of what is not known.

use std::sync::{Arc, Mutex, PoisonError};

use super::answer::Outcome;
use super::unknown::Unknown;
use crate::answer::largest_movement_in_duct;
use crate::ground::{Ground, road};
use crate::run::{run_over, run_shown};
use crate::scene::{End, Measure};
use crate::{CableEnd, Error, FixedMesh, Limited, Limits, Place, Progress, Run, RunOptions, Scene, SceneFile};

/// Tolerance of the runs that look for the worst, if the scene's own is not looser.
const COARSE: f64 = 0.05;
/// What a run with the scene's tolerance costs, in coarse ones.
const DECISIVE_COST: f64 = 12.0;

/// The limits of a scene, with whatever clamps it has.
pub type LimitsOf<'a> = &'a (dyn Fn(&Scene) -> Limits + Sync);

/// A scene with one combination, and its ground.
struct Case {
    at: Vec<f64>,
    scene: Scene,
    ground: Arc<Ground>,
}

/// How accurate a run is.
#[derive(Clone, Copy, PartialEq)]
pub enum Effort {
    /// On the mesh that all share.
    Coarse,
    /// With the scene's own tolerance.
    Decisive,
}

/// All runs of a scene, and how many there were.
pub struct Runs<'a> {
    file: &'a SceneFile,
    unknowns: &'a [Unknown],
    limits: LimitsOf<'a>,
    progress: Progress<'a>,
    /// Cost of all, in coarse runs.
    expected: f64,
    done: Mutex<(usize, f64)>,
    cases: Mutex<Vec<Arc<Case>>>,
    /// Node spacing and vehicle step of coarse runs, and what one has shown of them.
    mesh: Option<(f64, f64, Option<FixedMesh>)>,
}

impl<'a> Runs<'a> {
    /// Runs of which `expected` are coarse as a rule. Their mesh is that of a run in the middle of what is not known, with fixed ends or
    /// as the scene has them.
    pub fn new(
        file: &'a SceneFile,
        unknowns: &'a [Unknown],
        limits: LimitsOf<'a>,
        progress: Progress<'a>,
        expected: usize,
    ) -> Result<Self, Error> {
        let mut runs = Self {
            file,
            unknowns,
            limits,
            progress,
            expected: expected as f64 + 2.0 * DECISIVE_COST,
            done: Mutex::default(),
            cases: Mutex::default(),
            mesh: None,
        };
        let middle: Vec<f64> = unknowns.iter().map(Unknown::middle).collect();
        let case = runs.case(&middle)?;
        for held in [Some(End::Fixed), None] {
            let measure = Measure {
                upstream: held,
                downstream: held,
                ..Measure::default()
            };
            let scene = runs.coarse(measure.applied(&case.scene));
            // It may be stopped, but its share of the work is not counted.
            let options = RunOptions {
                progress: progress.part(0.0, 0.0),
                ..RunOptions::default()
            };
            match run_shown(&scene, Arc::clone(&case.ground), &options) {
                Err(Error::Stopped) => return Err(Error::Stopped),
                Err(_) => {}
                Ok((run, shown)) => {
                    runs.mesh = Some((run.plan.node_spacing_m, run.plan.vehicle_step_m, shown));
                    break;
                }
            }
        }
        Ok(runs)
    }

    /// The scene with the coarse tolerance, on the mesh that is known.
    fn coarse(&self, mut scene: Scene) -> Scene {
        scene.solver.tolerance = scene.solver.tolerance.max(COARSE);
        if let Some((spacing, step, _)) = self.mesh {
            scene.solver.node_spacing.get_or_insert(spacing);
            scene.solver.vehicle_step.get_or_insert(step);
        }
        scene
    }

    /// The scene with this combination; friction alone leaves the ground as it is.
    fn case(&self, at: &[f64]) -> Result<Arc<Case>, Error> {
        let all = || self.cases.lock().unwrap_or_else(PoisonError::into_inner);
        let known = all().iter().find(|case| case.at == at).cloned();
        if let Some(known) = known {
            return Ok(known);
        }
        let set = |(unknown, value): (&Unknown, &f64)| format!("{}={value:?}", unknown.key);
        let overrides: Vec<String> = self.unknowns.iter().zip(at).map(set).collect();
        let scene = self.file.with(&overrides)?.scene()?;
        let moves_alike = |case: &&Arc<Case>| motion(&case.scene) == motion(&scene);
        let ground = all().iter().find(moves_alike).map(|case| Arc::clone(&case.ground));
        let ground = match ground {
            Some(ground) => ground,
            None => Arc::new(Ground::new(&scene, None, road::reach(&scene))?),
        };
        let case = Arc::new(Case {
            at: at.to_vec(),
            scene,
            ground,
        });
        all().push(Arc::clone(&case));
        Ok(case)
    }

    /// What the scene comes to with `measure`. A run that fails is an outcome with its error.
    ///
    /// # Errors
    ///
    /// [`Error::Stopped`] where the progress stops it.
    pub fn run(&self, measure: &Measure, at: &[f64], effort: Effort) -> Result<Outcome, Error> {
        let outcome = match self.computed(measure, at, effort) {
            Err(Error::Stopped) => return Err(Error::Stopped),
            Err(error) => Outcome::failed(at, crate::with_causes(&error)),
            Ok((scene, run)) => Outcome::new(at, self.limits_in_duct(&scene).verdicts(&run), largest(&run)),
        };
        let mut done = self.done.lock().unwrap_or_else(PoisonError::into_inner);
        done.0 += 1;
        done.1 += if effort == Effort::Coarse { 1.0 } else { DECISIVE_COST };
        self.progress.report((done.1 / self.expected).min(1.0))?;
        Ok(outcome)
    }

    fn computed(&self, measure: &Measure, at: &[f64], effort: Effort) -> Result<(Scene, Run), Error> {
        let case = self.case(at)?;
        let mut scene = measure.applied(&case.scene);
        let mut options = RunOptions::default();
        if effort == Effort::Coarse {
            scene = self.coarse(scene);
            options.mesh = self.mesh.and_then(|(.., shown)| shown);
        }
        scene.validate()?;
        let run = run_over(&scene, Arc::clone(&case.ground), &options)?;
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
    pub fn count(&self) -> usize {
        self.done.lock().unwrap_or_else(PoisonError::into_inner).0
    }
}

/// What the motion of the duct follows from.
fn motion(scene: &Scene) -> impl PartialEq + use<'_> {
    (&scene.ground, &scene.duct, &scene.vehicles, &scene.heat, &scene.solver)
}

/// The largest force on an end, movement of an end and force on a clamp.
fn largest(run: &Run) -> [f64; 3] {
    let of_ends = |quantity| CableEnd::ALL.map(|end| run.largest(end, quantity));
    let [force, movement] = [Limited::Force, Limited::Movement].map(of_ends);
    let clamps = run.restraints.iter().map(|clamp| run.largest(Place::Clamp(clamp.position_m), Limited::Force));
    [force[0].max(force[1]), movement[0].max(movement[1]), clamps.fold(0.0, f64::max)]
}
