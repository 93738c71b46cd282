//! All points of a sweep, and their table.

use std::fmt;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::sync_channel;
use std::thread;

use serde::{Deserialize, Serialize};

use super::axis::AxisValues;
use super::bands::Band;
use super::error::SweepError;
use super::grid::Sweep;
use super::journal::Journal;
use super::list;
use super::numbers::si;
use super::row::{Answer, PointError, Row};
use super::sink::{Cell, Column, Kind};
use super::table::Format;
use crate::answer::si_of_field;
use crate::output::{Files, Output};
use crate::scene::si_unit;
use crate::{Error, Progress, Run, Scene, Units, finite};

/// Rows that may wait for the journal.
const WAITING: usize = 64;

/// Computes a point.
pub type Evaluate<'a> = dyn Fn(&Scene) -> Result<Run, Error> + Sync + 'a;

/// Columns of an answer, by the names of its fields.
const COLUMNS: [(&str, Kind); 8] = [
    ("downstream_force_n", Kind::Number),
    ("upstream_force_n", Kind::Number),
    ("max_compression_n", Kind::Number),
    ("saturation_force_n", Kind::Number),
    ("passes_to_95_percent", Kind::Count),
    ("upstream_displacement_m", Kind::Number),
    ("downstream_displacement_m", Kind::Number),
    ("error_estimate", Kind::Number),
];
/// Those of a cable that is heated, where the file says so.
const HEAT_COLUMNS: [(&str, Kind); 5] = [
    ("downstream_max_n", Kind::Number),
    ("downstream_min_n", Kind::Number),
    ("upstream_max_n", Kind::Number),
    ("upstream_min_n", Kind::Number),
    ("drift_per_day_m", Kind::Number),
];

/// How to sweep.
#[derive(Default, Clone, Copy)]
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

impl fmt::Debug for SweepOptions<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("SweepOptions")
            .field("threads", &self.threads)
            .field("progress", &self.progress)
            .field("force", &self.force)
            .finish_non_exhaustive()
    }
}

impl Sweep {
    /// Computes all points that are not done yet and writes the table to `output`, whose name ends in `.csv`,
    /// `.parquet` or `.xlsx`. Numbers are in SI, but in a workbook in the units that were typed, which stand below the names of its columns.
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
                allowed: "at most 1048574, as many as Excel has rows; more in .csv or .parquet",
            });
        }
        let output = Files::reading([], options.force).output(output, format.kind())?;
        let mut beside = output.path().as_os_str().to_owned();
        beside.push(".journal");
        let mut journal = Journal::open(beside.into(), self.name(), self.count())?;
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
        let pool = pool.map_err(|error| SweepError::File("threads".into(), std::io::Error::other(error)))?;
        let finished = journal.finished();
        let report = |done: usize| {
            let reported = options.progress.report(done as f64 / self.count() as f64);
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
                journal.append(row)?;
                report(journal.done())?;
            }
            Ok(())
        })
    }

    /// Computes one point. Whatever goes wrong there is its answer.
    fn row(&self, index: usize, evaluate: &Evaluate<'_>) -> Row {
        let compute = || -> Result<Answer, PointError> {
            let scene = self.scene(index).map_err(Error::from)?;
            let run = evaluate(&scene)?;
            finite::check(&run)?;
            Answer::of(&run).ok_or_else(|| PointError::Failed("no pass was computed".into()))
        };
        let outcome = catch_unwind(AssertUnwindSafe(compute))
            .unwrap_or_else(|_| Err(PointError::Failed("the computation broke off".into())));
        Row { index, outcome }
    }

    /// The columns of an answer.
    fn answers(&self) -> impl Iterator<Item = (&'static str, Kind)> {
        let is_heated = self.scene(0).is_ok_and(|scene| scene.heat.is_some());
        let heat = HEAT_COLUMNS.into_iter().filter(move |_| is_heated);
        COLUMNS.into_iter().chain(heat)
    }

    fn columns(&self) -> Vec<Column> {
        let units = self.file_at(0).map(|file| Units::typed(&file, None, None));
        let units = units.unwrap_or_default();
        let column = |name: &str, kind| Column {
            unit: si_unit(name).or(si_of_field(name).map(|(_, unit)| unit)),
            shown: units.of_field(name).map(|(name, unit)| (name.to_owned(), unit)),
            name: name.to_owned(),
            kind,
        };
        let is_number = |value: &String| value.is_empty() || si(value).is_some();
        let varied = self.axes.iter().map(|axis| match &axis.values {
            _ if axis.key == list::ID => column(&axis.key, Kind::Text),
            AxisValues::List(list) if !list.iter().all(is_number) => column(&axis.key, Kind::Text),
            _ => Column {
                shown: axis.unit().map(|unit| (axis.key.clone(), unit)),
                ..column(&axis.key, Kind::Number)
            },
        });
        let sample = (self.samples.count > 0).then(|| column("sample", Kind::Count));
        let answer = self.answers().map(|(name, kind)| column(name, kind));
        let end = ["status", "error"].map(|name| column(name, Kind::Text));
        varied.chain(sample).chain(answer).chain(end).collect()
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
        let answers: Vec<(&str, Kind)> = self.answers().collect();
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
                    summary.bands.push(Band::of(self.listed(&values), &samples));
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

    /// The keys that are not drawn, with their values.
    fn listed(&self, values: &[String]) -> Vec<(String, String)> {
        let pairs = self.axes.iter().zip(values);
        pairs
            .filter(|(axis, _)| matches!(axis.values, AxisValues::List(_)))
            .map(|(axis, value)| (axis.key.clone(), value.clone()))
            .collect()
    }

    fn cells(
        &self,
        values: Vec<String>,
        columns: &[Column],
        answers: &[(&str, Kind)],
        row: &Row,
    ) -> Vec<Cell> {
        let varied = values
            .into_iter()
            .zip(columns)
            .map(|(value, column)| match column.kind {
                Kind::Text => Cell::Text(value),
                _ => si(&value).map_or(Cell::Absent, Cell::Number),
            });
        let samples = self.samples.count;
        let sample = (samples > 0).then(|| Cell::Count((row.index % samples) as u64));
        let fields = serde_json::json!(row.outcome.as_ref().ok());
        let answer = answers.iter().map(|&(name, kind)| match kind {
            Kind::Count => fields[name].as_u64().map_or(Cell::Absent, Cell::Count),
            _ => fields[name].as_f64().map_or(Cell::Absent, Cell::Number),
        });
        let end = match &row.outcome {
            Ok(_) => [Cell::Text("ok".into()), Cell::Absent],
            Err(error) => ["error", error.message()].map(|text| Cell::Text(text.into())),
        };
        varied.chain(sample).chain(answer).chain(end).collect()
    }
}
