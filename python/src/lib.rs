//! The native module of the Python package `creepage`: each function takes a scene as text and calls the Rust library, without the GIL.

mod arrow;
mod call;
mod failure;
mod reading;

use std::collections::BTreeSet;
use std::path::PathBuf;

use creepage::calibration::{Loss, Unknown};
use creepage::report::{Report, ReportOptions};
use creepage::sweep::{AnswerValues, Samples, Sweep, SweepOptions};
use creepage::{CalibrateOptions, Readings, RunOptions, SavedState, SceneFile, Series};
use pyo3::prelude::*;
use pyo3::types::PyAny;

use arrow::Table;
use call::{Call, watched};
use failure::Failure;

/// A scene: the name that errors give it, its text, and what is set on top.
#[derive(FromPyObject)]
struct Source(String, String, Vec<String>);

impl Source {
    fn file(&self) -> Result<SceneFile, Failure> {
        let Self(name, text, overrides) = self;
        Ok(SceneFile::from_toml(name, text)?.with(overrides)?)
    }
}

/// A table of readings: the name that errors give it, its bytes, and how they are to be read.
#[derive(FromPyObject)]
struct Written(String, Vec<u8>, Vec<(String, String)>);

fn json(answer: &impl serde::Serialize) -> Result<String, Failure> {
    serde_json::to_string(answer).map_err(|error| Failure::computation(&error))
}

/// What looks like a slip in the scene, before the warnings of an answer, as the command line tells them.
fn with_slips(file: &SceneFile, warnings: &mut Vec<String>) {
    let slips = file.slips().into_iter();
    warnings.splice(
        0..0,
        slips.map(|(location, words)| format!("{location}: {words}")),
    );
}

/// The JSON Schema of a scene, as JSON.
#[pyfunction]
fn schema() -> String {
    creepage::scene::schema().to_string()
}

/// The run of a scene and the state that it leaves as JSON; it begins with the state of another run, if there is one.
#[pyfunction]
fn run(
    py: Python<'_>,
    scene: Source,
    verify: bool,
    state: Option<String>,
    call: Call,
) -> PyResult<(String, String)> {
    watched(py, call, |progress| {
        let file = scene.file()?;
        let start = state
            .as_deref()
            .map(serde_json::from_str::<SavedState>)
            .transpose();
        let start = start
            .map_err(|error| Failure::argument(format!("from_state is not the state of a run: {error}")))?;
        let options = RunOptions {
            verify,
            start: start.as_ref(),
            progress,
            ..RunOptions::default()
        };
        let run = creepage::run_with(&file.scene()?, &options);
        let mut run = run.map_err(|error| error.located(&file))?;
        with_slips(&file, &mut run.warnings);
        Ok((json(&run)?, json(&run.state)?))
    })
}

/// The report of a scene as a page of HTML.
#[pyfunction]
fn report(py: Python<'_>, scene: Source, call: Call) -> PyResult<String> {
    watched(py, call, |progress| {
        let file = scene.file()?;
        let options = ReportOptions {
            progress,
            ..ReportOptions::default()
        };
        let report = Report::new(&file.scene()?, &options).map_err(|error| error.located(&file))?;
        Ok(report.to_html())
    })
}

/// A row a duct, computed: the table of the command `sweep --rows`. The rows may be a part of a table which draws the keys `drawn`.
#[pyfunction]
fn sweep(
    py: Python<'_>,
    scene: Source,
    rows: &Bound<'_, PyAny>,
    samples: usize,
    seed: u64,
    drawn: Option<Vec<String>>,
    call: Call,
) -> PyResult<Table> {
    let rows = arrow::columns(py, rows)?;
    let samples = Samples { count: samples, seed };
    watched(py, call, |progress| {
        let options = SweepOptions {
            progress,
            ..SweepOptions::default()
        };
        let file = scene.file()?;
        let sweep = match drawn {
            None => Sweep::of_table(file, rows, samples)?,
            Some(drawn) => Sweep::of_part(file, rows, samples, drawn)?,
        };
        let columns = sweep.answers(&options)?;
        Table::of(columns.into_iter().map(|column| (column.name, column.values)))
    })
}

/// The columns of the table of a part without rows, the keys that it draws and the files that it names, once all keys and distributions
/// are checked.
#[pyfunction]
fn heads(
    py: Python<'_>,
    scene: Source,
    rows: &Bound<'_, PyAny>,
    samples: usize,
) -> PyResult<(Table, BTreeSet<String>, BTreeSet<PathBuf>)> {
    let rows = arrow::columns(py, rows)?;
    let samples = Samples {
        count: samples,
        seed: 0,
    };
    watched(py, Call::default(), |_| {
        let sweep = Sweep::of_part(scene.file()?, rows, samples, [])?;
        let columns = sweep.columns().into_iter();
        Ok((
            Table::of(columns.map(|column| (column.name, column.values)))?,
            sweep.drawn_keys().clone(),
            sweep.files(),
        ))
    })
}

/// The names of columns, and their cells as they would be typed.
#[pyfunction]
fn texts(py: Python<'_>, rows: &Bound<'_, PyAny>) -> PyResult<(Vec<String>, Vec<Vec<String>>)> {
    Ok(arrow::columns(py, rows)?.into_iter().unzip())
}

/// The table of ducts in a file, as the command `sweep --rows` reads it.
#[pyfunction]
fn read_rows(py: Python<'_>, file: PathBuf) -> PyResult<Table> {
    watched(py, Call::default(), |_| {
        let columns = creepage::sweep::read_rows(&file, &creepage::readings::TableOptions::default())?;
        let texts = |cells: Vec<String>| AnswerValues::Texts(cells.into_iter().map(Some).collect());
        Table::of(columns.into_iter().map(|(name, cells)| (name, texts(cells))))
    })
}

/// Parameters fitted to readings, as JSON. The readings are the bytes of a table in whatever form the command line reads.
#[pyfunction]
fn calibrate(
    py: Python<'_>,
    scene: Source,
    readings: Written,
    fit: Vec<String>,
    robust: bool,
    call: Call,
) -> PyResult<String> {
    watched(py, call, |progress| {
        let file = scene.file()?;
        let Written(name, bytes, read) = readings;
        let readings = Readings::from_bytes(&name, &bytes, &reading::options(read)?);
        let readings = readings.map_err(creepage::Error::from)?;
        let unknown = |name: &String| name.parse::<Unknown>().map_err(Failure::argument);
        let options = CalibrateOptions {
            unknowns: fit.iter().map(unknown).collect::<Result<_, _>>()?,
            loss: if robust { Loss::Tukey } else { Loss::Squares },
            progress,
            ..CalibrateOptions::default()
        };
        let scene = file.scene()?;
        let series = Series {
            scene: &scene,
            readings: &readings,
        };
        let fitted = creepage::calibrate_jointly(&[series], &options);
        let mut fitted = fitted.map_err(|error| error.located(&file))?;
        with_slips(&file, &mut fitted.warnings);
        json(&fitted)
    })
}

#[pymodule]
fn _creepage(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<Table>()?;
    module.add_function(wrap_pyfunction!(schema, module)?)?;
    module.add_function(wrap_pyfunction!(run, module)?)?;
    module.add_function(wrap_pyfunction!(report, module)?)?;
    module.add_function(wrap_pyfunction!(sweep, module)?)?;
    module.add_function(wrap_pyfunction!(heads, module)?)?;
    module.add_function(wrap_pyfunction!(texts, module)?)?;
    module.add_function(wrap_pyfunction!(read_rows, module)?)?;
    module.add_function(wrap_pyfunction!(calibrate, module)?)?;
    module.add("__version__", env!("CARGO_PKG_VERSION"))
}
