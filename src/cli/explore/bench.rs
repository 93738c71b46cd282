//! One computation at a time, of scenes that are alike: the newest question stops the others, and what is known of the ground is used again.

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Mutex, PoisonError};

use creepage_plan::ground::KnownGrounds;

use crate::{Error, Progress, Run, RunOptions, SavedState, Scene};

/// Grounds that are kept: those of drafts and of answers, each before and after the last change.
const GROUNDS: usize = 4;

pub struct Bench {
    /// Of two layers and two lanes the ground takes longer than the passes of a draft.
    pub grounds: KnownGrounds,
    /// The scene that was run last, and the cable as that leaves it.
    last: Option<(Scene, SavedState)>,
}

impl Bench {
    /// Runs a valid `scene`, as [`crate::run_with`] does.
    pub fn run(&mut self, scene: &Scene, progress: Progress<'_>) -> Result<Run, Error> {
        let options = RunOptions {
            progress,
            ..RunOptions::default()
        };
        let run = creepage_run::run::run_over(scene, self.grounds.of(scene)?, &options)?;
        self.last = run.state.clone().map(|state| (scene.clone(), state));
        Ok(run)
    }

    /// The cable as the passes of `scene` leave it, on whatever mesh.
    pub fn state(&mut self, scene: &Scene, progress: Progress<'_>) -> Result<Option<SavedState>, Error> {
        let is_it = |(last, _): &(Scene, _)| {
            let mut last = last.clone();
            last.solver = scene.solver;
            last == *scene
        };
        if !self.last.as_ref().is_some_and(is_it) {
            self.run(scene, progress)?;
        }
        Ok(self.last.as_ref().map(|(_, state)| state.clone()))
    }
}

/// Where questions wait for the bench.
pub struct Desk {
    newest: AtomicU64,
    bench: Mutex<Bench>,
}

impl Default for Desk {
    fn default() -> Self {
        let grounds = KnownGrounds::new(GROUNDS);
        Self {
            newest: AtomicU64::new(0),
            bench: Mutex::new(Bench { grounds, last: None }),
        }
    }
}

impl Desk {
    /// Computes in rayon's threads, until something newer is asked.
    pub fn compute<A: Send>(
        &self,
        work: impl FnOnce(&mut Bench, Progress<'_>) -> Result<A, Error> + Send,
    ) -> Result<A, Error> {
        let own = self.newest.fetch_add(1, Ordering::Relaxed) + 1;
        let go_on = |_| match self.newest.load(Ordering::Relaxed) {
            newest if newest == own => ControlFlow::Continue(()),
            _ => ControlFlow::Break(()),
        };
        let progress = Progress::new(&go_on);
        let bench = &mut *self.bench.lock().unwrap_or_else(PoisonError::into_inner);
        progress.report(0.0)?;
        rayon::scope(|_| work(bench, progress))
    }
}
