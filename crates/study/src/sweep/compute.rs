//! Computing the points of a sweep, each in one thread.

use std::ops::ControlFlow;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};
use std::sync::{Mutex, PoisonError};

use super::columns::{Answer, AnswerColumn, Row};
use super::error::SweepError;
use super::finished::Finished;
use super::grid::Sweep;
use super::run::SweepOptions;
use creepage_plan::{error::with_causes, finite, ground::KnownGrounds};
use creepage_run::{Error, Progress, Run, RunOptions, run::run_over};
use creepage_scene::Scene;

impl Sweep {
    /// Computes the points that are not finished.
    pub(super) fn compute(
        &self,
        finished: &mut Finished,
        columns: &[AnswerColumn],
        options: &SweepOptions<'_>,
    ) -> Result<(), SweepError> {
        let count = self.count();
        let is_missing = |point: &usize| !finished.rows.contains_key(point);
        let points: Vec<usize> = (0..count).filter(is_missing).collect();
        let (begun, done) = (AtomicUsize::new(0), AtomicUsize::new(count - points.len()));
        let report = || options.progress.report(done.load(Relaxed) as f64 / count as f64);
        report().map_err(|_| SweepError::Stopped)?;
        // A point that takes long can be stopped too.
        let within = |_| report().map_or(ControlFlow::Break(()), ControlFlow::Continue);
        let finished = Mutex::new(finished);
        let work = || -> Result<(), SweepError> {
            let grounds = KnownGrounds::new(1);
            let run_options = RunOptions {
                progress: Progress::new(&within),
                ..RunOptions::default()
            };
            let run = |scene: &Scene| match options.evaluate {
                Some(evaluate) => evaluate(scene).and_then(|run| finite::check(&run).map(|()| run)),
                None => run_over(scene, grounds.of(scene)?, &run_options),
            };
            while let Some(&point) = points.get(begun.fetch_add(1, Relaxed)) {
                let row = self.computed(point, columns, &run)?;
                let mut finished = finished.lock().unwrap_or_else(PoisonError::into_inner);
                finished.keep(point, row)?;
                drop(finished);
                done.fetch_add(1, Relaxed);
                report().map_err(|_| SweepError::Stopped)?;
            }
            Ok(())
        };
        let ends = rayon::broadcast(|_| {
            // Where one thread fails, no other begins another point.
            work().inspect_err(|_| begun.store(points.len(), Relaxed))
        });
        ends.into_iter().collect()
    }

    /// The row of one point. Whatever goes wrong there is its answer, in one line: what follows it
    /// shows the place in the file again.
    fn computed(
        &self,
        point: usize,
        columns: &[AnswerColumn],
        run: &impl Fn(&Scene) -> Result<Run, Error>,
    ) -> Result<Row, SweepError> {
        let compute = || -> Result<Row, Error> {
            let scene = self.scene(point)?;
            let run = &run(&scene)?;
            let limits = self.limits.as_ref();
            let verdicts = limits.map_or(Ok(Vec::new()), |limits| limits.verdicts(run, &scene))?;
            let answer = Answer {
                run,
                last: run.passes.last().ok_or(Error::NoPass)?,
                verdicts: &verdicts,
            };
            Ok(self.row(point, Ok(answer), columns))
        };
        let error = match catch_unwind(AssertUnwindSafe(compute)) {
            Ok(Ok(row)) => return Ok(row),
            Ok(Err(Error::Stopped)) => return Err(SweepError::Stopped),
            Ok(Err(error)) => with_causes(&error),
            Err(_) => "the computation broke off".into(),
        };
        let line = error.lines().next().unwrap_or_default();
        Ok(self.row(point, Err(&line.replace(char::is_control, " ")), columns))
    }
}
