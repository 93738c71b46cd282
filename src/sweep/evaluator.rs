//! One row after the other: a scene with some keys set, and its answer.

use std::sync::{Arc, Mutex, PoisonError};

use crate::ground::{Ground, road};
use crate::run::run_over;
use crate::scene::{self, TrafficVehicle};
use crate::{Error, Run, RunOptions, Scene, SceneFile};

/// Computes rows, each of which is one scene with some keys set: without files and without threads of its own.
///
/// A row's answer depends on that row alone. What costs most apart from the passes, the ground and the motion of the duct, is kept from one
/// row to the next, and is computed anew only where a key of theirs differs.
///
/// It computes in rayon's threads: in a pool of one thread ([`rayon::ThreadPool::install`]) it takes no second core.
///
/// ```
/// use creepage::sweep::{Answer, Evaluator};
/// use creepage::{RunOptions, SceneFile};
///
/// let file = SceneFile::read("examples/scenes/full-scale-upper.toml")?.with(&["traffic.passes=1"])?;
/// let rows = Evaluator::new(file);
/// let force = |friction: f64| -> Result<f64, creepage::Error> {
///     let row = [format!("friction.dynamic_coefficient={friction}")];
///     Ok(Answer::of(&rows.run(&row, &RunOptions::default())?).expect("a pass").downstream_force_n)
/// };
/// assert!(force(0.3)? > force(0.2)?);
/// let error = rows.run(&["duct.depth=-1 m"], &RunOptions::default()).unwrap_err();
/// assert_eq!(error.key(), Some("duct.depth"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct Evaluator {
    file: SceneFile,
    last: Mutex<Option<(Site, Arc<Ground>)>>,
}

/// All that the motion of the duct depends on.
#[derive(Debug, Clone, PartialEq)]
struct Site {
    ground: scene::Ground,
    vehicles: Vec<TrafficVehicle>,
    /// Depth, distance to the side, reach and tolerance.
    numbers: [f64; 4],
}

impl Site {
    fn of(scene: &Scene) -> Self {
        Self {
            ground: scene.ground.clone(),
            vehicles: scene.vehicles.clone(),
            numbers: [
                scene.duct.depth,
                scene.duct.lateral_offset,
                road::reach(scene),
                scene.solver.tolerance,
            ],
        }
    }
}

impl Evaluator {
    /// Rows on top of the scene in `file`.
    pub fn new(file: SceneFile) -> Self {
        Self {
            file,
            last: Mutex::default(),
        }
    }

    /// The run of the scene with each `KEY=VALUE` of `overrides` set.
    ///
    /// # Errors
    ///
    /// [`Error`] with the line and the key at fault where the row is wrong, or the computation fails.
    pub fn run<T: AsRef<str>>(&self, overrides: &[T], options: &RunOptions<'_>) -> Result<Run, Error> {
        let file = self.file.with(overrides)?;
        self.run_scene(&file.scene()?, options)
            .map_err(|error| error.located(&file))
    }

    /// The run of a scene, on the ground of the one before if that is the same.
    pub(super) fn run_scene(&self, scene: &Scene, options: &RunOptions<'_>) -> Result<Run, Error> {
        if options.ground.is_some() {
            return crate::run_with(scene, options);
        }
        scene.validate()?;
        let site = Site::of(scene);
        let known = self.last().take_if(|(last, _)| *last == site);
        let ground = match known {
            Some((_, ground)) => ground,
            None => Arc::new(Ground::new(scene, None, site.numbers[2])?),
        };
        *self.last() = Some((site, Arc::clone(&ground)));
        run_over(scene, ground, options)
    }

    fn last(&self) -> std::sync::MutexGuard<'_, Option<(Site, Arc<Ground>)>> {
        self.last.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
