//! Rows as readings, each with its line.

use creepage_tables::{Cell, Row, Table};

use super::DataError;
use super::columns::{Columns, Values, columns};
use super::options::ReadOptions;
use super::reading::{Place, Reading};
use super::role::Role;
use super::{runs, time};

/// Rows from which on vehicles that only ever grow are taken for a running total: by chance one file in 120.
const TOTAL: usize = 5;
/// Most lines that a note names.
const MOST_LINES: usize = 8;
/// Most vehicles of a pass or a count.
const MOST: f64 = 1e15;
const WHOLE: &str = "a whole number, 0 for the reading before the first pass";

/// What a table holds.
pub struct Found {
    pub readings: Vec<Reading>,
    /// Names of the runs.
    pub runs: Vec<String>,
    /// Rows without a value.
    pub skipped: usize,
    /// What the user should know of how the file was read.
    pub notes: Vec<String>,
}

/// The readings in `table`.
pub fn read(table: &mut Table, options: &ReadOptions) -> Result<Found, DataError> {
    let columns = columns(table, options)?;
    let Columns {
        pass,
        vehicles,
        run,
        position,
        ..
    } = columns;
    let values = columns
        .values
        .iter()
        .flat_map(|value| [Some(value.column), value.sigma]);
    let numbers: Vec<usize> = values.chain([pass, vehicles, position]).flatten().collect();
    table.decide(&numbers)?;
    let mut reader = Reader {
        table,
        columns: &columns,
        options,
        blank: Vec::new(),
        unusable: Vec::new(),
    };
    if let Some(column) = columns.time {
        time::check_order(table, column, run)?;
    }
    if let (Some(column), None) = (vehicles, &options.columns.vehicles) {
        reader.refuse_totals(column)?;
    }
    let mut readings = Vec::new();
    // Names of the runs, and the vehicles of each so far.
    let mut labels: Vec<(String, u64)> = Vec::new();
    for row in &table.rows {
        let label = run.map_or("", |column| row.cell(column));
        let of_row = labels
            .iter()
            .position(|(other, _)| other == label)
            .unwrap_or_else(|| {
                labels.push((label.to_owned(), 0));
                labels.len() - 1
            });
        readings.extend(reader.readings(row, of_row, &mut labels[of_row].1)?);
    }
    let Reader { blank, unusable, .. } = reader;
    let name = |value: &Values| &table.names[value.column].text;
    if let (true, Some((line, text))) = (readings.is_empty(), unusable.first()) {
        let found = format!(
            "{}: found \"{text}\", and no number anywhere",
            name(&columns.values[0])
        );
        return Err(table.wrong(*line, found, "a finite number"));
    }
    let mut notes = Vec::new();
    let list = |count: usize, what: &str, lines: &mut dyn Iterator<Item = String>| {
        let lines: Vec<String> = lines.take(MOST_LINES).collect();
        let more = if count > MOST_LINES { ", …" } else { "" };
        format!(
            "{count} {what} were left out: line {}{more}",
            lines.join(", line ")
        )
    };
    if !blank.is_empty() {
        let what = format!(
            "rows without a {}",
            columns.values[0].role.measured(Place::Natural).name()
        );
        notes.push(list(blank.len(), &what, &mut blank.iter().map(u64::to_string)));
    }
    if !unusable.is_empty() {
        let shown = |(line, text): &(u64, String)| format!("{line} (\"{text}\")");
        notes.push(list(
            unusable.len(),
            "cells without a number",
            &mut unusable.iter().map(shown),
        ));
    }
    let mut labels: Vec<String> = labels.into_iter().map(|(label, _)| label).collect();
    if run.is_none() && vehicles.is_none() {
        labels = runs::split_where_passes_begin_anew(&mut readings, &mut notes);
    }
    runs::count_from_rest(&mut readings, labels.len(), options.run_start, &mut notes);
    let is_bare = |value: &&Values| {
        value.role == Role::Force && options.unit.is_none() && table.names[value.column].unit.is_none()
    };
    if let Some(bare) = columns.values.iter().find(is_bare) {
        let force = bare.role.measured(Place::Natural);
        let forces = readings.iter().filter(|reading| reading.measured.is_like(force));
        let largest = forces.map(|reading| reading.value.abs()).fold(0.0, f64::max);
        if largest > 0.0 && largest < 10.0 {
            notes.push(format!(
                "column {} names no unit and was read as newtons, at most {largest:.3} N: it looks like kN (--unit kN)",
                name(bare)
            ));
        }
    }
    Ok(Found {
        readings,
        runs: labels,
        skipped: blank.len() + unusable.len(),
        notes,
    })
}

struct Reader<'a> {
    table: &'a Table,
    columns: &'a Columns,
    options: &'a ReadOptions,
    /// Lines without a value.
    blank: Vec<u64>,
    /// Lines with a cell that is no number, and that cell.
    unusable: Vec<(u64, String)>,
}

impl Reader<'_> {
    fn refuse_totals(&self, column: usize) -> Result<(), DataError> {
        let rows = &self.table.rows;
        let counts = rows.iter().filter_map(|row| self.whole(row, column).ok());
        let counts: Vec<u64> = counts.collect();
        if counts.len() < TOTAL || counts.windows(2).any(|pair| pair[1] <= pair[0]) {
            return Ok(());
        }
        Err(self.table.wrong(
            rows[0].line,
            "vehicles that grow from row to row: a running total, or vehicles since the row before".into(),
            "either: --column-pass NAME takes a total, --column-vehicles NAME takes those since the row before",
        ))
    }

    /// The readings of a row; `counted` vehicles have passed in its run.
    fn readings(&mut self, row: &Row, run: usize, counted: &mut u64) -> Result<Vec<Reading>, DataError> {
        let columns = self.columns;
        if let Some(column) = columns.vehicles {
            let vehicles = if row.cell(column).is_empty() {
                0
            } else {
                self.whole(row, column)?
            };
            *counted = counted.saturating_add(vehicles);
        }
        let mut readings = Vec::new();
        for value in &columns.values {
            match self.table.cell(row, value.column)? {
                Cell::Blank => self.blank.push(row.line),
                Cell::NoValue(text) => self.unusable.push((row.line, text.to_owned())),
                Cell::Number(..) => {
                    let pass = columns
                        .pass
                        .map_or(Ok(*counted), |column| self.whole(row, column))?;
                    let at = match columns.position.filter(|column| !row.cell(*column).is_empty()) {
                        Some(column) => Place::At(self.si(
                            row,
                            column,
                            Role::Position,
                            column,
                            "metres from the upstream end",
                        )?),
                        None => value.end.map_or(Place::Natural, Place::End),
                    };
                    let is_tension = self.options.tension_positive && value.role == Role::Force;
                    let si = self.si(
                        row,
                        value.column,
                        value.role,
                        value.column,
                        "a finite number, with a unit if any",
                    )?;
                    readings.push(Reading {
                        pass,
                        passes: pass,
                        measured: value.role.measured(at),
                        value: if is_tension { -si } else { si },
                        sigma: self.sigma(row, value)?,
                        run,
                        line: row.line,
                    });
                }
            }
        }
        Ok(readings)
    }

    /// "12.0" is what a spreadsheet makes of 12.
    fn whole(&self, row: &Row, column: usize) -> Result<u64, DataError> {
        match self.table.cell(row, column) {
            Ok(Cell::Number(value, "")) if value.fract() == 0.0 && (0.0..=MOST).contains(&value) => {
                Ok(value as u64)
            }
            _ => Err(self.table.wrong_cell(row, column, WHOLE)),
        }
    }

    fn sigma(&self, row: &Row, value: &Values) -> Result<Option<f64>, DataError> {
        let Some(column) = value.sigma.filter(|column| !row.cell(*column).is_empty()) else {
            return Ok(None);
        };
        let allowed = "a finite, positive number";
        // Its own unit, or that of the value.
        let of_value = self.table.names[column].unit.is_none()
            || self.options.unit.is_some() && value.role == Role::Force;
        let unit_of = if of_value { value.column } else { column };
        let sigma = self.si(row, column, value.role, unit_of, allowed)?;
        if sigma > 0.0 {
            Ok(Some(sigma))
        } else {
            Err(self.table.wrong_cell(row, column, allowed))
        }
    }

    /// The number of a cell in SI, by its own unit or that of the column `unit_of`.
    fn si(
        &self,
        row: &Row,
        column: usize,
        role: Role,
        unit_of: usize,
        allowed: &'static str,
    ) -> Result<f64, DataError> {
        let wrong = || self.table.wrong_cell(row, column, allowed);
        let Ok(Cell::Number(value, unit)) = self.table.cell(row, column) else {
            return Err(wrong());
        };
        let told = self.options.unit.as_deref().filter(|_| role == Role::Force);
        let unit = if unit.is_empty() {
            told.or(self.table.names[unit_of].unit.as_deref())
        } else {
            Some(unit)
        };
        let factor = unit
            .map_or(Some(1.0), |unit| role.factor(unit))
            .ok_or_else(wrong)?;
        // Divided where the factor is a negative power of ten, so that 35.7 um is 35.7e-6.
        let inverse = (1.0 / factor).round();
        let is_inverse = factor < 1.0 && (inverse * factor - 1.0).abs() < 1e-12;
        let si = if is_inverse {
            value / inverse
        } else {
            value * factor
        };
        if si.is_finite() { Ok(si) } else { Err(wrong()) }
    }
}
