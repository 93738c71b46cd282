//! All points of a sweep, and their table in a file.

use std::path::Path;
use std::sync::Mutex;

use serde::{Deserialize, Serialize};

use super::bands::Band;
use super::compute::lock;
use super::error::SweepError;
use super::grid::Sweep;
use super::journal::Journal;
use super::options::SweepOptions;
use super::row::Row;
use super::sink::Kind;
use super::table::Format;
use crate::output::{Files, Output};

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
}

impl Sweep {
    /// Computes all points that are not done yet and writes the table to `output`, whose name ends in `.csv`
    /// or `.xlsx`. Numbers are in SI, but in a workbook in the units that were typed, which stand below the
    /// names of its columns.
    ///
    /// The journal stands beside it, as `output.journal`, until the table is in place. Where `output` is a link, it stands beside
    /// what that points to.
    ///
    /// # Errors
    ///
    /// [`SweepError`] when the output cannot be written, or it or its journal is something else already. What fails at a point is
    /// a row of the table.
    pub fn run(&self, output: &Path, options: &SweepOptions<'_>) -> Result<SweepSummary, SweepError> {
        let format = Format::of(output)?;
        if self.count() > format.most_rows() {
            return Err(SweepError::Unfit {
                found: format!("{} points for {}", self.count(), output.display()),
                allowed: "at most 1048574, as many as Excel has rows; more in .csv",
            });
        }
        let output = Files::reading([], options.force).output(output, format.ending())?;
        let mut beside = output.path().as_os_str().to_owned();
        beside.push(".journal");
        let mut journal = Journal::open(beside.into(), self.name(), self.count())?;
        let resumed = journal.done();
        let finished = journal.finished();
        let keeper = Mutex::new(&mut journal);
        self.compute(&finished, options, &|row| lock(&keeper).append(row))?;
        journal.force()?;
        let summary = self.write(&journal, resumed, &output, format, options.each)?;
        journal.remove()?;
        Ok(summary)
    }

    fn write(
        &self,
        journal: &Journal,
        resumed: usize,
        output: &Output,
        format: Format,
        each: Option<&dyn Fn(&Row)>,
    ) -> Result<SweepSummary, SweepError> {
        let columns = self.columns();
        let answers: Vec<(&str, Kind)> = self.answer_columns().collect();
        let mut summary = SweepSummary {
            points: self.count(),
            resumed,
            failed: 0,
            first_error: None,
            bands: Vec::new(),
        };
        let mut samples = Vec::new();
        let failed = |source| SweepError::File(output.path().display().to_string(), source);
        // It comes into its place when it is whole.
        let mut table = format
            .sink(output.begin()?, &columns, &self.file)
            .map_err(failed)?;
        for row in journal.rows() {
            if let Some(each) = each {
                each(row);
            }
            if let Err(error) = &row.outcome {
                summary.failed += 1;
                summary.first_error.get_or_insert_with(|| error.to_string());
            }
            let values = self.values(row.index);
            if self.samples.count > 0 {
                samples.push(row);
                if samples.len() == self.samples.count {
                    summary
                        .bands
                        .push(Band::of(self.listed(row.index, &values), &samples));
                    samples.clear();
                }
            }
            table
                .row(self.cells(values, &columns, &answers, row))
                .map_err(failed)?;
        }
        table.finish().map_err(failed)?.finish()?;
        Ok(summary)
    }

    /// The keys that a point has values for and does not draw.
    fn listed(&self, index: usize, values: &[String]) -> Vec<(String, String)> {
        let drawn: Vec<&str> = self.drawn(index / self.samples.count.max(1)).collect();
        let pairs = self.axes.iter().zip(values);
        pairs
            .filter(|(axis, value)| !(drawn.contains(&&*axis.key) || self.by_row && value.is_empty()))
            .map(|(axis, value)| (axis.key.clone(), value.clone()))
            .collect()
    }
}
