//! The columns of a table and the cells of its rows.

use super::axis::{Axis, AxisValues};
use super::grid::Sweep;
use super::list;
use super::numbers::si;
use super::row::Row;
use super::sink::{Cell, Column, Kind};
use crate::Units;
use crate::answer::si_of_field;
use crate::scene::si_unit;

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

/// The section of a scene that heats the cable.
const HEAT: &str = "heat";

impl Sweep {
    /// The columns of an answer.
    pub(super) fn answer_columns(&self) -> impl Iterator<Item = (&'static str, Kind)> {
        let sets = |axis: &Axis| axis.key == HEAT || axis.key.starts_with("heat.");
        let is_heated = self.file.locate(HEAT).is_some() || self.axes.iter().any(sets);
        let heat = HEAT_COLUMNS.into_iter().filter(move |_| is_heated);
        COLUMNS.into_iter().chain(heat)
    }

    pub(super) fn columns(&self) -> Vec<Column> {
        let units = self.file_at(0).map(|file| Units::typed(&file, None, None));
        let units = units.unwrap_or_default();
        let column = |name: &str, kind| Column {
            unit: si_unit(name).or(si_of_field(name).map(|(_, unit)| unit)),
            shown: units.of_field(name).map(|(name, unit)| (name.to_owned(), unit)),
            name: name.to_owned(),
            kind,
        };

        let varied = self.axes.iter().map(|axis| match &axis.values {
            _ if axis.key == list::ID => column(&axis.key, Kind::Text),
            // What is drawn is a number: a text beside it fails in its row.
            AxisValues::List(list)
                if !self.drawn_keys.contains(&axis.key) && !list.iter().all(|value| is_number(value)) =>
            {
                column(&axis.key, Kind::Text)
            }
            _ => Column {
                shown: axis.unit().map(|unit| (axis.key.clone(), unit)),
                ..column(&axis.key, Kind::Number)
            },
        });
        let sample = (self.samples.count > 0).then(|| column("sample", Kind::Count));
        let answer = self.answer_columns().map(|(name, kind)| column(name, kind));
        let end = ["status", "error"].map(|name| column(name, Kind::Text));
        varied.chain(sample).chain(answer).chain(end).collect()
    }

    pub(super) fn cells(
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

/// Whether a cell stands for a number, or for none.
fn is_number(cell: &str) -> bool {
    cell.is_empty() || si(cell).is_some()
}
