//! The command line, from outside: what it answers where, and its exit status. What it says of mistakes stands in messages.rs.

use std::collections::BTreeSet;
use std::fs;
use std::process::Stdio;
use std::time::Duration;

use serde_json::Value;

use crate::command::{
    answer, answered, assert_says, command, folder, json, list, number, numbers, output, printed, read, table,
};
use crate::scenes::assert_near;

const PASS_FIELDS: &str = "pass downstream_force_n downstream_peak_n upstream_force_n upstream_peak_n max_compression_n \
    upstream_displacement_m downstream_displacement_m dissipated_energy_j downstream_least_n upstream_least_n";
const PROFILE_FIELDS: &str = "positions_m longitudinal_m vertical_m longitudinal_velocity_m_per_s";
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
    for (pass, name) in [("2 000 000 ", "back"), ("3 000 001 ", "there")] {
        let pass = pass.replacen(' ', "\u{a0}", 2);
        let row = said.lines().find(|line| line.trim_start().starts_with(&pass));
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
    let passes = list(&run["passes"]);
    assert_eq!(passes.len(), 200);
    for (pass, index) in passes.iter().zip(1_u64..) {
        assert_eq!(pass["pass"].as_u64(), Some(index));
        let of = |field: &str| number(&pass[field]);
        assert!(PASS_FIELDS.split(' ').all(|field| of(field).is_finite()));
        assert!(of("downstream_peak_n") >= of("downstream_force_n"), "{pass}");
        assert!(of("upstream_force_n") == 0.0 && of("downstream_displacement_m") == 0.0);
    }
    // An independent program's force, before passes of which the last are alike.
    assert_near(number(&run["saturation"]["force_n"]), 527.84, 0.01, "saturation");
    let nearly = number(&run["saturation"]["passes_to_95_percent"]);
    assert!((30.0..60.0).contains(&nearly), "{nearly}");
    let error = number(&run["error_estimate"]["relative"]);
    assert!((0.0..=0.01).contains(&error) && run["error_estimate"]["method"].is_string());
    assert_eq!(run["warnings"], Value::Array(vec![]));
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
    let words: Vec<&str> = said.split_whitespace().collect();
    assert_says(
        &words.join(" "),
        &[" 60 1 day ", " 1826 1 month ", " 10 958 183 days "],
    );
    assert_eq!(table(&file).0[..2], ["pass", "years"]);
    // The same keys on the other commands, and a time in days or years.
    let plan = printed("plan UPPER --years 20 --trucks-per-day 800 --json");
    assert_says(&plan, &["of 5844000 passes"]);
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
    let first = rows.iter().find(|row| largest(row) > limit);
    let first = first.expect("a pass above it");
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
    let between = -0.5 * (after + least);
    let broken = run(&format!("{pulled} --limit-force upstream={between}"));
    let verdict = &broken["limits"][0];
    assert_eq!(number(&verdict["largest"]), -least);
    assert!(verdict["during_a_pass"] == true && verdict["pulled"] == true);
    assert!(broken["limit_reached_after"]["pass"].is_u64(), "{broken}");

    // A limit without a name is that of both ends, of a free one too; what is named counts before it.
    for (more, expected) in [
        ("", [(1e-6, true), (1e-6, false)]),
        ("--limit-movement 'upstream=1 m'", [(1.0, false), (1e-6, false)]),
        ("--set ends.downstream=free", [(1e-6, true), (1e-6, true)]),
    ] {
        let document = run(&format!("--limit-movement '1 um' {more}"));
        let verdict = |verdict: &Value| (number(&verdict["limit"]), !verdict["reached_after"].is_null());
        let verdicts: Vec<_> = list(&document["limits"]).iter().map(verdict).collect();
        assert_eq!(verdicts, expected, "{more}");
    }
    // With --check an exceeded limit is a failure of its own kind, after the whole answer.
    let both = format!("{RUN} --limit-movement '1 um'");
    let (status, checked, _) = output(&format!("{both} --check"));
    assert_eq!((status, checked), (3, printed(&both)));
    assert_eq!(output(&format!("{RUN} --limit-movement '1 m' --check")).0, 0);
}

/// Every table has the numbers of its document, replaces an older and longer one, and is the same on standard output.
#[test]
fn a_table_is_its_document() {
    let file = folder("tables").join("table.csv");
    let path = file.display();
    for (line, fields) in [
        ("run UPPER --set traffic.passes=9", PASS_FIELDS),
        (SHORT, PASS_FIELDS),
        ("profile UPPER --positions -1,0,2.5", PROFILE_FIELDS),
    ] {
        let document = json(&format!("{line} --csv {path}"));
        let (mut header, rows) = table(&file);
        // A list of numbers has one for each.
        header[0] = header[0].replace("position_m", "positions_m");
        assert_eq!(header.join(" "), fields);
        for (column, field) in fields.split(' ').enumerate() {
            let written = rows.iter().map(|row| row[column].parse().expect("a number"));
            let expected = match document.get("passes") {
                Some(passes) => list(passes).iter().map(|pass| number(&pass[field])).collect(),
                None => numbers(&document[field]),
            };
            assert_eq!(written.collect::<Vec<f64>>(), expected, "{line}: {field}");
        }
        let same = printed(&format!("{line} --csv -"));
        assert_eq!(same, fs::read_to_string(&file).expect("the table"));
    }
}

#[test]
fn the_table_marks_the_passes_that_were_not_simulated() {
    let file = folder("marked").join("forces.csv");
    let line = "run UPPER --days 20 --trucks-per-day 100 --set solver.tolerance=0.05";
    let run = json(&format!("{line} --csv {}", file.display()));
    let passes = list(&run["passes"]);
    assert_eq!(passes.last().expect("a pass")["pass"], 2000);
    let written = fs::read_to_string(&file).expect("a table");
    let (header, rows) = written.split_once('\n').expect("a header");
    assert!(header.ends_with(",interpolated") && !rows.contains(",-0.0,"));
    let mut marked = 0;
    for (line, pass) in rows.lines().zip(passes) {
        let is_marked = pass["interpolated"] == true;
        assert!(line.ends_with(if is_marked { ",1" } else { ",0" }), "{line}");
        marked += usize::from(is_marked);
    }
    assert!((1..passes.len() - 1).contains(&marked), "{marked}");
}

#[test]
fn verify_measures_the_error_and_leaves_the_forces() {
    let (estimated, verified) = (json(SHORT), json(&format!("{SHORT} --verify")));
    assert_eq!(verified["passes"], estimated["passes"]);
    let measured = number(&verified["error_estimate"]["relative"]);
    assert!(measured > 0.0 && measured < 0.01, "{measured}");
    let [one, other] = [&estimated, &verified].map(|run| &run["error_estimate"]["method"]);
    assert_ne!(one, other);
    // The finer run it speaks of, made by hand.
    let [node, step] = ["node_spacing_m", "vehicle_step_m"].map(|key| 0.5 * number(&verified["plan"][key]));
    let finer = json(&format!(
        "{SHORT} --set solver.node_spacing={node} --set solver.vehicle_step={step}"
    ));
    let difference = (last_force(&finer) / last_force(&verified) - 1.0).abs();
    assert!(difference <= measured * 1.0001, "{difference} {measured}");
}

/// What is warned of where stands in messages.rs.
#[test]
fn warnings_go_to_standard_error_and_into_the_document() {
    let coarse = "'solver={ node_spacing = 0.1, tolerance = 1e-4 }' --set vehicles.0.speed=40";
    let (run, errors) = answered(&format!("run UPPER --set traffic.passes=2 --set {coarse}"));
    let warnings = list(&run["warnings"]);
    assert!(warnings.len() > 1, "{errors}");
    for warning in warnings {
        assert_says(
            &errors,
            &["warning: ", &format!("{}\n", warning.as_str().expect("a text"))],
        );
    }
}

// profile

#[test]
fn profile_takes_positions_of_any_sign_in_their_order() {
    let lists = |more: &str| -> Vec<Vec<f64>> {
        let profile = json(&format!("profile UPPER {more}"));
        PROFILE_FIELDS
            .split(' ')
            .map(|field| numbers(&profile[field]))
            .collect()
    };
    let all = lists("");
    assert!(all[0].len() > 100 && all[0].is_sorted());
    for (positions, expected) in [
        ("--positions -1.5,0,1.5", &[-1.5, 0.0, 1.5][..]),
        ("--positions=1,-1,1", &[1.0, -1.0, 1.0]),
        ("--positions -2", &[-2.0]),
    ] {
        let found = lists(positions);
        assert_eq!(found[0], expected);
        assert!(found.iter().all(|list| list.len() == expected.len()), "{found:?}");
    }
    assert_eq!(printed("profile UPPER --positions -1,0,2.5").lines().count(), 5);
}

// help, explain, presets, new, completions

/// What each command says of itself is on docs/commands.md: generated_pages.rs.
#[test]
fn every_command_has_its_help_and_every_shell_the_commands() {
    let help = printed("--help");
    let (_, commands) = help.split_once("Commands:\n").expect("the commands");
    let commands = commands.lines().map_while(|line| line.strip_prefix("  "));
    // Long descriptions go on in lines of their own.
    let names = commands.filter_map(|line| line.split(' ').next().filter(|name| !name.is_empty()));
    let commands: Vec<&str> = names.collect();
    assert!(commands.len() > 10, "{help}");
    for command in commands.iter().filter(|command| **command != "help") {
        let help = printed(&format!("{command} --help"));
        assert_says(&help, &["Examples:", "Exit status:"]);
    }
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        assert_says(&printed(&format!("completions {shell}")), &commands);
    }
    let version = format!("creepage {}\n", env!("CARGO_PKG_VERSION"));
    assert_eq!(printed("--version"), version);
}

#[cfg(unix)]
#[test]
fn the_shell_understands_its_script() {
    let script = folder("completions").join("script");
    fs::write(&script, printed("completions bash")).expect("a file");
    let line = "source \"$0\"; complete -p creepage; COMP_WORDS=(creepage ru) COMP_CWORD=1; \
                _creepage creepage ru creepage; echo \"${COMPREPLY[@]}\"";
    let bash = std::process::Command::new("bash")
        .args(["-c", line])
        .arg(&script)
        .output();
    let (_, told, errors) = answer(bash.expect("bash starts"));
    let understood = told.starts_with("complete ") && told.ends_with("\nrun\n");
    assert!(understood, "{told}{errors}");
}

/// The keys themselves are on docs/scene.md: generated_pages.rs.
#[test]
fn keys_are_explained_by_path_and_by_name() {
    let required = [
        "\n*  duct.depth ",
        "\n   duct.slope ",
        "\n*  vehicles.wheels.load ",
    ];
    assert_says(&printed("explain"), &required);
    for key in ["duct.depth", "depth", "vehicles.0.speed", "vehicles.speed"] {
        assert_says(&printed(&format!("explain {key}")), &["(units: m", "  required"]);
    }
    let both = ["duct.lateral_offset\n", "vehicles.lateral_offset\n"];
    assert_says(&printed("explain lateral_offset"), &both);
    assert_eq!(json("explain traffic.years")[0]["key"], "traffic.years");
}

#[test]
fn presets_are_listed_with_their_sources() {
    let (said, document) = (printed("presets"), json("presets"));
    assert!(list(&document).len() > 15);
    for preset in list(&document) {
        assert_says(&said, &[preset["name"].as_str().expect("a name")]);
        for source in list(&preset["sources"]) {
            let assumed = ["", "ASSUMED, "][usize::from(source["assumed"] == true)];
            let [key, source] = ["key", "source"].map(|field| source[field].as_str().expect("a text"));
            assert_says(&said, &[&format!("{key}: {assumed}{source}\n")]);
        }
    }
    let one = printed("presets t-25");
    assert!(one.contains("ASSUMED") && !one.contains("t-20"), "{one}");
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
        assert!(written.matches('#').count() > 15, "{written}");
        let (status, said, warned) = output(&format!("check {path}"));
        assert!(status == 0 && said.contains("valid"), "{said}{warned}");
        let (document, same) = answered(&format!("run {path}"));
        assert!(last_force(&document).is_finite());
        // The last two grounds give way more than roads do, and nothing else is warned of.
        let is_soft = index >= 2;
        let warns = warned.contains("far above what is measured under roads");
        assert_eq!(
            (warns, warned.lines().count()),
            (is_soft, usize::from(is_soft)),
            "{warned}"
        );
        assert_eq!(warned, same);
        // It is there now, and stays as it is.
        assert_eq!(output(&format!("new {path}")).0, 2);
        assert_eq!(fs::read_to_string(&file).expect("the scene"), written);
    }
}

// what goes wrong outside

#[test]
fn a_reader_that_leaves_is_no_error() {
    for line in [
        "run UPPER --set traffic.passes=2",
        "run UPPER --set traffic.passes=2 --json",
        "profile UPPER",
        "check UPPER",
    ] {
        let mut command = command(line);
        command.stdout(Stdio::piped()).stderr(Stdio::piped());
        let mut child = command.spawn().expect("the command");
        drop(child.stdout.take());
        let (status, _, errors) = answer(child.wait_with_output().expect("it ends"));
        assert_eq!((status, &*errors), (0, ""), "{line}");
    }
}

/// A sweep of 48 points of one pass each on two threads: 20 ms a point, so that there is time to kill it.
#[test]
fn a_killed_sweep_loses_nothing_finished_and_ends_with_the_same_file() {
    let folder = folder("sweep_killed");
    let [calm, killed] = ["calm", "killed"].map(|name| folder.join(format!("{name}.xlsx")));
    let [first, line] = [&calm, &killed].map(|out| {
        format!(
            "sweep UPPER --set traffic.passes=1 --threads 2 --vary friction.dynamic_coefficient=0.05:0.6:0.05 \
             --vary duct.depth=0.9m,1.2m,1.5m,2m --out {}",
            out.display()
        )
    });
    assert_says(&printed(&first), &["calm", "48 points\n"]);
    let unfinished = folder.join("killed.xlsx.unfinished");
    let lines = || {
        fs::read_to_string(&unfinished)
            .unwrap_or_default()
            .matches('\n')
            .count()
    };
    let mut child = command(&line);
    let mut child = child.stdout(Stdio::null()).spawn().expect("the command starts");
    while lines() < 12 {
        let ended = child.try_wait().expect("a state");
        assert!(ended.is_none(), "it ended before it was killed");
        std::thread::sleep(Duration::from_millis(2));
    }
    child.kill().expect("SIGKILL");
    child.wait().expect("it ends");
    assert!(!killed.exists());
    let kept = lines() as u64 - 2;
    assert!(kept >= 10, "{kept}");
    let summary = json(&line);
    let counts = ["points", "resumed", "failed"].map(|field| summary[field].as_u64());
    assert_eq!(counts, [Some(48), Some(kept), Some(0)]);
    assert!(fs::read(&killed).expect("a table") == fs::read(&calm).expect("a table"));
    assert!(!unfinished.exists());
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
