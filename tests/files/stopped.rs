//! What a long command says while it goes on, and what is left of it when it is stopped.

use std::ops::ControlFlow;
use std::os::unix::process::ExitStatusExt;
use std::process::{ExitStatus, Stdio};
use std::time::{Duration, Instant};

use creepage::scene::{Heat, SolverMethod, Warming};
use creepage::{Error, PassRecord, Progress, RunOptions, Scene, Underway};
use serde_json::Value;

use super::common::{Folder, SCENE, creepage};
use super::signals::send;

/// Minutes of work.
const PASSES: u64 = 900_000;

/// How a command ended that was stopped after `time`, and what it printed.
struct Stopped {
    status: ExitStatus,
    printed: String,
    said: String,
}

impl Stopped {
    fn after(time: Duration, folder: &Folder, arguments: &[&str], signal: &str) -> Self {
        let child = folder
            .command(creepage(), arguments)
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .expect("a process");
        std::thread::sleep(time);
        let asked = Instant::now();
        send(folder, &child, signal);
        let output = child.wait_with_output().expect("it ends");
        let took = asked.elapsed();
        assert!(
            took < Duration::from_secs(1),
            "{arguments:?} took {took:?} to end"
        );
        Self {
            status: output.status,
            printed: String::from_utf8(output.stdout).expect("UTF-8"),
            said: String::from_utf8(output.stderr).expect("UTF-8"),
        }
    }
}

/// The number before `word`, or the one behind it.
fn number_behind(text: &str, word: &str) -> Option<u64> {
    let (_, rest) = text.split_once(word)?;
    rest.split_whitespace().next()?.trim_end_matches(',').parse().ok()
}

#[test]
fn the_passes_of_a_stopped_run_are_those_of_a_whole_one() {
    let folder = Folder::new("cut-short");
    let passes = format!("traffic.passes={PASSES}");
    let run = ["run", "scene.toml", "--json", "--set", &passes];
    let stopped = Stopped::after(Duration::from_millis(800), &folder, &run, "INT");
    assert_eq!(stopped.status.code(), Some(130), "{}", stopped.said);
    let cut: Value = serde_json::from_str(&stopped.printed).expect("one document");
    assert_eq!(cut["cut_short"], true);
    // Nobody knows where it leads, nor how wrong it is.
    for unknown in ["saturation", "error_estimate"] {
        assert!(cut.get(unknown).is_some_and(Value::is_null), "{unknown}");
    }
    let records = cut["passes"].as_array().expect("passes");
    let last = records.last().expect("a pass")["pass"]
        .as_u64()
        .expect("its number");
    assert!(last < PASSES, "{last}");
    let said = format!("stopped: cut short after pass {last} of {PASSES}, on nodes 0.500 m apart");
    assert!(stopped.said.contains(&said), "{}", stopped.said);

    // As many passes as all are listed.
    let few = last.min(40);
    let whole = folder.command(
        creepage(),
        &[
            "run",
            "scene.toml",
            "--json",
            "--set",
            &format!("traffic.passes={few}"),
        ],
    );
    let whole = { whole }.output().expect("a run");
    let whole: Value = serde_json::from_slice(&whole.stdout).expect("a document");
    assert!(whole.get("cut_short").is_none());
    assert_eq!(whole["plan"]["node_spacing_m"], cut["plan"]["node_spacing_m"]);
    assert_eq!(
        whole["passes"].as_array().expect("passes")[..],
        records[..few as usize]
    );
}

#[test]
fn a_stopped_run_says_so_and_leaves_an_older_table() {
    let folder = Folder::new("cut-short-in-words");
    let older = ["run", "scene.toml", "--csv", "table.csv"];
    folder.succeeds(&older);
    let before = folder.read("table.csv");
    let passes = format!("traffic.passes={PASSES}");
    let run = ["run", "scene.toml", "--set", &passes, "--csv", "table.csv"];
    for (signal, number) in [("INT", 2), ("TERM", 15)] {
        let stopped = Stopped::after(Duration::from_millis(500), &folder, &run, signal);
        let status = stopped.status;
        let ended = status.signal().or(status.code().map(|code| code - 128));
        assert_eq!(ended, Some(number), "{}", stopped.said);
        let line = stopped.printed.lines().find(|line| line.starts_with("cut short"));
        let line = line.unwrap_or_else(|| panic!("{}", stopped.printed));
        let last = number_behind(line, "after pass ").expect("a number");
        let row = stopped.printed.lines().rfind(|line| !line.trim().is_empty());
        assert_eq!(
            row.and_then(|row| number_behind(row, "")),
            Some(last),
            "{}",
            stopped.printed
        );
        assert!(line.ends_with("the error is not known"), "{line}");
        assert!(!stopped.printed.contains("estimated error"));
        assert_eq!(folder.read("table.csv"), before);
    }
}

#[test]
fn a_stopped_search_shows_the_stiffnesses_that_it_tried() {
    let folder = Folder::new("cut-short-design");
    let arguments = [
        "design",
        "scene.toml",
        "--limit-force",
        "100N",
        "--json",
        "--set",
        "traffic.passes=4000",
    ];
    let stopped = Stopped::after(Duration::from_secs(2), &folder, &arguments, "INT");
    assert_eq!(stopped.status.code(), Some(130), "{}", stopped.said);
    let cut: Value = serde_json::from_str(&stopped.printed).expect("one document");
    let tried = cut["curve"].as_array().expect("a curve").len();
    assert_eq!(cut["cut_short"], true);
    assert!(cut.get("answer").is_none());
    let said = format!("stopped: cut short after {tried} stiffnesses: no answer");
    assert!(stopped.said.contains(&said), "{}", stopped.said);
}

#[test]
fn a_stopped_sweep_says_what_it_keeps() {
    let folder = Folder::new("cut-short-sweep");
    let sweep = [
        "sweep",
        "scene.toml",
        "--out",
        "table.csv",
        "--set",
        "traffic.passes=300",
        "--vary",
    ];
    let sweep = [&sweep[..], &["friction.dynamic_coefficient=0.001:1:0.001"]].concat();
    let stopped = Stopped::after(Duration::from_secs(1), &folder, &sweep, "INT");
    assert_eq!(stopped.status.code(), Some(130), "{}", stopped.said);
    let said = "of 1000 points are kept beside table.csv; the same command goes on from there";
    assert!(stopped.said.contains(said), "{}", stopped.said);
    let names = folder.names();
    assert!(names.iter().any(|name| name == "table.csv.journal"), "{names:?}");
    assert!(!names.iter().any(|name| name == "table.csv"), "{names:?}");
}

/// All passes of a coarser mesh outlast a finer one that is not finished, with heat and with jumps too.
#[test]
fn a_run_that_is_stopped_in_refining_keeps_the_mesh_before() {
    let mut plain = Scene::from_toml("scene.toml", SCENE).expect("a scene");
    plain.solver.node_spacing = None;
    plain.solver.vehicle_step = None;
    plain.solver.method = SolverMethod::Auto;
    plain.solver.tolerance = 0.002;
    plain.traffic.passes = 40;
    let mut jumps = plain.clone();
    jumps.traffic.passes = 1_000_000;
    jumps.solver.method = SolverMethod::PassLaw;
    let mut heated = plain.clone();
    heated.traffic.per_day = Some(20.0);
    heated.heat = Some(Heat {
        expansion: 1.5e-5,
        offset: 0.0,
        warming: Warming::Swing(10.0),
    });
    for scene in [plain, jumps, heated] {
        let underway = Underway::default();
        let until_refined = |_: f64| match underway.reached() {
            Some(now) if now.is_refined && now.pass > 0 => ControlFlow::Break(()),
            _ => ControlFlow::Continue(()),
        };
        let options = RunOptions {
            progress: Progress::new(&until_refined),
            underway: Some(&underway),
            ..RunOptions::default()
        };
        let run = creepage::run_with(&scene, &options);
        assert!(matches!(run, Err(Error::Stopped)), "it did not refine: {run:?}");
        let kept = underway.finished().expect("a finished mesh");
        let spacing = underway.reached().expect("a mesh").node_spacing_m;
        let traffic = &scene.traffic;
        let last = kept.passes.last().expect("a pass");
        assert_eq!(last.pass, traffic.passes);
        assert!(
            kept.plan.node_spacing_m > spacing,
            "{} {spacing}",
            kept.plan.node_spacing_m
        );

        // The same passes on that mesh alone; and the forces are nearly those.
        let mut alone = scene.clone();
        alone.solver.node_spacing = Some(kept.plan.node_spacing_m);
        alone.solver.tolerance = 0.1;
        let alone = creepage::run(&alone).expect("a run");
        let numbers = |passes: &[PassRecord]| passes.iter().map(|record| record.pass).collect::<Vec<_>>();
        assert_eq!(numbers(&kept.passes), numbers(&alone.passes));
        let force = |passes: &[PassRecord]| passes[passes.len() - 1].downstream_force_n;
        let (kept, alone) = (force(&kept.passes), force(&alone.passes));
        assert!((kept / alone - 1.0).abs() < 0.05, "{kept} N, alone {alone} N");
    }
}

/// With jumps too, passes are counted up to those of the traffic.
#[test]
fn a_long_run_says_how_far_it_is() {
    let folder = Folder::new("progress");
    let every_pass = ["solver.method=quasi-static", "traffic.passes=900000"];
    let jumps = ["solver.method=pass-law", "traffic.passes=5844000"];
    for [method, passes] in [every_pass, jumps] {
        // A fine mesh keeps the jumps busy too.
        let fine = "solver.node_spacing=0.01";
        let arguments = [
            "run",
            "scene.toml",
            "--set",
            method,
            "--set",
            passes,
            "--set",
            fine,
        ];
        let stopped = Stopped::after(Duration::from_secs(3), &folder, &arguments, "INT");
        let line = stopped.said.lines().find(|line| line.starts_with("progress: "));
        let line = line.unwrap_or_else(|| panic!("{arguments:?}: {}", stopped.said));
        let (_, total) = passes.split_once('=').expect("a number");
        assert!(line.contains(&format!(" of {total} on nodes ")), "{line}");
        let pass = number_behind(line, "pass ").expect("a pass");
        assert!(pass <= total.parse().expect("a number"), "{line}");
    }
}
