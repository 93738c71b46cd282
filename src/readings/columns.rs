//! Which column of a table holds what.

use creepage_tables::{Kind, Row, Table};

use super::DataError;
use super::kinds::{ALLOWED, FORCE, MEASURED, MOVEMENT, PASS, POSITION, RUN, SIGMA, TIME, VEHICLES, end, si};
use super::options::ReadOptions;
use crate::CableEnd;

const UNITS: &str =
    "N, kN, daN, kgf, lbf and so on for forces, m, mm, um for movements; --unit names that of the forces";

/// A column of values.
#[derive(Debug, Clone, PartialEq)]
pub struct Values {
    pub column: usize,
    pub kind: Kind,
    pub end: Option<CableEnd>,
    /// The column of their standard deviations.
    pub sigma: Option<usize>,
}

/// The columns of a table of readings.
#[derive(Debug, Clone, PartialEq)]
pub struct Columns {
    pub pass: Option<usize>,
    pub vehicles: Option<usize>,
    pub run: Option<usize>,
    pub time: Option<usize>,
    pub position: Option<usize>,
    pub values: Vec<Values>,
}

/// Finds the columns of `table`.
pub fn columns(table: &Table, options: &ReadOptions) -> Result<Columns, DataError> {
    refuse_cut_decimals(table)?;
    let pass = table.one(PASS)?;
    let is_chosen = |kind| {
        let mut names = table.names.iter();
        names.any(|name| name.chosen && name.kind == Some(kind))
    };
    let vehicles = match pass {
        Some(_) if !is_chosen(VEHICLES) => None,
        _ => table.one(VEHICLES)?,
    };
    let time = table.names.iter().position(|name| name.kind == Some(TIME));
    if pass.or(vehicles).is_none() {
        let of_times = "the vehicles counted since the row before as well (--column-vehicles): times alone say nothing of passes";
        return Err(table.missing("pass", time.map_or(ALLOWED, |_| of_times)));
    }
    let mut values = values(table, options)?;
    if values.is_empty() {
        return Err(table.missing("force_n", ALLOWED));
    }
    add_sigmas(table, &mut values)?;
    Ok(Columns {
        pass,
        vehicles,
        run: table.one(RUN)?,
        time,
        position: table.one(POSITION)?,
        values,
    })
}

/// A row that was cut at its decimal commas has more cells than the header; without a header it looks like whole numbers.
fn refuse_cut_decimals(table: &Table) -> Result<(), DataError> {
    let is_whole = |cell: &String| cell.bytes().all(|byte| byte.is_ascii_digit()) && !cell.is_empty();
    let is_cut = |row: &Row| row.cells.len() == 3 && row.cells.iter().all(is_whole);
    match &table.rows[..] {
        [first, _, _, ..]
            if first.line == table.line
                && table.rows.iter().all(is_cut)
                && table.rows.iter().any(|row| row.cell(2) != first.cell(2)) =>
        {
            let cells = first.cells.join(",");
            let found = format!(
                "\"{cells}\": three whole numbers, or a decimal comma between cells separated by commas"
            );
            let allowed = "a header that names the columns, or cells separated by semicolons";
            Err(table.wrong(first.line, found, allowed))
        }
        _ => Ok(()),
    }
}

/// The columns of values. Beside forces others count where they were chosen or are this program's own: tables of its runs hold both.
fn values(table: &Table, options: &ReadOptions) -> Result<Vec<Values>, DataError> {
    let mut values: Vec<Values> = Vec::new();
    for (kind, column) in MEASURED
        .into_iter()
        .flat_map(|kind| table.of(kind).into_iter().map(move |column| (kind, column)))
    {
        let name = &table.names[column];
        let is_told = |(column, _): &&(String, CableEnd)| {
            name.chosen && column.to_lowercase() == name.text.to_lowercase()
        };
        let told = options.ends.iter().find(is_told).map(|(_, end)| *end);
        let value = Values {
            column,
            kind,
            end: told.or_else(|| end(name)),
            sigma: None,
        };
        if values
            .iter()
            .any(|other| (other.kind, other.end) == (kind, value.end))
        {
            let word = if kind == MOVEMENT { "movement" } else { "force" };
            let found = format!(
                "a second column {}; --column-{word} chooses one, or names the end of each: upstream=NAME",
                name.text
            );
            return Err(table.wrong(table.line, found, ALLOWED));
        }
        if let Some(unit) = name.unit.as_ref().filter(|unit| si(kind, "1", unit).is_none()) {
            let is_told = kind == FORCE && options.table.unit.is_some();
            let of = if is_told { "--unit" } else { &name.text };
            return Err(table.wrong(table.line, format!("{of}: the unit `{unit}`"), UNITS));
        }
        values.push(value);
    }
    let has_force = values.iter().any(|value| value.kind == FORCE);
    values.retain(|value| value.kind == FORCE || !has_force || table.names[value.column].is_own());
    Ok(values)
}

/// Gives each column of standard deviations to the values of its unit.
fn add_sigmas(table: &Table, values: &mut [Values]) -> Result<(), DataError> {
    let names = &table.names;
    for column in (0..names.len()).filter(|&column| names[column].kind == Some(SIGMA)) {
        let name = &names[column];
        let fits = |value: &&mut Values| {
            name.unit
                .as_ref()
                .is_none_or(|unit| si(value.kind, "1", unit).is_some())
        };
        let mut fitting = values.iter_mut().filter(fits).peekable();
        if fitting.peek().is_none() {
            return Err(table.wrong(table.line, format!("{}: its unit", name.text), UNITS));
        }
        for value in fitting {
            if let Some(first) = value.sigma.replace(column) {
                let found = format!("a second column {} beside {}", name.text, names[first].text);
                return Err(table.wrong(table.line, found, ALLOWED));
            }
        }
    }
    Ok(())
}
