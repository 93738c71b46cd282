//! Rows as readings, each with its line.

use std::path::Path;

use creepage_tables::{Cell, Kind, Name, Row, Table};

use super::columns::{Columns, Values, columns};
use super::kinds::{DEFLECTION, FORCE, NAMES, POSITION, SIGMA, measured, si};
use super::list::Readings;
use super::options::ReadOptions;
use super::reading::{Place, Reading};
use super::{DataError, runs, time};

/// Rows from which on vehicles that only ever grow are taken for a running total: by chance one file in 120.
const TOTAL: usize = 5;
/// Most lines that a note names.
const MOST_LINES: usize = 8;
/// Most vehicles of a pass or a count.
const MOST: f64 = 1e15;
const WHOLE: &str = "a whole number, 0 for the reading before the first pass";

impl Readings {
    /// Reads the file at `path`, recognising how it is written.
    ///
    /// # Errors
    ///
    /// [`DataError`] with the first thing that is wrong, and its line.
    pub fn from_file(path: impl AsRef<Path>) -> Result<Self, DataError> {
        Self::from_file_with(path, &ReadOptions::default())
    }

    /// Reads the file at `path` as `options` say.
    ///
    /// # Errors
    ///
    /// As for [`Readings::from_file`].
    pub fn from_file_with(path: impl AsRef<Path>, options: &ReadOptions) -> Result<Self, DataError> {
        read(Table::from_file(path.as_ref(), &options.table, &NAMES)?, options)
    }

    /// Reads a table from `bytes`, recognising how it is written; `file` stands for it in errors.
    ///
    /// # Errors
    ///
    /// As for [`Readings::from_file`].
    pub fn from_csv(file: &str, bytes: &[u8]) -> Result<Self, DataError> {
        Self::from_bytes(file, bytes, &ReadOptions::default())
    }

    /// Reads a table or a workbook from `bytes` as `options` say; `file` stands for it in errors.
    ///
    /// # Errors
    ///
    /// As for [`Readings::from_file`].
    pub fn from_bytes(file: &str, bytes: &[u8], options: &ReadOptions) -> Result<Self, DataError> {
        read(Table::read(file, bytes, &options.table, &NAMES)?, options)
    }
}

/// The readings in `table`.
fn read(mut table: Table, options: &ReadOptions) -> Result<Readings, DataError> {
    // What is said of forces holds for their deviations.
    let is_of_force = |name: &&mut Name| {
        name.kind == Some(SIGMA)
            && name
                .unit
                .as_ref()
                .is_some_and(|unit| si(FORCE, "1", unit).is_some())
    };
    if options.table.unit.is_some() {
        table
            .names
            .iter_mut()
            .filter(is_of_force)
            .for_each(|name| name.unit.clone_from(&options.table.unit));
    }
    let columns = columns(&table, options)?;
    let of_values = columns
        .values
        .iter()
        .flat_map(|value| [Some(value.column), value.sigma]);
    let others = [columns.pass, columns.vehicles, columns.position];
    let numbers: Vec<usize> = of_values.chain(others).flatten().collect();
    table.decide(&numbers)?;
    let reader = Reader {
        table: &table,
        columns: &columns,
        options,
    };
    if let Some(column) = columns.time {
        time::check_order(&table, column, columns.run)?;
    }
    reader.refuse_totals()?;
    let mut list: Vec<Reading> = Vec::new();
    // Lines without a value, and what stands there; names of the runs, and the vehicles of each so far.
    let mut left_out: Vec<(u64, &str)> = Vec::new();
    let mut runs: Vec<String> = Vec::new();
    let mut counted: Vec<u64> = Vec::new();
    for row in &table.rows {
        let label = columns.run.map_or("", |column| row.cell(column));
        let run = runs.iter().position(|other| other == label).unwrap_or(runs.len());
        if run == runs.len() {
            runs.push(label.to_owned());
            counted.push(0);
        }
        if let Some(column) = columns.vehicles.filter(|&column| !row.cell(column).is_empty()) {
            counted[run] = counted[run].saturating_add(reader.whole(row, column)?);
        }
        for value in &columns.values {
            match table.cell(row, value.column)? {
                Cell::Blank => left_out.push((row.line, "")),
                Cell::NoValue(text) => left_out.push((row.line, text)),
                Cell::Number(..) => list.push(Reading {
                    run,
                    ..reader.reading(row, value, counted[run])?
                }),
            }
        }
    }
    let first = columns.values.first().map_or(FORCE, |value| value.kind);
    check(&table, &columns, &list, &left_out)?;
    let mut notes = Vec::new();
    let of_kind = format!("rows without a {}", measured(first, Place::Natural).name());
    for (is_blank, what) in [(true, &*of_kind), (false, "cells without a number")] {
        let cells: Vec<_> = left_out
            .iter()
            .filter(|(_, text)| text.is_empty() == is_blank)
            .collect();
        let shown = |(line, text): &&(u64, &str)| {
            if is_blank {
                format!("line {line}")
            } else {
                format!("line {line} (\"{text}\")")
            }
        };
        let lines: Vec<String> = cells.iter().take(MOST_LINES).map(shown).collect();
        let more = if cells.len() > MOST_LINES { ", …" } else { "" };
        if !cells.is_empty() {
            notes.push(format!(
                "{} {what} were left out: {}{more}",
                cells.len(),
                lines.join(", ")
            ));
        }
    }
    if columns.run.or(columns.vehicles).is_none() {
        runs = runs::split_where_passes_begin_anew(&mut list, &mut notes);
    }
    runs::count_from_rest(&mut list, options.run_start, &mut notes);
    notes.extend(too_small(&table, &columns, &list));
    Ok(Readings {
        skipped: left_out.len(),
        file: table.file.clone(),
        list,
        runs,
        notes,
    })
}

/// Refuses what are no readings as a whole.
fn check(
    table: &Table,
    columns: &Columns,
    list: &[Reading],
    left_out: &[(u64, &str)],
) -> Result<(), DataError> {
    let no_value = left_out.iter().find(|(_, text)| !text.is_empty());
    let Some(first) = list.first() else {
        let Some((line, text)) = no_value else {
            return Err(DataError::Empty(table.file.clone()));
        };
        let name = &table.names[columns.values[0].column].text;
        let found = format!("{name}: found \"{text}\", and no number anywhere");
        return Err(table.wrong(*line, found, "a finite number"));
    };
    if list.iter().all(|reading| reading.pass == 0) {
        return Err(table.wrong(
            first.line,
            "pass: found \"0\" alone",
            "readings after at least one pass",
        ));
    }
    let bare = list.iter().find(|reading| reading.sigma.is_none());
    match bare.filter(|_| list.iter().any(|reading| reading.sigma.is_some())) {
        Some(bare) => Err(table.wrong(
            bare.line,
            "sigma_n is blank, but given for other readings",
            "all or none",
        )),
        None => Ok(()),
    }
}

/// A note where forces without a unit look like kilonewtons.
fn too_small(table: &Table, columns: &Columns, list: &[Reading]) -> Option<String> {
    let mut names = columns
        .values
        .iter()
        .filter(|value| value.kind == FORCE)
        .map(|value| &table.names[value.column]);
    let bare = names.find(|name| name.unit.is_none())?;
    let force = measured(FORCE, Place::Natural);
    let forces = list.iter().filter(|reading| reading.measured.is_like(force));
    let largest = forces.map(|reading| reading.value.abs()).fold(0.0, f64::max);
    (largest > 0.0 && largest < 10.0).then(|| {
        format!(
            "column {} names no unit and was read as newtons, at most {largest:.3} N: it looks like kN (--unit kN)",
            bare.text
        )
    })
}

struct Reader<'a> {
    table: &'a Table,
    columns: &'a Columns,
    options: &'a ReadOptions,
}

impl Reader<'_> {
    /// Refuses vehicles that may be a running total, unless their column was chosen.
    fn refuse_totals(&self) -> Result<(), DataError> {
        let rows = &self.table.rows;
        let column = self
            .columns
            .vehicles
            .filter(|&column| !self.table.names[column].chosen);
        let counts = column.map(|column| rows.iter().filter_map(move |row| self.whole(row, column).ok()));
        let counts: Vec<u64> = counts.into_iter().flatten().collect();
        if counts.len() < TOTAL || counts.windows(2).any(|pair| pair[1] <= pair[0]) {
            return Ok(());
        }
        let found = "vehicles that grow from row to row: a running total, or vehicles since the row before";
        let allowed = "either: --column-pass NAME takes a total, --column-vehicles NAME takes those since the row before";
        Err(self.table.wrong(rows[0].line, found, allowed))
    }

    /// A value of a row; `counted` vehicles have passed in its run.
    fn reading(&self, row: &Row, value: &Values, counted: u64) -> Result<Reading, DataError> {
        let (table, columns) = (self.table, self.columns);
        let pass = columns
            .pass
            .map_or(Ok(counted), |column| self.whole(row, column))?;
        let at = match columns.position.filter(|&column| !row.cell(column).is_empty()) {
            Some(_) if value.kind == DEFLECTION => {
                let allowed = "deflections without a place: they are that of the duct under the first vehicle, wherever it is";
                return Err(table.wrong(row.line, "a place beside a deflection", allowed));
            }
            Some(column) => Place::At(self.si(row, column, POSITION, "", "metres from the upstream end")?),
            None => value.end.map_or(Place::Natural, Place::End),
        };
        let allowed = "a finite number, with a unit if any";
        let of_instrument = self.si(row, value.column, value.kind, "", allowed)?;
        let is_tension = self.options.tension_positive && value.kind == FORCE;
        // Its own unit, or that of the value.
        let unit = table.names[value.column].unit.as_deref().unwrap_or("");
        let allowed = "a finite, positive number";
        let sigma = value.sigma.filter(|&column| !row.cell(column).is_empty());
        let sigma = sigma.map(|column| match self.si(row, column, value.kind, unit, allowed)? {
            sigma if sigma > 0.0 => Ok(sigma),
            _ => Err(table.wrong_cell(row, column, allowed)),
        });
        Ok(Reading {
            pass,
            passes: pass,
            measured: measured(value.kind, at),
            value: if is_tension { -of_instrument } else { of_instrument },
            sigma: sigma.transpose()?,
            run: 0,
            line: row.line,
        })
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

    /// The number of a cell in SI, by its own unit, that of its column, or else this one.
    fn si(&self, row: &Row, column: usize, kind: Kind, unit: &str, allowed: &str) -> Result<f64, DataError> {
        let quantity = self.table.quantity(row, column);
        let value =
            quantity.and_then(|(digits, own)| si(kind, &digits, if own.is_empty() { unit } else { own }));
        value.ok_or_else(|| self.table.wrong_cell(row, column, allowed))
    }
}
