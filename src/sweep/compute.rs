//! Computing the points of a sweep, each in one thread after the other's.

use std::ops::ControlFlow;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};

use super::error::SweepError;
use super::evaluator::Evaluator;
use super::grid::Sweep;
use super::options::SweepOptions;
use super::row::{Answer, PointError, Row};
use crate::{Error, Progress, Run, RunOptions, Scene, finite};

/// What was locked, whatever became of the thread that had it before.
pub fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Takes finished points, from several threads.
type Keep<'a> = dyn Fn(Row) -> Result<(), SweepError> + Sync + 'a;

impl Sweep {
    /// Computes all points that are not `finished` and gives them to `keep`.
    pub(super) fn compute(
        &self,
        finished: &[bool],
        options: &SweepOptions<'_>,
        keep: &Keep<'_>,
    ) -> Result<(), SweepError> {
        let (progress, evaluate) = (options.progress, options.evaluate);
        let done = AtomicUsize::new(finished.iter().filter(|done| **done).count());
        let report = || progress.report(done.load(Ordering::Relaxed) as f64 / finished.len() as f64);
        // A point that takes long can be stopped too.
        let within = |_| report().map_or(ControlFlow::Break(()), ControlFlow::Continue);
        let within = Progress::new(&within);
        report().map_err(|_| SweepError::Stopped)?;
        let options = RunOptions {
            progress: within,
            ..RunOptions::default()
        };
        let next = AtomicUsize::new(0);
        let failure = Mutex::new(None);
        let one = |rows: &Evaluator, index: usize| {
            let row = self.row(index, |scene| match evaluate {
                Some(evaluate) => evaluate(scene),
                None => rows.run_scene(scene, &options),
            })?;
            keep(row)?;
            done.fetch_add(1, Ordering::Relaxed);
            report().map_err(|_| SweepError::Stopped)
        };
        rayon::broadcast(|_| {
            let rows = Evaluator::new(self.file.clone());
            loop {
                let index = next.fetch_add(1, Ordering::Relaxed);
                match finished.get(index) {
                    None => return,
                    Some(true) => {}
                    Some(false) => {
                        if let Err(error) = one(&rows, index) {
                            next.store(finished.len(), Ordering::Relaxed);
                            lock(&failure).get_or_insert(error);
                        }
                    }
                }
            }
        });
        failure
            .into_inner()
            .unwrap_or_else(PoisonError::into_inner)
            .map_or(Ok(()), Err)
    }

    /// Computes one point. Whatever goes wrong there is its answer.
    fn row(&self, index: usize, run: impl Fn(&Scene) -> Result<Run, Error>) -> Result<Row, SweepError> {
        let compute = || -> Result<Answer, Error> {
            let run = run(&self.scene(index)?)?;
            finite::check(&run)?;
            Answer::of(&run).ok_or(Error::NoPass)
        };
        let outcome = match catch_unwind(AssertUnwindSafe(compute)) {
            Ok(Err(Error::Stopped)) => return Err(SweepError::Stopped),
            Ok(outcome) => outcome.map_err(PointError::from),
            Err(_) => Err(PointError::Failed("the computation broke off".into())),
        };
        Ok(Row { index, outcome })
    }
}
