//! Files as load cells, data loggers and spreadsheets write them: each is read right. What is refused stands in messages.rs and
//! readings.rs.

use creepage::readings::{Measured, Place, ReadOptions};
use creepage::{CableEnd, Readings};

use crate::command::assert_says;
use crate::scenes::{assert_near, upper};

/// The series that every readable shape holds: passes and forces \[N\].
const PASSES: [u64; 6] = [1, 2, 3, 5, 8, 13];
const FORCES: [f64; 6] = [94.1, 135.8, 160.25, 198.0, 240.5, 1286.7];

fn utf_16(text: &str, bytes: fn(u16) -> [u8; 2]) -> Vec<u8> {
    text.encode_utf16().flat_map(bytes).collect()
}

/// Options from words of the command line.
pub fn options(words: &str) -> ReadOptions {
    let mut options = ReadOptions::default();
    for word in words.split_whitespace() {
        let (key, value) = word.split_once('=').unwrap();
        let name = match key {
            "pass" | "vehicles" | "force" | "run" | "movement" | "position" => format!("column_{key}"),
            "header" => "header_line".into(),
            "start" => "run_start".into(),
            "tension" => "tension_positive".into(),
            key => key.to_owned(),
        };
        let value = value.replace('_', " ").replace("yes", "True");
        options.set(&name, &value).unwrap();
    }
    options
}

/// Shapes of the series: name ‖ header ‖ row ‖ options. `¶` ends a line; in a row {n} is the pass, {v} the vehicles since the reading
/// before, {t} two digits of a time, {f} the force, {c} with a decimal comma, {m} in millinewtons, {k} in kilonewtons, {kc} with a comma.
const SHAPES: &str = r#"
plain ‖ pass,force_n¶ ‖ {n},{f} ‖
semicolons and decimal commas ‖ Überfahrt;Kraft [N]¶ ‖ {n};{c} ‖
tabs ‖ pass⇥force_n¶ ‖ {n}⇥{f} ‖
bars ‖ pass|force_n¶ ‖ {n}|{f} ‖
spaces ‖ pass  force_n¶ ‖   {n}   {f} ‖
spaces and decimal commas ‖ pass force_n¶ ‖ {n} {c} ‖ separator=space
quoted decimal commas ‖ pass,force_n¶ ‖ {n},"{c}" ‖
capitals and spaces ‖  PASS , Force_N ¶ ‖  {n} , {f}  ‖
no header ‖ ‖ {n},{f} ‖
passes with decimals ‖ pass,force_n¶ ‖ {n}.0,{f} ‖
kilonewtons in words ‖ Überfahrten;Kraft in kN¶ ‖ {n};{kc} ‖
kilonewtons by option ‖ pass,force_n¶ ‖ {n},{k} ‖ unit=kN
decanewtons ‖ pass,force (daN)¶ ‖ {n},{d} ‖
units below the names ‖ pass,force¶-,kN¶ ‖ {n},{k} ‖
units in the cells ‖ pass,force¶ ‖ {n},{f} N ‖
names of one's own among others ‖ Nr;Zeit;Zelle 1¶ ‖ {n};09:{t};{c} ‖ pass=Nr force=Zelle_1
French ‖ passage;effort (N)¶ ‖ {n};{c} ‖
Japanese ‖ 通過回数,荷重[N]¶ ‖ {n},{f} ‖
a data logger's preamble ‖ Logger 7¶Station: duct 4, joint¶Rate;10 Hz¶Überfahrt;Kraft [N]¶ ‖ {n};{c} ‖
Excel's own separator ‖ sep=;¶Überfahrt;Kraft [N]¶ ‖ {n};{c} ‖
comments ‖ # load cell 3¶¶pass,force_n¶ ‖ {n},{f} ‖
times beside passes ‖ time,pass,force_n¶ ‖ 2025-12-24 17:{t},{n},{f} ‖
vehicles counted between times ‖ timestamp;vehicles;force_n¶ ‖ 24.12.2025 17:{t};{v};{c} ‖
tension positive ‖ pass,force_n¶ ‖ {n},-{f} ‖ tension=yes
the minus of typographers ‖ pass,force_n¶ ‖ {n},−{f} ‖ tension=yes
notes in a further column ‖ pass,force_n,remark¶ ‖ {n},{f},ok ‖
TOA5 of Campbell's loggers ‖ "TOA5","duct 4","CR1000X"¶"TIMESTAMP","pass","force"¶"TS","RN","N"¶"","","Avg"¶ ‖ "2025-12-24 17:{t}:00",{n},{f} ‖
a third row of a header ‖ pass;force¶-;N¶sensor;HBM C9¶ ‖ {n};{f} ‖ skip=2
a header of three rows by its line ‖ Logger;7¶Last;Station¶Nr;F¶-;N¶50 Hz;HBM¶ ‖ {n};{f} ‖ header=3 skip=2 pass=Nr force=F
X_Value beside passes ‖ X_Value,pass,force_n¶ ‖ {n}0,{n},{f} ‖
empty columns at the end ‖ pass,force_n,,¶ ‖ {n},{f},, ‖
millinewtons ‖ pass,Force mN¶ ‖ {n},{m} ‖
"#;

/// The file of a row of [`SHAPES`]: its name, text and options.
fn shape(row: &'static str) -> (&'static str, String, &'static str) {
    let [name, header, row, words] = row.split('‖').collect::<Vec<_>>()[..] else {
        panic!("{row}")
    };
    let plain = |text: &str| text.replace('¶', "\n").replace('⇥', "\t");
    // One blank belongs to the sign between the cells.
    let inner = |cell: &'static str| {
        cell.strip_prefix(' ')
            .and_then(|cell| cell.strip_suffix(' '))
            .unwrap_or("")
    };
    let mut before = 0;
    let lines = PASSES.iter().zip(FORCES).map(|(&n, f)| {
        let comma = |value: &str| value.replace('.', ",");
        let kilo = format!("{:.5}", f / 1e3);
        let mut line = plain(inner(row)) + "\n";
        for (sign, value) in [
            ("{n}", n.to_string()),
            ("{v}", (n - before).to_string()),
            ("{t}", format!("{n:02}")),
            ("{f}", f.to_string()),
            ("{c}", comma(&f.to_string())),
            ("{m}", (1e3 * f).to_string()),
            ("{d}", (f / 10.0).to_string()),
            ("{kc}", comma(&kilo)),
            ("{k}", kilo),
        ] {
            line = line.replace(sign, &value);
        }
        before = n;
        line
    });
    let text = plain(inner(header)) + &lines.collect::<String>();
    (name.trim(), text, words)
}

/// All shapes with their bytes: those of the table, and others of their bytes, line ends and signs.
fn shapes() -> Vec<(&'static str, Vec<u8>, &'static str)> {
    let rows = SHAPES.lines().filter(|row| !row.is_empty()).map(shape);
    let mut shapes: Vec<_> = rows
        .map(|(name, text, words)| (name, text.into_bytes(), words))
        .collect();
    let of = |name: &str| {
        let (_, bytes, _) = shapes.iter().find(|shape| shape.0 == name).expect(name);
        String::from_utf8(bytes.clone()).expect("UTF-8")
    };
    let [plain, german, japanese] = ["plain", "semicolons and decimal commas", "Japanese"].map(of);
    let (head, rows) = plain.split_once('\n').expect("a header");
    let turned: Vec<&str> = rows.lines().rev().collect();
    let shift_jis = encoding_rs::SHIFT_JIS
        .encode(&japanese.replace("[N]", "［Ｎ］"))
        .0
        .into_owned();
    let latin_1: Vec<u8> = german
        .chars()
        .map(|c| u8::try_from(u32::from(c)).unwrap())
        .collect();
    let marked = format!("\u{feff}{german}");
    let text = |text: String| text.into_bytes();
    #[rustfmt::skip]
    let others = [
        ("byte order mark", text(format!("\u{feff}{plain}")), ""),
        ("line ends of Windows", text(plain.replace('\n', "\r\n")), ""),
        ("line ends of old Macs", text(plain.replace('\n', "\r")), ""),
        ("comments at the end", text(format!("{plain}# end\n")), ""),
        ("rows in any order", text(format!("{head}\n{}", turned.join("\n"))), ""),
        ("thousands apart", text(german.replace("1286", "1.286")), ""),
        ("thousands by commas", text(plain.replace("1286.7", "\"1,286.7\"")), ""),
        ("UTF-16", utf_16(&marked, u16::to_le_bytes), ""),
        ("UTF-16, the other order", utf_16(&marked, u16::to_be_bytes), ""),
        ("UTF-16 without a mark", utf_16(&german, u16::to_le_bytes), ""),
        ("UTF-16 by option", utf_16(&german, u16::to_le_bytes), "encoding=utf-16"),
        ("Latin-1", latin_1.clone(), ""),
        ("Latin-1 by option", latin_1, "encoding=latin-1"),
        ("Shift_JIS", shift_jis, ""),
    ];
    shapes.extend(others);
    shapes
}

#[test]
fn every_shape_of_the_series_is_read_right() {
    let shapes = shapes();
    assert!(shapes.len() >= 35, "{}", shapes.len());
    for (name, bytes, words) in shapes {
        let data = Readings::from_bytes("cell.csv", &bytes, &options(words));
        let data = data.unwrap_or_else(|error| panic!("{name}: {error}"));
        let mut found = series(&data, 0);
        found.sort_by_key(|reading| reading.0);
        let passes: Vec<u64> = found.iter().map(|reading| reading.0).collect();
        assert_eq!(passes, PASSES, "{name}");
        for ((_, force), expected) in found.into_iter().zip(FORCES) {
            assert_near(force, expected, 1e-9, name);
        }
        assert!(data.notes.is_empty(), "{name}: {:?}", data.notes);
        assert_eq!((data.runs.len(), data.list.len()), (1, PASSES.len()), "{name}");
        let is_force = |(kind, _)| kind == Measured::Force(Place::Natural);
        assert!(kinds(&data).into_iter().all(is_force), "{name}");
    }
}

/// What was measured, and the value.
fn kinds(data: &Readings) -> Vec<(Measured, f64)> {
    let readings = data.list.iter();
    readings
        .map(|reading| (reading.measured, reading.value))
        .collect()
}

fn read(text: &str, words: &str) -> Readings {
    Readings::from_bytes("cell.csv", text.as_bytes(), &options(words))
        .unwrap_or_else(|error| panic!("{text}: {error}"))
}

fn values(data: &Readings) -> Vec<f64> {
    data.list.iter().map(|reading| reading.value).collect()
}

fn series(data: &Readings, run: usize) -> Vec<(u64, f64)> {
    let of_run = data.list.iter().filter(|reading| reading.run == run);
    of_run.map(|reading| (reading.passes, reading.value)).collect()
}

#[test]
fn cells_without_a_number_are_told_with_their_lines() {
    let words = "OVLD #NAME? 1.#QNAN No_Data n.v. k.A. BAD".split(' ');
    let rows: Vec<String> = words
        .map(|word| format!("5,{}\n", word.replace('_', " ")))
        .collect();
    let data = read(&format!("pass,force_n\n1,94\n{}4,170\n", rows.concat()), "");
    assert_eq!(values(&data), [94.0, 170.0]);
    assert!(data.notes[0].starts_with("7 cells"), "{:?}", data.notes);
    let data = read("pass,force_n\n1,94\n2,\n3,#N/A\n4,170\n5,---\n", "");
    assert_eq!(series(&data, 0), [(1, 94.0), (4, 170.0)]);
    let lines = ["line 3", "line 4 (\"#N/A\")", "line 6 (\"---\")"];
    assert_says(
        &data.notes.join("\n"),
        &[&["1 rows", "2 cells"], &lines[..]].concat(),
    );
    // Vehicles that passed while the cell failed are counted.
    let data = read(
        "time,vehicles,force_n\n9:00,0,0.2\n9:10,4,94\n9:20,3,\n9:30,5,170\n",
        "",
    );
    assert_eq!(series(&data, 0), [(0, 0.2), (4, 94.0), (12, 170.0)]);
}

#[test]
fn two_cells_and_a_transducer_in_one_file() {
    let rows = "1;0,05;0,094;0,3\n2;0,07;0,136;0,5\n";
    let head = "pass;Kraft upstream [kN];Kraft downstream [kN];movement [mm]";
    let found = kinds(&read(&format!("{head}\n{rows}"), ""));
    for ((measured, value), (kind, expected)) in found.iter().zip([
        (Measured::Force(Place::End(CableEnd::Upstream)), 50.0),
        (Measured::Force(Place::End(CableEnd::Downstream)), 94.0),
        (Measured::Movement(Place::Natural), 0.3e-3),
    ]) {
        assert_eq!(*measured, kind);
        assert_near(*value, expected, 1e-12, kind);
    }
    assert_eq!(found.len(), 6);
    // Names that say nothing of the end.
    let data = read("pass,A,B\n1,50,94\n", "force=upstream=A force=downstream=B");
    assert_eq!(kinds(&data)[0].0, Measured::Force(Place::End(CableEnd::Upstream)));
    // A table of this program's own runs: forces after the pass, not the peaks during it.
    let own = "pass,downstream_force_n,downstream_peak_n,upstream_force_n,upstream_peak_n,downstream_displacement_m\n1,94,99,0,2,0.001\n";
    assert_eq!(values(&read(own, "")), [94.0, 0.0]);
}

#[test]
fn places_along_the_cable() {
    for text in [
        "pass,force_n,position [m]\n1,94,10\n1,120,0\n",
        "pass,force_n,Position [mm]\n1,94,10000\n",
        "pass;force;Ort\n-;N;cm\n1;94;1000\n",
    ] {
        let found = kinds(&read(text, ""));
        assert_eq!(found[0], (Measured::Force(Place::At(10.0)), 94.0), "{text}");
        let other = (Measured::Force(Place::At(0.0)), 120.0);
        assert!(found[1..].iter().all(|found| *found == other), "{text}");
    }
    let strain = read("pass,strain [µm/m]\n1,12\n", "");
    assert_eq!(kinds(&strain), [(Measured::Strain(Place::Natural), 12e-6)]);
}

#[test]
fn runs_begin_at_rest_or_go_on() {
    let anew = "pass,force_n,run\n1,94,A\n2,135,A\n1,95,B\n2,136,B\n";
    let data = read(anew, "");
    assert_eq!(data.runs, ["A", "B"]);
    assert_eq!(series(&data, 1), [(1, 95.0), (2, 136.0)]);
    assert_says(&data.notes[0], &["2 runs, each from a cable at rest"]);
    let data = read(anew, "start=continue");
    assert_eq!(series(&data, 1), [(3, 95.0), (4, 136.0)]);
    assert_eq!(data.last_pass(), 4);
    // Passes that go on count on, whatever the run.
    let on = "pass,force_n,run\n1,94,A\n2,135,A\n3,150,B\n4,160,B\n";
    assert_eq!(series(&read(on, ""), 1), [(3, 150.0), (4, 160.0)]);
    assert_eq!(series(&read(on, "start=rest"), 1), [(1, 150.0), (2, 160.0)]);
    // Without a column the passes tell.
    let appended = "pass,force_n\n1,94\n2,135\n3,150\n1,95\n2,136\n3,151\n";
    let data = read(appended, "");
    assert_eq!(series(&data, 1), [(1, 95.0), (2, 136.0), (3, 151.0)]);
    assert!(data.notes[0].contains("begin anew on line 5"), "{:?}", data.notes);
    assert_eq!(series(&read(appended, "start=continue"), 1)[0], (4, 95.0));
}

#[test]
fn forces_a_thousand_times_too_small_are_told_with_the_option_that_reads_them() {
    let scene = upper(&["solver.node_spacing=0.3", "solver.vehicle_step=0.2"]);
    let told = |unit: f64| {
        let rows = [(1, 94.0), (2, 135.0), (5, 190.0), (10, 230.0)]
            .map(|(pass, force)| format!("{pass},{}\n", force / unit));
        let data = read(&format!("pass,force\n{}", rows.concat()), "");
        match creepage::calibrate(&scene, &data, &creepage::CalibrateOptions::default()) {
            Ok(fit) => fit.warnings.join("; "),
            Err(error) => error.to_string(),
        }
    };
    assert!(told(1e3).contains("--unit kN"), "{}", told(1e3));
    assert!(!told(1.0).contains("--unit"), "{}", told(1.0));
}

/// `tests/data/readings.xlsx` by `tests/data/readings_xlsx.py`: a workbook with a preamble, a unit in the header and a cell that failed.
#[test]
fn a_workbook_is_read() {
    let data = Readings::from_file("tests/data/readings.xlsx", &ReadOptions::default()).unwrap();
    let found = data
        .list
        .iter()
        .map(|reading| (reading.pass, (1e6 * reading.value).round() / 1e6, reading.line));
    assert!(found.eq([(0, 0.3, 4), (1, 94.1, 5), (2, 135.8, 6), (4, 170.0, 8)]));
    assert_says(&data.notes[0], &["line 7 (\"#N/A\")"]);
}

/// A workbook of rows with `¶` between them and `|` between cells, with these cells merged: first row and column, last row and column.
fn workbook(rows: &str, merged: &[[u32; 4]]) -> Vec<u8> {
    let mut book = rust_xlsxwriter::Workbook::new();
    let sheet = book.add_worksheet();
    for [top, left, bottom, right] in merged.iter().copied() {
        let (left, right) = (left as u16, right as u16);
        let format = rust_xlsxwriter::Format::new();
        sheet.merge_range(top, left, bottom, right, "", &format).unwrap();
    }
    for (line, cells) in (0..).zip(rows.split('¶')) {
        for (column, cell) in (0..).zip(cells.split('|')).filter(|(_, cell)| !cell.is_empty()) {
            match cell.parse::<f64>() {
                Ok(number) => sheet.write(line, column, number).unwrap(),
                Err(_) => sheet.write(line, column, cell).unwrap(),
            };
        }
    }
    book.save_to_buffer().unwrap()
}

/// A group over two cells, and a name over two rows; the kind in the group alone, units below; a unit below a merged name; a title over all
/// columns.
#[test]
fn a_header_of_merged_cells_is_read() {
    let (up, down) = (Place::End(CableEnd::Upstream), Place::End(CableEnd::Downstream));
    let both = &[(up, 50.0), (down, 94.0)][..];
    #[rustfmt::skip]
    let books = [
        ("pass|Force|¶|upstream [kN]|downstream [kN]¶1|0.05|0.094", &[[0, 0, 1, 0], [0, 1, 0, 2]][..], both),
        ("|Kraft|¶pass|up|down¶-|kN|kN¶1|0.05|0.094", &[[0, 1, 0, 2]], both),
        ("pass|force|remark¶|kN|¶1|0.05|ok", &[[0, 0, 1, 0], [0, 2, 1, 2]], &[(Place::Natural, 50.0)]),
        ("Force after each pass||¶pass|upstream force_kn|downstream force_kn¶1|0.05|0.094", &[[0, 0, 0, 2]], both),
    ];
    for (rows, merged, expected) in books {
        let read = Readings::from_bytes("cell.xlsx", &workbook(rows, merged), &ReadOptions::default());
        let read = read.unwrap_or_else(|error| panic!("{rows}: {error}"));
        let expected = expected
            .iter()
            .map(|&(place, force)| (Measured::Force(place), force));
        assert!(kinds(&read).into_iter().eq(expected), "{rows}");
    }
}
