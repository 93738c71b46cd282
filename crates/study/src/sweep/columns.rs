//! The columns of a table: what each is called, and what its cells say of a point.

use csv::StringRecord;

use super::axis::Axis;
use super::distribution::ID;
use super::grid::Sweep;
use super::numbers::si;
use creepage_run::{DayExtremes, PassRecord, Run, Units, Verdict};
use creepage_scene::Unit;

/// A row of the table, as it stands in CSV: numbers in SI, and nothing if there is none.
pub type Row = StringRecord;

/// What there is to say of a point.
#[derive(Clone, Copy)]
pub struct Answer<'a> {
    pub run: &'a Run,
    pub last: &'a PassRecord,
    /// Those of the sweep's limits.
    pub verdicts: &'a [Verdict],
}

/// A column of the answer: its name, what it holds, and the text of its cell, `None` if that is
/// empty.
type Field = (
    &'static str,
    AnswerValues,
    for<'a> fn(&Answer<'a>) -> Option<String>,
);

const NUMBERS: AnswerValues = AnswerValues::Numbers(Vec::new());
const COUNTS: AnswerValues = AnswerValues::Counts(Vec::new());
const FLAGS: AnswerValues = AnswerValues::Flags(Vec::new());
const TEXTS: AnswerValues = AnswerValues::Texts(Vec::new());

/// The column that says why a row has no answer.
const ERROR: &str = "error";

/// Columns of every answer, after the last pass.
#[rustfmt::skip]
const ANSWER: [Field; 8] = [
    ("downstream_force_n", NUMBERS, |of| Some(of.last.downstream_force_n.to_string())),
    ("upstream_force_n", NUMBERS, |of| Some(of.last.upstream_force_n.to_string())),
    ("max_compression_n", NUMBERS, |of| Some(of.last.max_compression_n.to_string())),
    ("saturation_force_n", NUMBERS, |of| Some(of.run.saturation?.force_n.to_string())),
    ("passes_to_95_percent", COUNTS, |of| Some(of.run.saturation?.passes_to_95_percent.to_string())),
    ("upstream_displacement_m", NUMBERS, |of| Some(of.last.upstream_displacement_m.to_string())),
    ("downstream_displacement_m", NUMBERS, |of| Some(of.last.downstream_displacement_m.to_string())),
    ("error_estimate", NUMBERS, |of| Some(of.run.error_estimate.relative.to_string())),
];
/// Those of a cable that is heated: forces over all days, and its movement from day to day in the
/// end, where days repeat but for that.
#[rustfmt::skip]
const HEAT_ANSWER: [Field; 5] = [
    ("downstream_max_n", NUMBERS, |of| Some(all_days(of)?.downstream_max_n.to_string())),
    ("downstream_min_n", NUMBERS, |of| Some(all_days(of)?.downstream_min_n.to_string())),
    ("upstream_max_n", NUMBERS, |of| Some(all_days(of)?.upstream_max_n.to_string())),
    ("upstream_min_n", NUMBERS, |of| Some(all_days(of)?.upstream_min_n.to_string())),
    ("drift_per_day_m", NUMBERS, |of| Some(of.run.heat.as_ref()?.drift_per_day_m?.to_string())),
];
/// Those of limits: whether any is exceeded, and when the first of them is.
const LIMITS: [Field; 2] = [
    ("limit_exceeded", FLAGS, |of| {
        Some(of.verdicts.iter().any(Verdict::is_exceeded).to_string())
    }),
    ("limit_reached_after_years", NUMBERS, |of| {
        let verdicts = of.verdicts.iter();
        let years = verdicts.filter_map(|verdict| verdict.reached_after?.years);
        Some(years.min_by(f64::total_cmp)?.to_string())
    }),
];

fn all_days<'a>(of: &Answer<'a>) -> Option<&'a DayExtremes> {
    Some(&of.run.heat.as_ref()?.all_days)
}

/// The section of a scene that heats the cable.
const HEAT: &str = "heat";

/// A column of a sweep's table.
#[derive(Debug, Clone)]
pub struct AnswerColumn {
    /// Its name: a key, or what it says of the run.
    pub name: String,
    /// A value a row, in SI.
    pub values: AnswerValues,
    /// Its unit in a workbook, if that is not SI.
    pub(super) unit: Option<Unit>,
}

/// The values of a column; `None` if a row has none.
#[derive(Debug, Clone, PartialEq)]
pub enum AnswerValues {
    /// Numbers in SI.
    Numbers(Vec<Option<f64>>),
    /// Counts.
    Counts(Vec<Option<u64>>),
    /// Yes or no.
    Flags(Vec<Option<bool>>),
    /// Texts.
    Texts(Vec<Option<String>>),
}

impl AnswerColumn {
    /// Adds a cell; of another kind it is none.
    pub(super) fn push(&mut self, cell: &str) {
        match &mut self.values {
            AnswerValues::Numbers(values) => values.push(cell.parse().ok()),
            AnswerValues::Counts(values) => values.push(cell.parse().ok()),
            AnswerValues::Flags(values) => values.push(cell.parse().ok()),
            AnswerValues::Texts(values) => {
                let is_there = !cell.is_empty() || self.name != ERROR;
                values.push(is_there.then(|| cell.to_owned()));
            }
        }
    }
}

impl Sweep {
    /// What its table says of a run.
    fn fields(&self) -> impl Iterator<Item = Field> {
        let sets_heat = |axis: &Axis| axis.key == HEAT || axis.key.starts_with("heat.");
        let is_heated = self.file.locate(HEAT).is_some() || self.axes.iter().any(sets_heat);
        let heat = HEAT_ANSWER.into_iter().filter(move |_| is_heated);
        let limits = LIMITS.into_iter().filter(|_| self.limits.is_some());
        ANSWER.into_iter().chain(heat).chain(limits)
    }

    /// The columns of its table, without rows.
    pub fn columns(&self) -> Vec<AnswerColumn> {
        let units = self.file_at(0).map(|file| Units::typed(&file, None, None));
        let units = units.unwrap_or_default();
        let column = |name: &str, values, typed: Option<Unit>| AnswerColumn {
            name: name.to_owned(),
            values,
            unit: typed.or(units.of_field(name).map(|(_, unit)| unit)),
        };
        let varied = self.axes.iter().map(|axis| {
            let mut values = axis.values.iter().filter(|value| !value.is_empty());
            // What is drawn is a number: a text among them fails in its row.
            let is_drawn = self.drawn_keys.contains(&axis.key);
            if axis.key != ID && (is_drawn || values.all(|value| si(value).is_some())) {
                column(&axis.key, NUMBERS, axis.unit())
            } else {
                column(&axis.key, TEXTS, None)
            }
        });
        let sample = (self.samples.count > 0).then(|| column("sample", COUNTS, None));
        let fields = self.fields().map(|(name, values, _)| column(name, values, None));
        let status = ["status", ERROR].map(|name| column(name, TEXTS, None));
        varied.chain(sample).chain(fields).chain(status).collect()
    }

    /// The row of a point with its answer, or why there is none.
    pub(super) fn row(
        &self,
        index: usize,
        answer: Result<Answer<'_>, &str>,
        columns: &[AnswerColumn],
    ) -> Row {
        let varied = self.values(index).into_iter().zip(columns);
        let varied = varied.map(|(value, column)| match column.values {
            AnswerValues::Texts(_) => Some(value),
            _ => Some(si(&value)?.to_string()),
        });
        let sample = (self.samples.count > 0).then(|| Some((index % self.samples.count).to_string()));
        let fields = self.fields().map(|(.., cell)| cell(&answer.ok()?));
        let status = match answer {
            Ok(_) => [Some("ok".to_owned()), None],
            Err(error) => [Some("error".to_owned()), Some(error.to_owned())],
        };
        let cells = varied.chain(sample).chain(fields).chain(status);
        cells.map(Option::unwrap_or_default).collect()
    }
}

/// Why a row has no answer, if it has none: what its last cell says.
pub fn error_of(row: &Row) -> Option<&str> {
    let error = row.get(row.len().checked_sub(1)?);
    error.filter(|error| !error.is_empty())
}

/// The numbers of the column of this `name`, one a row.
pub fn numbers(name: &str, columns: &[AnswerColumn], rows: &[Row]) -> Vec<Option<f64>> {
    let place = columns.iter().position(|column| column.name == name);
    let number = |row: &Row| row.get(place?)?.parse().ok();
    rows.iter().map(number).collect()
}
