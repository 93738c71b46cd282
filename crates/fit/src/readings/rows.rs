//! Rows as readings, each with its line.

use std::path::Path;

use creepage_tables::{Row, Table, is_no_value};

use super::columns::{Columns, Values, columns};
use super::kinds::{DEFLECTION, FORCE, LAYOUT, measured};
use super::list::Readings;
use super::options::ReadOptions;
use super::reading::{Place, Reading};
use super::{DataError, runs};

/// Fewest rows of vehicles that only grow for a running total: by chance one file in 120.
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
        read(Table::read(file, bytes, &options.table, &LAYOUT)?, options)
    }
}

/// The readings in `table`.
fn read(table: Table, options: &ReadOptions) -> Result<Readings, DataError> {
    let columns = columns(table, options)?;
    columns.check_order_of_times()?;
    columns.refuse_totals()?;
    columns.readings()
}

/// The column, if the row has anything there.
fn given(row: &Row, column: Option<usize>) -> Option<usize> {
    column.filter(|&column| !row.cell(column).is_empty())
}

impl Columns<'_> {
    fn readings(&self) -> Result<Readings, DataError> {
        let mut readings = Readings::default();
        // Vehicles of each run so far; rows without a value, and what stands there.
        let mut counted: Vec<u64> = Vec::new();
        let (mut blank, mut unusable) = (Vec::new(), Vec::new());
        for row in &self.table.rows {
            let label = self.run.map_or("", |column| row.cell(column));
            let known = readings.runs.iter().position(|run| run == label);
            let run = known.unwrap_or(readings.runs.len());
            if run == counted.len() {
                readings.runs.push(label.to_owned());
                counted.push(0);
            }
            if let Some(column) = given(row, self.vehicles) {
                let count = self.table.value(row, column, column)?;
                counted[run] = counted[run].saturating_add(count as u64);
            }
            for values in &self.values {
                match row.cell(values.column) {
                    "" => blank.push((row.line, "")),
                    text if is_no_value(text) => unusable.push((row.line, text)),
                    _ => readings.list.push(self.reading(row, values, run, counted[run])?),
                }
            }
        }
        self.check(&readings.list, unusable.first())?;
        let measured = measured(self.values[0].kind, Place::Natural).name();
        let blank = left_out(&format!("rows without a {measured}"), &blank);
        let unusable = left_out("cells without a number", &unusable);
        readings.notes.extend(blank.into_iter().chain(unusable));
        if self.run.or(self.vehicles).is_none() {
            runs::split_where_passes_begin_anew(&mut readings);
        }
        runs::count_from_rest(&mut readings, self.options.run_start);
        Ok(readings)
    }

    /// The reading of a row in a column, in this run, after this many vehicles if they are counted.
    fn reading(&self, row: &Row, values: &Values, run: usize, counted: u64) -> Result<Reading, DataError> {
        let table = &self.table;
        let value = |column| table.value(row, column, column);
        let force = value(values.column)?;
        let passes = self.pass.map(value).transpose()?;
        let passes = passes.map_or(counted, |pass| pass as u64);
        let place = match given(row, self.position) {
            None => values.end.map_or(Place::Natural, Place::End),
            Some(_) if values.kind == DEFLECTION => {
                let allowed = "deflections without one: they are those of the duct under the first vehicle, wherever it is";
                return Err(table.wrong(row.line, "a place beside a deflection", allowed));
            }
            Some(position) => Place::At(value(position)?),
        };
        let is_tension = self.options.tension_positive && values.kind == FORCE;
        let mut reading = Reading::force(passes, if is_tension { -force } else { force });
        (reading.run, reading.line) = (run, row.line);
        reading.measured = measured(values.kind, place);
        if let Some((column, like)) = values.sigma
            && !row.cell(column).is_empty()
        {
            let sigma = table.value(row, column, like)?;
            if sigma <= 0.0 {
                return Err(table.wrong_cell(row, column, "a finite, positive number"));
            }
            reading.sigma = Some(sigma);
        }
        Ok(reading)
    }

    /// Refuses what are no readings as a whole.
    fn check(&self, list: &[Reading], unusable: Option<&(u64, &str)>) -> Result<(), DataError> {
        let wrong = |line, found: &str, allowed| Err(self.table.wrong(line, found, allowed));
        let name = &self.table.names[self.values[0].column].text;
        let Some(first) = list.first() else {
            let Some((line, text)) = unusable else {
                return wrong(0, "no rows", LAYOUT.allowed);
            };
            let found = format!("{name}: found \"{text}\", and no number anywhere");
            return wrong(*line, &found, "a finite number");
        };
        if list.iter().all(|reading| reading.pass == 0) {
            let allowed = "readings after at least one pass";
            return wrong(first.line, "pass: found \"0\" alone", allowed);
        }
        let has_sigmas = list.iter().any(|reading| reading.sigma.is_some());
        let blank = list.iter().find(|reading| reading.sigma.is_none());
        blank.filter(|_| has_sigmas).map_or(Ok(()), |blank| {
            let found = "sigma_n is blank, but given for other readings";
            wrong(blank.line, found, "all or none")
        })
    }

    /// Refuses vehicles that may be a running total, unless their column was chosen.
    fn refuse_totals(&self) -> Result<(), DataError> {
        let (table, rows) = (&self.table, &self.table.rows);
        let open = self.vehicles.filter(|&column| !table.names[column].chosen);
        let count = |row| table.value(row, open?, open?).ok();
        let counts: Vec<f64> = rows.iter().filter_map(count).collect();
        if counts.len() < TOTAL || counts.windows(2).any(|pair| pair[1] <= pair[0]) {
            return Ok(());
        }
        let found = "vehicles that grow from row to row: a running total, or vehicles since the row before";
        let allowed = "either: --column-pass NAME takes a total, --column-vehicles NAME takes those since the row before";
        Err(table.wrong(rows[0].line, found, allowed))
    }
}

/// A note of cells that were left out, each with its line and what stands there.
fn left_out(what: &str, cells: &[(u64, &str)]) -> Option<String> {
    let shown = |(line, text): &(u64, &str)| match *text {
        "" => format!("line {line}"),
        text => format!("line {line} (\"{text}\")"),
    };
    let lines: Vec<String> = cells.iter().take(MOST_LINES).map(shown).collect();
    let (count, lines) = (cells.len(), lines.join(", "));
    let more = if count > MOST_LINES { ", …" } else { "" };
    (count > 0).then(|| format!("{count} {what} were left out: {lines}{more}"))
}
