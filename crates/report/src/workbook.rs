//! A run as a workbook. Its numbers are those of the JSON document, under the same names without the unit at their end; of clamps also the
//! largest.

mod measures;

use std::io;

use rust_xlsxwriter::XlsxError;
use serde_json::{Value, json};

use creepage_plan::shown::words_if;
use creepage_run::{Limited, Place, Run, Units, Verdict};
use creepage_scene::SceneFile;

use creepage_study::book::{Book, Cell, scene};
pub use measures::of_measures;

/// Parts of the document that stand on the first sheet, in their order. What is a table has a sheet of its own.
const ANSWER: [&str; 10] = [
    "saturation",
    "range",
    "random",
    "heat",
    "duct_motion",
    "slip_lengths",
    "error_estimate",
    "warnings",
    "plan",
    "cost",
];
/// Tables inside these, and another name of a part of the error for other programs.
const LEFT_OUT: [&str; 4] = ["cycle", "hot_profile", "cold_profile", "law"];

/// The file of a workbook: the answer, a row for each listed pass, the force along the cable, clamps, days where the cable is heated,
/// and the scene. Interpolated passes are marked.
///
/// # Errors
///
/// Where the answer cannot be written as a workbook: with more rows than Excel has.
pub fn of_run(run: &Run, verdicts: &[Verdict], file: &SceneFile, units: &Units) -> io::Result<Vec<u8>> {
    let document = serde_json::to_value(run)?;
    write(run, &document, verdicts, file, units).map_err(io::Error::other)
}

fn write(
    run: &Run,
    document: &Value,
    verdicts: &[Verdict],
    file: &SceneFile,
    units: &Units,
) -> Result<Vec<u8>, XlsxError> {
    let mut book = Book::new(&run.title)?;
    answer(&mut book, run, document, verdicts, units)?;
    let heat = &document["heat"];
    for (name, records) in [
        ("passes", &document["passes"]),
        ("days", &document["days"]),
        ("last day", &heat["cycle"]),
        ("force along", &along(&document["force_profile"])),
        ("hottest", &along(&heat["hot_profile"])),
        ("coldest", &along(&heat["cold_profile"])),
        ("clamps", &clamps(run, document)),
    ] {
        table(&mut book, name, records, units)?;
    }
    scene(&mut book, file)?;
    book.finish()
}

/// The name of a field, and its unit; what they are where the name has none.
fn named<'f>(field: &'f str, units: &Units) -> (&'f str, &'static str) {
    match (units.of_field(field), field) {
        (Some((name, unit)), _) => (name, unit.symbol()),
        (None, "years") => (field, "years"),
        (None, "hour") => (field, "h"),
        (None, "warming_k") => ("warming", "K"),
        (None, "dissipated_energy_j") => ("dissipated_energy", "J"),
        (None, _) => (field, ""),
    }
}

/// A value of a field in the unit of a reader.
fn cell(field: &str, value: &Value, units: &Units) -> Cell {
    match value {
        Value::Number(number) => number.as_f64().map_or(Cell::Absent, |si| {
            Cell::Number(units.of_field(field).map_or(si, |(_, unit)| unit.of_si(si)))
        }),
        Value::String(text) => Cell::Text(text.clone()),
        Value::Bool(truth) => Cell::Truth(*truth),
        _ => Cell::Absent,
    }
}

fn text(text: impl Into<String>) -> Cell {
    Cell::Text(text.into())
}

/// A value of a document: what it is, its field, and itself.
type Entry<'d> = (String, &'d str, &'d Value);

/// The values in `value` of a `field`, which is `name` to a reader, and in what it holds. Tables and lists of numbers are left out.
fn entries<'d>(name: &str, field: &'d str, value: &'d Value, units: &Units) -> Vec<Entry<'d>> {
    match value {
        Value::Object(fields) => {
            let fields = fields.iter().filter(|(field, _)| !LEFT_OUT.contains(&&***field));
            let inside = fields.flat_map(|(field, value)| {
                let own = named(field, units).0;
                let before = words_if(!name.is_empty(), ": ");
                entries(&format!("{name}{before}{own}"), field, value, units)
            });
            inside.collect()
        }
        Value::Array(items) => {
            let items = (1..).zip(items).filter(|(_, item)| !item.is_number());
            let inside = items.flat_map(|(number, item)| {
                let number = format!(" {number}");
                let number = words_if(item.is_object(), &number);
                entries(&format!("{name}{number}"), field, item, units)
            });
            inside.collect()
        }
        value => vec![(name.to_owned(), field, value)],
    }
}

fn answer(
    book: &mut Book,
    run: &Run,
    document: &Value,
    verdicts: &[Verdict],
    units: &Units,
) -> Result<(), XlsxError> {
    book.sheet("answer", &[("quantity", ""), ("value", ""), ("unit", "")])?;
    book.row([text("title"), text(&run.title)], false)?;
    let program = concat!("creepage ", env!("CARGO_PKG_VERSION"));
    book.row([text("computed by"), text(program)], false)?;
    for verdict in verdicts {
        book.row([text("limits"), text(verdict.shown(units))], false)?;
    }
    let last = document["passes"].as_array().and_then(|passes| passes.last());
    let last = last.map(|last| ("last pass", "", last));
    let parts = ANSWER.iter().map(|part| (*part, *part, &document[*part]));
    let all = last.into_iter().chain(parts);
    for (name, field, value) in all.flat_map(|(name, field, value)| entries(name, field, value, units)) {
        let row = match value {
            // It has its place, and says so.
            Value::Null if name == "saturation" => vec![text(name), text("none")],
            Value::Null => continue,
            value => vec![text(name), cell(field, value, units), text(named(field, units).1)],
        };
        book.row(row, false)?;
    }
    Ok(())
}

/// A sheet with a row for each record; none if there are no records.
fn table(book: &mut Book, name: &str, records: &Value, units: &Units) -> Result<(), XlsxError> {
    let records = records.as_array().into_iter().flatten();
    let records: Vec<Vec<Entry>> = records.map(|record| entries("", "", record, units)).collect();
    // What only some records have comes last.
    let mut columns: Vec<(&str, &str)> = Vec::new();
    for (name, field, _) in records.iter().flatten() {
        if !columns.iter().any(|(known, _)| known == name) {
            columns.push((name, named(field, units).1));
        }
    }
    if columns.is_empty() {
        return Ok(());
    }
    book.sheet(name, &columns)?;
    for record in &records {
        let of = |(column, _): &(&str, &str)| {
            let entry = record.iter().find(|(name, ..)| name == column);
            entry.map_or(Cell::Absent, |(_, field, value)| cell(field, value, units))
        };
        let is_marked = |(_, field, value): &Entry| *field == "interpolated" && **value == Value::Bool(true);
        book.row(columns.iter().map(of), record.iter().any(is_marked))?;
    }
    Ok(())
}

/// The clamps of the document, with what each comes to over all passes and days.
fn clamps(run: &Run, document: &Value) -> Value {
    let mut clamps = document["restraints"].clone();
    let records = clamps.as_array_mut().into_iter().flatten();
    for (record, clamp) in records.zip(&run.restraints) {
        let place = Place::Clamp(clamp.position_m);
        record["largest_force_n"] = run.largest(place, Limited::Force).into();
        record["largest_displacement_m"] = run.largest(place, Limited::Movement).into();
    }
    clamps
}

/// A record for each place of a profile of the force.
fn along(profile: &Value) -> Value {
    let list = |field: &str| profile[field].as_array().into_iter().flatten();
    let places = list("positions_m").zip(list("force_n"));
    places
        .map(|(place, force)| json!({ "position_m": place, "force_n": force }))
        .collect()
}
