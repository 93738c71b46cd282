//! How far a computation is. The command computes in rayon's threads, as many as `--threads` says, while a further one shows how far it is.

use std::io::{self, IsTerminal, Write};
use std::ops::ControlFlow;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::thread;
use std::time::{Duration, Instant};

use super::{signals, terminal};
use crate::Progress;
use crate::shown::time;

/// What takes no longer is not shown.
const UNSEEN: Duration = Duration::from_secs(2);
/// Between two lines, each of which takes the place of the one before.
const BETWEEN_LINES: Duration = Duration::from_millis(200);
/// Letters of a line.
const LINE: usize = 78;
/// What clears the line.
const CLEAR: &str = "\r\x1b[K";

/// A time in whole seconds, minutes or hours.
fn rounded(seconds: f64) -> String {
    if seconds < 100.0 {
        format!("{seconds:.0} s")
    } else {
        time(seconds.max(120.0))
    }
}

/// What is done with the share that it is, and the time \[s\] that is `left`, or gone by where that is not known: a computation may not say how
/// far it is, or take longer than usual.
fn line(words: &str, share: f64, seconds: f64, left: f64) -> String {
    if left.is_finite() && left > 0.0 {
        let (percent, left) = (100.0 * share, rounded(left.max(1.0)));
        return format!("{percent:.0} %, {words}, about {left} left");
    }
    format!("{words}, {} so far", rounded(seconds))
}

/// Computes something and shows at a terminal how far it is: the share that is done with the time that the rest takes at the same speed, and `words` of that share.
/// As a rule it is done at the share `usual`.
pub fn watched<A: Send>(
    usual: f64,
    words: impl Fn(f64) -> String + Send,
    compute: impl FnOnce(Progress<'_>) -> A + Send,
) -> A {
    signals::listen();
    let (begun, share, first) = (Instant::now(), &AtomicU64::new(0), &OnceLock::new());
    let report = |now: f64| {
        first.get_or_init(|| now);
        share.store(now.to_bits(), Ordering::Relaxed);
        ControlFlow::Continue(())
    };
    let shown = move || {
        let share = f64::from_bits(share.load(Ordering::Relaxed));
        let seconds = begun.elapsed().as_secs_f64();
        let left = seconds * (usual - share) / (share - first.get().copied().unwrap_or_default());
        line(&words(share), share / usual, seconds, left)
    };
    thread::scope(|scope| {
        // It is dropped with an answer, and without one.
        let (_done, running) = channel();
        if io::stderr().is_terminal() {
            scope.spawn(move || show(&running, shown));
        }
        rayon::scope(|_| compute(Progress::new(&report)))
    })
}

/// Shows lines while something is `running`, and clears the last.
fn show(running: &Receiver<()>, line: impl Fn() -> String) {
    let mut wait = UNSEEN;
    while running.recv_timeout(wait) == Err(RecvTimeoutError::Timeout) {
        wait = BETWEEN_LINES;
        let line: String = terminal::line(&line()).chars().take(LINE).collect();
        let _ = write!(io::stderr(), "{CLEAR}{line}");
    }
    if wait == BETWEEN_LINES {
        let _ = write!(io::stderr(), "{CLEAR}");
    }
}
