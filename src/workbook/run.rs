//! A run as a workbook. Its numbers are those of the JSON document, under the same names without the unit at their end; of clamps also the
//! largest.

use std::io;

use rust_xlsxwriter::XlsxError;
use serde_json::Value;

use super::scene::scene;
use super::sheet::{Book, Cell};
use crate::{Limited, Place, Run, SceneFile, Units, Verdict};

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
/// Tables inside these.
const TABLES: [&str; 4] = ["cycle", "hot_profile", "cold_profile", "parts"];

/// The file of a workbook: the answer, a row for each listed pass, the force along the cable, clamps, days where the cable is heated, the
/// parts of the error, and the scene. Interpolated passes are marked.
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
    table(&mut book, "passes", &document["passes"], units)?;
    table(&mut book, "days", &document["days"], units)?;
    table(&mut book, "last day", &heat["cycle"], units)?;
    for (name, profile) in [
        ("force along", &document["force_profile"]),
        ("hottest", &heat["hot_profile"]),
        ("coldest", &heat["cold_profile"]),
    ] {
        along(&mut book, name, profile, units)?;
    }
    table(&mut book, "clamps", &clamps(run, document), units)?;
    errors(&mut book, document)?;
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

fn answer(
    book: &mut Book,
    run: &Run,
    document: &Value,
    verdicts: &[Verdict],
    units: &Units,
) -> Result<(), XlsxError> {
    book.sheet("answer", &[("quantity", ""), ("value", ""), ("unit", "")])?;
    book.widths(&[45.0, 25.0, 10.0])?;
    book.row([text("title"), text(&run.title)], false)?;
    let program = concat!("creepage ", env!("CARGO_PKG_VERSION"));
    book.row([text("computed by"), text(program)], false)?;
    for verdict in verdicts {
        book.row([text("limits"), text(verdict.shown(units))], false)?;
    }
    if let Some(last) = document["passes"].as_array().and_then(|passes| passes.last()) {
        leaves(book, "last pass", "", last, units)?;
    }
    for part in ANSWER {
        leaves(book, part, part, &document[part], units)?;
    }
    Ok(())
}

/// A row for each value that is no table; `path` says what it is, and `field` is its own name.
fn leaves(book: &mut Book, path: &str, field: &str, value: &Value, units: &Units) -> Result<(), XlsxError> {
    match value {
        Value::Object(fields) => {
            for (name, value) in fields.iter().filter(|(name, _)| !TABLES.contains(&name.as_str())) {
                let shown = named(name, units).0;
                leaves(book, &format!("{path}: {shown}"), name, value, units)?;
            }
            Ok(())
        }
        Value::Array(items) => items
            .iter()
            .try_for_each(|item| leaves(book, path, field, item, units)),
        // It has its place, and says so.
        Value::Null if path == "saturation" => book.row([text(path), text("none")], false),
        Value::Null => Ok(()),
        value => {
            let (_, unit) = named(field, units);
            book.row([text(path), cell(field, value, units), text(unit)], false)
        }
    }
}

/// A value of a record: the name of its column, its field, and itself.
type Entry<'d> = (String, &'d str, &'d Value);

/// The values of a record, those of records inside it too. Lists of numbers are no part of a row.
fn entries<'d>(before: &str, record: &'d Value, units: &Units) -> Vec<Entry<'d>> {
    let inside = |(field, value): (&'d String, &'d Value)| -> Vec<Entry<'d>> {
        let name = format!("{before}{}", named(field, units).0);
        match value {
            Value::Array(items) => (1..)
                .zip(items)
                .flat_map(|(number, item)| entries(&format!("{name} {number}: "), item, units))
                .collect(),
            Value::Object(_) => entries(&format!("{name}: "), value, units),
            value => vec![(name, field, value)],
        }
    };
    record
        .as_object()
        .into_iter()
        .flatten()
        .flat_map(inside)
        .collect()
}

/// A sheet with a row for each record; none where there are no records.
fn table(book: &mut Book, name: &str, records: &Value, units: &Units) -> Result<(), XlsxError> {
    let records: Vec<Vec<Entry>> = records
        .as_array()
        .into_iter()
        .flatten()
        .map(|record| entries("", record, units))
        .collect();
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
        let is_marked = record
            .iter()
            .any(|(_, field, value)| *field == "interpolated" && **value == Value::Bool(true));
        book.row(columns.iter().map(of), is_marked)?;
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

/// A sheet with the force along the cable; none where that is not known.
fn along(book: &mut Book, name: &str, profile: &Value, units: &Units) -> Result<(), XlsxError> {
    let numbers = |field: &str| -> Vec<Cell> {
        let values = profile[field].as_array().into_iter().flatten();
        values.map(|value| cell(field, value, units)).collect()
    };
    let (places, forces) = (numbers("positions_m"), numbers("force_n"));
    if places.is_empty() {
        return Ok(());
    }
    let columns = [
        ("position", units.length.symbol()),
        ("force", units.force.symbol()),
    ];
    book.sheet(name, &columns)?;
    let mut rows = places.into_iter().zip(forces);
    rows.try_for_each(|(place, force)| book.row([place, force], false))
}

/// The parts of the error.
fn errors(book: &mut Book, document: &Value) -> Result<(), XlsxError> {
    book.sheet("error", &[("part", ""), ("share", ""), ("of", "")])?;
    book.widths(&[20.0, 12.0, 40.0])?;
    let estimate = &document["error_estimate"];
    let share = |value: &Value| value.as_f64().map_or(Cell::Absent, Cell::Share);
    let whole = [text("all"), share(&estimate["relative"]), text("a force")];
    book.row(whole, false)?;
    // Another name of `passes`, for other programs.
    let parts = estimate["parts"].as_object().into_iter().flatten();
    for (name, value) in parts.filter(|(name, _)| *name != "law") {
        let of = match name.as_str() {
            "movement" => "the largest movement; not in the sum",
            _ => "a force",
        };
        book.row([text(name), share(value), text(of)], false)?;
    }
    Ok(())
}
