//! How far a computation is. The command computes in rayon's threads, as many as `--threads` says, while this one shows how far it is.

use std::cell::Cell;
use std::io::{self, IsTerminal, Write};
use std::ops::ControlFlow;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::thread;
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressStyle};

use super::{signals, terminal};
use crate::Progress;
use crate::shown::time;

/// How often it is looked at.
const TICK: Duration = Duration::from_millis(25);
/// What takes no longer is not shown; where nobody watches, a line is written every few seconds.
const UNSEEN: Duration = Duration::from_secs(2);
const BETWEEN_LINES: Duration = Duration::from_secs(5);
/// Steps of a bar.
const STEPS: u64 = 1000;

/// A time in whole seconds, minutes or hours.
fn rounded(seconds: f64) -> String {
    if seconds < 100.0 {
        format!("{seconds:.0} s")
    } else {
        time(seconds.max(120.0))
    }
}

/// Computes something and shows how far it is: the share that is done with the time that the rest takes at the same speed, and `words` of that share.
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
        let begun = Instant::now();
        let screen = Screen::default();
        let answer = loop {
            match receive.recv_timeout(TICK) {
                Ok(answer) => break answer,
                Err(RecvTimeoutError::Disconnected) => match worker.join() {
                    Err(panic) => std::panic::resume_unwind(panic),
                    Ok(()) => unreachable!("it sends before it ends"),
                },
                Err(RecvTimeoutError::Timeout) => {}
            }
            let elapsed = begun.elapsed();
            if elapsed > UNSEEN {
                let share = f64::from_bits(share.load(Ordering::Relaxed));
                let seconds = elapsed.as_secs_f64();
                let left = seconds * (usual - share) / (share - first.get().copied().unwrap_or_default());
                // A computation may not say how far it is, or take longer than usual.
                let known = left.is_finite() && left > 0.0;
                let time = if known {
                    format!("about {} left", rounded(left.max(1.0)))
                } else {
                    format!("{} so far", rounded(seconds))
                };
                screen.show(
                    elapsed,
                    known.then_some(share / usual),
                    format!("{}, {time}", words(share)),
                );
            }
        };
        screen.clear();
        answer
    })
}

/// Where it is shown: as a bar at a terminal, else line by line.
#[derive(Default)]
struct Screen {
    bar: Cell<Option<ProgressBar>>,
    /// When the next line is due.
    due: Cell<Duration>,
}

impl Screen {
    fn show(&self, elapsed: Duration, share: Option<f64>, words: String) {
        if !io::stderr().is_terminal() {
            if elapsed >= self.due.get() {
                self.due.set(elapsed + BETWEEN_LINES);
                let percent = share.map_or_else(String::new, |share| format!("{:.0} %, ", 100.0 * share));
                let _ = writeln!(terminal::err(), "progress: {percent}{words}");
            }
            return;
        }
        let bar = self.bar.take().unwrap_or_else(|| ProgressBar::new(STEPS));
        let template = match share {
            Some(_) => "{bar:20} {percent} %, {wide_msg}",
            None => "{spinner} {wide_msg}",
        };
        if let Ok(style) = ProgressStyle::with_template(template) {
            bar.set_style(style);
        }
        bar.set_message(words);
        bar.set_position((share.unwrap_or(0.0) * STEPS as f64) as u64);
        self.bar.set(Some(bar));
    }

    fn clear(&self) {
        if let Some(bar) = self.bar.take() {
            bar.finish_and_clear();
        }
    }
}
