//! What is done when the process is asked to stop: what it has half written goes, and what it has finished may be printed first.

#[cfg(unix)]
pub use unix::{Watch, end, listen};

#[cfg(unix)]
mod unix {
    use std::ffi::c_int;
    use std::sync::Once;
    use std::sync::atomic::{AtomicBool, AtomicI32, Ordering};
    use std::time::{Duration, Instant};

    use signal_hook::consts::{SIGINT, SIGTERM};
    use signal_hook::iterator::Signals;
    use signal_hook::low_level::emulate_default_handler;

    /// Signals that come together are one: `timeout` sends its own to the process and to its group.
    const ONE: Duration = Duration::from_millis(200);

    /// Whether somebody waits for signals, and the one that came.
    static WATCHED: AtomicBool = AtomicBool::new(false);
    static ASKED: AtomicI32 = AtomicI32::new(0);

    /// Removes temporary files when Ctrl-C or SIGTERM ends the process. SIGHUP is left as it is, so that
    /// `nohup` works: a terminal that is closed may leave a temporary file behind.
    pub fn listen() {
        static ONCE: Once = Once::new();
        ONCE.call_once(|| {
            // Without this a stopped process leaves a file behind, and nothing worse.
            let Ok(mut signals) = Signals::new([SIGINT, SIGTERM]) else {
                return;
            };
            std::thread::spawn(move || {
                let mut asked = None;
                for signal in signals.forever() {
                    let is_told = WATCHED.load(Ordering::SeqCst);
                    // Who asks twice does not want to wait.
                    let first = *asked.get_or_insert_with(Instant::now);
                    if !is_told || first.elapsed() > ONE {
                        end(signal);
                    }
                    ASKED.store(signal, Ordering::SeqCst);
                }
            });
        });
    }

    /// While this lives, the first Ctrl-C or SIGTERM does not end the process but is told.
    pub struct Watch(());

    impl Watch {
        pub fn new() -> Self {
            listen();
            WATCHED.store(true, Ordering::SeqCst);
            Self(())
        }

        /// The signal that asks the process to stop.
        #[expect(clippy::unused_self, reason = "signals are told only while it lives")]
        pub fn asked(&self) -> Option<c_int> {
            Some(ASKED.load(Ordering::SeqCst)).filter(|&signal| signal != 0)
        }
    }

    impl Drop for Watch {
        fn drop(&mut self) {
            WATCHED.store(false, Ordering::SeqCst);
        }
    }

    /// Removes temporary files and ends the process: with status 130 after Ctrl-C, as shells say it, else by the signal.
    pub fn end(signal: c_int) -> ! {
        let _until_the_end = crate::output::remove_all();
        if signal != SIGINT {
            let _ = emulate_default_handler(signal);
        }
        std::process::exit(128 + signal)
    }
}

/// Elsewhere the system ends the process.
#[cfg(not(unix))]
pub fn listen() {}

#[cfg(not(unix))]
pub struct Watch;

#[cfg(not(unix))]
impl Watch {
    pub fn new() -> Self {
        Self
    }

    pub fn asked(&self) -> Option<i32> {
        None
    }
}

#[cfg(not(unix))]
pub fn end(signal: i32) -> ! {
    std::process::exit(128 + signal)
}
