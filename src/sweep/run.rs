//! All points of a sweep, and their table.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::sync_channel;
use std::thread;

use serde::Serialize;

use super::axis::si;
use super::bands::{Band, Gatherer};
use super::journal::Journal;
use super::row::{Answer, Row};
use super::table::{self, Cell, Column, Format, Kind, Sink};
use super::{AxisValues, Sweep, SweepError};
use crate::error::with_causes;
use crate::output::{Files, Output};
use crate::{Error, Progress, Run, Scene, finite};

/// Rows that may wait for the journal.
const WAITING: usize = 64;

/// Computes a point.
pub type Evaluate<'a> = dyn Fn(&Scene) -> Result<Run, Error> + Sync + 'a;

/// How to sweep.
#[derive(Default)]
pub struct SweepOptions<'a> {
    /// Number of threads; all cores where it is `None`.
    pub threads: Option<usize>,
    /// Called with the share of the points that are done, at the start and after each point; it may stop the sweep, which the same call
    /// resumes later.
    pub progress: Progress<'a>,
    /// Called with each row of the table, in the order of the grid.
    pub each: Option<&'a dyn Fn(&Row)>,
    /// Computes a point in place of [`crate::run`].
    pub evaluate: Option<&'a Evaluate<'a>>,
    /// Whether the output replaces a file that is no table of a sweep.
    pub force: bool,
}

/// What a sweep did.
#[derive(Debug, Clone, PartialEq, Serialize)]
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
    /// Computes all points that are not done yet and writes the table to `output`, whose name ends in `.csv` or `.parquet`.
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
        let output = Files::reading([], options.force).output(output, format.kind())?;
        let mut journal = Journal::open(table::beside(output.path(), "journal"), self.name(), self.count)?;
        let resumed = journal.done();
        self.compute(&mut journal, options)?;
        journal.force()?;
        let summary = self.write(&journal, resumed, &output, format, options.each)?;
        journal.remove()?;
        Ok(summary)
    }

    fn compute(&self, journal: &mut Journal, options: &SweepOptions<'_>) -> Result<(), SweepError> {
        let threads = options.threads.unwrap_or(0);
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        let pool = pool.map_err(|error| SweepError::File {
            file: "threads".into(),
            source: std::io::Error::other(error),
        })?;
        let finished = journal.finished();
        let report = |done: usize| {
            let reported = options.progress.report(done as f64 / self.count as f64);
            reported.map_err(|_| SweepError::Stopped)
        };
        report(journal.done())?;
        let next = AtomicUsize::new(0);
        let (send, receive) = sync_channel(WAITING);
        let evaluate = options.evaluate.unwrap_or(&crate::run);
        let work = |send: &std::sync::mpsc::SyncSender<Row>| {
            loop {
                let index = next.fetch_add(1, Ordering::Relaxed);
                match finished.get(index) {
                    None => return,
                    Some(true) => {}
                    // Nobody takes rows any more where the journal cannot be written.
                    Some(false) => {
                        if send.send(self.row(index, evaluate)).is_err() {
                            return;
                        }
                    }
                }
            }
        };
        thread::scope(|scope| {
            // `send` ends with the workers, and with it the rows.
            scope.spawn(move || pool.broadcast(|_| work(&send)));
            for row in receive {
                journal.append(&row)?;
                report(journal.done())?;
            }
            Ok(())
        })
    }

    /// Computes one point. Whatever goes wrong there is its answer.
    fn row(&self, index: usize, evaluate: &Evaluate<'_>) -> Row {
        let compute = || {
            let run = evaluate(&self.scene(index)?)?;
            finite::check(&run)?;
            Ok::<_, Error>(Answer::of(&run))
        };
        let outcome = match catch_unwind(AssertUnwindSafe(compute)) {
            Ok(Ok(Some(answer))) => Ok(answer),
            Ok(Ok(None)) => Err("no pass was computed".to_owned()),
            Ok(Err(error)) => Err(with_causes(&error)),
            Err(_) => Err("the computation broke off".to_owned()),
        };
        Row { index, outcome }
    }

    fn columns(&self) -> Vec<Column> {
        let column = |name: &str, kind| Column {
            name: name.to_owned(),
            kind,
        };
        let mut columns: Vec<Column> = self
            .axes
            .iter()
            .map(|axis| {
                let text =
                    matches!(&axis.values, AxisValues::List(list) if list.iter().any(|v| si(v).is_none()));
                column(&axis.key, if text { Kind::Text } else { Kind::Number })
            })
            .collect();
        if self.samples.count > 0 {
            columns.push(column("sample", Kind::Count));
        }
        columns.extend([
            column("downstream_force_n", Kind::Number),
            column("upstream_force_n", Kind::Number),
            column("max_compression_n", Kind::Number),
            column("saturation_force_n", Kind::Number),
            column("passes_to_95_percent", Kind::Count),
            column("upstream_displacement_m", Kind::Number),
            column("downstream_displacement_m", Kind::Number),
            column("error_estimate", Kind::Number),
            column("status", Kind::Text),
            column("error", Kind::Text),
        ]);
        columns
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
        let mut summary = SweepSummary {
            points: self.count,
            resumed,
            failed: 0,
            first_error: None,
            bands: Vec::new(),
        };
        let mut gatherer = Gatherer::default();
        table::write(output, format, &columns, |sink| {
            journal.in_order(|row| {
                if let Some(each) = each {
                    each(&row);
                }
                if let Err(error) = &row.outcome {
                    summary.failed += 1;
                    summary.first_error.get_or_insert_with(|| error.clone());
                }
                if self.samples.count > 0 {
                    gatherer.add(&row);
                    if (row.index + 1).is_multiple_of(self.samples.count) {
                        summary.bands.push(gatherer.band(self.listed(row.index)));
                    }
                }
                self.record(sink, &columns, &row)
                    .map_err(|source| SweepError::File {
                        file: output.path().display().to_string(),
                        source,
                    })
            })
        })?;
        Ok(summary)
    }

    /// The keys that are not drawn, with their values at a point.
    fn listed(&self, index: usize) -> Vec<(String, String)> {
        self.axes
            .iter()
            .zip(self.values(index))
            .filter(|(axis, _)| matches!(axis.values, AxisValues::List(_)))
            .map(|(axis, value)| (axis.key.clone(), value))
            .collect()
    }

    fn record(&self, sink: &mut dyn Sink, columns: &[Column], row: &Row) -> std::io::Result<()> {
        let values = self.values(row.index);
        let mut cells: Vec<Cell> = values
            .iter()
            .zip(columns)
            .map(|(value, column)| match column.kind {
                Kind::Text => Cell::Text(Some(value)),
                _ => Cell::Number(si(value)),
            })
            .collect();
        if self.samples.count > 0 {
            cells.push(Cell::Count(Some((row.index % self.samples.count) as u64)));
        }
        let answer = row.outcome.as_ref().ok();
        let number = |field: fn(&Answer) -> f64| Cell::Number(answer.map(field));
        cells.extend([
            number(|answer| answer.downstream_force_n),
            number(|answer| answer.upstream_force_n),
            number(|answer| answer.max_compression_n),
            Cell::Number(answer.and_then(|answer| answer.saturation_force_n)),
            Cell::Count(answer.and_then(|answer| answer.passes_to_95_percent)),
            number(|answer| answer.upstream_displacement_m),
            number(|answer| answer.downstream_displacement_m),
            number(|answer| answer.error_estimate),
            Cell::Text(Some(if answer.is_some() { "ok" } else { "error" })),
            Cell::Text(row.outcome.as_ref().err().map(String::as_str)),
        ]);
        sink.row(&cells)
    }
}
