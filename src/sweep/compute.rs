//! Computing the points of a sweep, each in one thread.

use std::collections::BTreeMap;
use std::ops::ControlFlow;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};
use std::sync::{Mutex, PoisonError};

use super::error::SweepError;
use super::grid::Sweep;
use super::known_ground::KnownGround;
use super::point::{Answer, Row};
use super::run::SweepOptions;
use crate::error::with_causes;
use crate::run::run_over;
use crate::{Error, Progress, Run, RunOptions, Scene, finite};

/// Takes finished points, in the order of the grid.
type Keep<'a> = dyn FnMut(Row) -> Result<(), SweepError> + Send + 'a;

/// Finished points on their way to `keep`, which gets each after the one before it.
struct Queue<'a, 'b> {
    next: usize,
    waiting: BTreeMap<usize, Row>,
    keep: &'a mut Keep<'b>,
    failure: Option<SweepError>,
}

impl Queue<'_, '_> {
    fn take(&mut self, row: Row) -> Result<(), SweepError> {
        self.waiting.insert(row.index, row);
        while let Some(row) = self.waiting.remove(&self.next) {
            (self.keep)(row)?;
            self.next += 1;
        }
        Ok(())
    }
}

impl Sweep {
    /// Computes all points from the one of number `first` on and gives them to `keep`.
    pub(super) fn compute(
        &self,
        first: usize,
        options: &SweepOptions<'_>,
        keep: &mut Keep<'_>,
    ) -> Result<(), SweepError> {
        let count = self.count();
        let (begun, done) = (AtomicUsize::new(first), AtomicUsize::new(first));
        let report = || options.progress.report(done.load(Relaxed) as f64 / count as f64);
        report().map_err(|_| SweepError::Stopped)?;
        // A point that takes long can be stopped too.
        let within = |_| report().map_or(ControlFlow::Break(()), ControlFlow::Continue);
        let queue = Mutex::new(Queue {
            next: first,
            waiting: BTreeMap::new(),
            keep,
            failure: None,
        });
        let locked = || queue.lock().unwrap_or_else(PoisonError::into_inner);
        rayon::broadcast(|_| {
            let mut ground = KnownGround::default();
            let run_options = RunOptions {
                progress: Progress::new(&within),
                ..RunOptions::default()
            };
            let mut run = |scene: &Scene| match options.evaluate {
                Some(evaluate) => evaluate(scene),
                None => run_over(scene, ground.of(scene)?, &run_options),
            };
            loop {
                let index = begun.fetch_add(1, Relaxed);
                if index >= count {
                    return;
                }
                let kept = self.row(index, &mut run).and_then(|row| locked().take(row));
                done.fetch_add(1, Relaxed);
                if let Err(error) = kept.and_then(|()| report().map_err(|_| SweepError::Stopped)) {
                    begun.store(count, Relaxed);
                    locked().failure.get_or_insert(error);
                }
            }
        });
        let failure = locked().failure.take();
        failure.map_or(Ok(()), Err)
    }

    /// Computes one point. Whatever goes wrong there is its answer, in one line: what follows it
    /// shows the place in the file again.
    fn row(&self, index: usize, run: impl FnMut(&Scene) -> Result<Run, Error>) -> Result<Row, SweepError> {
        let mut run = run;
        let compute = || -> Result<Answer, Error> {
            let scene = self.scene(index)?;
            let run = run(&scene)?;
            finite::check(&run)?;
            let answer = Answer::of(&run).ok_or(Error::NoPass)?;
            match &self.limits {
                Some(limits) => answer.judged(&run, &scene, limits),
                None => Ok(answer),
            }
        };
        let outcome = match catch_unwind(AssertUnwindSafe(compute)) {
            Ok(Err(Error::Stopped)) => return Err(SweepError::Stopped),
            Ok(outcome) => outcome.map_err(|error| {
                let message = with_causes(&error);
                let line = message.lines().next().unwrap_or_default();
                line.replace(char::is_control, " ")
            }),
            Err(_) => Err("the computation broke off".into()),
        };
        Ok(Row { index, outcome })
    }
}
