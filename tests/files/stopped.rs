//! What a long command says while it goes on, and what it leaves when it is stopped.

use std::os::unix::process::ExitStatusExt;
use std::process::{ExitStatus, Stdio};
use std::time::{Duration, Instant};

use super::common::{Folder, creepage};
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

#[test]
fn a_stopped_run_says_so_and_leaves_an_older_table() {
    let folder = Folder::new("stopped-run");
    folder.succeeds(&["run", "scene.toml", "--csv", "table.csv"]);
    let before = folder.read("table.csv");
    let passes = format!("traffic.passes={PASSES}");
    for (signal, number) in [("INT", 2), ("TERM", 15)] {
        for output in [&["--csv", "table.csv"][..], &["--json"]] {
            let run = [&["run", "scene.toml", "--set", &passes][..], output].concat();
            let stopped = Stopped::after(Duration::from_millis(500), &folder, &run, signal);
            let status = stopped.status;
            let ended = status.signal().or(status.code().map(|code| code - 128));
            assert_eq!(ended, Some(number), "{}", stopped.said);
            // What is not finished is no answer.
            assert_eq!(stopped.printed, "");
            assert!(stopped.said.contains("stopped: "), "{}", stopped.said);
            assert_eq!(folder.read("table.csv"), before);
        }
    }
}

#[test]
fn a_stopped_search_has_no_answer() {
    let folder = Folder::new("stopped-design");
    let design = [
        "design",
        "scene.toml",
        "--limit-force",
        "100N",
        "--json",
        "--set",
        "traffic.passes=40000",
    ];
    let stopped = Stopped::after(Duration::from_secs(1), &folder, &design, "INT");
    assert_eq!(stopped.status.code(), Some(130), "{}", stopped.said);
    assert_eq!(stopped.printed, "");
    assert!(stopped.said.contains("stopped: "), "{}", stopped.said);
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
    let said = "the finished points are kept beside table.csv; the same command goes on from there";
    assert!(stopped.said.contains(said), "{}", stopped.said);
    let names = folder.names();
    assert!(
        names.iter().any(|name| name == "table.csv.unfinished"),
        "{names:?}"
    );
    assert!(!names.iter().any(|name| name == "table.csv"), "{names:?}");
}

/// What takes long shows its share and the time left at a terminal, and nothing elsewhere.
#[test]
fn a_long_run_says_how_far_it_is() {
    let folder = Folder::new("progress");
    let every_pass = "solver.method=quasi-static --set traffic.passes=900000";
    let jumps = "solver.method=pass-law --set traffic.passes=5844000";
    for scene in [every_pass, jumps] {
        // A fine mesh keeps the jumps busy too.
        let run = format!("run scene.toml --set solver.node_spacing=0.01 --set {scene}");
        let stopped = format!("timeout --foreground -s INT 4 '{}' {run}", creepage());
        let output = folder
            .command("script", &["-qec", &stopped, "/dev/null"])
            .output();
        let output = String::from_utf8(output.expect("a terminal").stdout).expect("UTF-8");
        let line = output
            .split("\r\x1b[K")
            .nth(1)
            .unwrap_or_else(|| panic!("{run}: {output}"));
        let (share, _) = line.split_once(" %").expect("a share");
        assert!(
            (0.0..=100.0).contains(&share.parse::<f64>().expect("a number")),
            "{line}"
        );
        assert!(line.ends_with(" left"), "{line}");
    }
    let arguments: Vec<&str> = ["run", "scene.toml", "--set"]
        .into_iter()
        .chain(every_pass.split(' '))
        .collect();
    let stopped = Stopped::after(Duration::from_secs(3), &folder, &arguments, "INT");
    assert!(stopped.said.starts_with("stopped: "), "{}", stopped.said);
}
