//! A table of axle loads, as weigh-in-motion gives it: each row a class of axles and their number.

use std::error::Error;
use std::path::{Path, PathBuf};

use creepage_tables::{Kind, Layout, Options, Row, Table, TableError};

use crate::content::Node;
use crate::error::{Result, SceneError};
use crate::key::Form;
use crate::key::Form::{Either, Number, Text};
use crate::range::{ANY_WHOLE, AXLE_COUNT, AXLE_LOAD, CONTACT_RADIUS};
use crate::section::keys;
use crate::stored::Stored;
use crate::units::Dimension;
use crate::vehicle::{TrafficVehicle, Wheel};

keys! {
    /// The name of a table of axle loads, and how it is to be read where that is not recognised.
    pub struct Histogram {
        /// The table, from the folder of the scene on.
        file: String = Text("the name of a table, such as \"axles.csv\"");
        /// What stands between its cells.
        separator: Option<String> = Text("comma, semicolon, tab, space or |, in quotes"), "recognised";
        /// What stands before its decimals.
        decimal: Option<String> = Text("\"point\" or \"comma\""), "recognised";
        /// How its characters are written.
        encoding: Option<String> = Text("utf-8, utf-16, latin-1, shift_jis, …, in quotes"), "recognised";
        /// Its line with the names of the columns.
        header_line: Option<u64> = Number(ANY_WHOLE), "recognised";
        /// Rows below the names that hold no axles.
        skip: Option<u64> = Number(ANY_WHOLE), "recognised";
        /// Sheet of a workbook.
        sheet: Option<String> = TEXT, "the first with rows";
        /// Unit of the loads.
        unit: Option<String> = Text("a unit of force, in quotes"), "that of the header";
        /// Name of the column with the loads.
        column_load: Option<String> = TEXT, "recognised";
        /// Name of the column with the numbers of axles.
        column_count: Option<String> = TEXT, "recognised";
        /// Name of the column with the radii.
        column_contact_radius: Option<String> = TEXT, "recognised";
    }
}

const TEXT: Form = Text("a text in quotes");
/// The name of a table of axles, or a table that says how it is to be read.
pub const HISTOGRAM: Form = Either(&Text(NAME_OR_TABLE), Histogram::KEYS);
const NAME_OR_TABLE: &str = "the name of a table, such as \"axles.csv\", with the columns load, count and, if wanted, contact_radius, or { file = \
                             \"axles.csv\", decimal = \"comma\" }";

/// Maximum number of classes of axles.
const MAX_CLASSES: usize = 1000;
const COUNT: Kind = Kind("count counts number axles anzahl nombre numero número 台数");
/// In place of a count.
const SHARE: Kind =
    Kind("share percent percentage frequency anteil häufigkeit fréquence frequenza frecuencia");
const LOAD: Kind = Kind("load achslast last charge carico carga 軸重");
const RADIUS: Kind = Kind("contact_radius radius");
/// Words of axles that were weighed as one.
const GROUP: Kind = Kind("group groups tandem tandems tridem tridems gruppe achsgruppe groupe gruppo grupo");
/// Words of a row that sums up the others.
const TOTAL: Kind = Kind("total totals sum summe gesamt somme totale suma 合計 計");
/// The name of an axle, and of a group of them in a table of groups.
const AXLE: &str = "axle";
pub const AXLE_GROUP: &str = "axle group";
const KEY: &str = "traffic.histogram";
const LAYOUT: Layout = Layout {
    kinds: &[COUNT, LOAD, RADIUS, SHARE],
    measured: Some(LOAD),
    missing: |names| {
        let has = |kind| names.iter().any(|name| name.kind == Some(kind));
        let count = (!has(COUNT) && !has(SHARE)).then_some("count");
        count.or((!has(LOAD)).then_some("load"))
    },
    is_number: |name| name.kind.is_some(),
    unnamed: &[],
    unit: |word| Dimension::unit_by_word(word).or_else(|| of_weight(word)),
    si,
    most: 1 << 20,
    allowed: "a table whose header names the columns load, count and, if wanted, contact_radius, with units in the cells or in the \
              name, such as \"load [kN]\"",
};
/// A heaviest axle below this was meant in larger units \[N\]: a bicycle's wheel.
const LIGHTEST: f64 = 1e3;

/// The force that an axle of so much mass weighs, and kips by their other name.
fn of_weight(word: &str) -> Option<&'static str> {
    match &*word.to_lowercase() {
        "kips" => Some("kip"),
        "kg" => Some("kgf"),
        "t" => Some("tf"),
        "lb" | "lbs" => Some("lbf"),
        _ => None,
    }
}

/// The value in SI of a number in a column of this kind, or what is allowed.
fn si(kind: Kind, digits: &str, unit: &str) -> Result<f64, String> {
    let quantity = match kind {
        LOAD => AXLE_LOAD,
        RADIUS => CONTACT_RADIUS,
        _ => AXLE_COUNT,
    };
    let value = match (quantity.dimension, unit) {
        (_, "") | (None, "%") => digits.parse().ok(),
        (None, _) => None,
        (Some(dimension), unit) => dimension.in_table(digits, of_weight(unit).unwrap_or(unit)),
    };
    let value = value.filter(|value| quantity.contains(*value));
    value.ok_or_else(|| quantity.allowed())
}

/// A file from the folder of the scene's file `name` on.
pub fn beside(name: &str, text: &str) -> PathBuf {
    Path::new(name).parent().unwrap_or(Path::new("")).join(text)
}

impl Histogram {
    fn options(&self) -> Result<Options> {
        let mut options = Options::default();
        // The first is the file.
        for (key, node) in Node::from(self.write(HISTOGRAM)).values("").iter().skip(1) {
            let written = node.written();
            let text = node.content.as_text().unwrap_or(&written);
            let wrong = |why| SceneError::value(&format!("{KEY}.{key}"), format!("\"{text}\""), why);
            options.set(key, text).map_err(wrong)?;
        }
        Ok(options)
    }

    /// The classes of the table, each a vehicle of one wheel in the first lane, at `speed` \[m/s\];
    /// `scene` is the file that names it.
    pub(crate) fn axles(&self, scene: &str, speed: f64) -> Result<Vec<TrafficVehicle>> {
        let table = Table::from_file(&beside(scene, &self.file), &self.options()?, &LAYOUT);
        table.and_then(|table| classes(table, speed)).map_err(|error| {
            let why = error.source().map(|why| format!(": {why}")).unwrap_or_default();
            let said = error.to_string() + &why;
            let (found, allowed) = said.split_once("; allowed: ").unwrap_or((&said, LAYOUT.allowed));
            SceneError::value(KEY, found, allowed)
        })
    }
}

fn classes(mut table: Table, speed: f64) -> Result<Vec<TrafficVehicle>, TableError> {
    let [count, share, load, radius] = [COUNT, SHARE, LOAD, RADIUS].map(|kind| table.one(kind));
    let (count, load, radius) = (count?.map_or(share, |count| Ok(Some(count)))?, load?, radius?);
    let (Some(count), Some(load)) = (count, load) else {
        return Ok(Vec::new());
    };
    // Axles and shares are numbers, whatever the header says of them.
    table.names[count].unit = None;
    let is_grouped = table.names.iter().any(|name| name.has(GROUP));
    let name = if is_grouped { AXLE_GROUP } else { AXLE };
    let (mut axles, mut heaviest) = (Vec::new(), None::<(f64, &Row)>);
    for row in rows(&table, count)? {
        let value = |column| table.value(row, column, column);
        let (share, force) = (value(count)?, value(load)?);
        let mut wheel = Wheel::default();
        (wheel.load, wheel.contact_radius) = (force, radius.map_or(Ok(0.0), value)?);
        // Classes that nothing was counted in are common.
        if share > 0.0 {
            let name = format!("{name} {}", axles.len() + 1);
            let mut axle = TrafficVehicle::point(&name, force, speed);
            (axle.share, axle.load, axle.wheels) = (share, None, vec![wheel]);
            axles.push(axle);
            if heaviest.is_none_or(|(most, _)| force > most) {
                heaviest = Some((force, row));
            }
        }
    }
    let Some((force, row)) = heaviest else {
        return Err(table.wrong(table.line, "no row with axles below the names", LAYOUT.allowed));
    };
    if axles.len() > MAX_CLASSES {
        let allowed = format!("at most {MAX_CLASSES} classes of axles");
        return Err(table.wrong(table.line, format!("{} classes", axles.len()), allowed));
    }
    match table.quantity(row, load, load)? {
        Some((cell, "")) if force < LIGHTEST => {
            let found = format!("load: {cell} N as the heaviest axle");
            let allowed = format!("a load with its unit, such as \"{cell} kN\", or a column \"load [kN]\"");
            Err(table.wrong(row.line, found, allowed))
        }
        _ => Ok(axles),
    }
}

/// The rows of classes of axles, without those that sum up the others.
fn rows(table: &Table, count: usize) -> Result<Vec<&Row>, TableError> {
    let is_class = |row: &&Row| {
        let label = row.cells.iter().find(|cell| !cell.is_empty());
        label.is_none_or(|label| !LAYOUT.name(label, &Options::default()).has(TOTAL))
    };
    let rows: Vec<&Row> = table.rows.iter().filter(is_class).collect();
    let is_bare = |row: &&&Row| !row.cell(count).contains('%');
    match rows.iter().find(is_bare) {
        Some(row) if !rows.iter().all(|row| is_bare(&row)) => {
            let found = format!("count: found \"{}\" among others in %", row.cell(count));
            Err(table.wrong(row.line, found, "all in %, or none"))
        }
        _ => Ok(rows),
    }
}
