//! A computation without the GIL, in threads of Rust, while Python's own thread tells how far it is and heeds Ctrl-C.

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::mpsc::{RecvTimeoutError, sync_channel};
use std::time::Duration;

use creepage::Progress;
use pyo3::prelude::*;
use rayon::{Scope, ThreadPool};

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
        let (send, receive) = sync_channel(1);
        let (report, share, stopped, call) = (&report, &share, &stopped, &call);
        // In rayon's threads; this one only waits.
        in_scope(pool.as_ref(), |scope| {
            // Whoever waits lives as long as this.
            scope.spawn(move |_| drop(send.send(compute(Progress::new(report)))));
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

/// Calls `wait` in this thread, with a scope whose tasks run in the threads of `pool`, or in rayon's own.
fn in_scope<'s, T>(pool: Option<&ThreadPool>, wait: impl FnOnce(&Scope<'s>) -> T) -> T {
    match pool {
        Some(pool) => pool.in_place_scope(wait),
        None => rayon::in_place_scope(wait),
    }
}
