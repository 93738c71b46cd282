//! A table of axle loads, as weigh-in-motion gives it: each row a class of axles with its load and how many of them were counted.

use std::fs;
use std::path::{Path, PathBuf};

use ground_field::{Direction, SurfaceLoad, Vehicle, Wheel};

use super::data::TrafficVehicle;
use super::document::{Content, Document};
use super::error::{SceneError, WrongKind};
use super::range::{AXLE_COUNT, AXLE_LOAD, CONTACT_RADIUS, Quantity};
use super::value::Value;

/// Most classes of axles, and size of the table \[bytes\].
const MOST: usize = 1000;
const LARGEST_FILE: u64 = 1 << 20;
const COLUMNS: [&str; 3] = ["load", "count", "contact_radius"];
/// Other names of these, in small letters.
const NAMES: [&[&str]; 3] = [
    &[
        "load",
        "axle load",
        "axle_load",
        "achslast",
        "last",
        "charge",
        "carico",
        "carga",
        "軸重",
    ],
    &[
        "count", "number", "axles", "anzahl", "nombre", "numero", "número", "台数",
    ],
    &["contact_radius", "contact radius", "radius"],
];
const TABLE: &str = "a table whose first line names the columns load, count and, if wanted, contact_radius, with units in the cells or in the \
                     name, such as \"load [kN]\"";
/// A heaviest axle below this, without a unit, is one that was meant in larger units \[N\]: a bicycle's wheel.
const LIGHTEST: f64 = 1e3;

/// The file that a document names, from the folder of the scene's file `name` on.
pub fn path(name: &str, document: &Document) -> Option<PathBuf> {
    match &document.root.child("traffic")?.child("histogram")?.content {
        Content::Text(text) => Some(beside(name, text)),
        _ => None,
    }
}

fn beside(name: &str, text: &str) -> PathBuf {
    Path::new(name).parent().unwrap_or(Path::new("")).join(text)
}

/// The classes of the table that `value` names, each a vehicle of one wheel in the first lane, at `speed` \[m/s\].
pub fn axles(name: &str, value: &Value, speed: f64) -> Result<Vec<TrafficVehicle>, SceneError> {
    let file = beside(name, &value.text("the name of a table, such as \"axles.csv\"")?);
    let unreadable = |why: String| value.inconsistent(format!("{}: {why}", file.display()), TABLE);
    let size = fs::metadata(&file)
        .map_err(|error| unreadable(error.to_string()))?
        .len();
    if size > LARGEST_FILE {
        return Err(unreadable(format!("{size} bytes, more than {LARGEST_FILE}")));
    }
    let text = fs::read_to_string(&file).map_err(|error| unreadable(error.to_string()))?;
    Table { value, file: &file }.read(&text, speed)
}

struct Table<'v> {
    value: &'v Value<'v>,
    file: &'v Path,
}

impl Table<'_> {
    fn wrong(&self, line: usize, found: &str, allowed: impl Into<String>) -> SceneError {
        let found = format!("{found} in line {line} of {}", self.file.display());
        self.value.wrong(WrongKind::Value, found, allowed)
    }

    fn read(&self, text: &str, speed: f64) -> Result<Vec<TrafficVehicle>, SceneError> {
        let lines = text.trim_start_matches('\u{feff}').lines().zip(1..);
        let mut rows =
            lines.filter(|(line, _)| !line.trim().is_empty() && !line.trim_start().starts_with('#'));
        let Some((head, line)) = rows.next() else {
            return Err(self.wrong(1, "nothing", TABLE));
        };
        // Spreadsheets of countries with a decimal comma write semicolons.
        let separator = [';', '\t']
            .into_iter()
            .find(|&mark| head.contains(mark))
            .unwrap_or(',');
        let cells = |row: &str| -> Vec<String> {
            let cell = |cell: &str| cell.trim().trim_matches('"').trim().to_owned();
            row.split(separator).map(cell).collect()
        };
        let heads = cells(head);
        let heads: Vec<(String, &str)> = heads.iter().map(|head| name_and_unit(head)).collect();
        let column = |names: &[&str]| {
            let place = heads
                .iter()
                .position(|(head, _)| names.contains(&head.as_str()))?;
            Some((place, heads[place].1))
        };
        let [Some(load), Some(count), radius] = NAMES.map(column) else {
            return Err(self.wrong(line, &format!("\"{}\"", head.trim()), TABLE));
        };
        let mut axles: Vec<TrafficVehicle> = Vec::new();
        let mut heaviest = (0.0, line, String::new());
        for (row, line) in rows {
            let cells = cells(row);
            let at = |(place, unit): (usize, &str), column, quantity| {
                let cell = cells.get(place).map_or("", String::as_str);
                let decimal_comma = separator != ',' && !cell.contains('.');
                let cell = if decimal_comma {
                    &cell.replacen(',', ".", 1)
                } else {
                    cell
                };
                let bare = cell.parse::<f64>().is_ok();
                let with_unit = if bare { &format!("{cell} {unit}") } else { cell };
                self.quantity(line, column, with_unit.trim(), quantity)
            };
            let share = at(count, COLUMNS[1], AXLE_COUNT)?;
            let force = at(load, COLUMNS[0], AXLE_LOAD)?;
            let radius = radius.map_or(Ok(0.0), |place| at(place, COLUMNS[2], CONTACT_RADIUS))?;
            // Classes that nothing was counted in are common.
            if share == 0.0 {
                continue;
            }
            if force > heaviest.0 {
                heaviest = (force, line, cells.get(load.0).cloned().unwrap_or_default());
            }
            let name = format!("axle {}", axles.len() + 1);
            let rejected = |error| self.value.wrong(WrongKind::Rejected(error), "", "");
            let wheel = Wheel {
                x: 0.0,
                y: 0.0,
                load: SurfaceLoad::new(force, radius).map_err(rejected)?,
            };
            let vehicle = Vehicle::new(name, vec![wheel], speed, Direction::Forward).map_err(rejected)?;
            axles.push(TrafficVehicle {
                vehicle,
                share,
                lateral_offset: 0.0,
            });
        }
        let (force, at, cell) = heaviest;
        if force < LIGHTEST && load.1.is_empty() && cell.parse::<f64>().is_ok() {
            let found = format!("{} \"{cell}\", in N, as the heaviest axle", COLUMNS[0]);
            return Err(self.wrong(
                at,
                &found,
                format!("a load with its unit, such as \"{cell} kN\", or a column \"load [kN]\""),
            ));
        }
        match axles.len() {
            0 => Err(self.wrong(line, "no row with axles below the names", TABLE)),
            found if found > MOST => {
                let allowed = format!("at most {MOST} classes of axles");
                Err(self
                    .value
                    .inconsistent(format!("{found} classes in {}", self.file.display()), allowed))
            }
            _ => Ok(axles),
        }
    }

    /// A cell with its unit, or a bare number in SI.
    fn quantity(&self, line: usize, column: &str, cell: &str, quantity: Quantity) -> Result<f64, SceneError> {
        let value = match quantity.dimension {
            Some(dimension) => dimension.parse_argument(cell).ok(),
            None => cell.parse().ok(),
        };
        let value = value.filter(|value| quantity.range.contains(*value));
        value.ok_or_else(|| self.wrong(line, &format!("{column} \"{cell}\""), quantity.allowed()))
    }
}

/// A column's name in small letters, and the unit in brackets behind it.
fn name_and_unit(head: &str) -> (String, &str) {
    let (name, unit) = head.split_once(['[', '(']).unwrap_or((head, ""));
    (
        name.trim().to_lowercase(),
        unit.trim_end_matches([']', ')']).trim(),
    )
}
