//! Rows as readings, each with its line.

use creepage_tables::{Row, is_no_value};

use super::columns::{Columns, Values};
use super::kinds::{DEFLECTION, FORCE, LAYOUT, measured};
use super::{DataError, Place, Reading, Readings, runs};

/// Maximum number of lines that a note names.
const MAX_LINES: usize = 8;

/// The column, if the row has anything there.
fn given(row: &Row, column: Option<usize>) -> Option<usize> {
    column.filter(|&column| !row.cell(column).is_empty())
}

impl Columns<'_> {
    /// All readings of the table.
    pub fn readings(&self) -> Result<Readings, DataError> {
        self.refuse_disorder()?;
        self.refuse_totals()?;
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
                return Err(table.wrong(row.line, "a place together with a deflection", allowed));
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
}

/// A note of cells that were left out, each with its line and what stands there.
fn left_out(what: &str, cells: &[(u64, &str)]) -> Option<String> {
    let shown = |(line, text): &(u64, &str)| match *text {
        "" => format!("line {line}"),
        text => format!("line {line} (\"{text}\")"),
    };
    let lines: Vec<String> = cells.iter().take(MAX_LINES).map(shown).collect();
    let (count, lines) = (cells.len(), lines.join(", "));
    let more = if count > MAX_LINES { ", …" } else { "" };
    (count > 0).then(|| format!("{count} {what} were left out: {lines}{more}"))
}
