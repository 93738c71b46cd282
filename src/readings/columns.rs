//! Which column of a table holds what.

use creepage_tables::{Name, Table, is_number};

use super::DataError;
use super::options::{ColumnNames, ReadOptions};
use super::role::{Role, end, is_own, role};
use crate::CableEnd;
use crate::scene::Dimension;

const ALLOWED: &str = "a header `pass,force_n` or `pass,force_n,sigma_n`, names such as `Force [kN]`, or names chosen by --column-pass, \
                       --column-vehicles, --column-force";
const UNITS: &str =
    "N, kN, daN, kgf, lbf and so on for forces, m, mm, um for movements; --unit names that of the forces";
const MEASURED: [Role; 4] = [Role::Force, Role::Movement, Role::Strain, Role::Deflection];

/// A column of values.
#[derive(Debug, Clone, PartialEq)]
pub struct Values {
    pub column: usize,
    pub role: Role,
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

/// Whether these are names of a table of readings.
pub fn is_header(names: &[Name], chosen: &ColumnNames) -> bool {
    let has = |text: &str| {
        names
            .iter()
            .any(|name| name.text.trim().to_lowercase() == text.trim().to_lowercase())
    };
    let holds = |of: Role| names.iter().any(|name| role(name) == Some(of));
    let named = |name: &Option<String>, of| name.as_ref().map_or_else(|| holds(of), |name| has(name));
    let listed = |names: &[String]| names.iter().any(|name| has(split_end(name).1));
    let counts = named(&chosen.pass, Role::Pass) || named(&chosen.vehicles, Role::Vehicles);
    counts && (listed(&chosen.force) || listed(&chosen.movement) || MEASURED.into_iter().any(holds))
}

/// Finds the columns of `table`; where it has no names, they are pass, force and standard deviation.
pub fn columns(table: &mut Table, options: &ReadOptions) -> Result<Columns, DataError> {
    if table.names.is_empty() {
        refuse_cut_decimals(table)?;
        let own = ["pass", "force_n", "sigma_n"]
            .into_iter()
            .take(table.rows.first().map_or(0, |row| row.cells.len()));
        table.names = own.map(|name| Name::of(name, Dimension::unit_by_word)).collect();
    }
    Header { table, options }.columns()
}

/// A row that was cut at its decimal commas has more cells than the header; without a header it looks like whole numbers.
fn refuse_cut_decimals(table: &Table) -> Result<(), DataError> {
    let digits = |cell: &String| is_number(cell) && cell.bytes().all(|byte| byte.is_ascii_digit());
    let rows = &table.rows;
    let is_cut = rows.len() > 2
        && rows
            .iter()
            .all(|row| row.cells.len() == 3 && row.cells.iter().all(digits))
        && rows.iter().any(|row| row.cell(2) != rows[0].cell(2));
    if !is_cut {
        return Ok(());
    }
    let found = format!(
        "\"{}\": three whole numbers, or a decimal comma between cells separated by commas",
        rows[0].cells.join(",")
    );
    Err(table.wrong(
        rows[0].line,
        found,
        "a header that names the columns, or cells separated by semicolons",
    ))
}

struct Header<'a> {
    table: &'a Table,
    options: &'a ReadOptions,
}

impl Header<'_> {
    fn wrong(&self, found: String) -> DataError {
        self.table.wrong(self.table.line, found, ALLOWED)
    }

    fn named(&self, name: &str) -> Result<usize, DataError> {
        self.table
            .named(name)
            .ok_or_else(|| self.table.missing(name, ALLOWED))
    }

    /// The columns of a role: those that this program writes, if any.
    fn of(&self, wanted: Role) -> Vec<usize> {
        let of = |holds: &dyn Fn(&Name) -> bool| -> Vec<usize> {
            let names = self.table.names.iter().enumerate();
            names
                .filter(|(_, name)| holds(name))
                .map(|(column, _)| column)
                .collect()
        };
        let own = of(&|name| is_own(name, wanted));
        if own.is_empty() {
            of(&|name| role(name) == Some(wanted))
        } else {
            own
        }
    }

    /// The column that the caller named, or the only one of its role.
    fn one(&self, chosen: Option<&String>, role: Role, option: &str) -> Result<Option<usize>, DataError> {
        if let Some(name) = chosen {
            return self.named(name).map(Some);
        }
        match self.of(role)[..] {
            [] => Ok(None),
            [only] => Ok(Some(only)),
            [_, second, ..] => Err(self.wrong(format!(
                "a second column {} ({option} chooses)",
                self.table.names[second].text
            ))),
        }
    }

    fn columns(&self) -> Result<Columns, DataError> {
        let chosen = &self.options.columns;
        let pass = self.one(chosen.pass.as_ref(), Role::Pass, "--column-pass")?;
        let vehicles = match (pass, &chosen.vehicles) {
            (Some(_), None) => None,
            (_, named) => self.one(named.as_ref(), Role::Vehicles, "--column-vehicles")?,
        };
        let time = self
            .table
            .names
            .iter()
            .position(|name| role(name) == Some(Role::Time));
        if pass.is_none() && vehicles.is_none() {
            let allowed = match time {
                Some(_) => {
                    "the vehicles counted since the row before as well (--column-vehicles): times alone say nothing of passes"
                }
                None => ALLOWED,
            };
            return Err(self.table.missing("pass", allowed));
        }
        let mut values = self.values(&chosen.force, Role::Force)?;
        let has_force = !values.is_empty();
        for role in MEASURED.into_iter().skip(1) {
            let named: &[String] = if role == Role::Movement {
                &chosen.movement
            } else {
                &[]
            };
            // Tables of this program's own runs hold displacements beside forces.
            let counts = |value: &Values| {
                !named.is_empty() || !has_force || is_own(&self.table.names[value.column], role)
            };
            values.extend(self.values(named, role)?.into_iter().filter(counts));
        }
        if values.is_empty() {
            return Err(self.table.missing("force_n", ALLOWED));
        }
        self.add_sigmas(&mut values)?;
        Ok(Columns {
            pass,
            vehicles,
            run: self.one(chosen.run.as_ref(), Role::Run, "--column-run")?,
            time,
            position: self.one(chosen.position.as_ref(), Role::Position, "--column-position")?,
            values,
        })
    }

    /// Columns of one kind of value.
    fn values(&self, chosen: &[String], role: Role) -> Result<Vec<Values>, DataError> {
        let names = &self.table.names;
        let of_end = |(column, said): (usize, Option<CableEnd>)| Values {
            column,
            role,
            end: said.or_else(|| end(&names[column])),
            sigma: None,
        };
        let found: Vec<Values> = if chosen.is_empty() {
            self.of(role)
                .into_iter()
                .map(|column| of_end((column, None)))
                .collect()
        } else {
            let named = |name: &String| {
                let (end, name) = split_end(name);
                Ok(of_end((self.named(name)?, end)))
            };
            chosen.iter().map(named).collect::<Result<_, DataError>>()?
        };
        for (index, value) in found.iter().enumerate() {
            let name = &names[value.column];
            if found[..index].iter().any(|other| other.end == value.end) {
                let word = if role == Role::Movement {
                    "movement"
                } else {
                    "force"
                };
                return Err(self.wrong(format!(
                    "a second column {}; --column-{word} chooses one, or names the end of each: upstream=NAME",
                    name.text
                )));
            }
            let told = self.options.unit.as_ref().filter(|_| role == Role::Force);
            if let Some(unit) = told
                .or(name.unit.as_ref())
                .filter(|unit| role.factor(unit).is_none())
            {
                let of = if told.is_some() { "--unit" } else { &name.text };
                return Err(self
                    .table
                    .wrong(self.table.line, format!("{of}: the unit `{unit}`"), UNITS));
            }
        }
        Ok(found)
    }

    /// Gives each column of standard deviations to the values of its unit.
    fn add_sigmas(&self, values: &mut [Values]) -> Result<(), DataError> {
        let names = &self.table.names;
        for (column, name) in names
            .iter()
            .enumerate()
            .filter(|(_, name)| role(name) == Some(Role::Sigma))
        {
            let fits = |value: &&mut Values| {
                name.unit
                    .as_ref()
                    .is_none_or(|unit| value.role.factor(unit).is_some())
            };
            let mut fitting = values.iter_mut().filter(fits).peekable();
            if fitting.peek().is_none() {
                return Err(self
                    .table
                    .wrong(self.table.line, format!("{}: its unit", name.text), UNITS));
            }
            for value in fitting {
                if let Some(first) = value.sigma.replace(column) {
                    let found = format!("a second column {} beside {}", name.text, names[first].text);
                    return Err(self.wrong(found));
                }
            }
        }
        Ok(())
    }
}

/// An end and a column's name: `upstream=NAME`.
fn split_end(name: &str) -> (Option<CableEnd>, &str) {
    let ends = CableEnd::ALL.into_iter();
    let mut said =
        ends.filter_map(|end| Some((Some(end), name.strip_prefix(end.name())?.strip_prefix('=')?)));
    said.next().unwrap_or((None, name))
}
