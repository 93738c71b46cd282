//! Rows as readings, each with its line.

use super::columns::columns;
use super::error::DataError;
use super::grid::{Grid, Row};
use super::header::{factor, strain_factor};
use super::layout::{Columns, LONGEST_CELL, Values};
use super::number::{Sign, decimal_sign, is_unusable, number};
use super::options::{Decimal, ReadOptions};
use super::reading::{Measured, Place, Reading};
use super::runs;
use super::time;
use crate::scene::Dimension;
use crate::shown::shortened;

/// Rows from which on vehicles that only ever grow are taken for a running total: by chance one file in 120.
const TOTAL: usize = 5;
/// Most lines that a note names.
const MOST_LINES: usize = 8;

/// What a table holds.
pub struct Table {
    pub readings: Vec<Reading>,
    /// Names of the runs.
    pub runs: Vec<String>,
    /// Rows without a value.
    pub skipped: usize,
    /// What the user should know of how the file was read.
    pub notes: Vec<String>,
}

/// The readings in `grid`.
pub fn read(file: &str, grid: &Grid, options: &ReadOptions) -> Result<Table, DataError> {
    let columns = columns(file, grid, options)?;
    let rows = &grid.rows[columns.skip..];
    let mut reader = Rows {
        file,
        decimal: sign(file, grid, rows, &columns, options)?,
        columns: &columns,
        options,
        blank: Vec::new(),
        unusable: Vec::new(),
    };
    if !columns.named {
        reader.refuse_cut_decimals(rows)?;
    }
    if let Some(place) = columns.time {
        time::check_order(file, rows, place, columns.run)?;
    }
    let mut readings = Vec::new();
    let mut labels: Vec<String> = Vec::new();
    // Vehicles so far, of each run.
    let mut counted: Vec<u64> = Vec::new();
    if let (Some(place), false) = (columns.vehicles, columns.sure_of_vehicles) {
        reader.refuse_totals(rows, place)?;
    }
    for row in rows {
        let label = columns.run.map_or("", |place| row.cell(place));
        let run = labels.iter().position(|other| other == label).unwrap_or_else(|| {
            labels.push(label.to_owned());
            counted.push(0);
            labels.len() - 1
        });
        readings.extend(reader.readings(row, run, &mut counted[run])?);
    }
    let Rows { blank, unusable, .. } = reader;
    if let (true, Some((line, text))) = (readings.is_empty(), unusable.first()) {
        let name = &columns.values[0].name;
        return Err(DataError::Line {
            file: file.to_owned(),
            line: *line,
            found: format!("{name}: found \"{text}\", and no number anywhere"),
            allowed: "a finite number".into(),
        });
    }
    let mut notes = Vec::new();
    if !blank.is_empty() {
        notes.push(format!(
            "{} rows without a {} were left out: {}",
            blank.len(),
            columns.values[0].measured.name(),
            lines(&blank)
        ));
    }
    if !unusable.is_empty() {
        let shown = |(line, text): &(u64, String)| format!("line {line} (\"{text}\")");
        let list: Vec<String> = unusable.iter().take(MOST_LINES).map(shown).collect();
        let more = if unusable.len() > MOST_LINES { " …" } else { "" };
        notes.push(format!(
            "{} cells without a number were left out: {}{more}",
            unusable.len(),
            list.join(", ")
        ));
    }
    let skipped = blank.len() + unusable.len();
    if columns.run.is_none() && columns.vehicles.is_none() {
        labels = runs::split_where_passes_begin_anew(&mut readings, &mut notes);
    }
    runs::count_from_rest(&mut readings, labels.len(), options.run_start, &mut notes);
    notes.extend(looks_like_kilonewtons(&columns, &readings));
    Ok(Table {
        readings,
        runs: labels,
        skipped,
        notes,
    })
}

fn lines(lines: &[u64]) -> String {
    let list: Vec<String> = lines.iter().take(MOST_LINES).map(u64::to_string).collect();
    let more = if lines.len() > MOST_LINES { ", …" } else { "" };
    format!("line {}{more}", list.join(", "))
}

/// Forces without a unit that are too small to be newtons.
fn looks_like_kilonewtons(columns: &Columns, readings: &[Reading]) -> Option<String> {
    let bare =
        |value: &&Values| matches!(value.measured, Measured::Force(_)) && !value.has_unit && columns.named;
    let column = columns.values.iter().find(bare)?;
    let forces = readings
        .iter()
        .filter(|reading| reading.measured.is_like(column.measured));
    let largest = forces.map(|reading| reading.value.abs()).fold(0.0, f64::max);
    (largest > 0.0 && largest < 10.0).then(|| {
        format!(
            "column {} names no unit and was read as newtons, at most {largest:.3} N: it looks like kN (--unit kN)",
            column.name
        )
    })
}

/// The decimal sign of the file.
fn sign(
    file: &str,
    grid: &Grid,
    rows: &[Row],
    columns: &Columns,
    options: &ReadOptions,
) -> Result<Decimal, DataError> {
    if let Some(decimal) = options.decimal {
        return Ok(decimal);
    }
    if grid.separator.is_none() {
        return Ok(Decimal::Point);
    }
    let cells = rows.iter().flat_map(|row| {
        let numbers = columns
            .values
            .iter()
            .flat_map(|value| [Some(value.place), value.sigma.map(|(place, _)| place)]);
        numbers
            .chain([columns.pass])
            .flatten()
            .map(|place| row.cell(place))
    });
    match decimal_sign(cells) {
        Sign::Certain(decimal) => Ok(decimal),
        Sign::Doubtful => {
            let first = rows.iter().find(|row| {
                columns
                    .values
                    .iter()
                    .any(|value| row.cell(value.place).contains(','))
            });
            let (line, text) = first.map_or((0, ""), |row| (row.line, row.cell(columns.values[0].place)));
            Err(DataError::Line {
                file: file.to_owned(),
                line,
                found: format!(
                    "\"{}\": a decimal comma or thousands",
                    shortened(text, LONGEST_CELL)
                ),
                allowed: "either: --decimal comma or --decimal point says which".into(),
            })
        }
    }
}

struct Rows<'a> {
    file: &'a str,
    decimal: Decimal,
    columns: &'a Columns,
    options: &'a ReadOptions,
    /// Lines without a value.
    blank: Vec<u64>,
    /// Lines with a cell that is no number, and that cell.
    unusable: Vec<(u64, String)>,
}

impl Rows<'_> {
    fn wrong(&self, row: &Row, found: String, allowed: &'static str) -> DataError {
        DataError::Line {
            file: self.file.to_owned(),
            line: row.line,
            found,
            allowed: allowed.into(),
        }
    }

    fn wrong_cell(&self, row: &Row, column: &str, cell: &str, allowed: &'static str) -> DataError {
        let cell = shortened(cell, LONGEST_CELL);
        let comma =
            cell.contains(',') && self.decimal == Decimal::Point && number(&cell, Decimal::Comma).is_some();
        let point =
            cell.contains('.') && self.decimal == Decimal::Comma && number(&cell, Decimal::Point).is_some();
        let cause = match (comma, point) {
            (true, _) => ", a decimal comma where other numbers have a point",
            (_, true) => ", a decimal point where other numbers have a comma",
            _ => "",
        };
        self.wrong(row, format!("{column}: found \"{cell}\"{cause}"), allowed)
    }

    /// A row that was cut at its decimal commas has more cells than the header; without a header it looks like whole numbers.
    fn refuse_cut_decimals(&self, rows: &[Row]) -> Result<(), DataError> {
        let digits = |cell: &str| !cell.is_empty() && cell.bytes().all(|byte| byte.is_ascii_digit());
        let is_cut = |row: &Row| row.cells.len() == 3 && row.cells.iter().all(|cell| digits(cell));
        let varies = rows.iter().any(|row| row.cell(2) != rows[0].cell(2));
        match rows
            .first()
            .filter(|_| rows.len() > 2 && varies && rows.iter().all(is_cut))
        {
            Some(row) => Err(self.wrong(
                row,
                format!(
                    "\"{}\": three whole numbers, or a decimal comma between cells separated by commas",
                    row.cells.join(",")
                ),
                "a header that names the columns, or cells separated by semicolons",
            )),
            None => Ok(()),
        }
    }

    fn refuse_totals(&self, rows: &[Row], place: usize) -> Result<(), DataError> {
        let counts: Vec<f64> = rows
            .iter()
            .filter_map(|row| number(row.cell(place), self.decimal))
            .map(|(n, _)| n)
            .collect();
        if counts.len() < TOTAL || counts.windows(2).any(|pair| pair[1] <= pair[0]) {
            return Ok(());
        }
        Err(self.wrong(
            &rows[0],
            "vehicles that grow from row to row: a running total, or vehicles since the row before".into(),
            "either: --column-pass NAME takes a total, --column-vehicles NAME takes those since the row before",
        ))
    }

    /// The readings of a row; `counted` vehicles have passed in its run.
    fn readings(&mut self, row: &Row, run: usize, counted: &mut u64) -> Result<Vec<Reading>, DataError> {
        let columns = self.columns;
        if row.cells.iter().skip(columns.width).any(|cell| !cell.is_empty()) {
            return Err(self.wrong(
                row,
                format!("{} cells where the first row has {}", row.cells.len(), columns.width),
                "as many: a decimal comma in a file separated by commas makes two of one; put it in quotes, or separate by semicolons",
            ));
        }
        if let Some(place) = columns.vehicles {
            let cell = row.cell(place);
            let whole = if cell.is_empty() {
                Some(0)
            } else {
                self.whole(cell)
            };
            let vehicles = whole.ok_or_else(|| {
                self.wrong_cell(
                    row,
                    "vehicles",
                    cell,
                    "a whole number of vehicles since the row before",
                )
            })?;
            *counted = counted.saturating_add(vehicles);
        }
        let mut readings = Vec::new();
        for value in &columns.values {
            let Some(found) = self.value(row, value)? else {
                continue;
            };
            let pass = match columns.pass {
                None => *counted,
                Some(place) => {
                    let cell = row.cell(place);
                    self.whole(cell).ok_or_else(|| {
                        self.wrong_cell(
                            row,
                            "pass",
                            cell,
                            "a whole number, 0 for the reading before the first pass",
                        )
                    })?
                }
            };
            readings.push(Reading {
                pass,
                passes: pass,
                measured: self.located(row, value.measured)?,
                value: found,
                sigma: self.sigma(row, value)?,
                run,
                line: row.line,
            });
        }
        Ok(readings)
    }

    /// "12.0" is what a spreadsheet makes of 12.
    fn whole(&self, cell: &str) -> Option<u64> {
        let (value, unit) = number(cell, self.decimal)?;
        (unit.is_empty() && value.fract() == 0.0 && (0.0..=1e15).contains(&value)).then_some(value as u64)
    }

    fn value(&mut self, row: &Row, column: &Values) -> Result<Option<f64>, DataError> {
        let cell = row.cell(column.place);
        if cell.is_empty() {
            self.blank.push(row.line);
            return Ok(None);
        }
        if is_unusable(cell) {
            self.unusable.push((row.line, cell.to_owned()));
            return Ok(None);
        }
        let is_force = matches!(column.measured, Measured::Force(_));
        let sign = if is_force && self.options.tension_positive {
            -1.0
        } else {
            1.0
        };
        let allowed = "a finite number";
        let (value, unit) =
            number(cell, self.decimal).ok_or_else(|| self.wrong_cell(row, &column.name, cell, allowed))?;
        let factor = if unit.is_empty() {
            Some(column.factor)
        } else {
            match column.measured {
                Measured::Force(_) => factor(Dimension::Force, unit),
                Measured::Strain(_) => strain_factor(unit),
                _ => factor(Dimension::Length, unit),
            }
        };
        let factor = factor
            .ok_or_else(|| self.wrong_cell(row, &column.name, cell, "a finite number, with a unit if any"))?;
        let value = sign * scaled(value, factor);
        value
            .is_finite()
            .then_some(Some(value))
            .ok_or_else(|| self.wrong_cell(row, &column.name, cell, allowed))
    }

    fn located(&self, row: &Row, measured: Measured) -> Result<Measured, DataError> {
        let Some(place) = self.columns.position else {
            return Ok(measured);
        };
        let cell = row.cell(place);
        if cell.is_empty() {
            return Ok(measured);
        }
        let metres = number(cell, self.decimal).and_then(|(value, unit)| match unit {
            "" => Some(value),
            unit => Some(value * factor(Dimension::Length, unit)?),
        });
        let at =
            metres.ok_or_else(|| self.wrong_cell(row, "position", cell, "metres from the upstream end"))?;
        Ok(match measured {
            Measured::Force(_) => Measured::Force(Place::At(at)),
            Measured::Movement(_) => Measured::Movement(Place::At(at)),
            Measured::Strain(_) => Measured::Strain(Place::At(at)),
            Measured::Deflection => measured,
        })
    }

    fn sigma(&self, row: &Row, column: &Values) -> Result<Option<f64>, DataError> {
        let Some((place, factor)) = column.sigma else {
            return Ok(None);
        };
        let cell = row.cell(place);
        if cell.is_empty() {
            return Ok(None);
        }
        let sigma = number(cell, self.decimal)
            .map(|(value, _)| scaled(value, factor))
            .filter(|sigma| sigma.is_finite() && *sigma > 0.0);
        sigma
            .map(Some)
            .ok_or_else(|| self.wrong_cell(row, "sigma_n", cell, "a finite, positive number"))
    }
}

/// The value in SI; divided where the factor is a negative power of ten, so that 35.7 um is 35.7e-6.
fn scaled(value: f64, factor: f64) -> f64 {
    let inverse = (1.0 / factor).round();
    if factor < 1.0 && (inverse * factor - 1.0).abs() < 1e-12 {
        value / inverse
    } else {
        value * factor
    }
}
