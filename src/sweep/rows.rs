//! Rows in place of a grid: each is a duct with its own values, and each may be sampled.

use std::collections::{BTreeSet, HashSet};
use std::path::Path;

use creepage_tables::Options;

use super::axis::{Axis, AxisValues};
use super::distribution::Distribution;
use super::error::SweepError;
use super::grid::{Samples, Sweep};
use super::list::{self, TEXTS};
use crate::SceneFile;
use crate::scene::TypedValue;

/// Most samples of a row.
const MOST_SAMPLES: usize = 1_000_000;

impl Sweep {
    /// The ducts of a table, `.csv` or `.xlsx`, read as `options` say, as [`Sweep::of_table`] takes them.
    ///
    /// # Errors
    ///
    /// [`SweepError::Rows`] where there is no such table, and as for [`Sweep::of_table`].
    pub fn of_rows(
        file: SceneFile,
        table: &Path,
        options: &Options,
        samples: Samples,
    ) -> Result<Self, SweepError> {
        Self::of_table(file, list::read(table, options)?, samples)
    }

    /// A table of ducts: a row is the scene in `file` with the values of the columns, which are named as keys and equally long. An empty cell
    /// leaves the scene's own value; a column `id` is carried over.
    ///
    /// With samples, a cell or a value of the scene may be a distribution ([`Axis::parse`]): each row is computed so many times. Then a row's
    /// tolerance is `solver.tolerance`, or a quarter of the standard deviation of its largest force where that is more, up to 5 %:
    /// of the quantiles at 5 and 95 % it is a seventh of the distance to the median.
    ///
    /// # Errors
    ///
    /// [`SweepError::Unfit`] where there is no key, no row, a column twice, a distribution without samples, more than a million samples, samples
    /// without a distribution, or a row without an id whose number is another's id; [`SweepError::Cell`] where a distribution is not written as
    /// it has to be; [`SweepError::Scene`] where a scene has no such key.
    pub fn of_table(
        file: SceneFile,
        columns: Vec<(String, Vec<String>)>,
        samples: Samples,
    ) -> Result<Self, SweepError> {
        let sweep = Self::of_part(file, columns, samples, [])?;
        if samples.count > 0 && sweep.drawn_keys.is_empty() {
            return Err(SweepError::Unfit {
                found: "samples and no distribution".into(),
                allowed: "a distribution with them, in a cell of the table or in the scene",
            });
        }
        Ok(sweep)
    }

    /// Some rows of a table of ducts, in which nothing needs to be drawn: `drawn` are the keys that others of its rows draw, and whose columns
    /// hold numbers in all parts.
    ///
    /// # Errors
    ///
    /// As for [`Sweep::of_table`], but for samples without a distribution.
    pub fn of_part(
        file: SceneFile,
        columns: Vec<(String, Vec<String>)>,
        samples: Samples,
        drawn: impl IntoIterator<Item = String>,
    ) -> Result<Self, SweepError> {
        let unfit = |found: String, allowed| Err(SweepError::Unfit { found, allowed });
        if samples.count > MOST_SAMPLES {
            return unfit(
                format!("{} samples", samples.count),
                "at most a million of each row",
            );
        }
        let mut axes: Vec<Axis> = Vec::with_capacity(columns.len());
        for (key, values) in columns {
            if axes.iter().any(|other| other.key == key) {
                return unfit(format!("two columns `{key}`"), "every key once");
            }
            let values = AxisValues::List(values);
            axes.push(Axis { key, values });
        }
        let file = with_medians(file, &mut axes, samples)?;
        if axes.iter().all(|axis| axis.key == list::ID) {
            return unfit(
                "no column that is named as a key".into(),
                "one or more, such as duct.depth",
            );
        }
        let lists = || axes.iter().filter_map(Axis::list);
        let rows = lists().next().map_or(0, <[String]>::len);
        let Some(count) = rows.checked_mul(samples.count.max(1)).filter(|&count| count > 0) else {
            return unfit(format!("{rows} rows"), "one or more");
        };
        if lists().any(|list| list.len() != rows) {
            return unfit(
                "columns of different lengths".into(),
                "a value a row, which may be empty",
            );
        }
        let mut sweep = Self {
            file,
            axes,
            samples,
            count,
            by_row: true,
            drawn_keys: drawn.into_iter().collect(),
        };
        sweep.check_ids()?;
        for axis in &sweep.axes {
            let given = axis
                .list()
                .and_then(|list| list.iter().position(|value| !value.is_empty()));
            if let Some(row) = given {
                sweep.knows_keys(row * samples.count.max(1))?;
            }
            for value in axis.list().unwrap_or_default() {
                sweep.check_cell(&axis.key, value)?;
            }
        }
        let own: BTreeSet<&str> = (0..rows).flat_map(|row| sweep.drawn(row)).collect();
        let own: Vec<String> = own.into_iter().map(str::to_owned).collect();
        sweep.drawn_keys.extend(own);
        Ok(sweep)
    }

    /// Refuses a row without an id whose number is the id of another: both would draw the same samples.
    fn check_ids(&self) -> Result<(), SweepError> {
        let ids = self
            .axes
            .iter()
            .find(|axis| axis.key == list::ID)
            .and_then(Axis::list);
        let ids = ids.filter(|_| self.samples.count > 0).unwrap_or_default();
        let known: HashSet<&str> = ids.iter().map(String::as_str).collect();
        let unnamed = ids.iter().zip(0_usize..).filter(|(id, _)| id.is_empty());
        let twice = unnamed
            .map(|(_, row)| row.to_string())
            .find(|row| known.contains(&**row));
        twice.map_or(Ok(()), |row| {
            Err(SweepError::Unfit {
                found: format!(
                    "the id `{row}`, by which a row without an id is known too, as its number from 0 is {row}"
                ),
                allowed: "an id in every row, or ids that are no such numbers",
            })
        })
    }

    /// The keys that rows draw, here or in the parts that [`Sweep::of_part`] was told of.
    pub fn drawn_keys(&self) -> &BTreeSet<String> {
        &self.drawn_keys
    }

    /// Refuses a distribution that is none, or that nobody draws from.
    fn check_cell(&self, key: &str, value: &str) -> Result<(), SweepError> {
        match distribution(key, value) {
            Some(Ok(_)) if self.samples.count == 0 => Err(SweepError::Unfit {
                found: format!("`{key}` with a distribution and no samples"),
                allowed: "a number of samples with it",
            }),
            Some(Err(error)) => Err(error),
            _ => Ok(()),
        }
    }

    /// What names a row: its `id`, or else its number.
    pub(super) fn id(&self, row: usize) -> String {
        let id = self.axes.iter().find(|axis| axis.key == list::ID);
        let id = id.and_then(|axis| axis.list()?.get(row).filter(|id| !id.is_empty()));
        id.map_or_else(|| row.to_string(), Clone::clone)
    }

    /// The values of a row, with those that are drawn at the `share` of their keys.
    pub(super) fn row_values(&self, row: usize, share: impl Fn(&str) -> f64) -> Vec<String> {
        let value = |axis: &Axis| match (axis.distribution(row), &axis.values) {
            _ if self.is_replaced(axis, row) => String::new(),
            (Some(distribution), _) => distribution.quantile(share(&axis.key)).1,
            (None, AxisValues::List(list)) => list[row].clone(),
            (None, AxisValues::Drawn(_)) => String::new(),
        };
        self.axes.iter().map(value).collect()
    }

    /// The keys that a row draws.
    pub(super) fn drawn(&self, row: usize) -> impl Iterator<Item = &str> {
        let drawn = self
            .axes
            .iter()
            .filter(move |axis| axis.distribution(row).is_some() && !self.is_replaced(axis, row));
        drawn.map(|axis| &*axis.key)
    }

    /// Whether the scene draws a key inside what the row has of its own: `ends.downstream` in place of `ends.downstream.spring`.
    fn is_replaced(&self, axis: &Axis, row: usize) -> bool {
        matches!(axis.values, AxisValues::Drawn(_))
            && self.axes.iter().any(|other| {
                let inner = axis.key.strip_prefix(&*other.key);
                inner.is_some_and(|inner| inner.starts_with('.'))
                    && other.list().is_some_and(|list| !list[row].is_empty())
            })
    }
}

impl Axis {
    /// Its values, where they are listed.
    pub(super) fn list(&self) -> Option<&[String]> {
        match &self.values {
            AxisValues::List(list) => Some(list),
            AxisValues::Drawn(_) => None,
        }
    }

    /// What a row draws from.
    fn distribution(&self, row: usize) -> Option<Distribution> {
        match &self.values {
            AxisValues::List(list) => distribution(&self.key, list.get(row)?)?.ok(),
            AxisValues::Drawn(distribution) => Some(distribution.clone()),
        }
    }
}

/// The distribution that stands at `key`, if one does.
pub fn distribution(key: &str, text: &str) -> Option<Result<Distribution, SweepError>> {
    let is_name = TEXTS.contains(&key.rsplit('.').next().unwrap_or(key));
    let found = Distribution::parse(text).filter(|_| !is_name)?;
    Some(found.map_err(|allowed| SweepError::Cell {
        key: key.to_owned(),
        found: text.to_owned(),
        allowed,
    }))
}

/// The scene with the median where a distribution stood: that one is drawn in rows that have no value of their own.
fn with_medians(file: SceneFile, axes: &mut Vec<Axis>, samples: Samples) -> Result<SceneFile, SweepError> {
    let mut medians = Vec::new();
    for typed in file.typed() {
        let (key, TypedValue::Text(text)) = (typed.key, typed.value) else {
            continue;
        };
        let Some(found) = distribution(&key, &text) else {
            continue;
        };
        let found = found?;
        if samples.count == 0 {
            return Err(SweepError::Unfit {
                found: format!("`{key}` with a distribution and no samples"),
                allowed: "a number of samples with it",
            });
        }
        medians.push(format!("{key}={}", found.quantile(0.5).1));
        match axes
            .iter_mut()
            .find(|axis| axis.key == key)
            .map(|axis| &mut axis.values)
        {
            Some(AxisValues::List(list)) => {
                let empty = list.iter_mut().filter(|value| value.is_empty());
                empty.for_each(|value| value.clone_from(&text));
            }
            _ => axes.push(Axis {
                key,
                values: AxisValues::Drawn(found),
            }),
        }
    }
    if medians.is_empty() {
        return Ok(file);
    }
    Ok(file.with(&medians)?)
}
