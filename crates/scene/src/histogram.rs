//! A table of axle loads, as weigh-in-motion gives it: each row a class of axles with its load and how many of them were counted.

use std::path::{Path, PathBuf};

use creepage_tables::{Name, Names, Options, Row, Table, TableError};
use ground_field::{Direction, SurfaceLoad, Vehicle, Wheel};

use crate::data::TrafficVehicle;
use crate::either::HistogramKeys;
use crate::error::Wrong;
use crate::range::{AXLE_COUNT, AXLE_LOAD, CONTACT_RADIUS, Quantity};
use crate::units::Dimension;

/// Most classes of axles, and size of the table \[bytes\].
const MOST: usize = 1000;
const LARGEST_FILE: u64 = 1 << 20;
/// A column: its name, words that stand for it, and what it holds.
type Column = (&'static str, &'static [&'static str], Quantity);
const COUNT: &[&str] = &[
    "count", "counts", "number", "axles", "anzahl", "nombre", "numero", "número", "台数",
];
const LOAD: &[&str] = &["load", "achslast", "last", "charge", "carico", "carga", "軸重"];
const COLUMNS: [Column; 3] = [
    ("count", COUNT, AXLE_COUNT),
    ("load", LOAD, AXLE_LOAD),
    ("contact_radius", &["radius"], CONTACT_RADIUS),
];
const KEY: &str = "traffic.histogram";
const TABLE: &str = "a table whose header names the columns load, count and, if wanted, contact_radius, with units in the cells or in the \
                     name, such as \"load [kN]\"";
/// A heaviest axle below this, without a unit, is one that was meant in larger units \[N\]: a bicycle's wheel.
const LIGHTEST: f64 = 1e3;

/// A file from the folder of the scene's file `name` on.
pub fn beside(name: &str, text: &str) -> PathBuf {
    Path::new(name).parent().unwrap_or(Path::new("")).join(text)
}

impl HistogramKeys {
    fn options(&self) -> Result<Options, Box<Wrong>> {
        Ok(Options {
            separator: parsed("separator", self.separator.as_deref())?,
            decimal: parsed("decimal", self.decimal.as_deref())?,
            encoding: parsed("encoding", self.encoding.as_deref())?,
            header_line: self.header_line,
            skip: self.skip,
            sheet: self.sheet.clone(),
        })
    }
}

fn parsed<T: std::str::FromStr<Err = String>>(
    key: &str,
    text: Option<&str>,
) -> Result<Option<T>, Box<Wrong>> {
    let refused = |why| {
        let key = format!("traffic.histogram.{key}");
        Wrong::value(key, format!("\"{}\"", text.unwrap_or_default()), why)
    };
    text.map(str::parse).transpose().map_err(refused)
}

/// The classes of the table that `keys` name, each a vehicle of one wheel in the first lane, at `speed` \[m/s\].
pub fn axles(name: &str, keys: &HistogramKeys, speed: f64) -> Result<Vec<TrafficVehicle>, Box<Wrong>> {
    let inconsistent = |found: String, allowed: String| Wrong::value(KEY, found, allowed);
    let given = [&keys.column_count, &keys.column_load, &keys.column_contact_radius];
    let wrong = |error: TableError| match error {
        TableError::Line {
            file,
            line,
            found,
            allowed,
        } => inconsistent(format!("{file}:{line}: {found}"), allowed.into_owned()),
        error => {
            let why = std::error::Error::source(&error).map_or_else(String::new, |why| format!(": {why}"));
            inconsistent(format!("{error}{why}"), TABLE.to_owned())
        }
    };
    let place = |names: &[Name], column: usize| {
        let is_named = |name: &Name| match given[column] {
            Some(given) => name.text == *given,
            None => column_of(name) == Some(column),
        };
        names.iter().position(is_named)
    };
    let is_header = |names: &[Name]| place(names, 0).is_some() && place(names, 1).is_some();
    let names = Names {
        is_header: &is_header,
        unit: Dimension::unit_by_word,
    };
    let file = beside(name, &keys.file);
    let mut table = Table::from_file(&file, LARGEST_FILE, &keys.options()?, &names).map_err(wrong)?;
    let [count, load, radius] = [0, 1, 2].map(|column| place(&table.names, column));
    let missing = |column: usize| wrong(table.missing(COLUMNS[column].0, TABLE));
    let count = count.ok_or_else(|| missing(0))?;
    let load = load.ok_or_else(|| missing(1))?;
    if let Some(unit) = &keys.unit {
        table.names[load].unit = Some(unit.clone());
    }
    let all: Vec<usize> = [Some(count), Some(load), radius].into_iter().flatten().collect();
    table.decide(&all).map_err(wrong)?;
    let rejected = |error: ground_field::GroundError| inconsistent(error.to_string(), TABLE.to_owned());
    let mut axles: Vec<TrafficVehicle> = Vec::new();
    let mut heaviest: Option<(f64, &Row)> = None;
    for row in &table.rows {
        let quantity = |place, column: usize| si(&table, row, place, &COLUMNS[column]).map_err(wrong);
        let (share, force) = (quantity(count, 0)?, quantity(load, 1)?);
        let radius = radius.map_or(Ok(0.0), |place| quantity(place, 2))?;
        // Classes that nothing was counted in are common.
        if share == 0.0 {
            continue;
        }
        if heaviest.is_none_or(|(most, _)| force > most) {
            heaviest = Some((force, row));
        }
        let wheel = Wheel {
            x: 0.0,
            y: 0.0,
            load: SurfaceLoad::new(force, radius).map_err(rejected)?,
        };
        let name = format!("axle {}", axles.len() + 1);
        axles.push(TrafficVehicle {
            vehicle: Vehicle::new(name, vec![wheel], speed, Direction::Forward).map_err(rejected)?,
            share,
            lateral_offset: 0.0,
        });
    }
    let Some((force, row)) = heaviest else {
        return Err(wrong(table.wrong(
            table.line,
            "no row with axles below the names".into(),
            TABLE,
        )));
    };
    let cell = table.written(row, load);
    if force < LIGHTEST && cell.parse::<f64>().is_ok() {
        let found = format!("load: found \"{cell}\", in N, as the heaviest axle");
        let allowed = format!("a load with its unit, such as \"{cell} kN\", or a column \"load [kN]\"");
        return Err(wrong(table.wrong(row.line, found, allowed)));
    }
    if axles.len() > MOST {
        let found = format!("{} classes in {}", axles.len(), table.file);
        return Err(inconsistent(found, format!("at most {MOST} classes of axles")));
    }
    Ok(axles)
}

/// The column whose words the name holds: "axle load" is a load, "axles" their number.
fn column_of(name: &Name) -> Option<usize> {
    COLUMNS.iter().position(|column| name.has(column.1))
}

/// A cell with its unit or that of its column, or a bare number in SI.
fn si(table: &Table, row: &Row, place: usize, column: &Column) -> Result<f64, TableError> {
    let cell = table.written(row, place);
    let value = match column.2.dimension {
        Some(dimension) => dimension.parse_argument(&cell).ok(),
        None => cell.parse().ok(),
    };
    let value = value.filter(|value| column.2.contains(*value));
    let found = || format!("{}: found \"{cell}\"", column.0);
    value.ok_or_else(|| table.wrong(row.line, found(), column.2.allowed()))
}
