//! Which column holds what.

use super::error::DataError;
use super::grid::{Grid, Row};
use super::header::{Name, Role};
use super::layout::{Columns, LONGEST_CELL, Values, option_factor, take_units, unit_factor, unknown_unit};
use super::number::number;
use super::options::{ColumnNames, Decimal, ReadOptions};
use super::reading::{Measured, Place};
use crate::CableEnd;
use crate::shown::shortened;

/// Rows above the header: what a data logger says of itself.
const PREAMBLE: usize = 40;
const ALLOWED: &str = "a header `pass,force_n` or `pass,force_n,sigma_n`, names such as `Force [kN]`, or names chosen by --column-pass, \
                       --column-vehicles, --column-force";

struct Header<'a> {
    file: &'a str,
    grid: &'a Grid,
    line: u64,
    names: Vec<Name>,
    options: &'a ReadOptions,
}

/// Finds the header and what its columns hold.
pub fn columns(file: &str, grid: &Grid, options: &ReadOptions) -> Result<Columns, DataError> {
    let Some(first) = grid.rows.first() else {
        return Err(DataError::Empty(file.to_owned()));
    };
    if options.columns == ColumnNames::default() && is_numeric(first) {
        return by_order(file, first, options);
    }
    let header = |row: &Row| Header {
        file,
        grid,
        line: row.line,
        names: row.cells.iter().map(|cell| Name::of(cell)).collect(),
        options,
    };
    let found = grid
        .rows
        .iter()
        .take(PREAMBLE)
        .position(|row| header(row).is_header());
    let place = found.unwrap_or(0);
    let mut columns = header(&grid.rows[place]).columns()?;
    columns.skip = place + 1;
    if let Some(units) = grid.rows.get(place + 1) {
        columns.skip += usize::from(take_units(&mut columns, units));
    }
    Ok(columns)
}

/// Whether the row holds readings, not names.
fn is_numeric(row: &Row) -> bool {
    let is_number = |cell: &String| {
        [Decimal::Point, Decimal::Comma]
            .iter()
            .any(|&decimal| number(cell, decimal).is_some_and(|(_, unit)| unit.is_empty()))
    };
    row.cells.len() > 1 && row.cells.iter().take(2).all(is_number)
}

fn by_order(file: &str, row: &Row, options: &ReadOptions) -> Result<Columns, DataError> {
    Ok(Columns {
        pass: Some(0),
        vehicles: None,
        sure_of_vehicles: false,
        run: None,
        time: None,
        position: None,
        values: vec![Values {
            place: 1,
            name: "force_n".into(),
            measured: Measured::Force(Place::Natural),
            factor: option_factor(file, row.line, options)?.unwrap_or(1.0),
            has_unit: options.unit.is_some(),
            sigma: (row.cells.len() > 2)
                .then_some((2, option_factor(file, row.line, options)?.unwrap_or(1.0))),
        }],
        width: row.cells.len(),
        skip: 0,
        named: false,
    })
}

impl Header<'_> {
    fn is_header(&self) -> bool {
        let chosen = &self.options.columns;
        let named = |name: &Option<String>, role| match name {
            Some(name) => self.named(name).is_some(),
            None => self.names.iter().any(|name| name.role() == Some(role)),
        };
        let value = |role: &Role| self.names.iter().any(|name| name.role() == Some(*role));
        let listed = |names: &[String]| names.iter().any(|name| self.named(split_end(name).1).is_some());
        (named(&chosen.pass, Role::Pass) || named(&chosen.vehicles, Role::Vehicles))
            && (listed(&chosen.force)
                || listed(&chosen.movement)
                || [Role::Force, Role::Movement, Role::Strain, Role::Deflection]
                    .iter()
                    .any(value))
    }

    fn named(&self, name: &str) -> Option<usize> {
        let same = |other: &Name| other.text.trim().to_lowercase() == name.trim().to_lowercase();
        self.names.iter().position(same)
    }

    fn wrong(&self, found: String) -> DataError {
        DataError::Line {
            file: self.file.to_owned(),
            line: self.line,
            found,
            allowed: ALLOWED.into(),
        }
    }

    /// That a column is missing, what there is, and what may be the cause.
    fn missing(&self, column: &str) -> DataError {
        let names: Vec<&str> = self
            .names
            .iter()
            .map(|name| &*name.text)
            .filter(|name| !name.is_empty())
            .collect();
        let separated = self
            .grid
            .separator
            .map_or("a workbook", |separator| separator.name());
        let cause = match &names[..] {
            [only] => {
                let other = [
                    (';', "semicolons"),
                    ('\t', "tabs"),
                    (',', "commas"),
                    (' ', "spaces"),
                ];
                let other = other.into_iter().find(|(sign, _)| only.contains(*sign));
                other.map_or_else(String::new, |(_, name)| format!("; it looks separated by {name}"))
            }
            _ => String::new(),
        };
        let names = shortened(&names.join(" | "), LONGEST_CELL);
        self.wrong(format!(
            "no column {column} in \"{names}\" (read as separated by {separated}{cause})"
        ))
    }

    /// The column that the caller named, or the only one of its role.
    fn one(&self, chosen: Option<&String>, role: Role, option: &str) -> Result<Option<usize>, DataError> {
        if let Some(name) = chosen {
            return self.named(name).map(Some).ok_or_else(|| self.missing(name));
        }
        let of = |holds: &dyn Fn(&Name) -> bool| -> Vec<usize> {
            (0..self.names.len())
                .filter(|&place| holds(&self.names[place]))
                .collect()
        };
        let own = of(&|name| name.is_own(role));
        let found = if own.is_empty() {
            of(&|name| name.role() == Some(role))
        } else {
            own
        };
        match &found[..] {
            [] => Ok(None),
            [only] => Ok(Some(*only)),
            [_, second, ..] => Err(self.wrong(format!(
                "a second column {} ({option} chooses)",
                self.names[*second].text
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
        let time = self.names.iter().position(|name| name.role() == Some(Role::Time));
        if pass.is_none() && vehicles.is_none() {
            let error = self.missing("pass");
            return Err(match (time, error) {
                (Some(_), DataError::Line { file, line, found, .. }) => DataError::Line {
                    file,
                    line,
                    found: found + "; there are times",
                    allowed: "the vehicles counted since the row before as well (--column-vehicles): times alone say nothing of passes".into(),
                },
                (_, error) => error,
            });
        }
        let mut values = self.values(&chosen.force, Role::Force)?;
        let has_force = !values.is_empty();
        for role in [Role::Movement, Role::Strain, Role::Deflection] {
            let named: &[String] = if role == Role::Movement {
                &chosen.movement
            } else {
                &[]
            };
            // Tables of this program's own runs hold displacements beside forces.
            let own = |value: &Values| Name::of(&value.name).is_own(role);
            let found = self.values(named, role)?;
            values.extend(
                found
                    .into_iter()
                    .filter(|value| !named.is_empty() || !has_force || own(value)),
            );
        }
        if values.is_empty() {
            return Err(self.missing("force_n"));
        }
        self.add_sigmas(&mut values)?;
        Ok(Columns {
            pass,
            vehicles,
            sure_of_vehicles: chosen.vehicles.is_some(),
            run: self.one(chosen.run.as_ref(), Role::Run, "--column-run")?,
            time,
            position: self.one(chosen.position.as_ref(), Role::Position, "--column-position")?,
            values,
            width: self.names.len(),
            skip: 0,
            named: true,
        })
    }

    /// Columns of one kind of value.
    fn values(&self, chosen: &[String], role: Role) -> Result<Vec<Values>, DataError> {
        let places: Vec<(usize, Option<CableEnd>)> = if chosen.is_empty() {
            let of = |own: bool| -> Vec<usize> {
                let fits = |name: &Name| {
                    if own {
                        name.is_own(role)
                    } else {
                        name.role() == Some(role)
                    }
                };
                (0..self.names.len())
                    .filter(|&place| fits(&self.names[place]))
                    .collect()
            };
            let own = of(true);
            let found = if own.is_empty() { of(false) } else { own };
            found
                .into_iter()
                .map(|place| (place, self.names[place].end()))
                .collect()
        } else {
            let find = |name: &String| {
                let (end, name) = split_end(name);
                let place = self.named(name).ok_or_else(|| self.missing(name))?;
                Ok((place, end.or_else(|| self.names[place].end())))
            };
            chosen.iter().map(find).collect::<Result<_, _>>()?
        };
        for (index, (place, end)) in places.iter().enumerate() {
            if places[..index].iter().any(|(_, other)| other == end) {
                let names: Vec<&str> = places
                    .iter()
                    .map(|(place, _)| &*self.names[*place].text)
                    .collect();
                let place = &self.names[*place].text;
                let word = if role == Role::Movement {
                    "movement"
                } else {
                    "force"
                };
                return Err(self.wrong(format!(
                    "a second column {place} in \"{}\"; --column-{word} chooses one, or names the end of each: upstream=NAME",
                    shortened(&names.join(" | "), LONGEST_CELL)
                )));
            }
        }
        places
            .into_iter()
            .map(|(place, end)| self.value(role, place, end))
            .collect()
    }

    fn value(&self, role: Role, place: usize, end: Option<CableEnd>) -> Result<Values, DataError> {
        let name = &self.names[place];
        let at = end.map_or(Place::Natural, Place::End);
        let measured = match role {
            Role::Movement => Measured::Movement(at),
            Role::Strain => Measured::Strain(at),
            Role::Deflection => Measured::Deflection,
            _ => Measured::Force(at),
        };
        let told = if role == Role::Force {
            option_factor(self.file, self.line, self.options)?
        } else {
            None
        };
        let factor = match (told, &name.unit) {
            (Some(told), _) => Some(told),
            (None, Some(unit)) => Some(
                unit_factor(measured, unit)
                    .ok_or_else(|| unknown_unit(self.file, self.line, &name.text, unit))?,
            ),
            (None, None) => None,
        };
        Ok(Values {
            place,
            name: name.text.clone(),
            measured,
            factor: factor.unwrap_or(1.0),
            has_unit: factor.is_some(),
            sigma: None,
        })
    }

    /// Gives each column of standard deviations to the values of its unit.
    fn add_sigmas(&self, values: &mut [Values]) -> Result<(), DataError> {
        let mut taken: Option<usize> = None;
        for place in (0..self.names.len()).filter(|&place| self.names[place].role() == Some(Role::Sigma)) {
            let name = &self.names[place];
            let fits = |value: &Values| {
                name.unit
                    .as_ref()
                    .is_none_or(|unit| unit_factor(value.measured, unit).is_some())
            };
            let mut found = false;
            for value in values.iter_mut().filter(|value| fits(value)) {
                if value.sigma.is_some() {
                    let first = taken.map_or("", |first| &*self.names[first].text);
                    return Err(self.wrong(format!("a second column {} beside {first}", name.text)));
                }
                let told = if self.options.unit.is_some() && matches!(value.measured, Measured::Force(_)) {
                    Some(value.factor)
                } else {
                    name.unit
                        .as_ref()
                        .and_then(|unit| unit_factor(value.measured, unit))
                };
                value.sigma = Some((place, told.unwrap_or(value.factor)));
                found = true;
            }
            if !found {
                return Err(unknown_unit(
                    self.file,
                    self.line,
                    &name.text,
                    name.unit.as_deref().unwrap_or(""),
                ));
            }
            taken = Some(place);
        }
        Ok(())
    }
}

/// An end and a column's name: `upstream=NAME`.
fn split_end(name: &str) -> (Option<CableEnd>, &str) {
    match name.split_once('=') {
        Some(("upstream", name)) => (Some(CableEnd::Upstream), name),
        Some(("downstream", name)) => (Some(CableEnd::Downstream), name),
        _ => (None, name),
    }
}
