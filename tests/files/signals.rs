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

/// Stops a sweep while its table is half written; false where the table was complete before the signal came.
fn stop_half_way(folder: &Folder, (name, number): (&str, i32)) -> bool {
    let many = "--vary friction.dynamic_coefficient=-10000:-1:1";
    let mut command = folder.piped(&format!("sweep scene.toml --threads 1 {many} --out target.csv"));
    command.stdout(Stdio::null()).stderr(Stdio::null());
    let mut child = command.spawn().expect("a process");
    // A shell that waits with its signal: to start one takes longer than to write the table.
    let line = format!("read _; kill -{name} {}", child.id());
    let mut shell = folder.command("sh", &["-c", &line]);
    shell.stdin(Stdio::piped()).stderr(Stdio::null());
    let mut shell = shell.spawn().expect("a shell");
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
    folder.succeeds(&format!("{SWEEP} --out target.csv"));
    let before = folder.contents();
    // Rows of all points, once they are computed: the sweep goes on with its table.
    let mut rows = None;
    for signal in SIGNALS {
        let stopped = (0..10).any(|_| {
            folder.write("target.csv", &before["target.csv"]);
            if let Some(rows) = &rows {
                folder.write("target.csv.unfinished", rows);
            }
            let stopped = stop_half_way(&folder, signal);
            let mut after = folder.contents();
            rows = after.remove("target.csv.unfinished").or(rows.take());
            assert!(after.keys().eq(before.keys()), "{signal:?}: {:?}", folder.names());
            // The signal may have come after the table.
            assert_complete(&after["target.csv"], "csv");
            folder.remove("target.csv.unfinished");
            stopped && after == before
        });
        assert!(stopped, "the table was always complete before the signal came");
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
