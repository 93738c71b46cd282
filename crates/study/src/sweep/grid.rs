//! The points of a sweep: every combination of the values of its keys, or the rows of a table of
//! ducts, each as often as it is sampled.

use std::collections::BTreeSet;
use std::path::PathBuf;

use super::axis::Axis;
use super::distribution::{ID, drawn};
use super::error::SweepError;
use super::limits::PointLimits;
use super::samples::Samples;
use creepage_plan::{hash::fnv1a, shown::words_if};
use creepage_scene::{Scene, SceneError, SceneFile, Wrong, did_you_mean, key_meanings, nearest_key};

/// Maximum number of points of a sweep.
const MAX_POINTS: usize = 100_000_000;

/// Tolerance of samples, whose scatter is far larger.
pub const SAMPLE_TOLERANCE: f64 = 0.02;
const TOLERANCE: &str = "solver.tolerance";

/// Columns of a table of ducts: names of keys, and a value a row.
pub type Columns = Vec<(String, Vec<String>)>;

/// A scene and the values of its varied keys.
#[derive(Debug, Clone)]
pub struct Sweep {
    pub(super) file: SceneFile,
    /// The keys. A value may be a distribution, or empty, which leaves the scene's own.
    pub(super) axes: Vec<Axis>,
    pub(super) samples: Samples,
    /// Whether a point takes one value of each key, those of a row, in place of every combination.
    by_row: bool,
    /// Keys that are drawn, here or in other parts of their table.
    pub(super) drawn_keys: BTreeSet<String>,
    /// What every point is judged by.
    pub(super) limits: Option<PointLimits>,
}

impl Sweep {
    /// The grid over `axes` of the scene in `file`.
    ///
    /// # Errors
    ///
    /// [`SweepError::Invalid`] if there is nothing to vary, a key stands twice or has no value, a
    /// distribution is not written as it has to be, samples are asked without a distribution or the
    /// other way round, or there are more than a hundred million points; [`SweepError::Scene`]
    /// where a scene has no such key.
    pub fn new(file: SceneFile, axes: Vec<Axis>, samples: Samples) -> Result<Self, SweepError> {
        Self::of(file, axes, samples, false, None)
    }

    /// A table of ducts: a row is the scene in `file` with the values of the columns, which are
    /// named as keys and equally long. An empty cell leaves the scene's own value; a column `id` is
    /// carried over.
    ///
    /// # Errors
    ///
    /// As for [`Sweep::new`], and [`SweepError::Invalid`] if columns have different lengths.
    pub fn of_table(file: SceneFile, columns: Columns, samples: Samples) -> Result<Self, SweepError> {
        Self::of(file, axes(columns), samples, true, None)
    }

    /// Some rows of a table of ducts, in which nothing needs to be drawn: `drawn` are the keys that
    /// others of its rows draw, and whose columns hold numbers in all parts.
    ///
    /// # Errors
    ///
    /// As for [`Sweep::of_table`], but for samples without a distribution.
    pub fn of_part(
        file: SceneFile,
        columns: Columns,
        samples: Samples,
        drawn: impl IntoIterator<Item = String>,
    ) -> Result<Self, SweepError> {
        let drawn = drawn.into_iter().collect();
        Self::of(file, axes(columns), samples, true, Some(drawn))
    }

    /// The same with limits, which every point is judged by.
    #[must_use]
    pub fn with_limits(mut self, limits: PointLimits) -> Self {
        self.limits = Some(limits);
        self
    }

    fn of(
        file: SceneFile,
        mut axes: Vec<Axis>,
        samples: Samples,
        by_row: bool,
        drawn_elsewhere: Option<BTreeSet<String>>,
    ) -> Result<Self, SweepError> {
        draw_in_scene(&file, &mut axes, by_row);
        let is_any = axes.iter().any(|axis| axis.key != ID);
        fits(is_any, "no varied key", "at least one, such as duct.depth")?;
        let is_part = drawn_elsewhere.is_some();
        let mut drawn_keys = drawn_elsewhere.unwrap_or_default();
        for (index, axis) in axes.iter().enumerate() {
            let (key, count) = (&axis.key, axis.values.len());
            let is_first = axes[..index].iter().all(|other| other.key != *key);
            fits(is_first, &format!("`{key}` twice"), "every key once")?;
            fits(count > 0, &format!("`{key}` without values"), "one value or more")?;
            let is_long = !by_row || count == axes[0].values.len();
            let allowed = "a value a row, which may be empty";
            fits(is_long, "columns of different lengths", allowed)?;
            if is_drawn(axis)? {
                let found = format!("`{key}` with a distribution and no samples");
                fits(samples.count > 0, &found, "a number of samples with it")?;
                drawn_keys.insert(key.clone());
            }
        }
        let is_used = samples.count == 0 || is_part || !drawn_keys.is_empty();
        let allowed = "a distribution with them, as a value of a key or in the scene";
        fits(is_used, "samples and no distribution", allowed)?;
        let sweep = Self {
            file,
            axes,
            samples,
            by_row,
            drawn_keys,
            limits: None,
        };
        let is_small = sweep.count() <= MAX_POINTS;
        fits(is_small, "too many points", "at most a hundred million")?;
        sweep.check_keys()?;
        Ok(sweep)
    }

    /// An unknown key fails everywhere; what fails at some points only is recorded there.
    fn check_keys(&self) -> Result<(), SweepError> {
        let given = |axis: &Axis| axis.values.iter().position(|value| !value.is_empty());
        let groups: BTreeSet<usize> = self.axes.iter().filter_map(given).collect();
        for group in groups {
            let point = if self.by_row { group } else { 0 } * self.samples.count.max(1);
            match self.scene(point) {
                Err(SceneError::Wrong(wrong)) if wrong.is_unknown => return Err(self.unknown(wrong)),
                _ => {}
            }
        }
        Ok(())
    }

    /// The error of a key that no scene has: that of its column, if it has one.
    fn unknown(&self, wrong: Box<Wrong>) -> SweepError {
        let inside = format!("{}.", wrong.key);
        let is_meant = |axis: &&Axis| axis.key == wrong.key || axis.key.starts_with(&inside);
        let column = self.axes.iter().find(is_meant).filter(|_| self.by_row);
        let Some(Axis { key, .. }) = column.filter(|axis| !is_key(&axis.key)) else {
            return SceneError::Wrong(wrong).into();
        };
        let meant = did_you_mean(nearest_key(key).as_deref());
        SweepError::unfit(
            format!("the column `{key}`, which is no key{meant}"),
            "keys of the scene, which `creepage explain` lists, and `id`",
        )
    }

    /// How many points there are, samples included.
    pub fn count(&self) -> usize {
        let lengths = self.axes.iter().map(|axis| axis.values.len());
        let lengths = lengths.take(if self.by_row { 1 } else { self.axes.len() });
        lengths.fold(self.samples.count.max(1), usize::saturating_mul)
    }

    /// The keys that are drawn, here or in the parts that [`Sweep::of_part`] was told of.
    pub fn drawn_keys(&self) -> &BTreeSet<String> {
        &self.drawn_keys
    }

    /// The value of each varied key in a group of samples, as it was given.
    pub(super) fn given(&self, mut group: usize) -> Vec<&str> {
        let mut values = Vec::with_capacity(self.axes.len());
        for Axis { values: list, .. } in self.axes.iter().rev() {
            values.push(&*list[group % list.len()]);
            group /= if self.by_row { 1 } else { list.len() };
        }
        values.reverse();
        values
    }

    /// The value of each varied key at a point.
    pub fn values(&self, index: usize) -> Vec<String> {
        let samples = self.samples.count.max(1);
        let (group, sample) = (index / samples, index % samples);
        let given = self.axes.iter().zip(self.given(group));
        // What names a row: its id, or else its number. In a grid all points have the same samples.
        let mut ids = given
            .clone()
            .filter(|(axis, id)| axis.key == ID && !id.is_empty());
        let number = words_if(self.by_row, &group.to_string()).to_owned();
        let id = ids.next().map_or(number, |(_, id)| id.to_owned());
        let value = |(axis, given): (&Axis, &str)| match drawn(&axis.key, given) {
            Some(Ok(distribution)) => {
                let share = self.samples.share(&axis.key, &id, sample);
                distribution.quantile(share).1
            }
            _ => given.to_owned(),
        };
        given.map(value).collect()
    }

    /// The scene of a point. Samples are computed to [`SAMPLE_TOLERANCE`], unless the scene or an
    /// axis names `solver.tolerance`.
    ///
    /// # Errors
    ///
    /// [`SceneError`] if its values are not valid.
    pub fn scene(&self, index: usize) -> Result<Scene, SceneError> {
        let file = self.file_at(index)?;
        let mut scene = file.scene()?;
        if self.samples.count > 0 && !file.names(TOLERANCE) {
            scene.solver.tolerance = SAMPLE_TOLERANCE;
        }
        Ok(scene)
    }

    /// The scene file of a point.
    ///
    /// # Errors
    ///
    /// [`SceneError`] if there is nothing at a varied key.
    pub fn file_at(&self, index: usize) -> Result<SceneFile, SceneError> {
        let values = self.axes.iter().zip(self.values(index));
        let set = values.filter(|(axis, value)| !value.is_empty() && axis.key != ID);
        let overrides: Vec<String> = set.map(|(axis, value)| format!("{}={value}", axis.key)).collect();
        self.file.with(&overrides)
    }

    /// The files that its scenes read besides their own: tables of axle loads.
    pub fn files(&self) -> BTreeSet<PathBuf> {
        let mut files = BTreeSet::from_iter(self.file.histogram());
        let named = |axis: &&Axis| matches!(&*axis.key, "traffic" | "traffic.histogram");
        for Axis { key, values } in self.axes.iter().filter(named) {
            for value in BTreeSet::from_iter(values) {
                let file = self.file.with(&[format!("{key}={value}")]);
                files.extend(file.ok().and_then(|file| file.histogram()));
            }
        }
        files
    }

    /// What distinguishes this sweep from another: program, scene, keys, values, and what stands in
    /// the files that they name.
    pub(super) fn name(&self) -> u64 {
        let version = env!("CARGO_PKG_VERSION");
        let typed = self.file.typed().into_iter();
        let scene: Vec<_> = typed.map(|typed| (typed.key, typed.text)).collect();
        let files = self.files().into_iter();
        let files: Vec<_> = files.map(|file| std::fs::read(file).ok()).collect();
        let rest = (&self.axes, &self.samples, &self.by_row, &self.limits);
        fnv1a(format!("{version}\0{scene:?}\0{files:?}\0{rest:?}").into_bytes())
    }
}

/// Refuses what does not fit together.
fn fits(holds: bool, found: &str, allowed: &str) -> Result<(), SweepError> {
    let refused = || SweepError::unfit(found, allowed);
    holds.then_some(()).ok_or_else(refused)
}

fn axes(columns: Columns) -> Vec<Axis> {
    let axis = |(key, values)| Axis { key, values };
    columns.into_iter().map(axis).collect()
}

/// Whether any of its values is a distribution; refuses one that is none.
fn is_drawn(Axis { key, values }: &Axis) -> Result<bool, SweepError> {
    let mut is_drawn = false;
    for found in values {
        let Some(distribution) = drawn(key, found) else {
            continue;
        };
        let refused = |allowed| SweepError::Cell {
            key: key.clone(),
            found: found.clone(),
            allowed,
        };
        distribution.map_err(refused)?;
        is_drawn = true;
    }
    Ok(is_drawn)
}

/// Adds the keys at which the scene has a distribution: it is drawn in rows that have no value of
/// their own, neither of the key nor of a section around it.
fn draw_in_scene(file: &SceneFile, axes: &mut Vec<Axis>, by_row: bool) {
    let rows = axes.first().filter(|_| by_row);
    let rows = rows.map_or(1, |axis| axis.values.len());
    let in_scene = file.typed().into_iter().map(|typed| (typed.key, typed.text));
    for (key, text) in in_scene.filter(|(key, text)| drawn(key, text).is_some()) {
        if let Some(axis) = axes.iter_mut().find(|axis| axis.key == key) {
            let empty = axis.values.iter_mut().filter(|value| value.is_empty());
            empty.for_each(|value| value.clone_from(&text));
            continue;
        }
        let is_around = |axis: &Axis| key.starts_with(&format!("{}.", axis.key));
        let is_given = |axis: &Axis, row: usize| axis.values.get(row).is_some_and(|value| !value.is_empty());
        let is_replaced = |row| axes.iter().any(|axis| is_around(axis) && is_given(axis, row));
        let value = |row| words_if(!is_replaced(row), &text).to_owned();
        let values = (0..rows).map(value).collect();
        axes.push(Axis { key, values });
    }
}

/// Whether a scene may have such a key, whatever its lists hold.
fn is_key(key: &str) -> bool {
    let names = key.split('.').filter(|name| name.parse::<usize>().is_err());
    let key = names.collect::<Vec<_>>().join(".");
    key_meanings().iter().any(|known| known.key == key)
}
