//! A computation without the GIL, in threads of Rust, while Python's own thread tells how far it is and heeds Ctrl-C.

use std::ops::ControlFlow;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::mpsc::{RecvTimeoutError, sync_channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

use creepage::Progress;
use pyo3::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuildError, ThreadPoolBuilder};

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
        None => threads_of_this_process(),
        Some(threads) => pool(threads),
    };
    let pool = pool.map_err(|error| Failure::computation(&error).raised(py))?;
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
        pool.in_place_scope(|scope| {
            scope.spawn(move |_| {
                let answer = catch_unwind(AssertUnwindSafe(|| compute(Progress::new(report))));
                // Whoever waits lives as long as this.
                drop(send.send(answer.unwrap_or_else(|_| Err(Failure::broken()))));
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
                    Ok(answer) => break (answer, raised),
                    Err(RecvTimeoutError::Disconnected) => break (Err(Failure::broken()), raised),
                }
            }
        })
    });
    match (answer, raised) {
        (_, Some(error)) => Err(error),
        (answer, None) => {
            let answer = answer.map_err(|failure| failure.raised(py))?;
            call.tell(py, 1.0)?;
            Ok(answer)
        }
    }
}

/// So many threads; as many as there are cores for 0.
fn pool(threads: usize) -> Result<Arc<ThreadPool>, ThreadPoolBuildError> {
    ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()
        .map(Arc::new)
}

/// The threads that calls of one process share. A forked process has none of its parent's threads and makes its own, which rayon's global
/// pool cannot. The lock is never held in a fork: whoever forks has the GIL, as who asks here.
fn threads_of_this_process() -> Result<Arc<ThreadPool>, ThreadPoolBuildError> {
    static SHARED: Mutex<Option<(u32, Arc<ThreadPool>)>> = Mutex::new(None);
    let mut shared = SHARED.lock().unwrap_or_else(PoisonError::into_inner);
    match &*shared {
        Some((process, pool)) if *process == std::process::id() => Ok(Arc::clone(pool)),
        _ => {
            let own = pool(0)?;
            // To end the parent's pool would wait for its threads.
            std::mem::forget(shared.replace((std::process::id(), Arc::clone(&own))));
            Ok(own)
        }
    }
}
