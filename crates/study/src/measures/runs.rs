//! Runs of a scene with one measure and one combination of what is not known.

use std::sync::{Arc, Mutex, PoisonError};

use super::answer::{Effort, Outcome};
use super::unknown::Unknown;
use creepage_plan::ground::{Ground, road};
use creepage_plan::plan_over;
use creepage_run::answer::largest_movement_in_duct;
use creepage_run::run::{run_over, run_shown};
use creepage_run::{Error, FixedMesh, Limited, Limits, Place, Progress, Run, RunOptions};
use creepage_scene::{CableEnd, Scene, SceneFile};
use creepage_scene::{End, Measure};

/// Tolerance of the runs that look for the worst, if the scene's own is not looser: their mesh is the one with which a run of this
/// tolerance begins, six nodes per depth as a rule.
const COARSE: f64 = 0.05;
/// What a run costs relative to one of the effort below it, as long as none was made.
const STEP_COST: f64 = 4.0;

/// The limits of a scene, with whatever clamps it has.
pub type LimitsOf<'a> = &'a (dyn Fn(&Scene) -> Limits + Sync);

/// A scene with one combination, and its ground.
struct Case {
    at: Vec<f64>,
    scene: Scene,
    ground: Arc<Ground>,
}

/// How many runs there were and will be, and what they cost \[node updates\], of each effort.
#[derive(Debug, Clone, Copy, Default)]
struct Work {
    expected: [f64; 3],
    done: [f64; 3],
    cost: [f64; 3],
}

impl Work {
    /// The share of the whole that is done.
    fn share(&self) -> f64 {
        let (mut whole, mut one) = (0.0, 1.0);
        for effort in 0..3 {
            one *= STEP_COST;
            if self.done[effort] > 0.0 {
                one = self.cost[effort] / self.done[effort];
            }
            whole += one * self.expected[effort].max(self.done[effort]);
        }
        self.cost.iter().sum::<f64>() / whole
    }
}

/// A mesh that runs share.
#[derive(Clone, Copy)]
struct SharedMesh {
    /// Node spacing and vehicle step \[m\].
    coarse: (f64, f64),
    finer: (f64, f64),
    /// What one run has shown of it.
    shown: Option<FixedMesh>,
}

/// All runs of a scene, and how many there were.
pub struct Runs<'a> {
    file: &'a SceneFile,
    unknowns: &'a [Unknown],
    limits: LimitsOf<'a>,
    progress: Progress<'a>,
    work: Mutex<Work>,
    cases: Mutex<Vec<Arc<Case>>>,
    mesh: Option<SharedMesh>,
}

impl<'a> Runs<'a> {
    /// Runs of which so many of each effort are expected. Those that look for the worst take the jumps of a run in the middle of what is
    /// not known, with fixed ends or as the scene has them.
    pub fn new(
        file: &'a SceneFile,
        unknowns: &'a [Unknown],
        limits: LimitsOf<'a>,
        progress: Progress<'a>,
        expected: [usize; 3],
    ) -> Result<Self, Error> {
        let work = Work {
            expected: expected.map(|count| count as f64),
            ..Work::default()
        };
        let mut runs = Self {
            file,
            unknowns,
            limits,
            progress,
            work: Mutex::new(work),
            cases: Mutex::default(),
            mesh: None,
        };
        let middle: Vec<f64> = unknowns.iter().map(Unknown::middle).collect();
        let case = runs.case(&middle)?;
        let levels = plan_over(
            &runs.coarse(case.scene.clone(), Effort::Coarse),
            Arc::clone(&case.ground),
        )?
        .levels;
        for held in [Some(End::Fixed), None] {
            runs.mesh = Some(SharedMesh {
                coarse: levels.spacing(levels.first),
                finer: levels.spacing(levels.first + 1),
                shown: None,
            });
            let measure = Measure {
                upstream: held,
                downstream: held,
                ..Measure::default()
            };
            let scene = runs.coarse(measure.applied(&case.scene), Effort::Coarse);
            // It may be stopped, but its share of the work is not counted.
            let options = RunOptions {
                progress: progress.part(0.0, 0.0),
                ..RunOptions::default()
            };
            let shown = run_shown(&scene, Arc::clone(&case.ground), &options);
            match (&mut runs.mesh, shown) {
                (_, Err(Error::Stopped)) => return Err(Error::Stopped),
                (Some(mesh), Ok((_, shown))) => {
                    mesh.shown = shown;
                    break;
                }
                (mesh, _) => *mesh = None,
            }
        }
        Ok(runs)
    }

    /// The scene with the coarse tolerance, on the mesh that is shared.
    fn coarse(&self, mut scene: Scene, effort: Effort) -> Scene {
        scene.solver.tolerance = scene.solver.tolerance.max(COARSE);
        if let Some(mesh) = self.mesh {
            let (spacing, step) = if effort == Effort::Coarse {
                mesh.coarse
            } else {
                mesh.finer
            };
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
        let ground = all()
            .iter()
            .find(moves_alike)
            .map(|case| Arc::clone(&case.ground));
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
        let (outcome, cost) = match self.computed(measure, at, effort) {
            Err(Error::Stopped) => return Err(Error::Stopped),
            Err(error) => (Outcome::failed(at, effort, creepage_plan::with_causes(&error)), 0),
            Ok((scene, run)) => {
                let verdicts = self.limits_in_duct(&scene).verdicts(&run);
                (
                    Outcome::new(at, effort, verdicts, largest(&run)),
                    run.cost.node_updates,
                )
            }
        };
        let mut work = self.work.lock().unwrap_or_else(PoisonError::into_inner);
        work.done[effort as usize] += 1.0;
        work.cost[effort as usize] += cost as f64;
        self.progress.report(work.share())?;
        Ok(outcome)
    }

    fn computed(&self, measure: &Measure, at: &[f64], effort: Effort) -> Result<(Scene, Run), Error> {
        let case = self.case(at)?;
        let scene = measure.applied(&case.scene);
        scene.validate()?;
        let run = |scene: &Scene, mesh| {
            let options = RunOptions {
                mesh,
                ..RunOptions::default()
            };
            run_over(scene, Arc::clone(&case.ground), &options)
        };
        let is_rough = effort != Effort::Decisive;
        if let Some(mesh) = self.mesh.filter(|_| is_rough) {
            let coarse = self.coarse(scene.clone(), effort);
            if let Ok(run) = run(&coarse, mesh.shown) {
                return Ok((scene, run));
            }
        }
        // Where that mesh is too coarse, a run finds its own.
        let mut own = scene.clone();
        own.solver.tolerance = own.solver.tolerance.max(if is_rough { COARSE } else { 0.0 });
        let run = run(&own, None)?;
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
        let work = self.work.lock().unwrap_or_else(PoisonError::into_inner);
        work.done.iter().sum::<f64>() as usize
    }
}

/// What the motion of the duct follows from.
fn motion(scene: &Scene) -> impl PartialEq + use<'_> {
    (
        &scene.ground,
        &scene.duct,
        &scene.vehicles,
        &scene.heat,
        &scene.solver,
    )
}

/// The largest force on an end, movement of an end and force on a clamp.
fn largest(run: &Run) -> [f64; 3] {
    let of_ends = |quantity| CableEnd::ALL.map(|end| run.largest(end, quantity));
    let [force, movement] = [Limited::Force, Limited::Movement].map(of_ends);
    let clamps = run
        .restraints
        .iter()
        .map(|clamp| run.largest(Place::Clamp(clamp.position_m), Limited::Force));
    [
        force[0].max(force[1]),
        movement[0].max(movement[1]),
        clamps.fold(0.0, f64::max),
    ]
}
