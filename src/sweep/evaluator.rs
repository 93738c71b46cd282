//! One row after the other: a scene with some keys set, and its answer.

use super::known_ground::KnownGround;
use crate::run::run_over;
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
    ground: KnownGround,
}

impl Evaluator {
    /// Rows on top of the scene in `file`.
    pub fn new(file: SceneFile) -> Self {
        Self {
            file,
            ground: KnownGround::default(),
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
        run_over(scene, self.ground.of(scene)?, options)
    }
}
