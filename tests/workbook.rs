//! Workbooks: every number is that of the JSON document or the CSV table, in the unit below its name.

use std::fs;
use std::path::{Path, PathBuf};

use calamine::{Data, Range, Reader, Xlsx, open_workbook};
use creepage::readings::TableOptions;
use creepage::scene::Dimension;
use creepage::sweep::{Samples, Sweep};
use serde_json::Value;

use crate::command::{UPPER, answered, assert_says, folder, list, number, numbers, output, table};
use crate::scenes::largest;

/// Ends of the names of fields, by which JSON says its units.
const ENDS: [&str; 6] = ["", "_n", "_m", "_n_per_m", "_j", "_k"];

struct Book(Xlsx<std::io::BufReader<fs::File>>);

impl Book {
    fn open(file: &Path) -> Self {
        Self(open_workbook(file).expect("a workbook"))
    }

    #[track_caller]
    fn sheet(&mut self, name: &str) -> Range<Data> {
        self.0.worksheet_range(name).expect(name)
    }

    /// The value beside a name on the first sheet.
    #[track_caller]
    fn answer(&mut self, quantity: &str) -> (Data, String) {
        let sheet = self.sheet("answer");
        let row = sheet.rows().find(|row| row[0] == *quantity).expect(quantity);
        (row[1].clone(), row[2].to_string())
    }
}

/// The SI value of a number and its unit.
fn si(number: f64, unit: &str) -> f64 {
    if ["", "years", "J", "h"].contains(&unit) {
        return number;
    }
    let text = format!("{number:e} {unit}");
    let mut dimensions = Dimension::ALL.iter();
    dimensions
        .find_map(|dimension| dimension.parse(&text).ok())
        .unwrap_or_else(|| panic!("{text}"))
}

#[track_caller]
fn assert_same(cell: &Data, unit: &str, value: &Value) {
    match (cell, value) {
        (Data::Float(number), Value::Number(expected)) => {
            let expected = expected.as_f64().expect("a number");
            let found = si(*number, unit);
            let off = (found - expected).abs();
            assert!(off <= 1e-14 * expected.abs(), "{found} {expected}");
        }
        (Data::String(text), Value::String(expected)) => assert_eq!(text, expected),
        (Data::Bool(truth), Value::Bool(expected)) => assert_eq!(truth, expected),
        (Data::Empty, Value::Null) => {}
        other => panic!("{other:?}"),
    }
}

/// Every cell of a sheet below two rows of heads is what the records of the document hold, and every field has its column.
#[track_caller]
fn assert_records(sheet: &Range<Data>, records: &[Value], units: &[(&str, &str)]) {
    let rows: Vec<&[Data]> = sheet.rows().collect();
    let heads = rows[0].iter().zip(rows[1]);
    let heads: Vec<_> = heads
        .map(|(name, unit)| (name.to_string(), unit.to_string()))
        .collect();
    for (name, unit) in units {
        let found = heads.iter().find(|(found, _)| found == name);
        assert_eq!(found.map(|(_, unit)| &**unit), Some(*unit), "{name}");
    }
    assert_eq!(rows.len() - 2, records.len());
    for (row, record) in rows[2..].iter().zip(records) {
        let record = record.as_object().expect("a record");
        let mut known = 0;
        for ((name, unit), cell) in heads.iter().zip(*row) {
            let field = ENDS.iter().find_map(|end| record.get(&format!("{name}{end}")));
            known += usize::from(field.is_some());
            assert_same(cell, unit, field.unwrap_or(&Value::Null));
        }
        // A list is no cell.
        let single = record.values().filter(|value| !value.is_array()).count();
        assert_eq!(known, single, "{record:?}");
    }
}

/// The clamps of a document, with what each comes to over its passes.
fn clamps(document: &Value) -> Vec<Value> {
    let mut clamps = list(&document["restraints"]).to_vec();
    for clamp in &mut clamps {
        let largest = largest(numbers(&clamp["during_passes_n"]));
        let stiffness = number(&clamp["stiffness_n_per_m"]);
        clamp["largest_force_n"] = largest.into();
        clamp["largest_displacement_m"] = (largest / stiffness).into();
    }
    clamps
}

#[test]
fn a_run_is_its_document_in_the_units_that_were_typed() {
    let file = folder("run-book").join("run.xlsx");
    let line = "run UPPER --set 'duct.length=98 ft' --set traffic.passes=20000 --trucks-per-day 100 --set title==1+1 \
        --set 'restraints=[{ position = \"40 ft\", stiffness = \"2 kip/in\" }]' --limit-force 'downstream=0.2 lbf'";
    let (document, _) = answered(&format!("{line} --xlsx {}", file.display()));
    let mut book = Book::open(&file);
    let names = ["answer", "passes", "force along", "clamps", "scene"];
    assert_eq!(book.0.sheet_names(), names);

    let passes = list(&document["passes"]);
    let is_marked = |pass: &Value| pass["interpolated"] == Value::Bool(true);
    assert!(passes.iter().any(is_marked) && !passes.iter().all(is_marked));
    let units = [
        ("downstream_force", "lbf"),
        ("upstream_displacement", "in"),
        ("years", "years"),
        ("dissipated_energy", "J"),
        ("pass", ""),
    ];
    assert_records(&book.sheet("passes"), passes, &units);
    let clamps = clamps(&document);
    let units = [
        ("position", "ft"),
        ("stiffness", "kip/in"),
        ("force", "lbf"),
        ("largest_displacement", "in"),
    ];
    assert_records(&book.sheet("clamps"), &clamps, &units);

    let along = book.sheet("force along");
    let [places, forces] = ["positions_m", "force_n"].map(|name| list(&document["force_profile"][name]));
    assert_eq!(along.height() - 2, places.len());
    for (row, (place, force)) in along.rows().skip(2).zip(places.iter().zip(forces)) {
        assert_same(&row[0], "ft", place);
        assert_same(&row[1], "lbf", force);
    }

    // A text is no formula.
    assert_eq!(book.answer("title").0, Data::String("=1+1".into()));
    let last = &passes[passes.len() - 1];
    let of = |part: &str, field: &str| document[part][field].clone();
    for (quantity, value) in [
        ("saturation: force", of("saturation", "force_n")),
        ("duct_motion: peak_vertical", of("duct_motion", "peak_vertical_m")),
        ("error_estimate: relative", of("error_estimate", "relative")),
        ("plan: node_spacing", of("plan", "node_spacing_m")),
        ("plan: ground", of("plan", "ground")),
        ("last pass: downstream_force", last["downstream_force_n"].clone()),
    ] {
        let (cell, unit) = book.answer(quantity);
        assert_same(&cell, &unit, &value);
    }
    let (verdict, _) = book.answer("limits");
    assert_says(&verdict.to_string(), &["limit 0.2 lbf, first at pass 1"]);

    let parts = document["error_estimate"]["parts"].as_object().expect("parts");
    // `law` is another name of `passes`.
    for (name, value) in parts.iter().filter(|(name, _)| *name != "law") {
        let (cell, unit) = book.answer(&format!("error_estimate: parts: {name}"));
        assert_same(&cell, &unit, value);
    }
    let scene = book.sheet("scene");
    let row = |key: &str| scene.rows().find(|row| row[0] == *key).expect(key);
    let typed = ["98 ft", "--set duct.length=98 ft"].map(|text| Data::String(text.into()));
    assert_eq!(row("duct.length")[1..], typed);
    assert_eq!(row("ground.layers.0.poisson_ratio")[1], Data::Float(0.4));

    // What is said at the terminal is in the same units.
    assert_says(&output(line).1, &["lbf", "in,", "clamp at", "40 ft"]);
}

#[test]
fn days_of_heat_have_sheets_and_the_same_run_is_the_same_file() {
    let folder = folder("heat-book");
    let files = ["one.xlsx", "two.xlsx"].map(|name| folder.join(name));
    let line = "run UPPER --set 'heat={ expansion = \"17e-6 1/K\", daily_swing = \"10 K\" }' --trucks-per-day 6 \
        --set traffic.passes=18 --set solver.tolerance=0.1 --set 'ends.downstream={ spring = \"500 kN/m\" }'";
    let [document, _] = [0, 1].map(|k: usize| answered(&format!("{line} --xlsx {}", files[k].display())).0);
    let read = |file: &PathBuf| fs::read(file).expect("a file");
    assert!(read(&files[0]) == read(&files[1]), "byte for byte");
    let mut book = Book::open(&files[0]);
    let units = [("downstream_max", "kN"), ("upstream_displacement_min", "mm")];
    let days = list(&document["days"]);
    assert_eq!(days.len(), 3);
    assert_records(&book.sheet("days"), days, &units);
    let cycle = list(&document["heat"]["cycle"]);
    let units = [("hour", "h"), ("warming", "K"), ("downstream_force", "kN")];
    assert_records(&book.sheet("last day"), cycle, &units);
    for name in ["hottest", "coldest"] {
        assert!(book.sheet(name).height() > 10, "{name}");
    }
    let (most, unit) = book.answer("heat: all_days: downstream_max");
    assert_same(&most, &unit, &document["heat"]["all_days"]["downstream_max_n"]);
}

/// The names, units and rows of a sheet of a sweep.
fn sweep(file: &Path) -> (Vec<String>, Vec<String>, Vec<Vec<Data>>) {
    let sheet = Book::open(file).sheet("sweep");
    let mut rows = sheet.rows().map(<[Data]>::to_vec);
    let mut head = || {
        rows.next()
            .expect("a head")
            .iter()
            .map(ToString::to_string)
            .collect()
    };
    (head(), head(), rows.collect())
}

#[test]
fn a_sweep_is_its_table_in_the_units_that_were_typed() {
    let folder = folder("sweep-book");
    let [csv, xlsx, ducts] = ["out.csv", "out.xlsx", "ducts.csv"].map(|name| folder.join(name));
    let rows = "007,90 cm,3 kN/m,0.2\n=1+1,120 cm,,\n-,1 m,2 kN/m,-1\n";
    let head = "id,duct.depth,ends.downstream.spring,friction.dynamic_coefficient";
    fs::write(&ducts, format!("{head}\n{rows}")).expect("a list");
    for out in [&csv, &xlsx] {
        let (ducts, out) = (ducts.display(), out.display());
        let line = format!("sweep UPPER --set traffic.passes=2 --rows {ducts} --out {out}");
        assert_eq!(output(&line).0, 0);
    }
    let (names, units, rows) = sweep(&xlsx);
    let (headers, expected) = table(&csv);
    assert_eq!((names.len(), rows.len()), (headers.len(), expected.len()));
    assert_eq!((rows.len(), &*expected[1][0]), (3, "'=1+1"));
    for (name, unit) in [
        // The depth has two units.
        ("duct.depth", "m"),
        ("ends.downstream.spring", "kN/m"),
        ("downstream_force", "kN"),
        ("upstream_displacement", "mm"),
        ("error_estimate", ""),
    ] {
        let place = names.iter().position(|found| found == name).expect(name);
        assert_eq!(units[place], unit, "{name}");
    }
    for (row, expected) in rows.iter().zip(&expected) {
        for (place, text) in expected.iter().enumerate() {
            let (name, header) = (&names[place], &headers[place]);
            let is_same = ENDS.iter().any(|end| format!("{name}{end}") == *header);
            assert!(is_same, "{name} {header}");
            match (&row[place], text.parse::<f64>()) {
                (Data::Float(number), Ok(value)) => {
                    let found = si(*number, &units[place]);
                    assert!((found - value).abs() <= 1e-14 * value.abs(), "{found} {value}");
                }
                // CSV alone keeps spreadsheets from taking it for a formula.
                (Data::String(found), _) => assert_eq!(found, text.strip_prefix('\'').unwrap_or(text)),
                (Data::Empty, _) => assert_eq!(text, ""),
                other => panic!("{other:?}"),
            }
        }
    }
    // An id is a text, whatever it looks like.
    for (row, id) in rows.iter().zip(["007", "=1+1", "-"]) {
        assert_eq!(row[0], Data::String(id.into()));
    }
    let failed = rows[2].last().expect("an error").to_string();
    assert!(failed.contains("friction.dynamic_coefficient"), "{failed}");
}

#[test]
fn a_list_of_ducts_may_be_a_workbook_with_units_below_its_names() {
    let ducts = folder("rows-book").join("ducts.xlsx");
    let file = creepage::SceneFile::read(UPPER).expect("a scene");
    let read = || {
        let sweep = Sweep::of_rows(file.clone(), &ducts, &TableOptions::default(), Samples::default());
        sweep.expect("a list")
    };
    let write = |rows: &[&[Data]]| {
        let mut book = rust_xlsxwriter::Workbook::new();
        let sheet = book.add_worksheet();
        for (line, cells) in (0..).zip(rows) {
            for (place, cell) in (0..).zip(*cells) {
                match cell {
                    Data::Float(number) => sheet.write_number(line, place, *number),
                    cell => sheet.write_string(line, place, cell.to_string()),
                }
                .expect("a cell");
            }
        }
        book.save(&ducts).expect("a file");
    };
    let text = |text: &str| Data::String(text.into());
    write(&[
        &["id", "duct.depth", "ends.downstream"].map(text),
        &["", "ft", ""].map(text),
        &[text("A"), Data::Float(4.0), text("free")],
        &[Data::Float(7.0), text("1.5 m")],
    ]);
    let sweep = read();
    let [first, second] = [0, 1].map(|row| sweep.scene(row).expect("a scene"));
    assert!((first.duct.depth - 4.0 * 0.3048).abs() < 1e-15 && second.duct.depth == 1.5);
    assert_eq!(
        (sweep.count(), sweep.values(1).join("|")),
        (2, "7|1.5 m|".to_owned())
    );
    assert_eq!(first.ends.downstream, creepage::scene::End::Free);
    assert_eq!(second.ends, file.scene().expect("a scene").ends);

    // Without units numbers are SI; a text is read as one, whatever its name.
    write(&[&[text("duct.depth")], &[Data::Float(2.0)]]);
    assert_eq!(read().scene(0).expect("a scene").duct.depth, 2.0);
    fs::write(&ducts, "duct.depth\n2\n").expect("a file");
    assert_eq!(read().scene(0).expect("a scene").duct.depth, 2.0);
}
