//! The points of a sweep: every combination of the values of its keys.

use std::collections::BTreeSet;
use std::path::PathBuf;

use super::axis::{Axis, AxisValues};
use super::error::SweepError;
use super::list;
use super::row::checksum;
use crate::scene::{SceneError, Wrong, WrongKind, did_you_mean, nearest_key};
use crate::{Scene, SceneFile};

/// Most points of a sweep.
const MOST_POINTS: usize = 10_000_000;

/// Tolerance of samples, whose scatter is far larger.
pub const SAMPLE_TOLERANCE: f64 = 0.02;
const TOLERANCE: &str = "solver.tolerance";

/// How drawn keys are sampled.
///
/// A sample's value follows from the seed, the row (its `id`, or else its number), the key and the number of the sample alone.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Samples {
    /// Samples at every point of the grid, or of every row; 0 where nothing is drawn.
    pub count: usize,
    /// Another seed gives other samples.
    pub seed: u64,
}

/// A scene and the values of its varied keys.
#[derive(Debug, Clone)]
pub struct Sweep {
    pub(super) file: SceneFile,
    pub(super) axes: Vec<Axis>,
    pub(super) samples: Samples,
    pub(super) count: usize,
    /// Whether a point takes one value of each key, those of a row, in place of every combination.
    pub(super) by_row: bool,
    /// Keys that rows draw, here or in other parts of their table.
    pub(super) drawn_keys: BTreeSet<String>,
}

impl Sweep {
    /// The grid over `axes` of the scene in `file`.
    ///
    /// # Errors
    ///
    /// [`SweepError::Unfit`] where there is nothing to vary, a key stands twice or has no value, samples are asked without a distribution or the
    /// other way round, or there are more than ten million points; [`SweepError::Scene`] where a scene has no such
    /// key.
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
        if drawn && samples.count == 0 {
            let found = "a distribution and no samples".into();
            return unfit(found, "a number of samples with it");
        }
        if !drawn && samples.count > 0 {
            return unfit("samples and no distribution".into(), "a distribution with them");
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
            by_row: false,
            drawn_keys: BTreeSet::new(),
        };
        sweep.knows_keys(0)?;
        Ok(sweep)
    }

    /// An unknown key fails everywhere; what fails at some points only is recorded there.
    pub(super) fn knows_keys(&self, index: usize) -> Result<(), SweepError> {
        match self.scene(index) {
            Err(SceneError::Wrong(wrong))
                if matches!(wrong.kind, WrongKind::UnknownKey | WrongKind::Override) =>
            {
                Err(self
                    .unknown_column(&wrong)
                    .unwrap_or(SceneError::Wrong(wrong).into()))
            }
            _ => Ok(()),
        }
    }

    /// The error of the column of a table whose name is no key, if `wrong` is of it.
    fn unknown_column(&self, wrong: &Wrong) -> Option<SweepError> {
        let inside = format!("{}.", wrong.key);
        let is_meant = |axis: &&Axis| axis.key == wrong.key || axis.key.starts_with(&inside);
        let is_unknown = self.by_row && wrong.kind == WrongKind::UnknownKey;
        let Axis { key, .. } = self.axes.iter().find(is_meant).filter(|_| is_unknown)?;
        let meant = did_you_mean(nearest_key(key).as_deref());
        Some(SweepError::Unfit {
            found: format!("the column `{key}`, which is no key{meant}"),
            allowed: "keys of the scene, which `creepage explain` lists, and `id`",
        })
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
        if self.by_row {
            let id = self.id(group);
            return self.row_values(group, |key| share(self.samples.seed, key, &id, sample));
        }
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
                    let share = share(self.samples.seed, &axis.key, "", sample);
                    distribution.quantile(share).1
                }
            })
            .collect();
        values.reverse();
        values
    }

    /// The scene of a point. Samples are computed to [`SAMPLE_TOLERANCE`], unless the scene or an axis names `solver.tolerance`.
    ///
    /// # Errors
    ///
    /// [`SceneError`] where its values are not valid.
    pub fn scene(&self, index: usize) -> Result<Scene, SceneError> {
        let file = self.file_at(index)?;
        let mut scene = file.scene()?;
        if self.samples.count > 0 && !file.names(TOLERANCE) {
            scene.solver.tolerance = SAMPLE_TOLERANCE;
        }
        Ok(scene)
    }

    /// Whether its points are samples to [`SAMPLE_TOLERANCE`], as neither the scene nor an axis names `solver.tolerance`.
    pub fn has_sample_tolerance(&self) -> bool {
        let is_varied = self.axes.iter().any(|axis| axis.key == TOLERANCE);
        self.samples.count > 0 && !is_varied && !self.file.names(TOLERANCE)
    }

    /// The scene file of a point.
    ///
    /// # Errors
    ///
    /// [`SceneError`] where there is nothing at a varied key.
    pub fn file_at(&self, index: usize) -> Result<SceneFile, SceneError> {
        self.file_with(self.values(index))
    }

    /// The scene file with a value for every axis.
    pub(super) fn file_with(&self, values: Vec<String>) -> Result<SceneFile, SceneError> {
        let overrides: Vec<String> = self
            .axes
            .iter()
            .zip(values)
            // What a row leaves out is the scene's own.
            .filter(|(axis, value)| !self.by_row || !(value.is_empty() || axis.key == list::ID))
            .map(|(axis, value)| format!("{}={value}", axis.key))
            .collect();
        self.file.with(&overrides)
    }

    /// The files that its scenes read beside their own: tables of axle loads.
    pub fn files(&self) -> BTreeSet<PathBuf> {
        let named = self
            .axes
            .iter()
            .filter(|axis| matches!(&*axis.key, "traffic" | "traffic.histogram"));
        let values: BTreeSet<String> = named
            .flat_map(|axis| {
                axis.list()
                    .unwrap_or_default()
                    .iter()
                    .map(|value| format!("{}={value}", axis.key))
            })
            .collect();
        let of_values = values
            .iter()
            .filter_map(|value| self.file.with(&[value]).ok()?.histogram());
        self.file.histogram().into_iter().chain(of_values).collect()
    }

    /// What distinguishes this sweep from another: program, scene, keys, values, and what stands in the files that they name.
    pub(super) fn name(&self) -> u64 {
        let version = env!("CARGO_PKG_VERSION");
        let typed = self.file.typed().into_iter();
        let scene: Vec<_> = typed.map(|typed| (typed.key, typed.value)).collect();
        let files: Vec<_> = self
            .files()
            .into_iter()
            .map(|file| std::fs::read(file).ok())
            .collect();
        let text = format!(
            "{version}\0{scene:?}\0{:?}\0{:?}\0{}\0{files:?}",
            self.axes, self.samples, self.by_row
        );
        checksum(text.as_bytes())
    }
}

/// A number in (0, 1), evenly distributed: that of one sample of one key of the row `id`.
fn share(seed: u64, key: &str, id: &str, sample: usize) -> f64 {
    /// Half the distance between two numbers of the generator: keeps 0 out.
    const HALF: f64 = 1.0 / (1_u64 << 54) as f64;
    let name = if id.is_empty() {
        key.to_owned()
    } else {
        format!("{key}\0{id}")
    };
    let stream = fastrand::Rng::with_seed(seed ^ checksum(name.as_bytes())).u64(..);
    // Generators of neighbouring seeds begin with related numbers, forks of them no more.
    let mut random = fastrand::Rng::with_seed(stream.wrapping_add(sample as u64)).fork();
    random.f64() + HALF
}

#[cfg(test)]
mod tests {
    use super::share;

    /// Two keys are drawn independently: with n samples, √n times their correlation is a standard normal number.
    #[test]
    fn samples_of_two_keys_are_independent() {
        const SAMPLES: usize = 1000;
        const PAIRS: u64 = 200;
        let draws = |seed, key| -> Vec<f64> { (0..SAMPLES).map(|k| share(seed, key, "", k) - 0.5).collect() };
        let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let scores: Vec<f64> = (0..PAIRS)
            .map(|seed| {
                let (a, b) = (draws(seed, "duct.depth"), draws(seed, "friction.coefficient"));
                (SAMPLES as f64).sqrt() * dot(&a, &b) / (dot(&a, &a) * dot(&b, &b)).sqrt()
            })
            .collect();
        // By chance one of 200 is so large once in 700 times; the mean square is off by four standard deviations.
        assert!(scores.iter().all(|z| z.abs() < 4.5), "{scores:?}");
        let mean_square = dot(&scores, &scores) / PAIRS as f64;
        assert!((mean_square - 1.0).abs() < 0.4, "{mean_square}");
    }
}
