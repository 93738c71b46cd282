//! What a long command says while it goes on, and what it leaves when it is stopped.

use std::time::{Duration, Instant};

use super::common::{Folder, creepage, said};
use super::signals::{SIGNALS, ended_by, send};
use crate::command::assert_says;

/// Stops a command after `time`, which ends within a second without an answer and says so; what it says.
#[track_caller]
fn stopped_after(time: Duration, folder: &Folder, line: &str, (signal, number): (&str, i32)) -> String {
    let child = folder.piped(line).spawn().expect("a process");
    std::thread::sleep(time);
    let asked = Instant::now();
    send(folder, &child, signal);
    let output = child.wait_with_output().expect("it ends");
    let elapsed = asked.elapsed();
    assert!(elapsed < Duration::from_secs(1), "{line} took {elapsed:?} to end");
    let said = said(&output);
    assert_eq!(ended_by(output.status), Some(number), "{said}");
    assert!(output.stdout.is_empty() && said.contains("stopped: "), "{said}");
    said
}

/// Stops commands that take minutes, with an older file in their place, after these times.
fn stop(test: &str, times: impl Iterator<Item = u64>) -> Folder {
    let folder = Folder::new(test);
    folder.succeeds("run scene.toml --csv table.csv");
    folder.succeeds("report scene.toml -o page.html");
    let before = folder.contents();
    let commands = [
        "run scene.toml --csv table.csv",
        "run scene.toml --json",
        "report scene.toml -o page.html",
    ];
    for (case, time) in times.enumerate() {
        let line = format!("{} --set traffic.passes=900000", commands[case % 3]);
        stopped_after(Duration::from_millis(time), &folder, &line, SIGNALS[case % 2]);
        assert!(folder.contents() == before);
    }
    folder
}

#[test]
fn a_stopped_command_says_so_and_leaves_an_older_file() {
    let folder = stop("stopped-run", [300; 6].into_iter());
    let before = folder.contents();
    let half = Duration::from_millis(300);
    let design = "design scene.toml --limit-force 100N --json --set traffic.passes=40000";
    stopped_after(2 * half, &folder, design, SIGNALS[0]);
    let sweep = "sweep scene.toml --out new.csv --set traffic.passes=300 --vary friction.dynamic_coefficient=0.001:1:0.001";
    let said = stopped_after(2 * half, &folder, sweep, SIGNALS[0]);
    let kept = "the finished points are kept beside new.csv; the same command goes on from there";
    assert_says(&said, &[kept]);
    folder.remove("new.csv.unfinished");
    assert!(folder.contents() == before);
}

#[test]
#[ignore = "minutes"]
fn however_often_it_is_stopped() {
    let mut random = fastrand::Rng::with_seed(2);
    stop("stopped-often", (0..600).map(|_| random.u64(100..700)));
}

/// What takes long shows its share and the time left at a terminal, and nothing elsewhere.
#[test]
#[ignore = "seven seconds of waiting: .ci/run runs it"]
fn a_long_run_says_how_far_it_is() {
    let folder = Folder::new("progress");
    let every_pass = "solver.method=quasi-static --set traffic.passes=900000";
    let jumps = "solver.method=pass-law --set traffic.passes=5844000";
    for scene in [every_pass, jumps] {
        // A fine mesh keeps the jumps busy too.
        let run = format!("run scene.toml --set solver.node_spacing=0.01 --set {scene}");
        let stopped = format!("timeout --foreground -s INT 3 '{}' {run}", creepage());
        let mut script = folder.command("script", &["-qec", &stopped, "/dev/null"]);
        let output = script.output().expect("a terminal");
        let output = String::from_utf8(output.stdout).expect("UTF-8");
        let line = output.split("\r\x1b[K").nth(1).expect(&output);
        let (share, _) = line.split_once(" %").expect("a share");
        let share: f64 = share.parse().expect("a number");
        assert!((0.0..=100.0).contains(&share) && line.ends_with(" left"));
    }
    let run = format!("run scene.toml --set {every_pass}");
    let said = stopped_after(Duration::from_secs(1), &folder, &run, SIGNALS[0]);
    assert!(said.starts_with("stopped: "), "{said}");
}
