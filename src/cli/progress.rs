//! How far a computation is. The command computes in rayon's threads, as many as `--threads` says, while this one shows how far it is.

use std::io::{self, IsTerminal, Write};
use std::ops::ControlFlow;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::thread;
use std::time::{Duration, Instant};

use super::{signals, terminal};
use crate::Progress;
use crate::shown::time;

/// How often it is looked at.
const TICK: Duration = Duration::from_millis(25);
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
    words: impl Fn(f64) -> String,
    compute: impl FnOnce(Progress<'_>) -> A + Send,
) -> A {
    signals::listen();
    let share = AtomicU64::new(0.0_f64.to_bits());
    let first = OnceLock::new();
    let report = |now: f64| {
        first.get_or_init(|| now);
        share.store(now.to_bits(), Ordering::Relaxed);
        ControlFlow::Continue(())
    };
    thread::scope(|scope| {
        let (send, receive) = channel();
        let progress = Progress::new(&report);
        let worker = scope.spawn(move || {
            // A scope runs in one of rayon's threads; the one that is left only waits.
            let _ = send.send(rayon::scope(|_| compute(progress)));
        });
        let (begun, is_terminal) = (Instant::now(), io::stderr().is_terminal());
        let mut due = UNSEEN;
        loop {
            match receive.recv_timeout(TICK) {
                Ok(answer) => {
                    if due > UNSEEN {
                        let _ = write!(io::stderr(), "{CLEAR}");
                    }
                    return answer;
                }
                Err(RecvTimeoutError::Disconnected) => match worker.join() {
                    Err(panic) => std::panic::resume_unwind(panic),
                    Ok(()) => unreachable!("it sends before it ends"),
                },
                Err(RecvTimeoutError::Timeout) => {}
            }
            let elapsed = begun.elapsed();
            if elapsed < due || !is_terminal {
                continue;
            }
            due = elapsed + BETWEEN_LINES;
            let share = f64::from_bits(share.load(Ordering::Relaxed));
            let begin = first.get().copied().unwrap_or_default();
            let seconds = elapsed.as_secs_f64();
            let left = seconds * (usual - share) / (share - begin);
            let line = terminal::line(&line(&words(share), share / usual, seconds, left));
            let line: String = line.chars().take(LINE).collect();
            let _ = write!(io::stderr(), "{CLEAR}{line}");
        }
    })
}
