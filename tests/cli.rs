//! The command line, from outside: what it answers where, and its exit status. What it says of mistakes stands in messages.rs.

use std::collections::BTreeSet;
use std::fs;
use std::process::Stdio;
use std::time::Duration;

use serde_json::Value;

use crate::command::{
    answered, assert_says, command, folder, json, list, number, numbers, output, printed, read, table,
};

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
/// The upper phase with a few passes only.
const SHORT: &str = "run UPPER --set traffic.passes=6";

fn last_force(run: &Value) -> f64 {
    number(&list(&run["passes"]).last().expect("a pass")["downstream_force_n"])
}

// run

/// Who drives in a pass of millions is known where vehicles come by turns.
#[test]
fn rows_of_long_traffic_name_their_vehicle() {
    let vehicles = r#"'vehicles=[{ name = "there", speed = 10, load = "20 tf" }, { name = "back", speed = 10, load = "10 tf" }]'"#;
    let long = "--set traffic.passes=3000001 --set duct.length=6 --set solver.tolerance=0.05";
    let said = printed(&format!("run UPPER --set {vehicles} {long}"));
    for (pass, name) in [
        ("2\u{a0}000\u{a0}000 ", "back"),
        ("3\u{a0}000\u{a0}001 ", "there"),
    ] {
        let row = said.lines().find(|line| line.trim_start().starts_with(pass));
        assert!(row.is_some_and(|row| row.ends_with(name)), "{said}");
    }
}

#[test]
fn run_answers_with_every_field_of_its_document() {
    let run = json("run UPPER");
    assert_eq!(run["title"], "Full-scale experiment, upper phase");
    assert!(run["plan"]["ground"].is_string() && run["plan"]["cable"].is_string());
    assert!(number(&run["plan"]["node_spacing_m"]) > 0.0 && number(&run["plan"]["vehicle_step_m"]) > 0.0);
    let reasons = list(&run["plan"]["reasons"]);
    assert!(!reasons.is_empty() && reasons.iter().all(Value::is_string));
    // Boussinesq's closed form: (1+ν)P/(2πE)·(2−2ν+1)/z below the load.
    let below = 1.4 * 196_133.0 / (std::f64::consts::TAU * 800e6) * 2.2 / 1.2;
    assert!((number(&run["duct_motion"]["peak_vertical_m"]) / below - 1.0).abs() < 1e-6);
    assert!((number(&run["duct_motion"]["peak_longitudinal_m"]) / 15.19e-6 - 1.0).abs() < 1e-3);

    let passes = list(&run["passes"]);
    assert_eq!(passes.len(), 200);
    for (pass, index) in passes.iter().zip(1_u64..) {
        assert_eq!(pass["pass"].as_u64(), Some(index));
        let [after, peak, free, fixed] = [1, 2, 3, 7].map(|field| number(&pass[PASS_FIELDS[field]]));
        assert!(
            PASS_FIELDS.iter().all(|field| number(&pass[field]).is_finite()),
            "{pass}"
        );
        assert!(peak >= after && free == 0.0 && fixed == 0.0, "{pass}");
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
    let nearly = run["saturation"]["passes_to_95_percent"]
        .as_u64()
        .expect("a whole number");
    assert!((30..60).contains(&nearly), "{nearly}");
    let error = number(&run["error_estimate"]["relative"]);
    assert!((0.0..=0.01).contains(&error) && run["error_estimate"]["method"].is_string());
    assert_eq!(run["warnings"], Value::Array(vec![]));
}

#[test]
fn run_prints_a_short_table_and_the_plan() {
    let line = "run UPPER --set traffic.passes=40";
    let (said, run) = (printed(line), json(line));
    assert!(
        said.lines().count() < 40 && said.starts_with("Full-scale experiment, upper phase\n"),
        "{said}"
    );
    for pass in [1, 40] {
        let record = &run["passes"][pass - 1];
        let numbers =
            |line: &str| -> Vec<f64> { line.split_whitespace().map_while(|n| n.parse().ok()).collect() };
        let mut rows = said.lines().map(numbers);
        let row = rows
            .find(|row| row.first() == Some(&(pass as f64)))
            .expect("a row for the pass");
        // Nothing is on a free end, and a fixed one does not move.
        let shown = [
            ("downstream_force_n", 1.0),
            ("upstream_displacement_m", 1e3),
            ("max_compression_n", 1.0),
        ];
        assert_eq!(row.len(), 1 + shown.len());
        for ((field, factor), shown) in shown.into_iter().zip(&row[1..]) {
            let value = factor * number(&record[field]);
            assert!((shown - value).abs() < 0.06, "pass {pass}, {field}: {row:?}");
        }
    }
    for reason in list(&run["plan"]["reasons"]) {
        assert_says(
            &said,
            &[reason.as_str().expect("a text"), "it has not levelled off"],
        );
    }
    assert!(run["saturation"].is_null());
}

#[test]
fn years_and_vehicles_a_day_give_the_passes_a_time() {
    let file = folder("years").join("years.csv");
    let line = "run UPPER --years 0.5 --trucks-per-day 60 --set 'duct.length=10 m'";
    let document = json(line);
    let rows = list(&document["passes"]);
    let pass = |row: &Value| row["pass"].as_u64().expect("a number");
    for row in rows {
        let share = number(&row["years"]) / (pass(row) as f64 / (365.25 * 60.0));
        assert!((share - 1.0).abs() < 1e-12, "{row}");
    }
    // 0.5 · 365.25 · 60 = 10957.5
    assert_eq!(pass(rows.last().expect("a pass")), 10_958);
    assert!(rows.iter().any(|row| pass(row) == 1826), "the first month");
    let said = printed(&format!("{line} --csv {}", file.display()));
    let words = said
        .lines()
        .map(|line| line.split_whitespace().collect::<Vec<_>>().join(" "));
    let words: Vec<String> = words.collect();
    for begin in ["60 1 day ", "1826 1 month ", "10 958 183 days "] {
        assert!(words.iter().any(|words| words.starts_with(begin)), "{said}");
    }
    assert_eq!(table(&file).0[..2], ["pass", "years"]);
    // The same keys on the other commands, and a time in days or years.
    let plan = printed("plan UPPER --years 20 --trucks-per-day 800 --json");
    assert_says(&plan, &["of 5844000 passes"]);
    let few = printed("run UPPER --trucks-per-day 2 --set traffic.passes=3");
    assert_says(&few, &["  3  1.5 days"]);
    for time in ["--days 2", "--years 0.0054757"] {
        let run = json(&format!("run UPPER --trucks-per-day 3 {time}"));
        assert_eq!(list(&run["passes"]).len(), 6, "{time}");
    }
}

#[test]
fn limits_have_a_verdict_and_the_pass_that_breaks_them() {
    const RUN: &str = "run UPPER --set traffic.passes=8 --set 'duct.length=10 m' --trucks-per-day 4";
    let run = |more: &str| json(&format!("{RUN} {more}"));
    let document = run("");
    assert_eq!(document.get("limit_reached_after"), None);
    let rows = list(&document["passes"]);
    // A limit between two passes is broken by the later one.
    let largest = |row: &Value| number(&row["downstream_force_n"]).max(number(&row["downstream_peak_n"]));
    let limit = 0.5 * (largest(&rows[2]) + largest(&rows[3]));
    let first = rows
        .iter()
        .find(|row| largest(row) > limit)
        .expect("a pass above the limit");
    assert_ne!(first["pass"], 1);
    let broken = run(&format!("--limit-force {limit}"));
    for field in ["pass", "years"] {
        assert_eq!(broken["limit_reached_after"][field], first[field]);
    }
    assert_eq!(list(&broken["limits"]).len(), 2);
    assert!(run("--limit-force downstream=1kN")["limit_reached_after"].is_null());

    // A cable that is pulled away from its fixed end is pulled hardest while a vehicle passes.
    let pulled = "--set ends.upstream=fixed --set ends.downstream=free";
    let document = run(pulled);
    let last = list(&document["passes"]).last().expect("a pass");
    let [after, least] = ["upstream_force_n", "upstream_least_n"].map(|field| number(&last[field]));
    assert!(least < 1.001 * after && after < 0.0, "{least} {after}");
    let broken = run(&format!(
        "{pulled} --limit-force upstream={}",
        -0.5 * (after + least)
    ));
    let verdict = &broken["limits"][0];
    assert_eq!(number(&verdict["largest"]), -least);
    assert!(
        verdict["during_a_pass"] == true && verdict["pulled"] == true,
        "{verdict}"
    );
    assert!(broken["limit_reached_after"]["pass"].is_u64(), "{broken}");

    // A limit without a name is that of both ends, of a free one too; what is named counts before it.
    for (more, expected) in [
        ("", [(1e-6, true), (1e-6, false)]),
        ("--limit-movement 'upstream=1 m'", [(1.0, false), (1e-6, false)]),
        ("--set ends.downstream=free", [(1e-6, true), (1e-6, true)]),
    ] {
        let document = run(&format!("--limit-movement '1 um' {more}"));
        let verdicts = list(&document["limits"]).iter();
        let verdicts =
            verdicts.map(|verdict| (number(&verdict["limit"]), !verdict["reached_after"].is_null()));
        assert_eq!(verdicts.collect::<Vec<_>>(), expected, "{more}");
    }
    let both = format!("{RUN} --limit-movement '1 um'");
    let said = printed(&both);
    assert_says(
        &said,
        &[
            "limit exceeded: the upstream end moves by up to ",
            "1 of 2 limits exceeded",
        ],
    );
    // With --check that is a failure of its own kind, after the whole answer.
    let (status, checked, _) = output(&format!("{both} --check"));
    assert_eq!((status, checked), (3, said));
    assert_eq!(output(&format!("{RUN} --limit-movement '1 m' --check")).0, 0);
}

/// Every table has the numbers of its document, replaces an older and longer one, and is the same on standard output.
#[test]
fn a_table_is_its_document() {
    let file = folder("tables").join("table.csv");
    let path = file.display();
    for (line, fields) in [
        ("run UPPER --set traffic.passes=9", &PASS_FIELDS[..]),
        (SHORT, &PASS_FIELDS),
        ("profile UPPER --positions -1,0,2.5", &PROFILE_FIELDS),
    ] {
        let document = json(&format!("{line} --csv {path}"));
        let (mut header, rows) = table(&file);
        // A list of numbers has one for each.
        header[0] = header[0].replace("position_m", "positions_m");
        assert_eq!(header, fields);
        for (column, field) in fields.iter().enumerate() {
            let written: Vec<f64> = rows
                .iter()
                .map(|row| row[column].parse().expect("a number"))
                .collect();
            let expected = match document.get("passes") {
                Some(passes) => list(passes).iter().map(|pass| number(&pass[field])).collect(),
                None => numbers(&document[field]),
            };
            assert_eq!(written, expected, "{line}: {field}");
        }
        assert_eq!(
            printed(&format!("{line} --csv -")),
            fs::read_to_string(&file).expect("the table")
        );
    }
}

#[test]
fn the_table_marks_the_passes_that_were_not_simulated() {
    let file = folder("marked").join("forces.csv");
    let run = json(&format!(
        "run UPPER --days 20 --trucks-per-day 100 --csv {}",
        file.display()
    ));
    let passes = list(&run["passes"]);
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

/// The same scene by overrides, as an edited file, and once more by the same command.
#[test]
fn set_is_as_good_as_an_edit_of_the_file() {
    let changes = "--set friction.dynamic_coefficient=0.3 --set 'vehicles.0.load=15 tf' --set title=Other";
    let set = json(&format!("{SHORT} {changes}"));
    assert_eq!(set["title"], "Other");
    let change = last_force(&set) / last_force(&json(SHORT)) - 1.0;
    assert!(change.abs() > 0.05, "changed by {change}");
    let file = folder("set").join("edited.toml");
    let edited = read("examples/scenes/full-scale-upper.toml")
        .replace("dynamic_coefficient = 0.25", "dynamic_coefficient = 0.3")
        .replace("load = \"20 tf\"", "load = \"15 tf\"")
        .replace("passes = 200", "passes = 6")
        .replace("Full-scale experiment, upper phase", "Other");
    fs::write(&file, edited).expect("a file");
    assert_eq!(json(&format!("run {}", file.display())), set);
    let random = "run UPPER --json --set traffic.passes=4 --set traffic.order=random --set traffic.seed=3";
    assert_eq!(printed(random), printed(random));
}

#[test]
fn a_mirrored_scene_has_the_mirrored_answer() {
    let forward = json(SHORT);
    let mirrored = json(&format!(
        "{SHORT} --set vehicles.0.direction=reverse --set ends.upstream=fixed --set ends.downstream=free"
    ));
    for (pass, original) in list(&mirrored["passes"]).iter().zip(list(&forward["passes"])) {
        for (field, other, sign) in [
            ("upstream_force_n", "downstream_force_n", 1.0),
            ("downstream_displacement_m", "upstream_displacement_m", -1.0),
        ] {
            assert!(
                (number(&pass[field]) / number(&original[other]) - sign).abs() < 1e-3,
                "{field}"
            );
        }
    }
}

#[test]
fn verify_measures_the_error_and_leaves_the_forces() {
    let (estimated, verified) = (json(SHORT), json(&format!("{SHORT} --verify")));
    assert_eq!(verified["passes"], estimated["passes"]);
    let measured = number(&verified["error_estimate"]["relative"]);
    assert!(measured > 0.0 && measured < 0.01, "{measured}");
    assert_ne!(
        verified["error_estimate"]["method"],
        estimated["error_estimate"]["method"]
    );
    // The finer run it speaks of, made by hand.
    let [node, step] = ["node_spacing_m", "vehicle_step_m"].map(|key| 0.5 * number(&verified["plan"][key]));
    let finer = json(&format!(
        "{SHORT} --set solver.node_spacing={node} --set solver.vehicle_step={step}"
    ));
    let difference = (last_force(&finer) / last_force(&verified) - 1.0).abs();
    assert!(
        difference <= measured * 1.0001,
        "{difference} where {measured} was measured"
    );
}

#[test]
fn warnings_go_to_standard_error_and_into_the_document() {
    let coarse = "--set 'solver.node_spacing=0.1 m' --set 'solver.tolerance=0.01 %'";
    // What an override says is told with its place.
    for (set, place) in [
        (coarse, "warning: "),
        (
            "--set 'ground.rigid_base_depth=1 m'",
            "ground.rigid_base_depth=1 m: ",
        ),
        ("--set vehicles.0.speed=40", "warning: "),
    ] {
        let (status, said, errors) = output(&format!("run UPPER --json --set traffic.passes=2 {set}"));
        assert_eq!(status, 0);
        let run: Value = serde_json::from_str(&said).expect("JSON and nothing else");
        let warnings = list(&run["warnings"]);
        assert!(!warnings.is_empty(), "{set}");
        for warning in warnings {
            assert_says(&errors, &["warning: ", warning.as_str().expect("a text")]);
        }
        let first = warnings[0].as_str().expect("a text");
        assert_says(&errors, &[&format!("{place}{first}\n")]);
    }
}

// profile

#[test]
fn profile_obeys_equation_1_and_the_symmetry_of_one_load() {
    let profile = json("profile UPPER");
    assert!(profile["ground"].is_string());
    let [xi, along, down, velocity] = PROFILE_FIELDS.map(|field| numbers(&profile[field]));
    assert!(
        [&along, &down, &velocity]
            .iter()
            .all(|list| list.len() == xi.len())
    );
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
    for positions in ["--positions -1.5,0,1.5", "--positions=-1.5,0,1.5"] {
        let profile = json(&format!("profile UPPER {positions}"));
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
    let one = json("profile UPPER --positions -2");
    assert!(
        PROFILE_FIELDS.iter().all(|field| numbers(&one[field]).len() == 1),
        "{one}"
    );
    let unsorted = json("profile UPPER --positions 1,-1,1");
    assert_eq!(numbers(&unsorted["positions_m"]), [1.0, -1.0, 1.0]);
    let said = printed("profile UPPER --positions -1,0,2.5");
    assert_eq!(said.lines().count(), 5, "{said}");
    assert_says(&said, &["ξ, m", "D_l, µm", "D_v, µm", "V_l, µm/s"]);
}

// help, explain, presets, new, completions

#[test]
fn help_and_version_are_no_errors_and_name_every_command() {
    let help = printed("--help");
    let (_, commands) = help.split_once("Commands:\n").expect("the commands");
    let commands = commands.lines().map_while(|line| line.strip_prefix("  "));
    // Long descriptions go on in lines of their own.
    let commands = commands.filter(|line| !line.starts_with(' '));
    let commands: Vec<&str> = commands
        .filter_map(|line| line.split_whitespace().next())
        .collect();
    for command in ["run", "profile", "check", "completions"] {
        assert!(commands.contains(&command), "{help}");
    }
    for command in commands.iter().filter(|command| **command != "help") {
        assert_says(&printed(&format!("{command} --help")), &["Examples:"]);
    }
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        assert_says(&printed(&format!("completions {shell}")), &commands);
    }
    for command in "run plan sweep design measures report explain calibrate presets".split(' ') {
        let help = printed(&format!("{command} --help"));
        assert!(help.trim_end().ends_with("130 stopped by Ctrl-C."), "{help}");
    }
    for command in ["run", "profile", "check"] {
        assert_says(&printed(&format!("{command} --help")), &["--set <KEY=VALUE>"]);
    }
    assert_says(&printed("help run"), &["--json", "--csv <FILE>", "--verify"]);
    assert_eq!(
        printed("--version"),
        format!("creepage {}\n", env!("CARGO_PKG_VERSION"))
    );
}

#[test]
fn keys_are_listed_and_explained() {
    let keys = [
        "\n*  duct.depth ",
        "\n   duct.slope ",
        "\n   traffic.per_day ",
        "\n*  vehicles.wheels.load ",
    ];
    assert_says(&printed("explain"), &keys);
    for key in ["duct.depth", "depth", "vehicles.0.speed", "vehicles.speed"] {
        let said = printed(&format!("explain {key}"));
        assert_says(&said, &["  allowed: a ", "(units: m", "  required"]);
    }
    let both = [
        "duct.lateral_offset\n",
        "vehicles.lateral_offset\n",
        "if omitted: 0 m",
    ];
    assert_says(&printed("explain lateral_offset"), &both);
    assert_says(&printed("explain friction"), &["friction.law\n"]);
    assert_eq!(json("explain traffic.years")[0]["key"], "traffic.years");
}

#[test]
fn presets_are_listed_with_their_sources() {
    let (said, document) = (printed("presets"), json("presets"));
    assert!(list(&document).len() > 15);
    let text = |value: &Value| value.as_str().expect("a text").to_owned();
    for preset in list(&document) {
        let [_, name, ..] = ["kind", "name", "summary", "toml"].map(|field| text(&preset[field]));
        assert_says(&said, &[&name]);
        for source in list(&preset["sources"]) {
            let assumed = if source["assumed"] == true {
                "ASSUMED, "
            } else {
                ""
            };
            let [key, source] = ["key", "source"].map(|field| text(&source[field]));
            assert_says(&said, &[&format!("{key}: {assumed}{source}\n")]);
        }
    }
    let one = printed("presets t-25");
    assert_says(&one, &["load = \"100 kN\"", "ASSUMED"]);
    assert!(
        !one.contains("t-20") && list(&json("presets t-25")).len() == 1,
        "{one}"
    );
}

#[test]
fn a_new_scene_passes_the_check_and_runs() {
    let folder = folder("new");
    for (index, flags) in [
        "",
        "--length '40 m' --depth 0.9 --vehicle t-20 --friction 0.3",
        "--pavement n6-cbr6 --length '20 m' --downstream '3 MN/m'",
        "--modulus '100 MPa' --title '\"Quoted\"' --cable xlpe-150-triplex",
    ]
    .into_iter()
    .enumerate()
    {
        let file = folder.join(format!("new-{index}.toml"));
        let path = file.display();
        let said = printed(&format!("new {path} --passes 3 {flags}"));
        assert_says(&said, &[&format!("creepage run {path}")]);
        let written = fs::read_to_string(&file).expect("the scene");
        assert!(
            written.matches('#').count() > 15 && written.contains("passes = 3"),
            "{written}"
        );
        let (status, said, warned) = output(&format!("check {path}"));
        assert!(status == 0 && said.contains("valid"), "{said}{warned}");
        let (document, same) = answered(&format!("run {path}"));
        assert!(last_force(&document).is_finite());
        // The last two grounds give way more than roads do, and nothing else is warned of.
        let is_soft = index >= 2;
        assert_eq!(
            warned.contains("far above what is measured under roads"),
            is_soft,
            "{warned}"
        );
        assert!(
            warned == same && warned.lines().count() == usize::from(is_soft),
            "{warned}{same}"
        );
        // It is there now, and stays as it is.
        assert_eq!(output(&format!("new {path}")).0, 2);
        assert_eq!(fs::read_to_string(&file).expect("the scene"), written);
    }
}

// what goes wrong outside

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_has_status_1() {
    for line in ["check UPPER", "profile UPPER", "profile UPPER --json"] {
        let full = fs::OpenOptions::new().write(true).open("/dev/full");
        let full = Stdio::from(full.expect("the full device"));
        let output = command(line).stdout(full).output().expect("the command");
        let (status, _, errors) = crate::command::answer(output);
        assert_eq!(status, 1, "{line}");
        assert_says(&errors, &["standard output: cannot be written"]);
    }
    let (status, said, errors) = output("profile UPPER --csv /dev/full");
    assert_eq!((status, &*said), (1, ""));
    assert_says(&errors, &["/dev/full", "cannot be written"]);
}

#[test]
fn a_reader_that_leaves_is_no_error() {
    for line in [
        "run UPPER --set traffic.passes=2",
        "run UPPER --set traffic.passes=2 --json",
        "profile UPPER",
        "check UPPER",
    ] {
        let mut child = command(line)
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .expect("the command");
        drop(child.stdout.take());
        let output = child.wait_with_output().expect("it ends");
        assert_eq!(output.status.code(), Some(0), "{line}");
        assert_eq!(String::from_utf8_lossy(&output.stderr), "", "{line}");
    }
}

/// A sweep of 48 points of one pass each on two threads: 20 ms a point, so that there is time to kill it.
#[test]
fn a_killed_sweep_loses_nothing_finished_and_ends_with_the_same_file() {
    let folder = folder("sweep_killed");
    for format in ["csv", "xlsx"] {
        let [calm, killed] = ["calm", "killed"].map(|name| folder.join(format!("{name}.{format}")));
        let [first, line] = [&calm, &killed].map(|out| {
            format!(
                "sweep UPPER --set traffic.passes=1 --threads 2 --vary friction.dynamic_coefficient=0.05:0.6:0.05 \
                 --vary duct.depth=0.9m,1.2m,1.5m,2m --out {}",
                out.display()
            )
        });
        assert_says(&printed(&first), &["calm", "48 points\n"]);
        let unfinished = folder.join(format!("killed.{format}.unfinished"));
        let lines = || {
            fs::read_to_string(&unfinished)
                .unwrap_or_default()
                .matches('\n')
                .count()
        };
        // Twice, each time with some more points done.
        let mut kept = 0;
        for _ in 0..2 {
            let mut child = command(&line)
                .stdout(Stdio::null())
                .spawn()
                .expect("the command starts");
            while lines() < kept + 8 {
                let ended = child.try_wait().expect("a state");
                assert!(ended.is_none(), "it ended before it was killed");
                std::thread::sleep(Duration::from_millis(2));
            }
            child.kill().expect("SIGKILL");
            child.wait().expect("it ends");
            assert!(!killed.exists());
            kept = lines() - 2;
        }
        assert!(kept >= 10, "{kept}");
        let summary = json(&line);
        let counts = ["points", "resumed", "failed"].map(|field| summary[field].as_u64());
        assert_eq!(counts, [Some(48), Some(kept as u64), Some(0)]);
        assert!(fs::read(&killed).expect("a table") == fs::read(&calm).expect("a table"));
        assert!(!unfinished.exists());
    }
}

/// All names of fields in a document.
fn fields(document: &Value, found: &mut BTreeSet<String>) {
    match document {
        Value::Object(object) => object.iter().for_each(|(name, value)| {
            found.insert(name.clone());
            fields(value, found);
        }),
        Value::Array(list) => list.iter().for_each(|value| fields(value, found)),
        _ => {}
    }
}

#[test]
fn the_page_on_json_names_every_field() {
    let folder = folder("json-page");
    let (scene, table) = (crate::pages::MY_DUCT, folder.join("bands.csv"));
    let table = table.display();
    let quick = "--set traffic.passes=4 --set solver.tolerance=0.05";
    let limits = "--limit-force '5 kN' --limit-movement '1 m'";
    let heat = "--set 'heat.expansion=1e-5 1/K' --set 'heat.daily_swing=5 K' --set traffic.per_day=2";
    let random = "--set traffic.passes=20000 --set traffic.order=random --set 'duct.length=81 m'";
    let drawn = "--vary 'friction.dynamic_coefficient=normal(0.25, 0.01)' --samples 2";
    let mut found = BTreeSet::new();
    for line in [
        &*format!("run {scene} {quick} {limits} {heat}"),
        &format!("run {scene} --set solver.tolerance=0.05 {random}"),
        &format!("plan {scene} {quick}"),
        &format!("profile {scene} {quick}"),
        &format!("design {scene} {quick} {limits} --at upstream --at '80 m'"),
        &format!("sweep {scene} {quick} {drawn} --out {table}"),
        "calibrate UPPER --data SERIES",
        "presets",
        "explain",
    ] {
        fields(&answered(line).0, &mut found);
    }
    assert!(found.len() > 120, "{found:?}");
    let page = read("docs/json.md");
    let missing = found.iter().filter(|name| !page.contains(&format!("`{name}`")));
    // A place that is a clamp has its position by this name.
    assert_eq!(missing.collect::<Vec<_>>(), ["clamp"], "not on docs/json.md");
}
