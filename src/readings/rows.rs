//! Rows as readings, each with its line.

use std::path::Path;

use creepage_tables::{Kind, Number, Row, Table};

use super::columns::{Columns, Values, columns};
use super::kinds::{DEFLECTION, FORCE, NAMES, POSITION, measured, si};
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
    let columns = columns(&table, options)?;
    let values = columns.values.iter();
    let of_values = values.flat_map(|value| [Some(value.column), value.sigma]);
    let numbers = of_values.chain([columns.pass, columns.vehicles, columns.position]);
    table.decide(&numbers.flatten().collect::<Vec<_>>())?;
    if let Some(column) = columns.time {
        time::check_order(&table, column, columns.run)?;
    }
    refuse_totals(&table, &columns)?;
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
            counted[run] = counted[run].saturating_add(whole(&table, row, column)?);
        }
        for value in &columns.values {
            if table.number(row, value.column)?.is_none() {
                left_out.push((row.line, row.cell(value.column)));
                continue;
            }
            let pass = columns
                .pass
                .map_or(Ok(counted[run]), |column| whole(&table, row, column))?;
            let is_tension = options.tension_positive && value.kind == FORCE;
            let allowed = "a finite number, with a unit if any";
            let si = si_of(&table, row, value.column, value.kind, value.column, allowed)?;
            list.push(Reading {
                pass,
                passes: pass,
                measured: measured(value.kind, place(&table, &columns, row, value)?),
                value: if is_tension { -si } else { si },
                sigma: sigma(&table, options, row, value)?,
                run,
                line: row.line,
            });
        }
    }
    let (blank, unusable): (Vec<_>, Vec<_>) = left_out.iter().partition(|(_, text)| text.is_empty());
    let first = &columns.values[0];
    check(&table, &table.names[first.column].text, &list, &unusable)?;
    let blanks = format!("rows without a {}", measured(first.kind, Place::Natural).name());
    let notes = [
        left_out_note(&blanks, &blank),
        left_out_note("cells without a number", &unusable),
    ];
    let mut notes: Vec<String> = notes.into_iter().flatten().collect();
    if columns.run.or(columns.vehicles).is_none() {
        runs = runs::split_where_passes_begin_anew(&mut list, &mut notes);
    }
    runs::count_from_rest(&mut list, options.run_start, &mut notes);
    notes.extend(too_small(&table, &columns, &list));
    let (file, skipped) = (table.file.clone(), left_out.len());
    Ok(Readings {
        file,
        list,
        runs,
        skipped,
        notes,
    })
}

/// A note of cells that were left out, with their lines and what stands there.
fn left_out_note(what: &str, cells: &[&(u64, &str)]) -> Option<String> {
    let shown = |(line, text): &&(u64, &str)| match *text {
        "" => format!("line {line}"),
        text => format!("line {line} (\"{text}\")"),
    };
    let lines: Vec<String> = cells.iter().take(MOST_LINES).map(shown).collect();
    let (count, lines) = (cells.len(), lines.join(", "));
    let more = if count > MOST_LINES { ", …" } else { "" };
    (count > 0).then(|| format!("{count} {what} were left out: {lines}{more}"))
}

/// Refuses what are no readings as a whole.
fn check(table: &Table, name: &str, list: &[Reading], unusable: &[&(u64, &str)]) -> Result<(), DataError> {
    let blank = list.iter().find(|reading| reading.sigma.is_none());
    let has_sigmas = list.iter().any(|reading| reading.sigma.is_some());
    let wrong = |line, found: &str, allowed| Err(table.wrong(line, found, allowed));
    match (list.first(), unusable.first(), blank) {
        (None, None, _) => Err(DataError::Empty(table.file.clone())),
        (None, Some((line, text)), _) => {
            let found = format!("{name}: found \"{text}\", and no number anywhere");
            wrong(*line, &found, "a finite number")
        }
        (Some(first), ..) if list.iter().all(|reading| reading.pass == 0) => {
            let allowed = "readings after at least one pass";
            wrong(first.line, "pass: found \"0\" alone", allowed)
        }
        (_, _, Some(blank)) if has_sigmas => {
            let found = "sigma_n is blank, but given for other readings";
            wrong(blank.line, found, "all or none")
        }
        _ => Ok(()),
    }
}

/// A note where forces without a unit look like kilonewtons.
fn too_small(table: &Table, columns: &Columns, list: &[Reading]) -> Option<String> {
    let mut forces = columns.values.iter().filter(|value| value.kind == FORCE);
    let bare = forces.find(|value| table.names[value.column].unit.is_none())?;
    let name = &table.names[bare.column].text;
    let force = measured(FORCE, Place::Natural);
    let forces = list.iter().filter(|reading| reading.measured.is_like(force));
    let largest = forces.map(|reading| reading.value.abs()).fold(0.0, f64::max);
    (largest > 0.0 && largest < 10.0).then(|| {
        format!("column {name} names no unit and was read as newtons, at most {largest:.3} N: it looks like kN (--unit kN)")
    })
}

/// Refuses vehicles that may be a running total, unless their column was chosen.
fn refuse_totals(table: &Table, columns: &Columns) -> Result<(), DataError> {
    let Some(column) = columns.vehicles.filter(|&column| !table.names[column].chosen) else {
        return Ok(());
    };
    let rows = &table.rows;
    let counts: Vec<u64> = rows
        .iter()
        .filter_map(|row| whole(table, row, column).ok())
        .collect();
    if counts.len() < TOTAL || counts.windows(2).any(|pair| pair[1] <= pair[0]) {
        return Ok(());
    }
    let found = "vehicles that grow from row to row: a running total, or vehicles since the row before";
    let allowed =
        "either: --column-pass NAME takes a total, --column-vehicles NAME takes those since the row before";
    Err(table.wrong(rows[0].line, found, allowed))
}

/// Where a value of a row was measured.
fn place(table: &Table, columns: &Columns, row: &Row, value: &Values) -> Result<Place, DataError> {
    match columns.position.filter(|&column| !row.cell(column).is_empty()) {
        None => Ok(value.end.map_or(Place::Natural, Place::End)),
        Some(_) if value.kind == DEFLECTION => {
            let allowed =
                "deflections without one: they are those of the duct under the first vehicle, wherever it is";
            Err(table.wrong(row.line, "a place beside a deflection", allowed))
        }
        Some(column) => {
            let allowed = "metres from the upstream end";
            si_of(table, row, column, POSITION, column, allowed).map(Place::At)
        }
    }
}

/// The standard deviation of a value of a row: in its own unit, or that of the value, as where this was said.
fn sigma(table: &Table, options: &ReadOptions, row: &Row, value: &Values) -> Result<Option<f64>, DataError> {
    let Some(column) = value.sigma.filter(|&column| !row.cell(column).is_empty()) else {
        return Ok(None);
    };
    let is_told = options.table.unit.is_some() && value.kind == FORCE;
    let of_value = is_told || table.names[column].unit.is_none();
    let allowed = "a finite, positive number";
    let unit_of = if of_value { value.column } else { column };
    match si_of(table, row, column, value.kind, unit_of, allowed)? {
        sigma if sigma > 0.0 => Ok(Some(sigma)),
        _ => Err(table.wrong_cell(row, column, allowed)),
    }
}

/// "12.0" is what a spreadsheet makes of 12.
fn whole(table: &Table, row: &Row, column: usize) -> Result<u64, DataError> {
    let number = table.number(row, column).ok().flatten();
    let is_whole = |number: &Number<'_>| number.value.fract() == 0.0 && (0.0..=MOST).contains(&number.value);
    match number.filter(|number| number.unit.is_empty() && is_whole(number)) {
        Some(number) => Ok(number.value as u64),
        None => Err(table.wrong_cell(row, column, WHOLE)),
    }
}

/// The number of a cell in SI, by its own unit or that of the column `unit_of`.
fn si_of(
    table: &Table,
    row: &Row,
    column: usize,
    kind: Kind,
    unit_of: usize,
    allowed: &str,
) -> Result<f64, DataError> {
    let number = table.number(row, column).ok().flatten();
    let value = number.and_then(|number| {
        let of_column = table.names[unit_of].unit.as_deref().unwrap_or("");
        si(
            kind,
            &number.digits,
            if number.unit.is_empty() {
                of_column
            } else {
                number.unit
            },
        )
    });
    value.ok_or_else(|| table.wrong_cell(row, column, allowed))
}
