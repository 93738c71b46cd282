//! The columns of a table, and the cells of its rows.

use serde_json::{Map, Value};

use super::axis::Axis;
use super::distribution::ID;
use super::grid::Sweep;
use super::numbers::si;
use super::point::Row;
use crate::Units;
use crate::answer::si_of_field;
use crate::scene::{Unit, si_unit};

/// Columns of an answer, by the names of its fields.
const ANSWER: [&str; 8] = [
    "downstream_force_n",
    "upstream_force_n",
    "max_compression_n",
    "saturation_force_n",
    PASSES,
    "upstream_displacement_m",
    "downstream_displacement_m",
    "error_estimate",
];
/// Those of a cable that is heated, where the file says so.
const HEAT_ANSWER: [&str; 5] = [
    "downstream_max_n",
    "downstream_min_n",
    "upstream_max_n",
    "upstream_min_n",
    "drift_per_day_m",
];
/// Those of limits, where there are some.
const LIMITS: [&str; 2] = [EXCEEDED, "limit_reached_after_years"];
const EXCEEDED: &str = "limit_exceeded";
/// Columns of counts.
const PASSES: &str = "passes_to_95_percent";
const SAMPLE: &str = "sample";
/// Columns of texts at the end.
const STATUS: [&str; 2] = ["status", "error"];

/// The section of a scene that heats the cable.
const HEAT: &str = "heat";

/// A column of a sweep's table.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(not(feature = "xlsx"), allow(dead_code, reason = "CSV shows no units"))]
pub struct AnswerColumn {
    /// Its name: a key, or a field of [`Answer`](super::Answer).
    pub name: String,
    /// A value a row, in SI.
    pub values: AnswerValues,
    /// Name for a reader of a workbook, and the unit there.
    pub(super) heading: (String, &'static str),
    /// That unit, if it is not SI.
    pub(super) unit: Option<Unit>,
}

/// The values of a column; `None` where a row has none.
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
    pub(super) fn push(&mut self, cell: &Value) {
        match &mut self.values {
            AnswerValues::Numbers(values) => values.push(cell.as_f64()),
            AnswerValues::Counts(values) => values.push(cell.as_u64()),
            AnswerValues::Flags(values) => values.push(cell.as_bool()),
            AnswerValues::Texts(values) => values.push(cell.as_str().map(str::to_owned)),
        }
    }
}

impl Sweep {
    /// The columns of its table, without rows.
    pub fn columns(&self) -> Vec<AnswerColumn> {
        let units = self.file_at(0).map(|file| Units::typed(&file, None, None));
        let units = units.unwrap_or_default();
        let column = |name: &str, values, typed: Option<Unit>| {
            let typed = typed.map(|unit| (name, unit)).or(units.of_field(name));
            let si = || si_unit(name).or(si_of_field(name).map(|(_, unit)| unit));
            let (shown, unit) = match typed {
                Some((shown, unit)) => (shown, unit.symbol()),
                None => (name, si().unwrap_or_default()),
            };
            AnswerColumn {
                name: name.to_owned(),
                values,
                heading: (shown.to_owned(), unit),
                unit: typed.map(|(_, unit)| unit),
            }
        };
        let numbers = || AnswerValues::Numbers(Vec::new());
        let counts = || AnswerValues::Counts(Vec::new());
        let texts = || AnswerValues::Texts(Vec::new());
        let varied = self.axes.iter().map(|axis| {
            let are_numbers = || {
                axis.values
                    .iter()
                    .all(|value| value.is_empty() || si(value).is_some())
            };
            // What is drawn is a number: a text beside it fails in its row.
            if axis.key != ID && (self.drawn_keys.contains(&axis.key) || are_numbers()) {
                column(&axis.key, numbers(), axis.unit())
            } else {
                column(&axis.key, texts(), None)
            }
        });
        let sample = (self.samples.count > 0).then_some(SAMPLE);
        let sets_heat = |axis: &Axis| axis.key == HEAT || axis.key.starts_with("heat.");
        let is_heated = self.file.locate(HEAT).is_some() || self.axes.iter().any(sets_heat);
        let heat = HEAT_ANSWER.into_iter().filter(|_| is_heated);
        let limits = LIMITS.into_iter().filter(|_| self.limits.is_some());
        let answer = sample.into_iter().chain(ANSWER).chain(heat).chain(limits);
        let answer = answer.map(|name| match name {
            PASSES | SAMPLE => column(name, counts(), None),
            EXCEEDED => column(name, AnswerValues::Flags(Vec::new()), None),
            _ => column(name, numbers(), None),
        });
        let status = STATUS.map(|name| column(name, texts(), None));
        varied.chain(answer).chain(status).collect()
    }

    /// The cells of a row: numbers, texts, or null where there is none.
    pub(super) fn cells(&self, row: &Row, columns: &[AnswerColumn]) -> Vec<Value> {
        let varied = self.values(row.index).into_iter().zip(columns);
        let mut cells: Vec<Value> = varied
            .map(|(value, column)| match column.values {
                AnswerValues::Texts(_) => Value::from(value),
                _ => si(&value).map_or(Value::Null, Value::from),
            })
            .collect();
        let mut fields = serde_json::json!(row.outcome.as_ref().ok());
        if self.samples.count > 0 {
            cells.push(Value::from(row.index % self.samples.count));
        }
        let answer = columns[cells.len()..columns.len() - STATUS.len()].iter();
        cells.extend(answer.map(|column| fields.get_mut(&column.name).map_or(Value::Null, Value::take)));
        cells.extend(match &row.outcome {
            Ok(_) => [Value::from("ok"), Value::Null],
            Err(error) => [Value::from("error"), Value::from(error.as_str())],
        });
        cells
    }
}

/// Whether a column holds a field of an answer.
fn is_answer(name: &str) -> bool {
    let all = [&ANSWER[..], &HEAT_ANSWER, &LIMITS];
    all.iter().any(|names| names.contains(&name))
}

/// The row of number `index` whose cells stand in a file; `None` for a record that is none.
pub fn row_of(index: usize, record: &csv::StringRecord, columns: &[AnswerColumn]) -> Option<Row> {
    let end = columns.len() - STATUS.len();
    let outcome = match record.get(end)? {
        "ok" => {
            let value = |text: &str| match (text.parse::<u64>(), text.parse::<bool>()) {
                (Ok(count), _) => Value::from(count),
                (_, Ok(flag)) => Value::from(flag),
                _ => text.parse::<f64>().map_or(Value::Null, Value::from),
            };
            let fields = columns[..end].iter().zip(record);
            let fields: Map<String, Value> = fields
                .filter(|(column, _)| is_answer(&column.name))
                .map(|(column, text)| (column.name.clone(), value(text)))
                .collect();
            Ok(serde_json::from_value(Value::from(fields)).ok()?)
        }
        "error" => Err(record.get(end + 1)?.to_owned()),
        _ => return None,
    };
    Some(Row { index, outcome })
}
