//! A process that is stopped leaves no half-written file, and the older one as it was.

use std::os::unix::process::ExitStatusExt;
use std::process::{Child, ExitStatus, Stdio};
use std::time::Duration;

use super::common::{Folder, SWEEP, assert_complete};

pub const SIGNALS: [(&str, i32); 2] = [("INT", 2), ("TERM", 15)];

pub fn send(folder: &Folder, child: &Child, signal: &str) {
    let words = [&format!("-{signal}"), &child.id().to_string()];
    folder.command("kill", &words).status().expect("kill");
}

/// The signal that ended the process, which Ctrl-C does by its status.
pub fn ended_by(status: ExitStatus) -> Option<i32> {
    let status_130 = status.code().filter(|&code| code == 130);
    status.signal().or(status_130.map(|code| code - 128))
}

/// Stops each command at a random moment of its work.
fn stop(cases: usize, seed: u64) {
    let folder = Folder::new(&format!("stopped-{seed}"));
    let mut random = fastrand::Rng::with_seed(seed);
    // What is written first and what is stopped, computed within a second or so. Failing points are fast: that sweep is mostly its rows
    // and its table.
    let [few, many] = ["--set traffic.passes=9", "--set traffic.passes=3000"];
    let commands = [
        ("run scene.toml --csv target.csv", few, many, "csv"),
        ("report scene.toml -o target.html", few, many, "html"),
        (
            "sweep scene.toml --threads 1 --out target.csv",
            "--vary duct.depth=1,2",
            "--vary friction.dynamic_coefficient=-20000:-1:1",
            "csv",
        ),
    ];
    for case in 0..cases {
        let (command, first, stopped, ending) = commands[case % commands.len()];
        let (name, number) = SIGNALS[random.usize(..SIGNALS.len())];
        let (target, unfinished) = (format!("target.{ending}"), format!("target.{ending}.unfinished"));
        folder.remove(&target);
        folder.remove(&unfinished);
        folder.succeeds(&format!("{command} {first}"));
        let before = folder.contents();

        let mut process = folder.piped(&format!("{command} {stopped}"));
        let mut child = process
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .expect("a process");
        std::thread::sleep(Duration::from_micros(random.u64(..600_000)));
        send(&folder, &child, name);
        let ended = ended_by(child.wait().expect("it ends"));
        assert!(ended.is_none_or(|signal| signal == number), "{command}");
        // A sweep goes on behind its rows; everything else is as it was, or whole.
        let mut after = folder.contents();
        after.remove(&unfinished);
        if after != before {
            assert!(
                after.keys().eq(before.keys()),
                "{command} {name}: {:?}",
                after.keys()
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

/// Stops a sweep while its table is half written; false where the table was complete before the signal came.
fn stop_half_way(folder: &Folder, (name, number): (&str, i32)) -> bool {
    let mut command = folder.piped(
        "sweep scene.toml --threads 1 --vary friction.dynamic_coefficient=-20000:-1:1 --out target.csv",
    );
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
    let unfinished = folder.path("target.csv.unfinished");
    let is_half = || folder.names().iter().any(|name| name.ends_with(".partial"));
    // Before there are rows it is but the probe of the place.
    while !(unfinished.exists() && is_half()) && child.try_wait().expect("a state").is_none() {
        std::thread::sleep(Duration::from_micros(50));
    }
    drop(shell.stdin.take());
    shell.wait().expect("it ends");
    let ended = ended_by(child.wait().expect("it ends"));
    assert!(ended.is_none_or(|signal| signal == number));
    ended.is_some()
}

#[test]
fn what_is_half_written_goes() {
    let folder = Folder::new("half");
    for signal in SIGNALS {
        let stopped = (0..10).any(|_| {
            folder.succeeds(&format!("{SWEEP} --out target.csv"));
            let before = folder.contents();
            let stopped = stop_half_way(&folder, signal);
            folder.remove("target.csv.unfinished");
            let after = folder.contents();
            assert!(after.keys().eq(before.keys()), "{signal:?}: {:?}", folder.names());
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
    let mut shell = folder.command("sh", &["-c", line, super::common::creepage()]);
    let run = "run scene.toml --set traffic.passes=3000 --csv target.csv";
    let child = shell.args(run.split(' ')).stdout(Stdio::null()).spawn();
    let mut child = child.expect("a process");
    std::thread::sleep(Duration::from_millis(150));
    assert!(child.try_wait().expect("a state").is_none(), "it is over already");
    send(&folder, &child, "HUP");
    assert!(child.wait().expect("it ends").success());
    assert_complete(&folder.read("target.csv"), "csv");
}
