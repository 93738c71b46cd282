//! Counts the model runs of a calibration, and stops it where the caller wants.

use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

use creepage_run::{Error, Progress};

/// What sees every model run.
pub(super) struct Watch<'a> {
    progress: Progress<'a>,
    limit: usize,
    runs: AtomicUsize,
    stopped: AtomicBool,
}

impl<'a> Watch<'a> {
    /// Reports the share of at most `limit` runs.
    pub fn new(progress: Progress<'a>, limit: usize) -> Self {
        Self {
            progress,
            limit,
            runs: AtomicUsize::new(0),
            stopped: AtomicBool::new(false),
        }
    }

    /// Counts a model run. Once the caller has stopped the calibration every further run fails at once, which ends the search.
    pub fn run(&self) -> Result<(), Error> {
        if self.is_stopped() {
            return Err(Error::Stopped);
        }
        let runs = self.runs.fetch_add(1, Ordering::Relaxed) + 1;
        let reported = self.progress.report((runs as f64 / self.limit as f64).min(1.0));
        if reported.is_err() {
            self.stopped.store(true, Ordering::Relaxed);
        }
        reported
    }

    pub fn is_stopped(&self) -> bool {
        self.stopped.load(Ordering::Relaxed)
    }
}
