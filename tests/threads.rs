//! A command takes no more threads than it is told, and a computation none but those of the pool it is called in.

use std::collections::HashSet;
use std::ops::ControlFlow;
use std::process::Command;
use std::sync::Mutex;

use creepage::{Progress, RunOptions};

use crate::command::{answer, folder, words};
use crate::scenes::{by_threads, upper};

/// Elapsed and processor time of a command on one thread \[s\].
fn times(line: &str) -> (f64, f64) {
    let shell = "TIMEFORMAT='%R %U %S'; time \"$@\" >/dev/null 2>&1";
    let mut command = Command::new("bash");
    command.args(["-c", shell, "bash", env!("CARGO_BIN_EXE_creepage")]);
    let (status, _, text) = answer(command.args(words(line)).output().expect("bash starts"));
    assert_eq!(status, 0, "{line}");
    let mut times = text.split_whitespace().map(|time| time.parse::<f64>().unwrap());
    (times.next().unwrap(), times.sum())
}

#[test]
fn one_thread_takes_one_core() {
    let out = folder("threads").join("threads.csv");
    let out = out.display();
    for line in [
        "run UPPER --set solver.tolerance=0.01",
        "plan UPPER --set solver.tolerance=0.001",
        "design UPPER --limit-force 500N --set solver.tolerance=0.1",
        &format!("sweep UPPER --set solver.tolerance=0.03 --vary duct.depth=1m,1.2m,1.4m --out {out}"),
    ] {
        let (elapsed, processor) = times(&format!("{line} --threads 1"));
        // A clock tick of 10 ms for each of the two times.
        let is_one = processor <= 1.05 * elapsed + 0.02;
        assert!(is_one, "{line}: {processor} s in {elapsed} s");
    }
}

#[test]
fn a_run_stays_in_its_pool() {
    let scene = upper(&["solver.tolerance=0.03"]);
    for threads in [1, 2] {
        let seen = Mutex::new(HashSet::new());
        let see = |_| {
            seen.lock().unwrap().insert(std::thread::current().id());
            assert_eq!(rayon::current_num_threads(), threads);
            ControlFlow::Continue(())
        };
        let options = RunOptions {
            progress: Progress::new(&see),
            ..RunOptions::default()
        };
        let own = by_threads(threads, || {
            creepage::run_with(&scene, &options).unwrap();
            rayon::broadcast(|_| std::thread::current().id())
        });
        assert!(seen.lock().unwrap().iter().all(|thread| own.contains(thread)));
    }
}
