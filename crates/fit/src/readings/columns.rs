//! Which column of a table holds what.

use creepage_tables::{Kind, Row, Table};

use super::kinds::{FORCE, LAYOUT, MEASURED, MOVEMENT, PASS, POSITION, RUN, SIGMA, TIME, VEHICLES, end, si};
use super::{DataError, ReadOptions};
use creepage_scene::CableEnd;

const UNITS: &str =
    "N, kN, daN, kgf, lbf and so on for forces, m, mm, um for movements; --unit names that of the forces";

/// A column of values.
#[derive(Debug)]
pub struct Values {
    pub column: usize,
    pub kind: Kind,
    pub end: Option<CableEnd>,
    /// The column of their standard deviations, and that in whose unit they are.
    pub sigma: Option<(usize, usize)>,
}

/// A table of readings, and which of its columns holds what.
pub struct Columns<'o> {
    pub table: Table,
    pub options: &'o ReadOptions,
    pub pass: Option<usize>,
    pub vehicles: Option<usize>,
    pub run: Option<usize>,
    pub time: Option<usize>,
    pub position: Option<usize>,
    pub values: Vec<Values>,
}

/// Finds the columns of `table`.
pub fn columns(mut table: Table, options: &ReadOptions) -> Result<Columns<'_>, DataError> {
    refuse_cut_decimals(&table)?;
    let pass = table.one(PASS)?;
    let vehicles = pass.map_or_else(|| table.one(VEHICLES), |_| Ok(None))?;
    // A number of passes has no unit, whatever a logger writes below its name.
    for column in pass.into_iter().chain(vehicles) {
        table.names[column].unit = None;
    }
    let mut values = values(&table, options)?;
    add_sigmas(&mut table, options, &mut values)?;
    Ok(Columns {
        pass,
        vehicles,
        run: table.one(RUN)?,
        time: table.names.iter().position(|name| name.kind == Some(TIME)),
        position: table.one(POSITION)?,
        values,
        options,
        table,
    })
}

/// Without a header, rows that were cut at their decimal commas look like whole numbers.
fn refuse_cut_decimals(table: &Table) -> Result<(), DataError> {
    let is_whole = |cell: &String| !cell.is_empty() && cell.bytes().all(|byte| byte.is_ascii_digit());
    let is_cut = |row: &Row| row.cells.len() == 3 && row.cells.iter().all(is_whole);
    let rows = &table.rows;
    let has_header = rows.first().is_none_or(|first| first.line != table.line);
    let varies = || rows.iter().any(|row| row.cell(2) != rows[0].cell(2));
    if has_header || rows.len() < 3 || !rows.iter().all(is_cut) || !varies() {
        return Ok(());
    }
    let cells = rows[0].cells.join(",");
    let found = format!("\"{cells}\": three whole numbers, or a decimal comma between two cells");
    let allowed = "a header that names the columns, or cells separated by semicolons";
    Err(table.wrong(table.line, found, allowed))
}

/// The columns of values. Beside forces others count where they were chosen or are this program's
/// own: tables of its runs hold both.
fn values(table: &Table, options: &ReadOptions) -> Result<Vec<Values>, DataError> {
    let mut values: Vec<Values> = Vec::new();
    let columns = MEASURED.map(|kind| table.of(kind).into_iter().map(move |column| (kind, column)));
    for (kind, column) in columns.into_iter().flatten() {
        let name = &table.names[column];
        let is_named = |chosen: &str| name.chosen && chosen.to_lowercase() == name.text.to_lowercase();
        let chosen = options.ends.iter().find(|(column, _)| is_named(column));
        let end = chosen.map(|(_, end)| *end).or_else(|| end(name));
        if values.iter().any(|other| (other.kind, other.end) == (kind, end)) {
            let word = if kind == MOVEMENT { "movement" } else { "force" };
            let choice = format!("--column-{word} chooses one, or names the end of each: upstream=NAME");
            let found = format!("a second column {}; {choice}", name.text);
            return Err(table.wrong(table.line, found, LAYOUT.allowed));
        }
        if let Some(unit) = name.unit.as_ref().filter(|unit| si(kind, "1", unit).is_err()) {
            // An option stands in no line.
            let (line, place) = if is_chosen_unit(options, kind) {
                (0, "--unit")
            } else {
                (table.line, &*name.text)
            };
            return Err(table.wrong(line, format!("{place}: found the unit `{unit}`"), UNITS));
        }
        values.push(Values {
            column,
            kind,
            end,
            sigma: None,
        });
    }
    let has_force = values.iter().any(|value| value.kind == FORCE);
    values.retain(|value| value.kind == FORCE || !has_force || table.names[value.column].is_own());
    Ok(values)
}

/// Whether the options say the unit of this kind of values.
fn is_chosen_unit(options: &ReadOptions, kind: Kind) -> bool {
    kind == FORCE && options.table.unit.is_some()
}

/// Gives each column of standard deviations to the values of its unit.
fn add_sigmas(table: &mut Table, options: &ReadOptions, values: &mut [Values]) -> Result<(), DataError> {
    for column in 0..table.names.len() {
        if table.names[column].kind != Some(SIGMA) {
            continue;
        }
        let name = &table.names[column];
        let (text, unit) = (name.text.clone(), name.unit.clone());
        let fits = |value: &&mut Values| unit.as_ref().is_none_or(|unit| si(value.kind, "1", unit).is_ok());
        let mut fitting = values.iter_mut().filter(fits).peekable();
        if fitting.peek().is_none() {
            return Err(table.wrong(table.line, format!("{text}: its unit"), UNITS));
        }
        for value in fitting {
            let is_of_value = unit.is_none() || is_chosen_unit(options, value.kind);
            let like = if is_of_value { value.column } else { column };
            table.names[column].kind = Some(value.kind);
            if let Some((first, _)) = value.sigma.replace((column, like)) {
                let found = format!("a second column {text} beside {}", table.names[first].text);
                return Err(table.wrong(table.line, found, LAYOUT.allowed));
            }
        }
    }
    Ok(())
}
