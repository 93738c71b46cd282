//! How far a computation is, and how to stop it.

use std::fmt;
use std::ops::ControlFlow;

use creepage_plan::Error;

/// What is called with the share of the work done so far, in \[0, 1\].
type Callback<'a> = dyn Fn(f64) -> ControlFlow<()> + Sync + 'a;

/// A callback that learns how far a computation is and may stop it; by default there is none.
///
/// It is called often, also from several threads at once, so it should return quickly. It never
/// falls; where finer meshes prove necessary it grows slowly at the end. [`ControlFlow::Break`]
/// stops the computation, which then ends with [`Error::Stopped`].
///
/// ```
/// use std::ops::ControlFlow;
/// use creepage_run::{Error, Progress, RunOptions, Scene};
///
/// let scene = Scene::from_file("../../examples/scenes/full-scale-upper.toml")?;
/// let half = |share: f64| if share < 0.5 { ControlFlow::Continue(()) } else { ControlFlow::Break(()) };
/// let options = RunOptions { progress: Progress::new(&half), ..RunOptions::default() };
/// assert!(matches!(creepage_run::run_with(&scene, &options), Err(Error::Stopped)));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Default)]
pub struct Progress<'a> {
    callback: Option<&'a Callback<'a>>,
    /// The part of the whole work that this computation is: where it begins and how large it is.
    start: f64,
    size: f64,
}

impl<'a> Progress<'a> {
    /// Calls `callback` with the share of the work done so far.
    pub fn new(callback: &'a (dyn Fn(f64) -> ControlFlow<()> + Sync + 'a)) -> Self {
        Self {
            callback: Some(callback),
            start: 0.0,
            size: 1.0,
        }
    }

    /// The progress of a computation that is the part from `start` to `end` of this one.
    #[must_use]
    pub fn part(self, start: f64, end: f64) -> Self {
        Self {
            callback: self.callback,
            start: self.start + self.size * start,
            size: self.size * (end - start),
        }
    }

    /// The next part of it, this `share` of what is left, if nobody knows how many there will be.
    pub(crate) fn next(&mut self, share: f64) -> Self {
        let now = self.part(0.0, share);
        *self = self.part(share, 1.0);
        now
    }

    /// The progress of work that is no part of the whole: it may be stopped, and the share done stays.
    #[must_use]
    pub(crate) fn still(self) -> Self {
        self.part(0.0, 0.0)
    }

    /// Reports the share done.
    ///
    /// # Errors
    ///
    /// [`Error::Stopped`] if the callback stops the computation.
    pub fn report(self, share: f64) -> Result<(), Error> {
        let share = self.start + self.size * share;
        match self.callback.map(|callback| callback(share)) {
            Some(ControlFlow::Break(())) => Err(Error::Stopped),
            _ => Ok(()),
        }
    }
}

impl fmt::Debug for Progress<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Progress").finish_non_exhaustive()
    }
}
