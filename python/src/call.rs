//! A computation without the GIL, in threads of Rust, while Python's own thread tells how far it is and heeds Ctrl-C.

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::mpsc::{RecvTimeoutError, sync_channel};
use std::thread;
use std::time::Duration;

use creepage::Progress;
use pyo3::prelude::*;

use crate::failure::Failure;

/// How often Python is asked whether to go on.
const TICK: Duration = Duration::from_millis(50);

/// How to compute: in how many threads, and whom to tell how far it is.
#[derive(Default, FromPyObject)]
pub struct Call(Option<usize>, Option<Py<PyAny>>);

impl Call {
    /// Asks Python whether to go on, with the share that is done.
    fn tell(&self, py: Python<'_>, share: f64) -> PyResult<()> {
        py.check_signals()?;
        match &self.1 {
            Some(progress) => progress.call1(py, (share,)).map(drop),
            None => Ok(()),
        }
    }
}

/// Computes in the threads that `call` allows. An exception of the progress, or Ctrl-C, stops it and is raised.
pub fn watched<T: Send>(
    py: Python<'_>,
    call: Call,
    compute: impl FnOnce(Progress<'_>) -> Result<T, Failure> + Send,
) -> PyResult<T> {
    let pool = match call.0 {
        None => None,
        Some(threads) => Some(
            rayon::ThreadPoolBuilder::new()
                .num_threads(threads)
                .build()
                .map_err(|error| Failure::computation(&error).raised(py))?,
        ),
    };
    let share = AtomicU64::new(0.0_f64.to_bits());
    let stopped = AtomicBool::new(false);
    let report = |now: f64| {
        share.store(now.to_bits(), Ordering::Relaxed);
        if stopped.load(Ordering::Relaxed) {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    };
    let (answer, raised) = py.detach(|| {
        thread::scope(|scope| {
            let (send, receive) = sync_channel(1);
            let report = &report;
            scope.spawn(move || {
                let compute = || compute(Progress::new(report));
                let answer = match pool {
                    Some(pool) => pool.install(compute),
                    None => rayon::scope(|_| compute()),
                };
                // Whoever waits lives as long as this.
                let _ = send.send(answer);
            });
            let mut raised = None;
            loop {
                match receive.recv_timeout(TICK) {
                    Err(RecvTimeoutError::Timeout) if raised.is_none() => {
                        let now = f64::from_bits(share.load(Ordering::Relaxed));
                        if let Err(error) = Python::attach(|py| call.tell(py, now)) {
                            stopped.store(true, Ordering::Relaxed);
                            raised = Some(error);
                        }
                    }
                    Err(RecvTimeoutError::Timeout) => {}
                    Ok(answer) => break (Some(answer), raised),
                    Err(RecvTimeoutError::Disconnected) => break (None, raised),
                }
            }
        })
    });
    match (answer, raised) {
        (_, Some(error)) => Err(error),
        (Some(answer), None) => {
            let answer = answer.map_err(|failure| failure.raised(py))?;
            call.tell(py, 1.0)?;
            Ok(answer)
        }
        // The scope has panicked with it.
        (None, None) => Err(Failure::broken().raised(py)),
    }
}
