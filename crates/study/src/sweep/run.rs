//! All points of a sweep, and their table in memory or in a file.

use std::io;
use std::path::Path;

use serde::{Deserialize, Serialize};

use super::bands::Band;
use super::columns::{AnswerColumn, Row, error_of};
use super::error::SweepError;
use super::finished::Finished;
use super::grid::Sweep;
use super::table;
use crate::output::Files;
use creepage_run::{Error, Progress, Run};
use creepage_scene::Scene;

/// Computes a point.
pub type Evaluate<'a> = dyn Fn(&Scene) -> Result<Run, Error> + Sync + 'a;

/// How to sweep, in rayon's threads: those of the pool in which it is called, or all cores.
#[derive(Default, Clone, Copy)]
pub struct SweepOptions<'a> {
    /// Called with the share of the points that are done, at the start and after each point; it may
    /// stop the sweep, which the same call resumes later.
    pub progress: Progress<'a>,
    /// Computes a point in place of [`creepage_run::run`].
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
    pub rows: Vec<Row>,
}

impl Sweep {
    /// Computes all points and returns the columns that [`Sweep::run`] writes, without any file.
    ///
    /// ```
    /// use creepage_scene::SceneFile;
    /// use creepage_study::sweep::{AnswerValues, Samples, Sweep, SweepOptions};
    ///
    /// let file = SceneFile::read("../../examples/scenes/full-scale-upper.toml")?.with(&["traffic.passes=1"])?;
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
    /// [`SweepError::Stopped`] if the progress stopped it. What fails at a point is a row of the
    /// table.
    pub fn answers(&self, options: &SweepOptions<'_>) -> Result<Vec<AnswerColumn>, SweepError> {
        let mut columns = self.columns();
        let mut finished = Finished::default();
        self.compute(&mut finished, &columns, options)?;
        for row in finished.rows.values() {
            let cells = columns.iter_mut().zip(row);
            cells.for_each(|(column, cell)| column.push(cell));
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
        let ending = table::ending(output)?;
        table::check_count(self.count(), output)?;
        let output = Files::reading([], options.force).output(output, ending)?;
        let columns = self.columns();
        let mut finished = Finished::beside(output.path(), self, &columns)?;
        let resumed = finished.rows.len();
        self.compute(&mut finished, &columns, options)?;
        let bytes = table::bytes(ending, &columns, &self.file, finished.rows.values());
        output.write(&bytes.map_err(|source| output.failed(io::Error::other(source)))?)?;
        let rows = finished.whole()?;
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
