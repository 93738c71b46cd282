//! Files as load cells, data loggers and spreadsheets write them: each is read right, or refused with the cause named.

use creepage::readings::{Measured, Place, ReadOptions};
use creepage::{CableEnd, Reading, Readings};

/// The series that every readable shape holds: passes and forces \[N\].
const PASSES: [u64; 6] = [1, 2, 3, 5, 8, 13];
const FORCES: [f64; 6] = [94.1, 135.8, 160.25, 198.0, 240.5, 1286.7];

/// A file of the series, one row a reading.
fn rows(header: &str, row: impl Fn(u64, f64) -> String) -> String {
    let lines = PASSES.iter().zip(FORCES).map(|(&pass, force)| row(pass, force));
    header.to_owned() + &lines.collect::<Vec<_>>().join("\n") + "\n"
}

fn comma(value: f64) -> String {
    value.to_string().replace('.', ",")
}

fn utf_16(text: &str, marked: bool, big: bool) -> Vec<u8> {
    let units = marked.then_some(0xFEFF).into_iter().chain(text.encode_utf16());
    units
        .flat_map(|unit| {
            if big {
                unit.to_be_bytes()
            } else {
                unit.to_le_bytes()
            }
        })
        .collect()
}

fn latin_1(text: &str) -> Vec<u8> {
    text.chars()
        .map(|c| u8::try_from(u32::from(c)).unwrap())
        .collect()
}

/// Options from words of the command line.
fn options(words: &str) -> ReadOptions {
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
        options
            .set(&name, &value.replace('_', " ").replace("yes", "True"))
            .unwrap();
    }
    options
}

/// Shapes of the series: name, bytes, options.
#[allow(clippy::too_many_lines, reason = "a table")]
fn shapes() -> Vec<(&'static str, Vec<u8>, &'static str)> {
    let plain = rows("pass,force_n\n", |n, f| format!("{n},{f}"));
    let german = rows("Überfahrt;Kraft [N]\n", |n, f| format!("{n};{}", comma(f)));
    let text = |text: &str| text.as_bytes().to_vec();
    let row = |header: &str, row: &dyn Fn(u64, f64) -> String| rows(header, row).into_bytes();
    let kilo = |f: f64| format!("{:.5}", f / 1e3);
    let mut total = 0;
    let mut between = |n: u64| {
        let vehicles = n - total;
        total = n;
        vehicles
    };
    let counted: Vec<u64> = PASSES.iter().map(|&n| between(n)).collect();
    let counted = |n: u64| counted[PASSES.iter().position(|&other| other == n).unwrap()];
    vec![
        ("plain", text(&plain), ""),
        ("byte order mark", text(&format!("\u{feff}{plain}")), ""),
        ("line ends of Windows", text(&plain.replace('\n', "\r\n")), ""),
        ("line ends of old Macs", text(&plain.replace('\n', "\r")), ""),
        ("semicolons and decimal commas", text(&german), ""),
        (
            "semicolons and points",
            row("pass;force_n\n", &|n, f| format!("{n};{f}")),
            "",
        ),
        ("tabs", row("pass\tforce_n\n", &|n, f| format!("{n}\t{f}")), ""),
        (
            "tabs and decimal commas",
            row("pass\tforce_n\n", &|n, f| format!("{n}\t{}", comma(f))),
            "",
        ),
        ("bars", row("pass|force_n\n", &|n, f| format!("{n}|{f}")), ""),
        (
            "spaces",
            row("pass  force_n\n", &|n, f| format!("  {n:>4}   {f:>9}")),
            "",
        ),
        (
            "spaces and decimal commas",
            row("pass force_n\n", &|n, f| format!("{n} {}", comma(f))),
            "separator=space",
        ),
        (
            "quoted decimal commas",
            row("pass,force_n\n", &|n, f| format!("{n},\"{}\"", comma(f))),
            "",
        ),
        (
            "quoted cells",
            row("\"pass\",\"force_n\"\n", &|n, f| format!("\"{n}\",\"{f}\"")),
            "",
        ),
        (
            "capitals and spaces",
            row(" PASS , Force_N \n", &|n, f| format!(" {n} , {f} ")),
            "",
        ),
        ("no header", row("", &|n, f| format!("{n},{f}")), ""),
        (
            "no header, decimal commas",
            row("", &|n, f| format!("{n};{}", comma(f))),
            "",
        ),
        (
            "passes with decimals",
            row("pass,force_n\n", &|n, f| format!("{n}.0,{f}")),
            "",
        ),
        (
            "kilonewtons in the name",
            row("pass,force_kn\n", &|n, f| format!("{n},{}", kilo(f))),
            "",
        ),
        (
            "kilonewtons in brackets",
            row("Pass;Force [kN]\n", &|n, f| format!("{n};{}", comma(f / 1e3))),
            "",
        ),
        (
            "kilonewtons in words",
            row("Überfahrten;Kraft in kN\n", &|n, f| {
                format!("{n};{}", comma(f / 1e3))
            }),
            "",
        ),
        (
            "kilonewtons by option",
            row("pass,force_n\n", &|n, f| format!("{n},{}", kilo(f))),
            "unit=kN",
        ),
        (
            "decanewtons",
            row("pass,force (daN)\n", &|n, f| format!("{n},{}", f / 10.0)),
            "",
        ),
        (
            "units below the names",
            row("pass,force\n-,kN\n", &|n, f| format!("{n},{}", kilo(f))),
            "",
        ),
        (
            "units in the cells",
            row("pass,force\n", &|n, f| format!("{n},{f} N")),
            "",
        ),
        (
            "thousands apart",
            row("pass;force_n\n", &|n, f| {
                format!("{n};{}", comma(f).replace("1286", "1.286"))
            }),
            "",
        ),
        (
            "thousands by commas",
            row("pass,force_n\n", &|n, f| {
                format!("{n},\"{}\"", f.to_string().replace("1286", "1,286"))
            }),
            "",
        ),
        (
            "names of one's own",
            row("A,B\n", &|n, f| format!("{n},{f}")),
            "pass=A force=B",
        ),
        (
            "names of one's own among others",
            row("Nr;Zeit;Zelle 1\n", &|n, f| format!("{n};09:{n:02};{}", comma(f))),
            "pass=Nr force=Zelle_1",
        ),
        (
            "French",
            row("passage;effort (N)\n", &|n, f| format!("{n};{}", comma(f))),
            "",
        ),
        (
            "Japanese",
            row("通過回数,荷重[N]\n", &|n, f| format!("{n},{f}")),
            "",
        ),
        ("UTF-16", utf_16(&german, true, false), ""),
        (
            "UTF-16, the other order of bytes",
            utf_16(&german, true, true),
            "",
        ),
        ("UTF-16 without a mark", utf_16(&german, false, false), ""),
        (
            "UTF-16 by option",
            utf_16(&german, false, false),
            "encoding=utf-16",
        ),
        ("Latin-1", latin_1(&german), ""),
        ("Latin-1 by option", latin_1(&german), "encoding=latin-1"),
        (
            "a data logger's preamble",
            text(&format!("Logger 7\nStation: duct 4, joint\nRate;10 Hz\n{german}")),
            "",
        ),
        ("Excel's own separator", text(&format!("sep=;\n{german}")), ""),
        ("comments", text(&format!("# load cell 3\n\n{plain}# end\n")), ""),
        (
            "times beside passes",
            row("time,pass,force_n\n", &|n, f| {
                format!("2025-12-24 17:{n:02},{n},{f}")
            }),
            "",
        ),
        (
            "vehicles counted between times",
            row("timestamp;vehicles;force_n\n", &|n, f| {
                format!("24.12.2025 17:{n:02};{};{}", counted(n), comma(f))
            }),
            "",
        ),
        (
            "vehicles by option",
            row("t;lorries;force_n\n", &|n, f| {
                format!("{n};{};{}", counted(n), comma(f))
            }),
            "vehicles=lorries",
        ),
        (
            "tension positive",
            row("pass,force_n\n", &|n, f| format!("{n},-{f}")),
            "tension=yes",
        ),
        (
            "the minus of typographers",
            row("pass,force_n\n", &|n, f| format!("{n},−{f}")),
            "tension=yes",
        ),
        (
            "notes in a further column",
            row("pass,force_n,remark\n", &|n, f| format!("{n},{f},ok")),
            "",
        ),
        (
            "Shift_JIS",
            encoding_rs::SHIFT_JIS
                .encode(&rows("通過回数,荷重［Ｎ］\n", |n, f| format!("{n},{f}")))
                .0
                .into_owned(),
            "",
        ),
        (
            "TOA5 of Campbell's loggers",
            row(
                "\"TOA5\",\"duct 4\",\"CR1000X\"\n\"TIMESTAMP\",\"pass\",\"force\"\n\"TS\",\"RN\",\"N\"\n\"\",\"\",\"Avg\"\n",
                &|n, f| format!("\"2025-12-24 17:{n:02}:00\",{n},{f}"),
            ),
            "",
        ),
        (
            "a third row of a header",
            row("pass;force\n-;N\nsensor;HBM C9\n", &|n, f| format!("{n};{f}")),
            "skip=2",
        ),
        (
            "tildes before a header of three rows",
            row("~pass;force\n~-;N\n~sensor;HBM C9\n", &|n, f| format!("{n};{f}")),
            "skip=2",
        ),
        (
            "a header of three rows by its line",
            row("Logger;7\nLast;Station\nNr;F\n-;N\n50 Hz;HBM\n", &|n, f| {
                format!("{n};{f}")
            }),
            "header=3 skip=2 pass=Nr force=F",
        ),
        (
            "a header by its line",
            row("pass;force\nNr;F\n", &|n, f| format!("{n};{f}")),
            "header=2 pass=Nr force=F",
        ),
        (
            "X_Value beside passes",
            row("X_Value,pass,force_n\n", &|n, f| format!("{},{n},{f}", 10 * n)),
            "",
        ),
        (
            "empty columns at the end",
            row("pass,force_n,,\n", &|n, f| format!("{n},{f},,")),
            "",
        ),
        (
            "millinewtons",
            row("pass,Force mN\n", &|n, f| format!("{n},{}", 1e3 * f)),
            "",
        ),
        (
            "rows in any order",
            text(
                &(plain
                    .lines()
                    .take(1)
                    .chain(plain.lines().skip(1).collect::<Vec<_>>().into_iter().rev())
                    .collect::<Vec<_>>()
                    .join("\n")),
            ),
            "",
        ),
    ]
}

#[test]
fn every_shape_of_the_series_is_read_right() {
    let shapes = shapes();
    assert!(shapes.len() >= 40, "{}", shapes.len());
    for (name, bytes, words) in shapes {
        let data = Readings::from_bytes("cell.csv", &bytes, &options(words))
            .unwrap_or_else(|error| panic!("{name}: {error}"));
        let mut found: Vec<(u64, f64)> = data
            .readings()
            .iter()
            .map(|reading| (reading.pass, reading.value))
            .collect();
        found.sort_by_key(|reading| reading.0);
        assert_eq!(found.len(), PASSES.len(), "{name}: {found:?}");
        for ((pass, force), (&n, f)) in found.iter().zip(PASSES.iter().zip(FORCES)) {
            assert!(
                *pass == n && (force / f - 1.0).abs() < 1e-9,
                "{name}: {pass} {force}"
            );
        }
        assert!(
            data.notes().is_empty() && data.runs().len() == 1,
            "{name}: {:?}",
            data.notes()
        );
        assert!(
            data.readings()
                .iter()
                .all(|reading| reading.measured == Measured::Force(Place::Natural)),
            "{name}"
        );
    }
}

/// A file, ¶ for an end of line and ⇥ for a tab ‖ options ‖ parts of the message
const REFUSED: &str = r#"
pass,force_n¶1,94,1¶2,135,8¶3,160,2¶ ‖ - ‖ cell.csv:2 ‖ 3 cells ‖ decimal comma
1,94,1¶2,135,8¶3,160,2¶ ‖ - ‖ cell.csv:1 ‖ decimal comma
pass;force_n¶1;94,1¶ ‖ separator=comma ‖ cell.csv:1 ‖ no column pass in "pass;force_n" (read as separated by commas
pass⇥force_n¶1⇥94.1¶ ‖ separator=semicolon ‖ cell.csv:1 ‖ (read as separated by semicolons
pass;force_n¶1;94,1¶2;135.8¶ ‖ - ‖ cell.csv:3 ‖ 135.8 ‖ decimals after a comma
pass;force_n¶1;1,113¶2;2,450¶ ‖ - ‖ cell.csv:2 ‖ 1,113 ‖ --decimal
Nr;Zelle¶1;94,1¶ ‖ - ‖ no column pass ‖ Nr | Zelle ‖ --column-pass
pass,cell¶1,94¶ ‖ - ‖ no column force_n ‖ pass | cell ‖ --column-force
pass,force_n¶1,94¶ ‖ force=Kraft ‖ no column Kraft
pass,force [V]¶1,94¶ ‖ - ‖ force [V] ‖ `V` ‖ --unit
pass,force_n¶1,94¶ ‖ unit=kNm ‖ --unit ‖ `kNm`
pass,force 1 [N],force 2 [N]¶1,94,95¶ ‖ - ‖ second column force 2 ‖ --column-force
time,force_n¶09:00,94¶09:05,95¶ ‖ - ‖ times ‖ --column-vehicles
time,vehicles,force_n¶09:00,5,94¶08:55,7,95¶ ‖ - ‖ cell.csv:3 ‖ "08:55" ‖ rows in the order of their times
vehicles,force_n¶3,1¶5,2¶9,3¶12,4¶20,5¶ ‖ - ‖ running total ‖ --column-pass
pass,force_n¶1,94¶2,many¶ ‖ - ‖ cell.csv:3 ‖ force_n ‖ many
pass,force_n¶1,94 m¶ ‖ - ‖ cell.csv:2 ‖ 94 m ‖ unit
pass,force_n¶1.5,94¶ ‖ - ‖ cell.csv:2 ‖ 1.5 ‖ whole number
pass,force_n¶0,0.3¶ ‖ - ‖ cell.csv:2 ‖ at least one pass
pass,force_n¶1,NaN¶2,#N/A¶ ‖ - ‖ cell.csv:2 ‖ NaN ‖ no number anywhere
pass,force_n,sigma_n¶1,94,4¶2,135,¶ ‖ - ‖ cell.csv:3 ‖ sigma_n is blank
pass,force_n¶1,113¶2,many¶ ‖ - ‖ cell.csv:3: force_n: found "many"
pass,force_n¶1,113¶¶-2,150¶ ‖ - ‖ cell.csv:4: pass: found "-2"
pass,force_n¶0,113¶ ‖ - ‖ cell.csv:2: pass: found "0"
pass,force_n¶1.5,113¶ ‖ - ‖ cell.csv:2: pass: found "1.5"
pass,force_n¶,113¶ ‖ - ‖ cell.csv:2: pass: found ""
pass,force_n¶1,NaN¶ ‖ - ‖ cell.csv:2: force_n: found "NaN"
pass,force_n¶1,inf¶ ‖ - ‖ cell.csv:2: force_n: found "inf"
pass,force_n¶1e300,5¶ ‖ - ‖ cell.csv:2: pass: found "1e300"
pass,force_n,sigma_n¶1,5,0¶ ‖ - ‖ cell.csv:2: sigma_n: found "0"
pass,force_n,sigma_n¶1,5,-1¶ ‖ - ‖ cell.csv:2: sigma_n: found "-1"
pass,force_n,sigma_n¶1,5,1¶2,6,¶ ‖ - ‖ cell.csv:3: sigma_n is blank
number,force¶1,5¶ ‖ - ‖ cell.csv:1: no column pass
# none¶pass,newtons¶1,5¶ ‖ - ‖ cell.csv:2: no column force_n
pass,force_n,pass¶1,5,1¶ ‖ - ‖ cell.csv:1: a second column pass
# only this¶¶ ‖ - ‖ cell.csv: no rows
pass,force_n¶ ‖ - ‖ cell.csv: no rows
pass,force_n,position¶1,94,joint¶ ‖ - ‖ cell.csv:2 ‖ position ‖ joint
pass;force_n¶1;1.140¶2;1.520¶ ‖ - ‖ cell.csv:2 ‖ 1.14 or 1140 ‖ --decimal
pass;force_n¶1;94¶2¶ ‖ - ‖ cell.csv:3 ‖ 1 cells where the first row has 2
x,force_n¶1,94¶ ‖ - ‖ no column pass
Station 4, joint¶number,cell force¶1,94¶ ‖ - ‖ cell.csv:2 ‖ no column pass
pass,force_n¶1,94¶ ‖ header=7 ‖ cell.csv:7 ‖ nothing
pass,deflection [um],position [m]¶1,115,3¶ ‖ - ‖ cell.csv:2 ‖ a place beside a deflection ‖ under the first vehicle
pass,force_n¶1,3000-3999¶ ‖ - ‖ cell.csv:2: force_n: found "3000-3999"
pass,force_n¶Total,3000¶ ‖ - ‖ cell.csv:2: pass: found "Total"
pass,A,A¶1,94,95¶ ‖ force=A ‖ second column A
pass;force_n¶1;0,113¶2;1.5¶ ‖ - ‖ cell.csv:3 ‖ 1.5 ‖ decimals after a comma
"#;

/// What is wrong is named: the file, words that the message holds.
#[test]
fn what_cannot_be_read_is_refused_with_its_cause() {
    for row in REFUSED.lines().filter(|row| !row.is_empty()) {
        let [text, words, ref parts @ ..] = row.split(" ‖ ").collect::<Vec<_>>()[..] else {
            panic!("{row}")
        };
        let text = text.replace('¶', "\n").replace('⇥', "\t");
        let error = Readings::from_bytes(
            "cell.csv",
            text.as_bytes(),
            &options(words.trim_start_matches('-')),
        )
        .expect_err(&text)
        .to_string();
        for part in parts {
            assert!(error.contains(part), "{text:?}: no {part:?} in {error}");
        }
    }
    let no_text = Readings::from_csv("photo.jpg", &[0xFF, 0xD8, 0xFF, 0xE0, 0, 16, 1, 2]).unwrap_err();
    assert!(no_text.to_string().contains("no text"), "{no_text}");
    let archive = Readings::from_csv("notes.docx", b"PK\x03\x04 and more").unwrap_err();
    assert!(archive.to_string().contains("cannot be read"), "{archive}");
}

fn read(text: &str, words: &str) -> Readings {
    Readings::from_bytes("cell.csv", text.as_bytes(), &options(words))
        .unwrap_or_else(|error| panic!("{text}: {error}"))
}

fn series(data: &Readings, run: usize) -> Vec<(u64, f64)> {
    let of_run = data.readings().iter().filter(|reading| reading.run == run);
    of_run.map(|reading| (reading.passes, reading.value)).collect()
}

#[test]
fn cells_without_a_number_are_told_with_their_lines() {
    let words = "OVLD #NAME? 1.#QNAN No_Data n.v. k.A. BAD";
    let rows = words
        .split(' ')
        .zip(5..)
        .map(|(word, pass)| format!("{pass},{}\n", word.replace('_', " ")));
    let data = read(
        &format!("pass,force_n\n1,94\n{}4,170\n", rows.collect::<String>()),
        "",
    );
    assert_eq!((data.values(), data.skipped()), (vec![94.0, 170.0], 7));
    let data = read("pass,force_n\n1,94\n2,\n3,#N/A\n4,170\n5,---\n", "");
    assert_eq!(series(&data, 0), [(1, 94.0), (4, 170.0)]);
    assert_eq!(data.skipped(), 3);
    let notes = data.notes().join("\n");
    for part in [
        "1 rows without a force",
        "line 3",
        "line 4 (\"#N/A\")",
        "line 6 (\"---\")",
    ] {
        assert!(notes.contains(part), "{notes}");
    }
}

/// Vehicles that passed while the cell failed are counted.
#[test]
fn vehicles_count_where_the_force_is_missing() {
    let data = read(
        "time,vehicles,force_n\n9:00,0,0.2\n9:10,4,94\n9:20,3,\n9:30,5,170\n",
        "",
    );
    assert_eq!(series(&data, 0), [(0, 0.2), (4, 94.0), (12, 170.0)]);
}

#[test]
fn two_cells_and_a_transducer_in_one_file() {
    let text =
        "pass;Kraft upstream [kN];Kraft downstream [kN];movement [mm]\n1;0,05;0,094;0,3\n2;0,07;0,136;0,5\n";
    let data = read(text, "");
    let found: Vec<(Measured, f64)> = data
        .readings()
        .iter()
        .map(|reading| (reading.measured, reading.value))
        .collect();
    let expected = [
        (Measured::Force(Place::End(CableEnd::Upstream)), 50.0),
        (Measured::Force(Place::End(CableEnd::Downstream)), 94.0),
        (Measured::Movement(Place::Natural), 0.3e-3),
    ];
    for ((measured, value), (kind, expected)) in found.iter().zip(expected) {
        assert!(
            *measured == kind && (value / expected - 1.0).abs() < 1e-12,
            "{found:?}"
        );
    }
    assert_eq!(found.len(), 6);
    // Names that say nothing of the end.
    let data = read("pass,A,B\n1,50,94\n", "force=upstream=A force=downstream=B");
    assert_eq!(
        data.readings()[0].measured,
        Measured::Force(Place::End(CableEnd::Upstream))
    );
    // A table of this program's own runs: forces after the pass, not the peaks during it.
    let own = "pass,downstream_force_n,downstream_peak_n,upstream_force_n,upstream_peak_n,downstream_displacement_m\n1,94,99,0,2,0.001\n";
    assert_eq!(read(own, "").values(), [94.0, 0.0]);
}

#[test]
fn places_along_the_cable() {
    let data = read("pass,force_n,position [m]\n1,94,10\n1,120,0\n", "");
    let places: Vec<Measured> = data.readings().iter().map(|reading| reading.measured).collect();
    assert_eq!(
        places,
        [Measured::Force(Place::At(10.0)), Measured::Force(Place::At(0.0))]
    );
    for text in [
        "pass,force_n,Position [mm]\n1,94,10000\n",
        "pass;force;Ort\n-;N;cm\n1;94;1000\n",
    ] {
        assert_eq!(
            read(text, "").readings()[0].measured,
            Measured::Force(Place::At(10.0)),
            "{text}"
        );
    }
    let strain = read("pass,strain [µm/m]\n1,12\n", "");
    assert_eq!(
        (strain.readings()[0].measured, strain.values()[0]),
        (Measured::Strain(Place::Natural), 12e-6)
    );
}

#[test]
fn runs_begin_at_rest_or_go_on() {
    let anew = "pass,force_n,run\n1,94,A\n2,135,A\n1,95,B\n2,136,B\n";
    let data = read(anew, "");
    assert_eq!(data.runs(), ["A", "B"]);
    assert_eq!(series(&data, 1), [(1, 95.0), (2, 136.0)]);
    assert!(
        data.notes()[0].contains("2 runs, each from a cable at rest"),
        "{:?}",
        data.notes()
    );
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
    assert!(
        data.notes()[0].contains("begin anew on line 5"),
        "{:?}",
        data.notes()
    );
    assert_eq!(series(&read(appended, "start=continue"), 1)[0], (4, 95.0));
}

#[test]
fn forces_a_thousand_times_too_small_are_told_with_the_option_that_reads_them() {
    let scene = creepage::Scene::from_file("examples/scenes/full-scale-upper.toml").unwrap();
    let told = |unit: f64| {
        let forces = [(1, 94.0), (2, 135.0), (5, 190.0), (10, 230.0)];
        let rows: Vec<String> = forces
            .iter()
            .map(|(pass, force)| format!("{pass},{}", force / unit))
            .collect();
        let data = read(&format!("pass,force\n{}\n", rows.join("\n")), "");
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
    let found: Vec<(u64, f64, u64)> = data
        .readings()
        .iter()
        .map(|r: &Reading| (r.pass, (1e6 * r.value).round() / 1e6, r.line))
        .collect();
    assert_eq!(found, [(0, 0.3, 4), (1, 94.1, 5), (2, 135.8, 6), (4, 170.0, 8)]);
    assert!(
        data.notes()[0].contains("line 7 (\"#N/A\")"),
        "{:?}",
        data.notes()
    );
}

/// Rows of a workbook, with these of their cells merged: first row and column, last row and column.
fn workbook(rows: &[&[&str]], merged: &[[u32; 4]]) -> Vec<u8> {
    let mut book = rust_xlsxwriter::Workbook::new();
    let sheet = book.add_worksheet();
    for [top, left, bottom, right] in merged.iter().copied() {
        let (left, right) = (left as u16, right as u16);
        let format = rust_xlsxwriter::Format::new();
        sheet.merge_range(top, left, bottom, right, "", &format).unwrap();
    }
    for (line, cells) in (0..).zip(rows) {
        for (column, cell) in (0..).zip(*cells).filter(|(_, cell)| !cell.is_empty()) {
            match cell.parse::<f64>() {
                Ok(number) => sheet.write(line, column, number).unwrap(),
                Err(_) => sheet.write(line, column, *cell).unwrap(),
            };
        }
    }
    book.save_to_buffer().unwrap()
}

#[test]
fn a_header_of_merged_cells_is_read() {
    let (up, down) = (Place::End(CableEnd::Upstream), Place::End(CableEnd::Downstream));
    let data = ["1", "0.05", "0.094"];
    for (name, rows, merged, expected) in [
        (
            "a group over two cells, and a name over two rows",
            &[
                &["pass", "Force", ""][..],
                &["", "upstream [kN]", "downstream [kN]"],
                &data,
            ][..],
            &[[0, 0, 1, 0], [0, 1, 0, 2]][..],
            &[(up, 50.0), (down, 94.0)][..],
        ),
        (
            "the kind in the group alone, units below",
            &[
                &["", "Kraft", ""],
                &["pass", "up", "down"],
                &["-", "kN", "kN"],
                &data,
            ],
            &[[0, 1, 0, 2]],
            &[(up, 50.0), (down, 94.0)],
        ),
        (
            "a unit below a merged name",
            &[
                &["pass", "force", "remark"],
                &["", "kN", ""],
                &["1", "0.05", "ok"],
            ],
            &[[0, 0, 1, 0], [0, 2, 1, 2]],
            &[(Place::Natural, 50.0)],
        ),
        (
            "a title over all columns",
            &[
                &["Force after each pass", "", ""],
                &["pass", "upstream force_kn", "downstream force_kn"],
                &data,
            ],
            &[[0, 0, 0, 2]],
            &[(up, 50.0), (down, 94.0)],
        ),
    ] {
        let book = workbook(rows, merged);
        let read = Readings::from_bytes("cell.xlsx", &book, &ReadOptions::default());
        let read = read.unwrap_or_else(|error| panic!("{name}: {error}"));
        let found: Vec<(Measured, f64)> = read
            .readings()
            .iter()
            .map(|reading| (reading.measured, reading.value))
            .collect();
        let expected: Vec<(Measured, f64)> = expected
            .iter()
            .map(|&(place, force)| (Measured::Force(place), force))
            .collect();
        assert_eq!(found, expected, "{name}");
    }
}
