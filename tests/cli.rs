//! The command line, from outside: what it prints where, its exit status, and what it says about bad input.

#![cfg(feature = "cli")]

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

use serde_json::Value;

const UPPER: &str = "examples/scenes/full-scale-upper.toml";
const PASS_FIELDS: [&str; 11] = [
    "pass",
    "downstream_force_n",
    "downstream_peak_n",
    "upstream_force_n",
    "upstream_peak_n",
    "max_compression_n",
    "upstream_displacement_m",
    "downstream_displacement_m",
    "dissipated_energy_j",
    "downstream_least_n",
    "upstream_least_n",
];
const PROFILE_FIELDS: [&str; 4] = [
    "positions_m",
    "longitudinal_m",
    "vertical_m",
    "longitudinal_velocity_m_per_s",
];

fn command(arguments: &[&str]) -> Command {
    let mut command = Command::new(assert_cmd::cargo::cargo_bin!("creepage"));
    command
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .args(arguments)
        .stdin(Stdio::null());
    command
}

fn output(arguments: &[&str]) -> Output {
    command(arguments).output().expect("the command starts")
}

/// Standard error without the lines of a command that takes longer than a moment.
fn without_progress(errors: &[u8]) -> String {
    let errors = std::str::from_utf8(errors).expect("UTF-8");
    let lines = errors.lines().filter(|line| !line.starts_with("progress: "));
    lines.collect::<Vec<_>>().join("\n")
}

/// What a command that succeeds prints; of standard error nothing but progress.
#[track_caller]
fn printed(arguments: &[&str]) -> String {
    let output = output(arguments);
    let errors = without_progress(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "{arguments:?}: {errors}");
    assert_eq!(errors, "", "{arguments:?}");
    String::from_utf8(output.stdout).expect("UTF-8")
}

/// The whole of standard output as one JSON document.
#[track_caller]
fn json(arguments: &[&str]) -> Value {
    serde_json::from_str(&printed(&[arguments, &["--json"]].concat())).expect("JSON and nothing else")
}

/// The upper phase with a few passes only, and what else is set.
#[track_caller]
fn short_run(set: &[&str]) -> Value {
    let mut arguments = vec!["run", UPPER, "--set", "traffic.passes=6"];
    for set in set {
        arguments.extend(["--set", set]);
    }
    json(&arguments)
}

/// Asserts exit status, silence on standard output, and an error that contains all of `parts`.
#[track_caller]
fn assert_fails(arguments: &[&str], status: i32, parts: &[&str]) {
    let output = output(arguments);
    let errors = String::from_utf8(output.stderr).expect("UTF-8");
    assert_eq!(output.status.code(), Some(status), "{arguments:?}: {errors}");
    assert_eq!(output.stdout, b"", "{arguments:?} prints on standard output");
    for part in parts {
        assert!(errors.contains(part), "{arguments:?}: {part} is not in\n{errors}");
    }
}

/// Who drives in a pass of millions is known where vehicles come by turns.
#[test]
fn rows_of_long_traffic_name_their_vehicle() {
    let vehicles = "vehicles=[{ name = \"there\", speed = 10, load = \"20 tf\" }, { name = \"back\", speed = 10, load = \"10 tf\" }]";
    let long = ["traffic.passes=3000001", "duct.length=6", "solver.tolerance=0.05"];
    let mut arguments = vec!["run", UPPER, "--set", vehicles];
    arguments.extend(long.iter().flat_map(|set| ["--set", set]));
    let printed = printed(&arguments);
    let row = |pass: &str| printed.lines().find(|line| line.trim_start().starts_with(pass));
    assert!(
        row("2\u{a0}000\u{a0}000 ").is_some_and(|row| row.ends_with("back")),
        "{printed}"
    );
    assert!(
        row("3\u{a0}000\u{a0}001 ").is_some_and(|row| row.ends_with("there")),
        "{printed}"
    );
}

/// A place for files of one test.
fn folder(test: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("cli").join(test);
    fs::create_dir_all(&folder).expect("a folder for the test");
    folder
}

fn text(path: &Path) -> &str {
    path.to_str().expect("a path in UTF-8")
}

#[track_caller]
fn numbers(value: &Value) -> Vec<f64> {
    let list = value.as_array().expect("a list");
    list.iter().map(|n| n.as_f64().expect("a number")).collect()
}

#[track_caller]
fn number(value: &Value) -> f64 {
    value
        .as_f64()
        .unwrap_or_else(|| panic!("{value} is not a number"))
}

#[track_caller]
fn last_force(run: &Value) -> f64 {
    number(&run["passes"].as_array().expect("passes").last().expect("a pass")["downstream_force_n"])
}

/// Header and rows of a CSV file.
fn table(file: &Path) -> (Vec<String>, Vec<Vec<f64>>) {
    let mut reader = csv::Reader::from_path(file).expect("a CSV file");
    let header = reader
        .headers()
        .expect("a header")
        .iter()
        .map(String::from)
        .collect();
    let rows = reader
        .records()
        .map(|row| {
            row.expect("a row")
                .iter()
                .map(|n| n.parse().expect("a number"))
                .collect()
        })
        .collect();
    (header, rows)
}

// run

#[test]
fn run_answers_with_every_field_of_its_document() {
    let run = json(&["run", UPPER]);
    assert_eq!(run["title"], "Full-scale experiment, upper phase");
    assert!(run["plan"]["ground"].is_string() && run["plan"]["cable"].is_string());
    assert!(number(&run["plan"]["node_spacing_m"]) > 0.0 && number(&run["plan"]["vehicle_step_m"]) > 0.0);
    let reasons = run["plan"]["reasons"].as_array().expect("a list");
    assert!(!reasons.is_empty() && reasons.iter().all(Value::is_string));
    // Boussinesq's closed form: (1+ν)P/(2πE)·(2−2ν+1)/z below the load.
    let below = 1.4 * 196_133.0 / (std::f64::consts::TAU * 800e6) * 2.2 / 1.2;
    assert!((number(&run["duct_motion"]["peak_vertical_m"]) / below - 1.0).abs() < 1e-6);
    assert!((number(&run["duct_motion"]["peak_longitudinal_m"]) / 15.19e-6 - 1.0).abs() < 1e-3);

    let passes = run["passes"].as_array().expect("a list");
    assert_eq!(passes.len(), 200);
    for (index, pass) in passes.iter().enumerate() {
        assert_eq!(pass["pass"].as_u64(), Some(index as u64 + 1));
        for field in PASS_FIELDS {
            assert!(number(&pass[field]).is_finite(), "{field}");
        }
        assert!(number(&pass["downstream_peak_n"]) >= number(&pass["downstream_force_n"]));
        assert_eq!(number(&pass["upstream_force_n"]), 0.0, "the upstream end is free");
        assert_eq!(
            number(&pass["downstream_displacement_m"]),
            0.0,
            "the downstream end is fixed"
        );
    }
    // Forces that a program of its own gave for this scene.
    for (pass, force) in [
        (1, 102.08),
        (5, 210.46),
        (10, 283.68),
        (60, 519.70),
        (200, 527.84),
    ] {
        let found = number(&passes[pass - 1]["downstream_force_n"]);
        assert!((found / force - 1.0).abs() < 0.01, "pass {pass}: {found} N");
    }

    assert!((number(&run["saturation"]["force_n"]) / 527.84 - 1.0).abs() < 0.01);
    let to_95_percent = run["saturation"]["passes_to_95_percent"]
        .as_u64()
        .expect("a whole number");
    assert!((30..60).contains(&to_95_percent), "{to_95_percent}");
    let error = number(&run["error_estimate"]["relative"]);
    assert!((0.0..=0.01).contains(&error) && run["error_estimate"]["method"].is_string());
    assert_eq!(run["warnings"], Value::Array(vec![]));
}

#[test]
fn run_prints_a_short_table_and_the_plan() {
    let arguments = ["run", UPPER, "--set", "traffic.passes=40"];
    let table = printed(&arguments);
    let run = json(&arguments);
    assert!(table.lines().count() < 40, "{table}");
    assert!(
        table.starts_with("Full-scale experiment, upper phase\n"),
        "{table}"
    );
    for pass in [1, 40] {
        let record = &run["passes"][pass - 1];
        let row: Vec<f64> = table
            .lines()
            .map(|line| line.split_whitespace().map_while(|n| n.parse().ok()).collect())
            .find(|row: &Vec<f64>| row.first() == Some(&(pass as f64)))
            .expect("a row for the pass");
        // Nothing is on a free end, and a fixed one does not move.
        let expected = [
            ("downstream_force_n", 1.0),
            ("upstream_displacement_m", 1e3),
            ("max_compression_n", 1.0),
        ];
        assert_eq!(row.len(), 1 + expected.len());
        for ((field, factor), shown) in expected.into_iter().zip(&row[1..]) {
            let value = factor * number(&record[field]);
            assert!((shown - value).abs() < 0.06, "pass {pass}, {field}: {row:?}");
        }
    }
    for reason in run["plan"]["reasons"].as_array().expect("a list") {
        assert!(table.contains(reason.as_str().expect("a text")), "{table}");
    }
    assert!(
        run["saturation"].is_null() && table.contains("it has not levelled off"),
        "{table}"
    );
}

#[test]
fn years_and_vehicles_a_day_give_the_passes_a_time() {
    let folder = folder("years");
    let file = folder.join("years.csv");
    let rate = [
        "--years",
        "0.5",
        "--trucks-per-day",
        "60",
        "--set",
        "duct.length=10 m",
    ];
    let run = |more: &[&'static str]| [&["run", UPPER][..], &rate, more].concat();
    let document = json(&run(&[]));
    let rows = document["passes"].as_array().expect("a list");
    let time = |row: &Value| (row["pass"].as_u64().expect("a number"), number(&row["years"]));
    for row in rows {
        let (pass, years) = time(row);
        assert!(
            (years / (pass as f64 / (365.25 * 60.0)) - 1.0).abs() < 1e-12,
            "{row}"
        );
    }
    // 0.5 · 365.25 · 60 = 10957.5
    assert_eq!(time(rows.last().expect("a pass")).0, 10_958);
    assert!(rows.iter().any(|row| time(row).0 == 1826), "the first month");
    let said = printed(&run(&[]));
    for line in ["60 1 day ", "1826 1 month ", "10 958 183 days "] {
        let words = said
            .lines()
            .map(|line| line.split_whitespace().collect::<Vec<_>>().join(" "));
        assert!(words.into_iter().any(|words| words.starts_with(line)), "{said}");
    }
    printed(&[&run(&[])[..], &["--csv", text(&file)]].concat());
    assert_eq!(table(&file).0[..2], ["pass", "years"]);

    // The same keys on the other commands; what the scene has not cannot be reckoned with.
    let plan = [
        "plan",
        UPPER,
        "--years",
        "20",
        "--trucks-per-day",
        "800",
        "--json",
    ];
    assert!(printed(&plan).contains("of 5844000 passes"));
    assert_fails(
        &["run", UPPER, "--years", "20"],
        2,
        &["`traffic.per_day` is missing"],
    );
    assert_fails(
        &["run", UPPER, "--years", "-1", "--trucks-per-day", "3"],
        2,
        &["'-1' for '--years <N>'"],
    );
    let few = printed(&["run", UPPER, "--trucks-per-day", "2", "--set", "traffic.passes=3"]);
    assert!(few.contains("  3  1.5 days"), "{few}");
}

#[test]
fn limits_have_a_verdict_and_the_pass_that_breaks_them() {
    fn run<'a>(more: &[&'a str]) -> Vec<&'a str> {
        let short = [
            "--set",
            "traffic.passes=8",
            "--set",
            "duct.length=10 m",
            "--trucks-per-day",
            "4",
        ];
        [&["run", UPPER][..], &short, more].concat()
    }
    let rows = json(&run(&[]));
    assert_eq!(rows.get("limit_reached_after"), None);
    let rows = rows["passes"].as_array().expect("a list").clone();
    // A limit between two passes is broken by the later one.
    let largest = |row: &Value| number(&row["downstream_force_n"]).max(number(&row["downstream_peak_n"]));
    let limit = 0.5 * (largest(&rows[2]) + largest(&rows[3]));
    let first = rows
        .iter()
        .position(|row| largest(row) > limit)
        .expect("a pass above the limit");
    assert!(first > 0);
    let broken = json(&run(&["--limit-force", &limit.to_string()]));
    let reached = &broken["limit_reached_after"];
    assert_eq!(reached["pass"], rows[first]["pass"]);
    assert_eq!(number(&reached["years"]), number(&rows[first]["years"]));
    assert_eq!(broken["limits"].as_array().map(Vec::len), Some(2));
    assert!(json(&run(&["--limit-force", "downstream=1kN"]))["limit_reached_after"].is_null());

    // A cable that is pulled away from its fixed end is pulled hardest while a vehicle passes.
    let pulled = ["--set", "ends.upstream=fixed", "--set", "ends.downstream=free"];
    let rows = json(&run(&pulled))["passes"].as_array().expect("a list").clone();
    let last = rows.last().expect("a pass");
    let (after, least) = (
        number(&last["upstream_force_n"]),
        number(&last["upstream_least_n"]),
    );
    assert!(least < 1.001 * after && after < 0.0, "{least} {after}");
    let limit = format!("upstream={}", -0.5 * (after + least));
    let broken = json(&run(&[&pulled[..], &["--limit-force", &limit]].concat()));
    assert_eq!(number(&broken["limits"][0]["largest"]), -least);
    assert_eq!(broken["limits"][0]["during_a_pass"], Value::Bool(true));
    assert!(broken["limit_reached_after"]["pass"].is_u64(), "{broken}");

    assert_eq!(broken["limits"][0]["pulled"], Value::Bool(true));

    // A limit without a name is that of both ends, of a free one too; what is named counts before it.
    let both = ["--limit-movement", "1 um"];
    let verdicts = |more: &[&str]| {
        let document = json(&run(&[&both[..], more].concat()));
        let verdicts = document["limits"].as_array().expect("verdicts").clone();
        verdicts
            .into_iter()
            .map(|verdict| (number(&verdict["limit"]), !verdict["reached_after"].is_null()))
            .collect::<Vec<_>>()
    };
    assert_eq!(verdicts(&[]), [(1e-6, true), (1e-6, false)]);
    let named = ["--limit-movement", "upstream=1 m"];
    assert_eq!(verdicts(&named), [(1.0, false), (1e-6, false)]);
    let free = ["--set", "ends.downstream=free"];
    assert_eq!(verdicts(&free), [(1e-6, true), (1e-6, true)]);
    let said = printed(&run(&both));
    assert!(
        said.contains("limit exceeded: the upstream end moves by up to "),
        "{said}"
    );
    assert!(said.contains("1 of 2 limits exceeded"), "{said}");
    // With --check that is a failure of its own kind, after the whole answer.
    let checked = output(&run(&[&both[..], &["--check"]].concat()));
    assert_eq!(checked.status.code(), Some(3));
    assert_eq!(String::from_utf8(checked.stdout).expect("UTF-8"), said);
    assert_fails(&run(&["--check"]), 2, &["--check", "--limit-force"]);
    let kept = output(&run(&["--limit-movement", "1 m", "--check"]));
    assert_eq!(kept.status.code(), Some(0));
    for (bad, part) in [
        ("-3", "greater than 0"),
        ("3 m", "a length"),
        ("left=3kN", "upstream, downstream, clamp"),
        ("nan N", "finite"),
    ] {
        assert_fails(&run(&["--limit-force", bad]), 2, &["--limit-force", part]);
    }
}

#[test]
fn run_writes_the_same_numbers_as_csv() {
    let file = folder("run_csv").join("forces.csv");
    let run = json(&["run", UPPER, "--set", "traffic.passes=6", "--csv", text(&file)]);
    let (header, rows) = table(&file);
    assert_eq!(header, PASS_FIELDS);
    let expected: Vec<Vec<f64>> = run["passes"]
        .as_array()
        .expect("a list")
        .iter()
        .map(|pass| PASS_FIELDS.iter().map(|field| number(&pass[field])).collect())
        .collect();
    assert_eq!(rows, expected);
}

#[test]
fn the_table_marks_the_passes_that_were_not_simulated() {
    let file = folder("run_marked").join("forces.csv");
    let traffic = ["--days", "20", "--trucks-per-day", "100", "--csv", text(&file)];
    let run = json(&[&["run", UPPER][..], &traffic].concat());
    let passes = run["passes"].as_array().expect("a list");
    assert_eq!(passes.last().expect("a pass")["pass"], 2000);
    let written = fs::read_to_string(&file).expect("a table");
    let mut lines = written.lines();
    assert!(lines.next().expect("a header").ends_with(",interpolated"));
    let mut marked = 0;
    for (line, pass) in lines.zip(passes) {
        let is_marked = pass["interpolated"].as_bool().unwrap_or(false);
        assert!(line.ends_with(if is_marked { ",1" } else { ",0" }), "{line}");
        assert!(!line.contains(",-0.0,"), "{line}");
        marked += usize::from(is_marked);
    }
    assert!((1..passes.len() - 1).contains(&marked), "{marked}");
}

#[test]
fn a_time_of_traffic_is_typed_in_days_or_years() {
    let passes = |time: &[&str]| {
        let run = json(&[&["run", UPPER, "--trucks-per-day", "3"], time].concat());
        run["passes"].as_array().expect("a list").len()
    };
    for time in [["--days", "2"], ["--years", "2 days"], ["--years", "0.0054757"]] {
        assert_eq!(passes(&time), 6, "{time:?}");
    }
}

#[test]
fn csv_replaces_an_older_longer_file() {
    let file = folder("csv_replaces").join("forces.csv");
    let _ = fs::remove_file(&file);
    printed(&["run", UPPER, "--set", "traffic.passes=9", "--csv", text(&file)]);
    assert_eq!(table(&file).1.len(), 9);
    printed(&["run", UPPER, "--set", "traffic.passes=2", "--csv", text(&file)]);
    assert_eq!(table(&file).1.len(), 2);
}

#[test]
fn set_is_as_good_as_an_edit_of_the_file() {
    let original = short_run(&[]);
    let set = short_run(&[
        "friction.dynamic_coefficient=0.3",
        "vehicles.0.load=15 tf",
        "title=Other",
    ]);
    assert_eq!(set["title"], "Other");
    let change = last_force(&set) / last_force(&original) - 1.0;
    assert!(change.abs() > 0.05, "changed by {change}");

    let file = folder("set").join("edited.toml");
    let scene = fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join(UPPER)).expect("the scene");
    let edited = scene
        .replace("dynamic_coefficient = 0.25", "dynamic_coefficient = 0.3")
        .replace("load = \"20 tf\"", "load = \"15 tf\"")
        .replace("passes = 200", "passes = 6")
        .replace("Full-scale experiment, upper phase", "Other");
    fs::write(&file, edited).expect("a file");
    assert_eq!(json(&["run", text(&file)]), set);
}

#[test]
fn a_mirrored_scene_has_the_mirrored_answer() {
    let forward = short_run(&[]);
    let mirrored = short_run(&[
        "vehicles.0.direction=reverse",
        "ends.upstream=fixed",
        "ends.downstream=free",
    ]);
    for (index, pass) in mirrored["passes"].as_array().expect("a list").iter().enumerate() {
        let original = &forward["passes"][index];
        let force = number(&original["downstream_force_n"]);
        assert!((number(&pass["upstream_force_n"]) / force - 1.0).abs() < 1e-3);
        let moved = number(&original["upstream_displacement_m"]);
        assert!((number(&pass["downstream_displacement_m"]) / moved + 1.0).abs() < 1e-3);
    }
}

#[test]
fn the_same_command_gives_the_same_answer() {
    let random = set(&["traffic.passes=4", "traffic.order=random", "traffic.seed=3"]);
    let arguments = [&["run", UPPER, "--json"][..], &random].concat();
    assert_eq!(printed(&arguments), printed(&arguments));
}

#[test]
fn verify_measures_the_error_and_leaves_the_forces() {
    let estimated = short_run(&[]);
    let verified = json(&["run", UPPER, "--set", "traffic.passes=6", "--verify"]);
    assert_eq!(verified["passes"], estimated["passes"]);
    let measured = number(&verified["error_estimate"]["relative"]);
    assert!(measured > 0.0 && measured < 0.01, "{measured}");
    assert_ne!(
        verified["error_estimate"]["method"],
        estimated["error_estimate"]["method"]
    );

    // The finer run it speaks of, made by hand.
    let half = |key: &str| 0.5 * number(&verified["plan"][key]);
    let finer = short_run(&[
        &format!("solver.node_spacing={}", half("node_spacing_m")),
        &format!("solver.vehicle_step={}", half("vehicle_step_m")),
    ]);
    let difference = (last_force(&finer) / last_force(&verified) - 1.0).abs();
    assert!(
        difference <= measured * 1.0001,
        "{difference} where {measured} was measured"
    );
}

#[test]
fn warnings_go_to_standard_error_and_into_the_document() {
    let output = output(&[
        "run",
        UPPER,
        "--json",
        "--set",
        "traffic.passes=2",
        "--set",
        "solver.node_spacing=0.1 m",
        "--set",
        "solver.tolerance=0.01 %",
    ]);
    assert_eq!(output.status.code(), Some(0));
    let run: Value = serde_json::from_slice(&output.stdout).expect("JSON and nothing else");
    let errors = String::from_utf8(output.stderr).expect("UTF-8");
    let warnings = run["warnings"].as_array().expect("a list");
    assert!(!warnings.is_empty());
    for warning in warnings {
        let warning = warning.as_str().expect("a text");
        assert!(errors.contains(&format!("warning: {warning}\n")), "{errors}");
    }
}

// profile

#[test]
fn profile_obeys_equation_1_and_the_symmetry_of_one_load() {
    let profile = json(&["profile", UPPER]);
    assert!(profile["ground"].is_string());
    let [xi, along, down, velocity] = PROFILE_FIELDS.map(|field| numbers(&profile[field]));
    for list in [&along, &down, &velocity] {
        assert_eq!(list.len(), xi.len());
    }
    assert!(xi.len() > 100 && xi.is_sorted());
    let speed = 40.0 / 3.6;
    let peak = along.iter().fold(0.0_f64, |peak, d| peak.max(d.abs()));
    for (i, step) in xi.windows(3).enumerate() {
        let difference = -speed * (along[i + 2] - along[i]) / (step[2] - step[0]);
        assert!(
            (difference - velocity[i + 1]).abs() < 0.05 * speed * peak / 1.2,
            "V_l at {} m",
            step[1]
        );
    }
    for i in 0..xi.len() {
        let mirror = xi.len() - 1 - i;
        assert!((along[i] + along[mirror]).abs() < 1e-9 * peak.max(1e-6) + 1e-12);
        assert!((down[i] - down[mirror]).abs() < 1e-12);
    }
    let middle = xi.len() / 2;
    assert!(
        velocity[middle] < 0.0,
        "the duct moves backward below a forward vehicle"
    );
    assert!(along[middle + 3] > 0.0, "the duct moves away from the load");
}

#[test]
fn profile_takes_positions_of_any_sign_in_their_order() {
    for positions in [&["--positions", "-1.5,0,1.5"][..], &["--positions=-1.5,0,1.5"]] {
        let profile = json(&[&["profile", UPPER], positions].concat());
        assert_eq!(numbers(&profile["positions_m"]), [-1.5, 0.0, 1.5]);
        let along = numbers(&profile["longitudinal_m"]);
        // Boussinesq's closed form at r = 1.5 m.
        let (r, z, nu): (f64, f64, f64) = (1.5, 1.2, 0.4);
        let root = r.hypot(z);
        let factor = (1.0 + nu) * 196_133.0 / (std::f64::consts::TAU * 800e6);
        let exact = factor * (r * z / root.powi(3) - (1.0 - 2.0 * nu) * r / (root * (root + z)));
        assert!((along[2] / exact - 1.0).abs() < 1e-6 && (along[0] / exact + 1.0).abs() < 1e-6);
        assert_eq!(along[1], 0.0);
    }
    let one = json(&["profile", UPPER, "--positions", "-2"]);
    for field in PROFILE_FIELDS {
        assert_eq!(numbers(&one[field]).len(), 1, "{field}");
    }
    let unsorted = json(&["profile", UPPER, "--positions", "1,-1,1"]);
    assert_eq!(numbers(&unsorted["positions_m"]), [1.0, -1.0, 1.0]);
}

#[test]
fn profile_writes_the_same_numbers_as_csv() {
    let file = folder("profile_csv").join("motion.csv");
    let profile = json(&["profile", UPPER, "--positions", "-1,0,2.5", "--csv", text(&file)]);
    let (header, rows) = table(&file);
    assert_eq!(header.len(), 4);
    assert_eq!(header[0], "position_m");
    assert_eq!(header[1..], PROFILE_FIELDS[1..]);
    for (column, field) in PROFILE_FIELDS.iter().enumerate() {
        let written: Vec<f64> = rows.iter().map(|row| row[column]).collect();
        assert_eq!(written, numbers(&profile[field]), "{field}");
    }
}

#[test]
fn profile_prints_a_table() {
    let table = printed(&["profile", UPPER, "--positions", "-1,0,2.5"]);
    assert_eq!(table.lines().count(), 5, "{table}");
    for unit in ["ξ, m", "D_l, µm", "D_v, µm", "V_l, µm/s"] {
        assert!(table.contains(unit), "{table}");
    }
}

// check, help

#[test]
fn check_accepts_the_example_scenes() {
    let scenes =
        fs::read_dir(Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/scenes")).expect("a folder");
    let mut count = 0;
    for scene in scenes {
        let scene = scene.expect("a file").path();
        let said = printed(&["check", text(&scene)]);
        assert!(said.contains("valid"), "{said}");
        count += 1;
    }
    assert!(count >= 2);
}

#[test]
fn an_unusual_scene_is_told_by_check_plan_and_run() {
    let rock = [
        "--set",
        "ground.rigid_base_depth=1 m",
        "--set",
        "traffic.passes=1",
    ];
    for command in ["check", "plan", "run"] {
        let output = output(&[&[command, UPPER], &rock[..]].concat());
        let errors = String::from_utf8(output.stderr).expect("UTF-8");
        assert_eq!(output.status.code(), Some(0), "{command}: {errors}");
        assert!(
            errors
                .starts_with("warning: --set ground.rigid_base_depth=1 m: `ground.rigid_base_depth` is 1 m"),
            "{command}: {errors}"
        );
    }
    let output = output(&[&["run", UPPER, "--json"], &rock[..]].concat());
    let run: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    let warning = run["warnings"][0].as_str().expect("a warning");
    assert!(warning.contains("within the rock"), "{warning}");
}

#[test]
fn too_long_a_duct_for_its_depth_is_told_at_its_place() {
    let output = output(&[
        "plan",
        UPPER,
        "--set",
        "duct.length=100km",
        "--set",
        "duct.depth=0.1",
    ]);
    let errors = String::from_utf8(output.stderr).expect("UTF-8");
    assert_eq!(output.status.code(), Some(2), "{errors}");
    assert!(
        errors.starts_with("error: --set duct.length=100km: duct.length = 100000 m"),
        "{errors}"
    );
}

#[test]
fn help_and_version_are_no_errors() {
    let help = printed(&["--help"]);
    for command in ["run", "profile", "check"] {
        assert!(help.contains(&format!("\n  {command} ")), "{help}");
        assert!(printed(&[command, "--help"]).contains("--set <KEY=VALUE>"));
    }
    let run = printed(&["help", "run"]);
    for flag in ["--json", "--csv <FILE>", "--verify"] {
        assert!(run.contains(flag), "{run}");
    }
    assert_eq!(
        printed(&["--version"]),
        format!("creepage {}\n", env!("CARGO_PKG_VERSION"))
    );
}

// presets

#[test]
fn keys_are_listed_and_explained() {
    let list = printed(&["explain"]);
    for line in [
        "\n*  duct.depth ",
        "\n   duct.slope ",
        "\n   traffic.per_day ",
        "\n*  vehicles.wheels.load ",
    ] {
        assert!(list.contains(line), "{list}");
    }
    for key in ["duct.depth", "depth", "vehicles.0.speed", "vehicles.speed"] {
        let said = printed(&["explain", key]);
        for part in ["  allowed: a ", "(units: m", "  required"] {
            assert!(said.contains(part), "{said}");
        }
    }
    let both = printed(&["explain", "lateral_offset"]);
    assert!(
        both.contains("duct.lateral_offset\n")
            && both.contains("vehicles.lateral_offset\n")
            && both.contains("if omitted: 0 m")
    );
    assert!(printed(&["explain", "friction"]).contains("friction.law\n"));
    let document = json(&["explain", "traffic.years"]);
    assert_eq!(document[0]["key"], "traffic.years");
    assert_fails(&["explain", "duct.dept"], 2, &["did you mean duct.depth?"]);
    assert_fails(&["explain", "depht"], 2, &["did you mean duct.depth?"]);
}

#[test]
fn every_help_tells_the_exit_status() {
    for command in [
        "run",
        "plan",
        "sweep",
        "design",
        "measures",
        "report",
        "explain",
        "calibrate",
        "presets",
    ] {
        let help = printed(&[command, "--help"]);
        assert!(help.trim_end().ends_with("130 stopped by Ctrl-C."), "{help}");
    }
}

#[test]
fn presets_are_listed_with_their_sources() {
    let list = printed(&["presets"]);
    let document = json(&["presets"]);
    let presets = document.as_array().expect("a list");
    assert!(presets.len() > 15);
    for preset in presets {
        for field in ["kind", "name", "summary", "toml"] {
            assert!(preset[field].is_string(), "{field}");
        }
        assert!(list.contains(preset["name"].as_str().expect("a name")), "{list}");
        for source in preset["sources"].as_array().expect("a list") {
            let line = format!(
                "{}: {}{}\n",
                source["key"].as_str().expect("a key"),
                if source["assumed"] == true {
                    "ASSUMED, "
                } else {
                    ""
                },
                source["source"].as_str().expect("a source")
            );
            assert!(list.contains(&line), "{line} is not in\n{list}");
        }
    }
    let one = printed(&["presets", "t-25"]);
    assert!(
        one.contains("load = \"100 kN\"") && one.contains("ASSUMED") && !one.contains("t-20"),
        "{one}"
    );
    assert_eq!(json(&["presets", "t-25"]).as_array().map(Vec::len), Some(1));
    assert_fails(&["presets", "t-52"], 2, &["`t-52`", "lists: t-25"]);
}

// sweep

/// A sweep of 48 points of one pass each on two threads: 20 ms a point, so that there is time to kill it.
fn sweep_arguments(out: &Path) -> Vec<String> {
    let vary = [
        "friction.dynamic_coefficient=0.05:0.6:0.05",
        "duct.depth=0.9m,1.2m,1.5m,2m",
    ];
    let mut arguments = vec![
        "sweep".to_owned(),
        UPPER.to_owned(),
        "--set".to_owned(),
        "traffic.passes=1".to_owned(),
        "--threads".to_owned(),
        "2".to_owned(),
    ];
    for vary in vary {
        arguments.extend(["--vary".to_owned(), vary.to_owned()]);
    }
    arguments.extend(["--out".to_owned(), text(out).to_owned()]);
    arguments
}

#[test]
fn a_killed_sweep_loses_nothing_finished_and_ends_with_the_same_file() {
    let folder = folder("sweep_killed");
    for format in ["csv", "xlsx"] {
        let [calm, killed] = ["calm", "killed"].map(|name| folder.join(format!("{name}.{format}")));
        let unfinished = folder.join(format!("killed.{format}.unfinished"));
        for file in [&calm, &killed, &unfinished] {
            let _ = fs::remove_file(file);
        }
        let arguments = sweep_arguments(&calm);
        let said = printed(&arguments.iter().map(String::as_str).collect::<Vec<_>>());
        assert!(said.contains("calm") && said.contains("48 points\n"), "{said}");

        let arguments = sweep_arguments(&killed);
        let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
        let lines = || {
            fs::read_to_string(&unfinished)
                .unwrap_or_default()
                .lines()
                .count()
        };
        // Twice, each time with some more points done.
        let mut kept = 0;
        for _ in 0..2 {
            let mut child = command(&arguments)
                .stdout(Stdio::null())
                .spawn()
                .expect("the command starts");
            while lines() < kept + 8 {
                assert!(
                    child.try_wait().expect("a state").is_none(),
                    "it ended before it was killed"
                );
                std::thread::sleep(std::time::Duration::from_millis(2));
            }
            child.kill().expect("SIGKILL");
            child.wait().expect("it ends");
            assert!(!killed.exists());
            kept = fs::read_to_string(&unfinished)
                .expect("the rows")
                .matches('\n')
                .count()
                - 2;
        }
        assert!(kept >= 10, "{kept}");
        let summary = json(&arguments);
        assert_eq!(summary["points"], 48);
        assert_eq!(summary["resumed"].as_u64(), Some(kept as u64));
        assert_eq!(summary["failed"], 0);
        assert!(fs::read(&killed).expect("a table") == fs::read(&calm).expect("a table"));
        assert!(!unfinished.exists());
    }
}

#[test]
fn a_sweep_tells_its_failing_points_and_fails_where_all_do() {
    let out = folder("sweep_failing").join("out.csv");
    let sweep = |vary: &str| {
        let arguments = [
            "sweep",
            UPPER,
            "--set",
            "traffic.passes=1",
            "--out",
            text(&out),
            "--vary",
            vary,
        ];
        output(&arguments)
    };
    let some = sweep("friction.dynamic_coefficient=0.2,-1,0.3");
    let errors = String::from_utf8(some.stderr).expect("UTF-8");
    assert_eq!(some.status.code(), Some(0), "{errors}");
    assert!(
        errors.contains("1 of 3 points failed") && errors.contains("found -1"),
        "{errors}"
    );
    assert_eq!(fs::read_to_string(&out).expect("the table").lines().count(), 4);
    let all = sweep("friction.dynamic_coefficient=-1,-2");
    assert_eq!(all.status.code(), Some(1));
    // A bare number that looks like a slip of units is told here too.
    let slip = sweep("vehicles.0.load=20,30");
    let errors = String::from_utf8(slip.stderr).expect("UTF-8");
    assert!(errors.contains("20 without a unit is 20 N"), "{errors}");
}

#[test]
fn bad_sweeps_have_status_2() {
    let folder = folder("sweep_bad");
    let out = folder.join("out.csv");
    let _ = fs::remove_file(&out);
    let nowhere = folder.join("no-such-folder").join("out.csv");
    let depth = "duct.depth=1:2:1";
    let text_file = folder.join("out.txt");
    let cases: &[(&[&str], &str)] = &[
        (&["--vary", depth], "--out"),
        (&["--out", text(&out)], "--vary"),
        (&["--out", text(&text_file), "--vary", depth], ".csv"),
        (&["--out", text(&out), "--vary", "duct.depth"], "KEY=A:B:STEP"),
        (
            &["--out", text(&out), "--vary", "duct.depth=1:2:0"],
            "a STEP that leads",
        ),
        (
            &["--out", text(&out), "--vary", depth, "--threads", "0"],
            "--threads",
        ),
    ];
    for (arguments, part) in cases {
        assert_fails(&[&["sweep", UPPER], *arguments].concat(), 2, &[part]);
    }
    assert_fails(
        &["sweep", UPPER, "--vary", depth, "--out", text(&nowhere)],
        2,
        &["no-such-folder"],
    );
    assert!(!out.exists());
}

#[test]
fn a_sweep_prints_the_quantiles_of_drawn_keys() {
    let out = folder("sweep_bands").join("out.csv");
    let drawn = "friction.dynamic_coefficient=normal(0.25, 0.03)";
    let mut arguments = vec![
        "sweep",
        UPPER,
        "--set",
        "traffic.passes=1",
        "--out",
        text(&out),
        "--vary",
        drawn,
    ];
    arguments.extend(["--samples", "20", "--seed", "4"]);
    let said = printed(&arguments);
    let document = json(&arguments);
    let quantiles = &document["bands"][0]["downstream_force_n"];
    assert_eq!(document["bands"][0]["samples"], 20);
    for field in ["mean", "p05", "p50", "p95"] {
        let value = format!("{:.1}", number(&quantiles[field]));
        assert!(said.contains(&value), "{field} {value}: {said}");
    }
    assert!(number(&quantiles["p05"]) < number(&quantiles["p95"]));
}

#[test]
fn a_sweep_draws_a_map_of_two_keys() {
    let folder = folder("sweep_map");
    let [out, map] = ["out.csv", "map.svg"].map(|name| folder.join(name));
    let sweep = |vary: &[&str]| {
        let mut arguments = vec![
            "sweep",
            UPPER,
            "--set",
            "traffic.passes=1",
            "--set",
            "solver.node_spacing=0.5 m",
        ];
        for vary in vary {
            arguments.extend(["--vary", vary]);
        }
        arguments.extend(["--out", text(&out), "--map", text(&map)]);
        output(&arguments)
    };
    let depths = "duct.depth=1m:2m:0.5m";
    let done = sweep(&[depths, "ends.upstream=free,fixed"]);
    assert_eq!(
        done.status.code(),
        Some(0),
        "{}",
        String::from_utf8_lossy(&done.stderr)
    );
    let svg = fs::read_to_string(&map).expect("a map");
    for part in ["duct.depth, m", "ends.upstream", "fixed", "force, N"] {
        assert!(svg.contains(part), "{part}");
    }
    for vary in [
        &[depths][..],
        &[depths, "duct.length=20m,30m", "duct.lateral_offset=0m,1m"],
    ] {
        assert_eq!(sweep(vary).status.code(), Some(2), "{vary:?}");
    }
}

// design

#[test]
fn design_answers_in_words_and_as_json() {
    let set = set(&[
        "traffic.passes=8",
        "duct.length=15 m",
        "solver.node_spacing=0.25 m",
    ]);
    let design = |more: &[&'static str]| [&["design", UPPER][..], &set, more].concat();
    let said = printed(&design(&["--limit-force", "150 N"]));
    let document = json(&design(&["--limit-force", "150 N"]));
    let answer = &document["answer"];
    assert!(number(&answer["force_n"]) <= 150.0 && number(&answer["stiffness_n_per_m"]) > 0.0);
    assert!(
        said.contains(&format!(
            "answer: a spring of {:.0} kN/m",
            1e-3 * number(&answer["stiffness_n_per_m"])
        )),
        "{said}"
    );
    let curve = document["curve"].as_array().expect("a list");
    assert!(curve.len() > 10 && said.lines().count() > curve.len());

    let fixed = printed(&design(&["--limit-force", "10 kN"]));
    assert!(fixed.contains("answer: fixed"), "{fixed}");
    // Nothing keeps these limits: the nearest is the answer, with status 1.
    let hard = design(&["--limit-force", "1 N", "--limit-movement", "downstream=0.1 mm"]);
    let none = output(&hard);
    let said = String::from_utf8(none.stdout).expect("UTF-8");
    assert_eq!(none.status.code(), Some(1));
    assert!(
        said.contains("no stiffness stays within the limits; nearest: a spring of ")
            && said.contains(" times its limit"),
        "{said}"
    );
    let document = output(&[&hard[..], &["--json"]].concat());
    assert_eq!(document.status.code(), Some(1));
    let document: Value = serde_json::from_slice(&document.stdout).expect("JSON and nothing else");
    assert!(document["answer"].is_null() && number(&document["nearest"]["downstream_force_n"]) > 1.0);
    // The free end moves farther than that, which counts where no end is named.
    let named = ["--limit-movement", "downstream=1 um", "--limit-force", "10 kN"];
    let fixed = printed(&design(&named));
    assert!(fixed.contains("answer: fixed; force on the"), "{fixed}");
    let free = output(&design(&["--limit-movement", "1 um"]));
    assert_eq!(free.status.code(), Some(1));
    for (more, part) in [
        (&["--limit-force", "3 m"][..], "force"),
        (&["--limit-force", "-3"], "limit-force"),
        (&["--limit-force", "0"], "greater than 0"),
        (&["--limit-force", "1", "--at", "nowhere"], "upstream, downstream"),
        (&["--limit-force", "1", "--at", "99 m"], "position"),
        (&["--limit-force", "1", "--years", "3"], "traffic.per_day"),
        (&[], "--limit-force"),
    ] {
        assert_fails(&design(more), 2, &[part]);
    }
}

#[test]
fn measures_are_compared_in_words_and_as_json() {
    let set = set(&[
        "traffic.passes=8",
        "duct.length=15 m",
        "measures=[{ name = \"fixed\", upstream = \"fixed\" }]",
    ]);
    let measures = |more: &[&'static str]| [&["measures", UPPER][..], &set, more].concat();
    let uncertain = [
        "--uncertain",
        "friction.dynamic_coefficient=0.2:0.4",
        "--uncertain",
        "ground.vertical_peak=20um:40um",
    ];
    let kept = [
        &uncertain[..],
        &["--limit-force", "10 kN", "--limit-movement", "0.1 m"],
    ]
    .concat();
    let said = printed(&measures(&kept));
    assert!(
        said.contains("friction 0.2 to 0.4, deflection 20 µm to 40 µm; 15 combinations"),
        "{said}"
    );
    assert!(
        said.contains("Recommended: as it is: nothing needs to be fitted"),
        "{said}"
    );
    let document = json(&measures(&kept));
    assert_eq!(document["recommended"], "as it is");
    let fixed = &document["measures"][1];
    assert_eq!(
        (fixed["name"].as_str(), fixed["within_limits"].as_bool()),
        (Some("fixed"), Some(true))
    );
    assert_eq!(fixed["ends"]["upstream"], "fixed");
    let worst = &fixed["worst"];
    assert!(
        worst["value"].as_f64() < worst["limit"].as_f64() && worst["quantity"].is_string(),
        "{worst}"
    );
    assert_eq!(worst["at"].as_object().map(|at| at.len()), Some(2), "{worst}");
    assert!(
        fixed["nominal"]["value"].is_number() && fixed["restraints"].is_array(),
        "{fixed}"
    );
    // Nothing holds: what comes nearest, and a failure.
    let hard = output(&measures(&[&uncertain[..], &["--limit-force", "1 N"]].concat()));
    assert_eq!(hard.status.code(), Some(1));
    let said = String::from_utf8_lossy(&hard.stdout);
    assert!(said.contains("comes nearest"), "{said}");
    for (more, part) in [
        (
            &[
                "--limit-force",
                "1 kN",
                "--uncertain",
                "friction.dynamic_coeficient=0.2:0.4",
            ][..],
            "friction.dynamic_coefficient",
        ),
        (
            &[
                "--limit-force",
                "1 kN",
                "--uncertain",
                "friction.dynamic_coefficient=0.4:0.2",
            ],
            "the lowest value and a greater one",
        ),
        (
            &["--limit-force", "1 kN", "--uncertain", "duct.depth=1kN:2kN"],
            "a length",
        ),
        (
            &["--limit-force", "1 kN", "--uncertain", "duct.depth"],
            "KEY=LOW:HIGH",
        ),
        (&[], "--limit-force"),
    ] {
        assert_fails(&measures(more), 2, &[part]);
    }
}

#[test]
fn design_takes_pairs_several_places_and_limits_of_clamps() {
    let set = set(&[
        "traffic.passes=4",
        "duct.length=15 m",
        "solver.node_spacing=0.3 m",
    ]);
    let design = |more: &[&'static str]| [&["design", UPPER][..], &set, more].concat();
    let tight = design(&[
        "--at",
        "upstream + downstream",
        "--limit-force",
        "10N",
        "--limit-movement",
        "0.01mm",
    ]);
    let none = output(&tight);
    let (said, failed) = (
        String::from_utf8(none.stdout).expect("UTF-8"),
        String::from_utf8(none.stderr).expect("UTF-8"),
    );
    assert_eq!(none.status.code(), Some(1));
    assert!(
        said.contains("kN/m at the upstream end and a spring of "),
        "{said}"
    );
    for part in ["times its limit of ", "force on the downstream end"] {
        assert!(said.contains(part), "{said}");
    }
    for part in ["the nearest is on standard output", "; try "] {
        assert!(failed.contains(part), "{failed}");
    }
    let clamps = design(&[
        "--at",
        "5m",
        "--at",
        "13m",
        "--limit-force",
        "0.1kN",
        "--limit-force",
        "clamp=0.15kN",
        "--limit-movement",
        "13m=1mm",
    ]);
    let said = printed(&clamps);
    assert!(
        said.contains("2 ways to hold the cable") && said.contains("best: clamp at 13 m"),
        "{said}"
    );
    for words in [
        "limits: ",
        "; force on the clamp at 5 m 0.15 kN",
        "; movement at the clamp at 13 m 1 mm",
        "on the clamp",
        "\nclamp at 13 m: force at most ",
    ] {
        assert!(said.contains(words), "{words}: {said}");
    }
    let unlimited = printed(&design(&["--at", "13m", "--limit-force", "0.1kN"]));
    assert!(
        unlimited.contains("clamps are not limited; --limit-force clamp=FORCE"),
        "{unlimited}"
    );
    let document = json(&clamps);
    let candidates = document["candidates"].as_array().expect("a list");
    assert_eq!(candidates.len(), 2);
    assert_eq!(document["place"]["clamp"], 13.0);
    assert_eq!(document["limits"]["clamps"][0]["position_m"], 13.0);
    assert_eq!(document["answer"], candidates[1]["answer"]);
    for (more, part) in [
        (
            &["--limit-force", "7m=1kN"][..],
            "a clamp at 7 m, where there is none",
        ),
        (&["--limit-force", "clamp=1kN"], "as the scene has no clamps"),
        (&["--limit-force", "middle=1kN"], "the position of a clamp"),
        (&["--limit-force", "1kN", "--at", "5m+6m+7m"], "two of these"),
        (&["--limit-force", "1kN", "--at", "5m+5m"], "two different places"),
    ] {
        assert_fails(&design(more), 2, &[part]);
    }
    // A clamp of the scene has its verdict.
    let run = [
        &["run", UPPER][..],
        &set[..4],
        &["--set", "restraints=[{ position = 13, stiffness = 1e5 }]"],
    ]
    .concat();
    let clamp = ["--limit-force", "13m=1N", "--limit-movement", "clamp=1m"];
    let said = printed(&[&run[..], &clamp].concat());
    assert!(
        said.contains("limit exceeded: the clamp at 13 m bears up to "),
        "{said}"
    );
    assert!(
        said.contains("limit kept: the cable at the clamp at 13 m moves by at most "),
        "{said}"
    );
    assert_fails(
        &[&run[..], &["--limit-force", "5m=1N"]].concat(),
        2,
        &["the position of a clamp: clamp at 13 m"],
    );
}

// new, completions

#[test]
fn a_new_scene_passes_the_check_and_runs() {
    let folder = folder("new");
    let flags: [&[&str]; 4] = [
        &[],
        &[
            "--length",
            "40 m",
            "--depth",
            "0.9",
            "--vehicle",
            "t-20",
            "--friction",
            "0.3",
        ],
        &[
            "--pavement",
            "n6-cbr6",
            "--length",
            "20 m",
            "--downstream",
            "3 MN/m",
        ],
        &[
            "--modulus",
            "100 MPa",
            "--title",
            "\"Quoted\"",
            "--cable",
            "xlpe-150-triplex",
        ],
    ];
    for (index, flags) in flags.into_iter().enumerate() {
        let file = folder.join(format!("new-{index}.toml"));
        let _ = fs::remove_file(&file);
        let said = printed(&[&["new", text(&file), "--passes", "3"], flags].concat());
        assert!(said.contains(&format!("creepage run {}", text(&file))), "{said}");
        let written = fs::read_to_string(&file).expect("the scene");
        assert!(
            written.matches('#').count() > 15 && written.contains("passes = 3"),
            "{written}"
        );
        // A soft ground is told: `printed` and `json` allow no warning.
        let soft = output(&["check", text(&file)]);
        let said = String::from_utf8_lossy(&soft.stderr);
        let is_told = |line: &str| line.contains("far above what is measured under roads");
        assert!(soft.status.success() && said.lines().all(is_told), "{said}");
        let ran = output(&["run", text(&file), "--json"]);
        let run: Value = serde_json::from_slice(&ran.stdout).expect("JSON and nothing else");
        assert!(last_force(&run).is_finite());
        // It is there now, and stays as it is.
        assert_fails(&["new", text(&file)], 2, &["exists", "nothing is overwritten"]);
        assert_eq!(fs::read_to_string(&file).expect("the scene"), written);
    }
}

#[test]
fn a_bad_flag_of_a_new_scene_writes_no_file() {
    let file = folder("new_bad").join("bad.toml");
    let _ = fs::remove_file(&file);
    let cases: [(&[&str], &[&str]); 4] = [
        (&["--depth", "1.2 kN"], &["`duct.depth`", "a force", "^^^"]),
        (
            &["--vehicle", "t25"],
            &["`vehicles.0.preset`", "did you mean `t-25`?"],
        ),
        (
            &["--pavement", "300 MPa"],
            &["`ground.preset`", "allowed: \"n5-cbr3\""],
        ),
        (
            &["--modulus", "1 MPa", "--pavement", "n6-cbr6"],
            &["cannot be used with"],
        ),
    ];
    for (flags, parts) in cases {
        assert_fails(&[&["new", text(&file)], flags].concat(), 2, parts);
        assert!(!file.exists(), "{flags:?}");
    }
    let nowhere = file.with_file_name("no-such-folder").join("new.toml");
    assert_fails(&["new", text(&nowhere)], 2, &["cannot be written"]);
}

#[test]
fn completions_name_every_command() {
    let help = printed(&["--help"]);
    let commands: Vec<&str> = help
        .split("Commands:\n")
        .nth(1)
        .expect("the commands")
        .lines()
        .map_while(|line| line.strip_prefix("  "))
        // Long descriptions go on in lines of their own.
        .filter(|line| !line.starts_with(' '))
        .filter_map(|line| line.split_whitespace().next())
        .collect();
    assert!(
        commands.contains(&"run") && commands.contains(&"completions"),
        "{commands:?}"
    );
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        let script = printed(&["completions", shell]);
        for command in &commands {
            assert!(script.contains(command), "{shell}: {command}");
        }
    }
    for command in commands.into_iter().filter(|command| *command != "help") {
        assert!(printed(&[command, "--help"]).contains("Examples:"), "{command}");
    }
    assert_fails(&["completions", "cmd"], 2, &["bash"]);
}

// what fails

#[test]
fn bad_usage_has_status_2() {
    let cases: &[(&[&str], &str)] = &[
        (&[], "Usage"),
        (&["walk", UPPER], "walk"),
        (&["run"], "SCENE"),
        (&["run", UPPER, UPPER], UPPER),
        (&["run", UPPER, "--fast"], "--fast"),
        (&["run", UPPER, "--csv"], "--csv"),
        (&["run", UPPER, "--set"], "--set"),
        (&["run", UPPER, "--positions", "0"], "--positions"),
        (&["profile", UPPER, "--verify"], "--verify"),
        (&["profile", UPPER, "--positions", "0,x"], "x"),
        (&["profile", UPPER, "--positions", "nan"], "nan"),
        (&["profile", UPPER, "--positions", "inf"], "inf"),
        (&["profile", UPPER, "--positions", "0,,1"], "--positions"),
        (&["check"], "SCENE"),
    ];
    for (arguments, part) in cases {
        assert_fails(arguments, 2, &[part]);
    }
}

#[test]
fn an_unreadable_scene_has_status_2() {
    let folder = folder("unreadable");
    let binary = folder.join("binary.toml");
    fs::write(&binary, b"title = \"\xff\xfe\"\n").expect("a file");
    let empty = folder.join("empty.toml");
    fs::write(&empty, "").expect("a file");
    for command in ["run", "profile", "check"] {
        let missing = folder.join("no-such-scene.toml");
        assert_fails(&[command, text(&missing)], 2, &["no-such-scene.toml", "No such"]);
        assert_fails(
            &[command, text(&missing), "--set", "duct.length=1"],
            2,
            &["no-such-scene.toml"],
        );
        assert_fails(&[command, text(&folder)], 2, &[text(&folder), "cannot be read"]);
        assert_fails(&[command, text(&binary)], 2, &["binary.toml, line 1", "UTF-8"]);
        assert_fails(&[command, text(&empty)], 2, &["empty.toml", "missing"]);
    }
}

#[test]
fn a_bad_scene_is_refused_with_file_line_key_found_and_allowed() {
    // Old text, new text, the key; all other faults and their words stand with the scene's own tests.
    let cases = [
        ("depth = \"1.2 m\"", "depth = \"1.2 m", "not valid TOML"),
        ("depth = \"1.2 m\"", "depth = \"1.2 kN\"", "`duct.depth`"),
        ("passes = 200", "passes = 0", "`traffic.passes`"),
        ("passes = 200", "passes = 200\npasses = 200", "not valid TOML"),
    ];
    let scene = fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join(UPPER)).expect("the scene");
    let file = folder("bad_scene").join("bad.toml");
    for (old, new, part) in cases {
        assert_eq!(scene.matches(old).count(), 1, "{old} is not one place");
        let faulty = scene.replace(old, new);
        // The last line of what is new: the second one of a key that stands twice.
        let end = faulty.find(new).expect("the new text") + new.len();
        let line = faulty[..end].lines().count();
        fs::write(&file, &faulty).expect("a file");
        let place = format!("{}, line {line}: ", text(&file));
        for command in ["run", "profile", "check"] {
            assert_fails(&[command, text(&file)], 2, &[&place, part]);
        }
    }
}

#[test]
fn a_bad_override_is_refused_with_its_text() {
    let cases = [
        ("friction.dynamic_coefficent=0.3", "did you mean"),
        ("friction.dynamic_coefficient=nan", "found nan"),
        ("vehicles.1.load=20 tf", "vehicles.1.load"),
        ("=0.3", "duct.length"),
        ("", "KEY=VALUE"),
    ];
    // An empty value removes the key: then the file lacks it.
    let removed = ["check", UPPER, "--set", "friction.dynamic_coefficient="];
    assert_fails(&removed, 2, &[UPPER, "friction.dynamic_coefficient", "missing"]);
    for (set, part) in cases {
        for command in ["run", "profile", "check"] {
            let place = format!("--set {set}");
            assert_fails(&[command, UPPER, "--set", set], 2, &[&place, part]);
        }
    }
}

#[test]
fn a_scene_that_does_not_fit_together_has_status_2() {
    let rigid_base = [
        "--set",
        "ground.rigid_base_depth=12 m",
        "--set",
        "ground.model=boussinesq",
    ];
    for command in ["run", "profile", "check"] {
        let arguments = [&[command, UPPER], &rigid_base[..]].concat();
        assert_fails(&arguments, 2, &["ground.model", "boussinesq", "rigid base"]);
    }
    let no_memory = [
        "--set",
        "friction.law=sigmoid",
        "--set",
        "solver.method=quasi-static",
    ];
    for command in ["run", "check"] {
        let arguments = [&[command, UPPER], &no_memory[..]].concat();
        assert_fails(&arguments, 2, &["quasi-static", "sigmoid"]);
    }
}

#[test]
fn what_does_not_fit_is_shown_in_the_file_or_the_override() {
    let scene = fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join(UPPER)).expect("the scene");
    let faulty = scene
        .replace("law = \"elastic-plastic\"", "law = \"sigmoid\"")
        .replace("passes = 200", "passes = 20\n[solver]\nmethod = \"quasi-static\"");
    let file = folder("unfit").join("unfit.toml");
    fs::write(&file, &faulty).expect("a file");
    let line = 1 + faulty
        .lines()
        .position(|line| line.starts_with("method"))
        .expect("the method");
    let place = format!("{}, line {line}: solver.method: quasi-static", text(&file));
    let marked = format!("{line} | method = \"quasi-static\" ");
    for command in ["run", "check"] {
        assert_fails(
            &[command, text(&file)],
            2,
            &[&place, &marked, "|          ^^^^^^^^^^^^^^"],
        );
        assert_fails(
            &[command, text(&file), "--set", "solver.method=quasi-static"],
            2,
            &["--set solver.method=quasi-static: solver.method", "^^^^^^^^^^^^"],
        );
    }
}

#[test]
fn bare_numbers_that_look_like_slips_are_told() {
    let arguments = ["--set", "vehicles.0.speed=40", "--set", "traffic.passes=2"];
    let output = output(&[&["run", UPPER, "--json"], &arguments[..]].concat());
    assert_eq!(output.status.code(), Some(0));
    let errors = String::from_utf8(output.stderr).expect("UTF-8");
    let run: Value = serde_json::from_slice(&output.stdout).expect("JSON and nothing else");
    let warning = "`vehicles.0.speed` (vehicle 1): 40 without a unit is 40 m/s: did you mean km/h?";
    assert!(errors.contains(warning) && errors.contains("^^"), "{errors}");
    assert!(
        run["warnings"][0].as_str().expect("a text").ends_with(warning),
        "{run}"
    );

    // Light and fast vehicles whose unit is written are meant.
    for (set, warned) in [
        ("vehicles.0.load=20", true),
        ("vehicles.0.load=20 N", false),
        ("vehicles.0.load=196133", false),
        ("vehicles.0.load=0", false),
        ("vehicles.0.wheels=[{ load = 50 }]", true),
        ("vehicles.0.speed=36", false),
        ("vehicles.0.speed=200 km/h", false),
    ] {
        let output = command(&["check", UPPER, "--set", set])
            .output()
            .expect("the command");
        assert_eq!(output.status.code(), Some(0), "{set}");
        assert_eq!(!without_progress(&output.stderr).is_empty(), warned, "{set}");
    }
}

#[test]
fn a_table_on_standard_output_stands_alone() {
    let file = folder("csv_stdout").join("forces.csv");
    for arguments in [
        &["run", UPPER, "--set", "traffic.passes=3"][..],
        &["profile", UPPER, "--positions", "0,1"],
    ] {
        let _ = fs::remove_file(&file);
        printed(&[arguments, &["--csv", text(&file)]].concat());
        let table = printed(&[arguments, &["--csv", "-"]].concat());
        assert_eq!(table, fs::read_to_string(&file).expect("the table"));
        let both = [arguments, &["--csv", "-", "--json"]].concat();
        assert_fails(&both, 2, &["--csv", "standard output", "--json"]);
    }
}

#[test]
fn a_csv_file_that_cannot_be_written_has_status_2_before_anything_is_computed() {
    let folder = folder("csv_unwritable");
    let nowhere = folder.join("no-such-folder").join("forces.csv");
    for file in [&nowhere, &folder] {
        for command in ["run", "profile"] {
            let arguments = [command, UPPER, "--csv", text(file)];
            assert_fails(&arguments, 2, &[text(file), "cannot be written"]);
        }
    }
    // Were it computed first, this would take days.
    let days = [
        "run",
        UPPER,
        "--set",
        "traffic.passes=100000000",
        "--csv",
        text(&nowhere),
    ];
    assert_fails(&days, 2, &["cannot be written"]);
}

#[test]
fn a_computation_that_fails_has_status_1() {
    let file = folder("fails").join("forces.csv");
    let too_stiff = [
        "run",
        UPPER,
        "--json",
        "--csv",
        text(&file),
        "--set",
        "cable.axial_stiffness=1e15 N",
        "--set",
        "solver.node_spacing=1 mm",
        "--set",
        "duct.length=3 m",
        "--set",
        "traffic.passes=1",
    ];
    assert_fails(&too_stiff, 1, &["error: ", "stiff"]);
    let left = fs::read_to_string(&file).unwrap_or_default();
    assert_eq!(left, "", "no numbers of a run that failed");
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_has_status_1() {
    let full = || {
        let file = fs::OpenOptions::new().write(true).open("/dev/full");
        Stdio::from(file.expect("the full device"))
    };
    for arguments in [
        &["check", UPPER][..],
        &["profile", UPPER],
        &["profile", UPPER, "--json"],
    ] {
        let output = command(arguments).stdout(full()).output().expect("the command");
        assert_eq!(output.status.code(), Some(1), "{arguments:?}");
        let errors = String::from_utf8(output.stderr).expect("UTF-8");
        assert!(errors.contains("standard output: cannot be written"), "{errors}");
    }
    assert_fails(
        &["profile", UPPER, "--csv", "/dev/full"],
        1,
        &["/dev/full", "cannot be written"],
    );
}

#[test]
fn a_reader_that_leaves_is_no_error() {
    for arguments in [
        &["run", UPPER, "--set", "traffic.passes=2"][..],
        &["run", UPPER, "--set", "traffic.passes=2", "--json"],
        &["profile", UPPER],
        &["check", UPPER],
    ] {
        let mut child = command(arguments)
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .expect("the command");
        drop(child.stdout.take());
        let output = child.wait_with_output().expect("it ends");
        assert_eq!(output.status.code(), Some(0), "{arguments:?}");
        assert_eq!(String::from_utf8_lossy(&output.stderr), "", "{arguments:?}");
    }
}

// the README

fn readme() -> String {
    fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("README.md")).expect("the README")
}

/// Blocks of code in one language.
fn blocks<'t>(text: &'t str, language: &str) -> Vec<&'t str> {
    let opening = format!("```{language}\n");
    text.split(&opening)
        .skip(1)
        .map(|rest| rest.split("\n```").next().unwrap_or_default())
        .collect()
}

#[test]
fn the_scene_in_the_readme_runs() {
    let readme = readme();
    let scenes = blocks(&readme, "toml");
    assert_eq!(scenes.len(), 1);
    let file = folder("readme").join("my-duct.toml");
    fs::write(&file, scenes[0]).expect("a file");
    let run = json(&["run", text(&file)]);
    assert!(last_force(&run).abs() > 1.0);
}

/// The README's commands with few passes: that they work does not take all of them, and its scene runs as it is in the test above.
#[test]
fn the_commands_in_the_readme_work() {
    readme_commands("readme_commands", short);
}

#[test]
#[ignore = "half a minute: hundreds of passes that show no more than a few"]
fn the_commands_of_the_readme_with_all_passes() {
    readme_commands("readme_commands_all", str::to_owned);
}

fn readme_commands(test: &str, said: impl Fn(&str) -> String) {
    let readme = readme();
    let _ = fs::remove_dir_all(folder(test));
    let folder = folder(test);
    let file = folder.join("my-duct.toml");
    fs::write(&file, blocks(&readme, "toml")[0]).expect("a file");
    // Commands on files that come with the project find them where they stand.
    for example in [
        "examples/scenes/full-scale-upper.toml",
        "examples/data/synthetic-upper.csv",
    ] {
        let copy = folder.join(example);
        fs::create_dir_all(copy.parent().expect("a folder")).expect("a folder");
        fs::copy(Path::new(env!("CARGO_MANIFEST_DIR")).join(example), copy).expect("a copy");
    }
    let commands: Vec<&str> = blocks(&readme, "sh").into_iter().flat_map(commands).collect();
    assert!(commands.len() >= 5, "{commands:?}");
    for line in commands {
        run_in(&folder, &said(line));
    }
}

/// The same command with twelve passes, where it reads a scene and names no passes itself.
fn short(line: &str) -> String {
    let words = line.split('#').next().unwrap_or_default().trim_end();
    let sceneless = ["new ", "presets", "explain", "schema", "completions"];
    if words.contains("traffic.passes") || sceneless.iter().any(|name| words.starts_with(name)) {
        words.to_owned()
    } else {
        format!("{words} --set traffic.passes=12")
    }
}

/// Lines of a block of `sh` that call the program, without its name.
fn commands(block: &str) -> impl Iterator<Item = &str> {
    block.lines().filter_map(|line| line.strip_prefix("creepage "))
}

/// What a command of a page prints; it has to succeed.
#[track_caller]
fn run_in(folder: &Path, line: &str) -> String {
    let words = line.split('#').next().unwrap_or_default();
    // What stands in quotes is one word.
    let arguments: Vec<&str> = words
        .split('"')
        .enumerate()
        .flat_map(|(index, part)| match index % 2 {
            0 => part.split_whitespace().collect(),
            _ => vec![part],
        })
        .collect();
    let output = command(&arguments)
        .current_dir(folder)
        .output()
        .expect("the command");
    let errors = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "creepage {line}: {errors}");
    String::from_utf8(output.stdout).expect("UTF-8")
}

/// Arguments that set `keys`.
fn set<'a>(keys: &[&'a str]) -> Vec<&'a str> {
    keys.iter().flat_map(|key| ["--set", key]).collect()
}

/// All names of fields in a document.
fn fields(document: &Value, found: &mut BTreeSet<String>) {
    match document {
        Value::Object(object) => {
            for (name, value) in object {
                found.insert(name.clone());
                fields(value, found);
            }
        }
        Value::Array(list) => list.iter().for_each(|value| fields(value, found)),
        _ => {}
    }
}

#[test]
fn the_page_on_json_names_every_field() {
    let page = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/json.md");
    let page = fs::read_to_string(page).expect("the page");
    let folder = folder("json-page");
    let (scene, table) = (folder.join("my-duct.toml"), folder.join("bands.csv"));
    let readme = readme();
    fs::write(&scene, blocks(&readme, "toml")[0]).expect("a file");
    let scene = text(&scene);
    let quick = set(&["traffic.passes=4", "solver.tolerance=0.05"]);
    let limits = ["--limit-force", "5 kN", "--limit-movement", "1 m"];
    let heat = set(&[
        "heat.expansion=1e-5 1/K",
        "heat.daily_swing=5 K",
        "traffic.per_day=2",
    ]);
    let random = set(&["traffic.passes=20000", "traffic.order=random", "duct.length=81 m"]);
    let places = ["--at", "upstream", "--at", "80 m"];
    let drawn = [
        "--vary",
        "friction.dynamic_coefficient=normal(0.25, 0.01)",
        "--samples",
        "2",
        "--out",
        text(&table),
    ];
    let fitted = ["--data", "examples/data/synthetic-upper.csv"];
    let mut found = BTreeSet::new();
    for arguments in [
        [&["run", scene][..], &quick, &limits, &heat].concat(),
        [&["run", scene][..], &quick[2..], &random].concat(),
        [&["plan", scene][..], &quick].concat(),
        [&["profile", scene][..], &quick].concat(),
        [&["design", scene][..], &quick, &limits, &places].concat(),
        [&["sweep", scene][..], &quick, &drawn].concat(),
        [&["calibrate", UPPER][..], &fitted].concat(),
        vec!["presets"],
        vec!["explain"],
    ] {
        let output = output(&[&arguments[..], &["--json"]].concat());
        assert_eq!(
            output.status.code(),
            Some(0),
            "{arguments:?}: {}",
            String::from_utf8_lossy(&output.stderr)
        );
        fields(&serde_json::from_slice(&output.stdout).expect("JSON"), &mut found);
    }
    assert!(found.len() > 120, "{found:?}");
    let missing: Vec<_> = found
        .iter()
        .filter(|name| !page.contains(&format!("`{name}`")))
        .collect();
    // A place that is a clamp has its position by this name.
    assert_eq!(missing, ["clamp"], "not on docs/json.md");
}

/// The commands of every page of docs/ run, a page in one folder with the README's scene as `my-duct.toml`; a block of
/// `csv` whose first line is `# NAME.csv` is a file there. A block of `text` after a block of `sh` shows lines that its
/// commands print, in their order; a line `...` stands for what is left out. Where nothing is shown, a few passes are enough. A block
/// marked `sh slow` is not run.
#[test]
fn the_commands_in_the_documentation_work_and_print_what_it_shows() {
    let scene = readme();
    let scene = blocks(&scene, "toml")[0];
    let docs = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs");
    let mut run = 0;
    for entry in fs::read_dir(docs).expect("docs/") {
        let page = entry.expect("an entry").path();
        if page.extension().is_none_or(|extension| extension != "md") {
            continue;
        }
        let name = Path::new("docs").join(page.file_stem().expect("a name"));
        let _ = fs::remove_dir_all(folder(text(&name)));
        let folder = folder(text(&name));
        fs::write(folder.join("my-duct.toml"), scene).expect("a file");
        let page = fs::read_to_string(&page).expect("a page");
        let mut printed = String::new();
        // Fences open and close in turn: every second part is a block, with its language in the first line.
        let fences = page.split("```").skip(1).step_by(2);
        let blocks: Vec<(&str, &str)> = fences
            .map(|block| block.split_once('\n').expect("a block"))
            .collect();
        for (index, &(language, block)) in blocks.iter().enumerate() {
            match language {
                "sh" => {
                    let mut after = blocks[index + 1..].iter().map(|(language, _)| *language);
                    let shows = after.find(|language| ["sh", "text"].contains(language)) == Some("text");
                    let said = |line: &str| if shows { line.to_owned() } else { short(line) };
                    printed = commands(block).map(|line| run_in(&folder, &said(line))).collect();
                    run += commands(block).count();
                }
                "csv" => {
                    let name = block.lines().next().and_then(|line| line.strip_prefix("# "));
                    let name = name.and_then(|line| line.split(':').next()).expect("a name");
                    fs::write(folder.join(name), block).expect("a file");
                }
                "text" => assert_shows(block, &printed),
                _ => {}
            }
        }
    }
    assert!(run >= 5, "{run} commands in docs/");
}

/// Every line of `shown` is printed, one after the other; numbers may differ a little from machine to machine.
#[track_caller]
fn assert_shows(shown: &str, printed: &str) {
    let mut lines = printed.lines();
    let mut left_out = true;
    for wanted in shown.lines() {
        if wanted.trim() == "..." {
            left_out = true;
        } else if left_out {
            assert!(
                lines.any(|line| alike(wanted, line)),
                "{wanted}\nis not in\n{printed}"
            );
            left_out = false;
        } else {
            let line = lines.next().unwrap_or_default();
            assert!(alike(wanted, line), "shown:\n{wanted}\nprinted:\n{line}");
        }
    }
}

/// Whether two lines have the same words, and numbers within 0.2 % or one of their last decimals; milliseconds that something takes, within
/// half of them, for planning is measured.
fn alike(shown: &str, printed: &str) -> bool {
    let words = |line: &str| -> Vec<String> { line.split_whitespace().map(str::to_owned).collect() };
    let (shown, printed) = (words(shown), words(printed));
    let same = |index: usize| {
        let (a, b) = (&shown[index], &printed[index]);
        let is_time = shown.get(index + 1).is_some_and(|unit| unit == "ms");
        match (a.parse::<f64>(), b.parse::<f64>()) {
            (Ok(x), Ok(y)) => {
                let share = if is_time { 0.5 } else { 2e-3 };
                (x - y).abs() <= (share * y.abs()).max(1.01 * last_decimal(a))
            }
            _ => a == b,
        }
    };
    shown.len() == printed.len() && (0..shown.len()).all(same)
}

/// 0.01 for "3.58"; 0 for a whole number or one with an exponent.
fn last_decimal(number: &str) -> f64 {
    match number.split_once('.') {
        Some((_, decimals)) if !decimals.contains('e') => 0.1_f64.powf(decimals.len() as f64),
        _ => 0.0,
    }
}

#[test]
fn the_output_in_the_readme_is_the_output() {
    let readme = readme();
    let shown = blocks(&readme, "text");
    let shown = shown.first().expect("the output of the main job");
    let printed = printed(&["run", UPPER]);
    assert!(shown.contains("saturation: "));
    assert_eq!(shown.lines().count(), printed.trim_end().lines().count());
    for (shown, printed) in shown.lines().zip(printed.lines()) {
        if ["estimated error", "Ground", "  ground", "  from runs"]
            .iter()
            .any(|start| printed.starts_with(start))
        {
            continue;
        }
        let (shown_words, words) = (shown.split_whitespace(), printed.split_whitespace());
        assert_eq!(
            shown_words.clone().count(),
            words.clone().count(),
            "{shown}\n{printed}"
        );
        for (shown_word, word) in shown_words.zip(words) {
            match (shown_word.parse::<f64>(), word.parse::<f64>()) {
                // Numbers may differ in their last digit from machine to machine.
                (Ok(a), Ok(b)) => assert!((a - b).abs() <= 2e-3 * b.abs() + 1e-3, "{shown}\n{printed}"),
                _ => assert_eq!(shown_word, word),
            }
        }
    }
}
