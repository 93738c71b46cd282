//! What is done when the process is asked to stop: what it has half written goes, and then it ends as it would have.

/// Removes temporary files when a signal ends the process. A signal that is ignored, as under `nohup`, stays so.
#[cfg(unix)]
pub fn clean_up_when_stopped() {
    use std::sync::Once;

    use signal_hook::iterator::Signals;
    use signal_hook::low_level::emulate_default_handler;

    static ONCE: Once = Once::new();
    ONCE.call_once(|| {
        // Without this a stopped process leaves a file behind, and nothing worse.
        let Ok(mut signals) = Signals::new(heeded()) else {
            return;
        };
        std::thread::spawn(move || {
            if let Some(signal) = signals.forever().next() {
                let _until_the_end = crate::output::remove_all();
                let _ = emulate_default_handler(signal);
            }
        });
    });
}

#[cfg(not(unix))]
pub fn clean_up_when_stopped() {}

/// The signals that ask a process to stop, without those that it ignores. Where the system does not say which these are, a closed
/// terminal is left alone: a long sweep under `nohup` counts for more than a file that is left.
#[cfg(unix)]
fn heeded() -> Vec<std::ffi::c_int> {
    use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};

    match std::fs::read_to_string("/proc/self/status") {
        Ok(status) => {
            let ignored = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
            let ignored = ignored.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok());
            let ignored = ignored.unwrap_or_default();
            let mut signals = vec![SIGHUP, SIGINT, SIGTERM];
            signals.retain(|signal| ignored & (1 << (signal - 1)) == 0);
            signals
        }
        Err(_) => vec![SIGINT, SIGTERM],
    }
}
