//! All points of a sweep, and their table in memory or in a file.

use std::path::Path;

use serde::{Deserialize, Serialize};

use super::bands::Band;
use super::columns::{AnswerColumn, Row, error_of};
use super::error::SweepError;
use super::grid::Sweep;
use super::table::Format;
use super::unfinished::Unfinished;
use crate::output::Files;
use crate::{Error, Progress, Run, Scene};

/// Computes a point.
pub type Evaluate<'a> = dyn Fn(&Scene) -> Result<Run, Error> + Sync + 'a;

/// How to sweep, in rayon's threads: those of the pool in which it is called, or all cores.
#[derive(Default, Clone, Copy)]
pub struct SweepOptions<'a> {
    /// Called with the share of the points that are done, at the start and after each point; it may
    /// stop the sweep, which the same call resumes later.
    pub progress: Progress<'a>,
    /// Computes a point in place of [`crate::run`].
    pub evaluate: Option<&'a Evaluate<'a>>,
    /// Whether the output replaces a file whose name ends otherwise.
    pub force: bool,
}

/// What a sweep did.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct SweepSummary {
    /// Points in the table.
    pub points: usize,
    /// Points that an earlier run had done.
    pub resumed: usize,
    /// Points that have an error in place of an answer.
    pub failed: usize,
    /// The first of these errors.
    pub first_error: Option<String>,
    /// Quantiles at every point of the grid, where keys are drawn.
    pub bands: Vec<Band>,
    /// All points, in the order of the grid.
    #[serde(skip)]
    pub(crate) rows: Vec<Row>,
}

impl Sweep {
    /// Computes all points and returns the columns that [`Sweep::run`] writes, without any file.
    ///
    /// ```
    /// use creepage::SceneFile;
    /// use creepage::sweep::{AnswerValues, Samples, Sweep, SweepOptions};
    ///
    /// let file = SceneFile::read("examples/scenes/full-scale-upper.toml")?.with(&["traffic.passes=1"])?;
    /// let depths = vec![("duct.depth".to_owned(), vec!["1.2 m".to_owned(), "2 m".to_owned()])];
    /// let sweep = Sweep::of_table(file, depths, Samples::default())?;
    /// let columns = sweep.answers(&SweepOptions::default())?;
    /// assert_eq!(columns[0].values, AnswerValues::Numbers(vec![Some(1.2), Some(2.0)]));
    /// assert_eq!(columns[1].name, "downstream_force_n");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`SweepError::Stopped`] where the progress stopped it. What fails at a point is a row of the
    /// table.
    pub fn answers(&self, options: &SweepOptions<'_>) -> Result<Vec<AnswerColumn>, SweepError> {
        let mut columns = self.columns();
        let mut rows = Vec::new();
        self.compute(0, &columns, options, &mut |row| {
            rows.push(row);
            Ok(())
        })?;
        for row in &rows {
            columns
                .iter_mut()
                .zip(row)
                .for_each(|(column, cell)| column.push(cell));
        }
        Ok(columns)
    }

    /// Computes all points that are not done yet and writes the table to `output`, whose name ends
    /// in `.csv` or `.xlsx`. Numbers are in SI, but in a workbook in the units that were typed,
    /// which stand below the names of its columns.
    ///
    /// Until the table is in place its rows stand beside it, as `output.unfinished`. Where `output`
    /// is a link, they stand beside what that points to.
    ///
    /// # Errors
    ///
    /// [`SweepError`] when the output cannot be written, or what stands beside it is no part of
    /// this sweep. What fails at a point is a row of the table.
    pub fn run(&self, output: &Path, options: &SweepOptions<'_>) -> Result<SweepSummary, SweepError> {
        let format = Format::of(output)?;
        if self.count() > format.most_rows() {
            return Err(SweepError::unfit(
                format!("{} points for {}", self.count(), output.display()),
                "at most 1048574, as many as Excel has rows; more in .csv",
            ));
        }
        let output = Files::reading([], options.force).output(output, format.ending())?;
        let columns = self.columns();
        let mut unfinished = Unfinished::open(output.path(), self, &columns)?;
        let resumed = unfinished.rows.len();
        self.compute(resumed, &columns, options, &mut |row| unfinished.keep(row))?;
        // It comes into its place when it is whole.
        let draft = format.write(output.begin()?, &columns, &self.file, &unfinished.rows);
        draft.map_err(SweepError::of_file(output.path()))?.finish()?;
        let rows = unfinished.remove()?;
        let errors = || rows.iter().filter_map(error_of);
        Ok(SweepSummary {
            points: rows.len(),
            resumed,
            failed: errors().count(),
            first_error: errors().next().map(str::to_owned),
            bands: self.bands(&columns, &rows),
            rows,
        })
    }
}
