//! What is done when the process is asked to stop: what it has half written goes, and a sentence says what is left of its work.

use std::sync::{Mutex, Once, PoisonError};

#[cfg(unix)]
use signal_hook::{
    consts::{SIGINT, SIGTERM},
    iterator::Signals,
    low_level::emulate_default_handler,
};

/// What is left of the work, in words.
static LEFT: Mutex<String> = Mutex::new(String::new());

/// Says what a stopped process leaves of its work, other than nothing.
pub fn leaves(words: String) {
    *LEFT.lock().unwrap_or_else(PoisonError::into_inner) = words;
}

/// Removes temporary files when Ctrl-C or SIGTERM ends the process: with status 130 after Ctrl-C, as shells say it, else by the signal.
/// SIGHUP is left as it is, so that `nohup` works: a terminal that is closed may leave a temporary file behind.
pub fn listen() {
    static ONCE: Once = Once::new();
    ONCE.call_once(|| {
        // Without this a stopped process leaves a file behind, and nothing worse.
        #[cfg(unix)]
        if let Ok(signals) = Signals::new([SIGINT, SIGTERM]) {
            std::thread::spawn(move || end_with_the_first(signals));
        }
    });
}

#[cfg(unix)]
fn end_with_the_first(mut signals: Signals) {
    use std::io::Write;
    let Some(signal) = signals.forever().next() else {
        return;
    };
    let _until_the_end = crate::output::remove_all();
    let left = match &**LEFT.lock().unwrap_or_else(PoisonError::into_inner) {
        "" => "nothing is computed or written".to_owned(),
        left => left.to_owned(),
    };
    let _ = writeln!(super::terminal::err(), "stopped: {left}");
    if signal != SIGINT {
        let _ = emulate_default_handler(signal);
    }
    std::process::exit(128 + signal)
}
