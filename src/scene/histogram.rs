//! A table of axle loads, as weigh-in-motion gives it: each row a class of axles with its load and how many of them were counted.

use std::path::{Path, PathBuf};

use creepage_tables::{Name, Names, Options, Row, Table, TableError};
use ground_field::{Direction, SurfaceLoad, Vehicle, Wheel};

use super::data::TrafficVehicle;
use super::document::{Content, Document};
use super::error::{SceneError, WrongKind};
use super::range::{AXLE_COUNT, AXLE_LOAD, CONTACT_RADIUS, Quantity};
use super::table;
use super::units::Dimension;
use super::value::Value;

/// Most classes of axles, and size of the table \[bytes\].
const MOST: usize = 1000;
const LARGEST_FILE: u64 = 1 << 20;
/// A column: its name, words that stand for it, and what it holds.
struct Column {
    name: &'static str,
    words: &'static [&'static str],
    quantity: Quantity,
}
const COLUMNS: [Column; 3] = [
    Column {
        name: "count",
        words: &[
            "count", "counts", "number", "axles", "anzahl", "nombre", "numero", "número", "台数",
        ],
        quantity: AXLE_COUNT,
    },
    Column {
        name: "load",
        words: &["load", "achslast", "last", "charge", "carico", "carga", "軸重"],
        quantity: AXLE_LOAD,
    },
    Column {
        name: "contact_radius",
        words: &["radius"],
        quantity: CONTACT_RADIUS,
    },
];
const TABLE: &str = "a table whose header names the columns load, count and, if wanted, contact_radius, with units in the cells or in the \
                     name, such as \"load [kN]\"";
/// A heaviest axle below this, without a unit, is one that was meant in larger units \[N\]: a bicycle's wheel.
const LIGHTEST: f64 = 1e3;

/// The file that a document names, from the folder of the scene's file `name` on.
pub fn path(name: &str, document: &Document) -> Option<PathBuf> {
    let histogram = document.root.child("traffic")?.child("histogram")?;
    match &histogram.child("file").unwrap_or(histogram).content {
        Content::Text(text) => Some(beside(name, text)),
        _ => None,
    }
}

fn beside(name: &str, text: &str) -> PathBuf {
    Path::new(name).parent().unwrap_or(Path::new("")).join(text)
}

/// What a scene says of the table.
#[derive(Default)]
struct Told {
    file: String,
    options: Options,
    /// Names of the columns, as in [`COLUMNS`].
    columns: [Option<String>; 3],
    /// Unit of the loads.
    unit: Option<String>,
}

impl Told {
    fn of(value: &Value) -> Result<Self, SceneError> {
        const FILE: &str = "the name of a table, such as \"axles.csv\"";
        if !value.is_table() {
            let file = value.text(FILE)?;
            return Ok(Self {
                file,
                ..Self::default()
            });
        }
        let table = table::Table::new(value.clone())?;
        let text = |key: &str| {
            table
                .optional(key)
                .map(|value| value.text("a text in quotes"))
                .transpose()
        };
        let whole = |key: &str| {
            table
                .optional(key)
                .map(|value| value.integer(0..=u64::MAX))
                .transpose()
        };
        let [count, load, radius] = ["column_count", "column_load", "column_contact_radius"].map(text);
        Ok(Self {
            file: table.required("file", FILE)?.text(FILE)?,
            options: Options {
                separator: parsed(&table, "separator")?,
                decimal: parsed(&table, "decimal")?,
                encoding: parsed(&table, "encoding")?,
                header_line: whole("header_line")?,
                skip: whole("skip")?,
                sheet: text("sheet")?,
            },
            columns: [count?, load?, radius?],
            unit: text("unit")?,
        })
    }
}

fn parsed<T: std::str::FromStr<Err = String>>(
    table: &table::Table,
    key: &str,
) -> Result<Option<T>, SceneError> {
    let Some(value) = table.optional(key) else {
        return Ok(None);
    };
    let parsed = value.text("a text in quotes")?.parse();
    parsed
        .map(Some)
        .map_err(|why| value.inconsistent(value.written(), why))
}

/// The classes of the table that `value` names, each a vehicle of one wheel in the first lane, at `speed` \[m/s\].
pub fn axles(name: &str, value: &Value, speed: f64) -> Result<Vec<TrafficVehicle>, SceneError> {
    let told = Told::of(value)?;
    let wrong = |error: TableError| match error {
        TableError::Line {
            file,
            line,
            found,
            allowed,
        } => value.inconsistent(format!("{file}:{line}: {found}"), allowed),
        error => {
            let why = std::error::Error::source(&error).map_or_else(String::new, |why| format!(": {why}"));
            value.inconsistent(format!("{error}{why}"), TABLE)
        }
    };
    let place = |names: &[Name], column: usize| {
        let is_named = |name: &Name| match &told.columns[column] {
            Some(told) => name.text == *told,
            None => column_of(name) == Some(column),
        };
        names.iter().position(is_named)
    };
    let is_header = |names: &[Name]| place(names, 0).is_some() && place(names, 1).is_some();
    let names = Names {
        is_header: &is_header,
        unit: Dimension::unit_by_word,
    };
    let file = beside(name, &told.file);
    let mut table = Table::from_file(&file, LARGEST_FILE, &told.options, &names).map_err(wrong)?;
    let [count, load, radius] = [0, 1, 2].map(|column| place(&table.names, column));
    let missing = |column: usize| wrong(table.missing(COLUMNS[column].name, TABLE));
    let count = count.ok_or_else(|| missing(0))?;
    let load = load.ok_or_else(|| missing(1))?;
    if let Some(unit) = told.unit {
        table.names[load].unit = Some(unit);
    }
    let all: Vec<usize> = [Some(count), Some(load), radius].into_iter().flatten().collect();
    table.decide(&all).map_err(wrong)?;
    let rejected = |error| value.wrong(WrongKind::Rejected(error), "", "");
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
        return Err(value.inconsistent(found, format!("at most {MOST} classes of axles")));
    }
    Ok(axles)
}

/// The column whose words the name holds: "axle load" is a load, "axles" their number.
fn column_of(name: &Name) -> Option<usize> {
    COLUMNS.iter().position(|column| name.has(column.words))
}

/// A cell with its unit or that of its column, or a bare number in SI.
fn si(table: &Table, row: &Row, place: usize, column: &Column) -> Result<f64, TableError> {
    let cell = table.written(row, place);
    let value = match column.quantity.dimension {
        Some(dimension) => dimension.parse_argument(&cell).ok(),
        None => cell.parse().ok(),
    };
    let value = value.filter(|value| column.quantity.range.contains(*value));
    let found = || format!("{}: found \"{cell}\"", column.name);
    value.ok_or_else(|| table.wrong(row.line, found(), column.quantity.allowed()))
}
