//! A process that is stopped leaves no half-written file, and the older one as it was.

use std::os::unix::process::ExitStatusExt;
use std::process::{Child, ExitStatus, Stdio};
use std::time::Duration;

use super::common::{Folder, assert_complete, creepage};

const SIGNALS: [(&str, i32); 2] = [("INT", 2), ("TERM", 15)];
/// Computed within a second or so: long enough to be stopped at any moment.
const PASSES: &str = "traffic.passes=3000";

pub fn send(folder: &Folder, child: &Child, signal: &str) {
    let sent = folder
        .command("kill", &[&format!("-{signal}"), &child.id().to_string()])
        .status();
    sent.expect("kill");
}

/// The signal that ended the process, which Ctrl-C does by its status.
fn ended_by(status: ExitStatus) -> Option<i32> {
    let status_130 = status.code().filter(|&code| code == 130);
    status.signal().or(status_130.map(|code| code - 128))
}

/// Stops each command at a random moment of its work.
fn stop(cases: usize, seed: u64) {
    let folder = Folder::new(&format!("stopped-{seed}"));
    let mut random = fastrand::Rng::with_seed(seed);
    let few = "traffic.passes=9";
    let run = |passes| ["run", "scene.toml", "--set", passes, "--csv", "target.csv"].to_vec();
    let report = |passes| ["report", "scene.toml", "--set", passes, "-o", "target.html"].to_vec();
    let sweep = |vary| sweep(vary).to_vec();
    // What is written first, and what is stopped. Failing points are fast: that sweep is mostly its rows and its table.
    let commands = [
        (run(few), run(PASSES), "csv"),
        (report(few), report(PASSES), "html"),
        (
            sweep("duct.depth=1,2"),
            sweep("friction.dynamic_coefficient=-20000:-1:1"),
            "csv",
        ),
    ];
    for case in 0..cases {
        let (first, command, ending) = &commands[case % commands.len()];
        let (name, number) = SIGNALS[random.usize(..SIGNALS.len())];
        let target = format!("target.{ending}");
        let unfinished = format!("{target}.unfinished");
        for file in [&target, &unfinished] {
            let _ = std::fs::remove_file(folder.path(file));
        }
        folder.succeeds(first);
        let before = folder.contents();

        let mut child = folder
            .command(creepage(), command)
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .expect("a process");
        std::thread::sleep(Duration::from_micros(random.u64(..600_000)));
        send(&folder, &child, name);
        let status = child.wait().expect("it ends");
        let mut after = folder.contents();
        if ended_by(status).is_some() {
            assert_eq!(ended_by(status), Some(number), "{command:?}");
        }
        // A sweep goes on behind its rows; everything else is as it was, or whole.
        after.remove(&unfinished);
        if after != before {
            assert_eq!(
                after.keys().collect::<Vec<_>>(),
                before.keys().collect::<Vec<_>>(),
                "{command:?} {name}"
            );
            assert_complete(&after[&target], ending);
            assert_ne!(after[&target], before[&target]);
        }
    }
}

#[test]
fn a_stopped_command_leaves_the_older_file_and_nothing_else() {
    stop(9, 1);
}

/// Stops a sweep while its table is half written; `None` where the table was complete before the signal came.
fn stop_half_way(folder: &Folder, (name, number): (&str, i32)) -> Option<()> {
    let unfinished = folder.path("target.csv.unfinished");
    let mut command = folder.command(creepage(), &sweep("friction.dynamic_coefficient=-50000:-1:1"));
    let mut child = command
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .expect("a process");
    // A shell that waits with its signal: to start one takes longer than to write the table.
    let mut shell = folder
        .command("sh", &["-c", &format!("read _; kill -{name} {}", child.id())])
        .stdin(Stdio::piped())
        .stderr(Stdio::null())
        .spawn()
        .expect("a shell");
    let is_half = || folder.names().iter().any(|name| name.ends_with(".partial"));
    // Before there are rows it is but the probe of the place.
    while !(unfinished.exists() && is_half()) && child.try_wait().expect("a state").is_none() {}
    drop(shell.stdin.take());
    shell.wait().expect("it ends");
    let status = child.wait().expect("it ends");
    ended_by(status).map(|signal| assert_eq!(signal, number))
}

fn sweep(vary: &str) -> [&str; 8] {
    [
        "sweep",
        "scene.toml",
        "--threads",
        "1",
        "--vary",
        vary,
        "--out",
        "target.csv",
    ]
}

#[test]
fn what_is_half_written_goes() {
    let folder = Folder::new("half");
    for signal in SIGNALS {
        let stopped = (0..10).any(|_| {
            folder.succeeds(&sweep("duct.depth=1,2"));
            let before = folder.contents();
            let stopped = stop_half_way(&folder, signal).is_some();
            let _ = std::fs::remove_file(folder.path("target.csv.unfinished"));
            let after = folder.contents();
            let same = after.keys().eq(before.keys());
            assert!(same, "{signal:?}: {:?}", folder.names());
            // The signal may have come after the table.
            assert_complete(&after["target.csv"], "csv");
            stopped && after == before
        });
        assert!(stopped, "the table was always complete before the signal came");
    }
}

#[test]
#[ignore = "minutes"]
fn however_often_it_is_stopped() {
    for seed in 2..12 {
        stop(60, seed);
    }
}

#[test]
fn under_nohup_a_command_outlives_its_terminal() {
    let folder = Folder::new("ignored");
    let line = "trap '' HUP\nexec \"$0\" \"$@\"";
    let report = ["run", "scene.toml", "--set", PASSES, "--csv", "target.csv"];
    let arguments = [&["-c", line, creepage()], &report[..]].concat();
    let mut child = folder
        .command("sh", &arguments)
        .stdout(Stdio::null())
        .spawn()
        .expect("a process");
    std::thread::sleep(Duration::from_millis(150));
    assert!(
        child.try_wait().expect("a state").is_none(),
        "it is over before it was stopped"
    );
    send(&folder, &child, "HUP");
    assert!(child.wait().expect("it ends").success());
    assert_complete(&folder.read("target.csv"), "csv");
}
