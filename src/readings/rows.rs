//! Rows as readings, each with its line.

use std::path::Path;

use creepage_tables::{Row, Table, is_no_value};

use super::columns::{Columns, Values, columns};
use super::kinds::{DEFLECTION, FORCE, LAYOUT, measured};
use super::list::Readings;
use super::options::ReadOptions;
use super::reading::{Measured, Place, Reading};
use super::{DataError, runs, time};

/// Rows from which on vehicles that only ever grow are taken for a running total: by chance one file in 120.
const TOTAL: usize = 5;
/// Most lines that a note names.
const MOST_LINES: usize = 8;

impl Readings {
    /// Reads the file at `path` as `options` say.
    ///
    /// # Errors
    ///
    /// [`DataError`] with the first thing that is wrong, and its line.
    pub fn from_file(path: impl AsRef<Path>, options: &ReadOptions) -> Result<Self, DataError> {
        read(Table::from_file(path.as_ref(), &options.table, &LAYOUT)?, options)
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
        read(Table::read(file.into(), bytes, &options.table, &LAYOUT)?, options)
    }
}

/// A table of readings, its columns found.
struct Source<'o> {
    table: Table,
    columns: Columns,
    options: &'o ReadOptions,
}

/// The readings in `table`.
fn read(mut table: Table, options: &ReadOptions) -> Result<Readings, DataError> {
    let columns = columns(&mut table, options)?;
    time::check_order(&table, &columns)?;
    let source = Source {
        table,
        columns,
        options,
    };
    source.refuse_totals()?;
    source.readings()
}

/// The column, if the row has anything there.
fn given(row: &Row, column: Option<usize>) -> Option<usize> {
    column.filter(|&column| !row.cell(column).is_empty())
}

impl Source<'_> {
    fn readings(&self) -> Result<Readings, DataError> {
        let (table, columns) = (&self.table, &self.columns);
        let (mut list, mut runs) = (Vec::new(), Vec::new());
        // Vehicles of each run so far; rows without a value, and what stands there.
        let mut counted: Vec<u64> = Vec::new();
        let (mut blank, mut unusable) = (Vec::new(), Vec::new());
        for row in &table.rows {
            let label = columns.run.map_or("", |column| row.cell(column));
            let run = runs.iter().position(|other| other == label).unwrap_or(runs.len());
            if run == runs.len() {
                runs.push(label.to_owned());
                counted.push(0);
            }
            if let Some(column) = given(row, columns.vehicles) {
                let count = table.value(row, column, column)?;
                counted[run] = counted[run].saturating_add(count as u64);
            }
            for values in &columns.values {
                match row.cell(values.column) {
                    "" => blank.push((row.line, "")),
                    text if is_no_value(text) => unusable.push((row.line, text)),
                    _ => list.push(self.reading(row, values, run, counted[run])?),
                }
            }
        }
        let first = &columns.values[0];
        let blanks = format!("rows without a {}", measured(first.kind, Place::Natural).name());
        let notes = [
            left_out(&blanks, &blank),
            left_out("cells without a number", &unusable),
        ];
        let mut readings = Readings {
            file: table.file.clone(),
            list,
            runs,
            skipped: blank.len() + unusable.len(),
            notes: notes.into_iter().flatten().collect(),
        };
        self.check(&readings.list, unusable.first())?;
        if columns.run.or(columns.vehicles).is_none() {
            runs::split_where_passes_begin_anew(&mut readings);
        }
        runs::count_from_rest(&mut readings, self.options.run_start);
        readings.notes.extend(self.too_small(&readings.list));
        Ok(readings)
    }

    /// The reading of a row in a column, in this run, after this many vehicles if they are counted.
    fn reading(&self, row: &Row, values: &Values, run: usize, counted: u64) -> Result<Reading, DataError> {
        let table = &self.table;
        let value = table.value(row, values.column, values.column)?;
        let numbered = self.columns.pass.map(|pass| table.value(row, pass, pass));
        let pass = numbered.transpose()?.map_or(counted, |pass| pass as u64);
        let place = match given(row, self.columns.position) {
            None => values.end.map_or(Place::Natural, Place::End),
            Some(_) if values.kind == DEFLECTION => {
                let allowed = "deflections without one: they are those of the duct under the first vehicle, wherever it is";
                return Err(table.wrong(row.line, "a place beside a deflection", allowed));
            }
            Some(position) => Place::At(table.value(row, position, position)?),
        };
        let sigma = values.sigma.filter(|(column, _)| !row.cell(*column).is_empty());
        let sigma = sigma.map(|(column, like)| match table.value(row, column, like)? {
            sigma if sigma > 0.0 => Ok(sigma),
            _ => Err(table.wrong_cell(row, column, "a finite, positive number")),
        });
        let is_tension = self.options.tension_positive && values.kind == FORCE;
        Ok(Reading {
            pass,
            passes: pass,
            measured: measured(values.kind, place),
            value: if is_tension { -value } else { value },
            sigma: sigma.transpose()?,
            run,
            line: row.line,
        })
    }

    /// Refuses what are no readings as a whole.
    fn check(&self, list: &[Reading], unusable: Option<&(u64, &str)>) -> Result<(), DataError> {
        let wrong = |line, found: &str, allowed| Err(self.table.wrong(line, found, allowed));
        let name = &self.table.names[self.columns.values[0].column].text;
        let blank = list.iter().find(|reading| reading.sigma.is_none());
        match (list.first(), blank) {
            (None, _) => match unusable {
                None => Err(DataError::Empty(self.table.file.clone())),
                Some((line, text)) => wrong(
                    *line,
                    &format!("{name}: found \"{text}\", and no number anywhere"),
                    "a finite number",
                ),
            },
            (Some(first), _) if list.iter().all(|reading| reading.pass == 0) => wrong(
                first.line,
                "pass: found \"0\" alone",
                "readings after at least one pass",
            ),
            (_, Some(blank)) if list.iter().any(|reading| reading.sigma.is_some()) => wrong(
                blank.line,
                "sigma_n is blank, but given for other readings",
                "all or none",
            ),
            _ => Ok(()),
        }
    }

    /// A note where forces without a unit look like kilonewtons.
    fn too_small(&self, list: &[Reading]) -> Option<String> {
        let name = |values: &Values| &self.table.names[values.column];
        let mut forces = self.columns.values.iter().filter(|values| values.kind == FORCE);
        let bare = name(forces.find(|values| name(values).unit.is_none())?);
        let forces = list
            .iter()
            .filter(|reading| matches!(reading.measured, Measured::Force(_)));
        let largest = forces.map(|reading| reading.value.abs()).fold(0.0, f64::max);
        (largest > 0.0 && largest < 10.0).then(|| {
            format!("column {} names no unit and was read as newtons, at most {largest:.3} N: it looks like kN (--unit kN)", bare.text)
        })
    }

    /// Refuses vehicles that may be a running total, unless their column was chosen.
    fn refuse_totals(&self) -> Result<(), DataError> {
        let table = &self.table;
        let Some(column) = self
            .columns
            .vehicles
            .filter(|&column| !table.names[column].chosen)
        else {
            return Ok(());
        };
        let counts = table
            .rows
            .iter()
            .filter_map(|row| table.value(row, column, column).ok());
        let counts: Vec<f64> = counts.collect();
        if counts.len() < TOTAL || counts.windows(2).any(|pair| pair[1] <= pair[0]) {
            return Ok(());
        }
        let found = "vehicles that grow from row to row: a running total, or vehicles since the row before";
        let allowed = "either: --column-pass NAME takes a total, --column-vehicles NAME takes those since the row before";
        Err(table.wrong(table.rows[0].line, found, allowed))
    }
}

/// A note of cells that were left out, each with its line and what stands there.
fn left_out(what: &str, cells: &[(u64, &str)]) -> Option<String> {
    let shown = |(line, text): &(u64, &str)| match *text {
        "" => format!("line {line}"),
        text => format!("line {line} (\"{text}\")"),
    };
    let (count, lines) = (
        cells.len(),
        cells
            .iter()
            .take(MOST_LINES)
            .map(shown)
            .collect::<Vec<_>>()
            .join(", "),
    );
    let more = if count > MOST_LINES { ", …" } else { "" };
    (count > 0).then(|| format!("{count} {what} were left out: {lines}{more}"))
}
