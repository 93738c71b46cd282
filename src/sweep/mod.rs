//! Sweeps: one scene with many values of some keys.
//!
//! Keys take listed values ([`Axis`]), and every combination is a point of a grid, the last key changing fastest. Keys may also be
//! drawn from a distribution: then every point of the grid is computed with the same samples, and the forces have quantiles
//! ([`Band`]).
//!
//! All cores work, each on a point of its own. A finished point is kept at once in a journal beside the output, so that a sweep
//! that was interrupted or killed goes on where it was and ends with the same file, byte for byte. The table stands in the order
//! of the grid; a point that fails is a row with its error. Memory does not grow with the answers: it holds some bytes a point.
//!
//! Samples: the number u of a sample follows from the seed, the key and the sample's number alone, and its value is the quantile of
//! u, so nothing depends on the threads or on the other keys.
//!
//! ```
//! use creepage::SceneFile;
//! use creepage::sweep::{Axis, Samples, Sweep};
//!
//! let file = SceneFile::read("examples/scenes/full-scale-upper.toml")?;
//! let axes = vec![Axis::parse("friction.dynamic_coefficient=0.2:0.4:0.1")?, Axis::parse("duct.depth=1.2m,2m")?];
//! let sweep = Sweep::new(file, axes, Samples::default())?;
//! assert_eq!(sweep.count(), 6);
//! assert_eq!(sweep.scene(3)?.duct.depth, 2.0);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod axis;
mod bands;
mod error;
mod journal;
#[cfg(feature = "plot")]
mod map;
#[cfg(feature = "parquet")]
mod parquet;
mod row;
mod run;
mod table;

pub use axis::{Axis, AxisValues, Distribution};
pub use bands::{Band, Quantiles};
pub use error::SweepError;
#[cfg(feature = "plot")]
pub use map::{MapValue, SweepMap};
pub use row::{Answer, Row};
pub use run::{Evaluate, SweepOptions, SweepSummary};

#[cfg(feature = "cli")]
use crate::output::Kind;
use crate::scene::{SceneError, WrongKind};
use crate::{Scene, SceneFile};

/// Most points of a sweep.
const MOST_POINTS: usize = 10_000_000;

/// How drawn keys are sampled.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Samples {
    /// Samples at every point of the grid; 0 where nothing is drawn.
    pub count: usize,
    /// Another seed gives other samples.
    pub seed: u64,
}

/// A scene and the values of its varied keys.
#[derive(Debug, Clone)]
pub struct Sweep {
    file: SceneFile,
    axes: Vec<Axis>,
    samples: Samples,
    count: usize,
}

impl Sweep {
    /// The grid over `axes` of the scene in `file`.
    ///
    /// # Errors
    ///
    /// [`SweepError::Unfit`] where there is nothing to vary, a key stands twice or has no value, samples are asked without a distribution or the
    /// other way round, or there are more than ten million points; [`SweepError::Scene`] where a varied key is none of a
    /// scene.
    pub fn new(file: SceneFile, axes: Vec<Axis>, samples: Samples) -> Result<Self, SweepError> {
        let unfit = |found: String, allowed| Err(SweepError::Unfit { found, allowed });
        if axes.is_empty() {
            return unfit("no varied key".into(), "at least one");
        }
        for (index, axis) in axes.iter().enumerate() {
            if axes[..index].iter().any(|other| other.key == axis.key) {
                return unfit(format!("`{}` varied twice", axis.key), "every key once");
            }
        }
        if let Some(axis) = axes.iter().find(|axis| axis.count() == 0) {
            return unfit(format!("`{}` without values", axis.key), "one value or more");
        }
        let drawn = axes
            .iter()
            .any(|axis| matches!(axis.values, AxisValues::Drawn(_)));
        match (drawn, samples.count) {
            (true, 0) => {
                return unfit(
                    "a distribution and no samples".into(),
                    "a number of samples with it",
                );
            }
            (false, 1..) => return unfit("samples and no distribution".into(), "a distribution with them"),
            _ => {}
        }
        let count = axes
            .iter()
            .map(Axis::count)
            .chain([samples.count.max(1)])
            .try_fold(1_usize, usize::checked_mul)
            .filter(|&count| count <= MOST_POINTS);
        let Some(count) = count else {
            return unfit("too many points".into(), "at most ten million");
        };
        let sweep = Self {
            file,
            axes,
            samples,
            count,
        };
        // A key that is none fails everywhere; what fails at some points only is recorded there.
        match sweep.scene(0) {
            Err(SceneError::Wrong(wrong))
                if matches!(wrong.kind, WrongKind::UnknownKey { .. } | WrongKind::Override) =>
            {
                Err(SceneError::Wrong(wrong).into())
            }
            _ => Ok(sweep),
        }
    }

    /// How many points there are, samples included.
    pub fn count(&self) -> usize {
        self.count
    }

    /// The varied keys.
    pub fn axes(&self) -> &[Axis] {
        &self.axes
    }

    /// The value of each varied key at a point.
    pub fn values(&self, index: usize) -> Vec<String> {
        let samples = self.samples.count.max(1);
        let (mut group, sample) = (index / samples, index % samples);
        let mut values: Vec<String> = self
            .axes
            .iter()
            .rev()
            .map(|axis| match &axis.values {
                AxisValues::List(list) => {
                    let value = list[group % list.len()].clone();
                    group /= list.len();
                    value
                }
                AxisValues::Drawn(distribution) => {
                    distribution
                        .quantile(share(self.samples.seed, &axis.key, sample))
                        .1
                }
            })
            .collect();
        values.reverse();
        values
    }

    /// The scene of a point.
    ///
    /// # Errors
    ///
    /// [`SceneError`] where its values make no scene.
    pub fn scene(&self, index: usize) -> Result<Scene, SceneError> {
        self.file_at(index)?.scene()
    }

    /// The scene file of a point.
    ///
    /// # Errors
    ///
    /// [`SceneError`] where there is nothing at a varied key.
    pub fn file_at(&self, index: usize) -> Result<SceneFile, SceneError> {
        let overrides: Vec<String> = self
            .axes
            .iter()
            .zip(self.values(index))
            .map(|(axis, value)| format!("{}={value}", axis.key))
            .collect();
        self.file.with(&overrides)
    }

    /// What tells this sweep from another: program, scene, keys and values.
    fn name(&self) -> u64 {
        let version = env!("CARGO_PKG_VERSION");
        let scene = self.file.values();
        let text = format!("{version}\0{scene}\0{:?}\0{:?}", self.axes, self.samples);
        row::checksum(text.as_bytes())
    }
}

/// What the name of an output asks for.
#[cfg(feature = "cli")]
pub(crate) fn kind_of(output: &std::path::Path) -> Result<Kind, SweepError> {
    Ok(table::Format::of(output)?.kind())
}

/// A number in (0, 1), evenly distributed: that of one sample of one key.
fn share(seed: u64, key: &str, sample: usize) -> f64 {
    /// Half the distance between two numbers of the generator: keeps 0 out.
    const HALF: f64 = 1.0 / (1_u64 << 54) as f64;
    let stream = fastrand::Rng::with_seed(seed ^ row::checksum(key.as_bytes())).u64(..);
    fastrand::Rng::with_seed(stream.wrapping_add(sample as u64)).f64() + HALF
}
