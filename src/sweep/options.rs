//! How to sweep.

use super::row::Row;
use crate::{Error, Progress, Run, Scene};

/// Computes a point.
pub type Evaluate<'a> = dyn Fn(&Scene) -> Result<Run, Error> + Sync + 'a;

/// How to sweep, in rayon's threads: those of the pool in which it is called, or all cores.
#[derive(Default, Clone, Copy)]
pub struct SweepOptions<'a> {
    /// Called with the share of the points that are done, at the start and after each point; it may stop the sweep, which the same call
    /// resumes later.
    pub progress: Progress<'a>,
    /// Called with each row of the table, in the order of the grid.
    pub each: Option<&'a dyn Fn(&Row)>,
    /// Computes a point in place of [`crate::run`].
    pub evaluate: Option<&'a Evaluate<'a>>,
    /// Whether the output replaces a file that is no table of a sweep.
    pub force: bool,
}
