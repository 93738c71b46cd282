//! What a caller sees of a fit while it runs.

use std::fmt;
use std::ops::ControlFlow;
use std::sync::Arc;

use crate::CalibrationError;

/// What an observer is given after each iteration.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Progress {
    /// Iteration of the present descent.
    pub iteration: u64,
    /// Deviance: its falls are in units of squared standard errors.
    pub deviance: f64,
    /// Parameters in their physical units.
    pub parameters: Vec<f64>,
}

type Callback = dyn Fn(&Progress) -> ControlFlow<()> + Send + Sync;

/// Called after each iteration; it can stop the fit.
///
/// ```
/// use std::ops::ControlFlow;
/// use calibrate::{Observer, Options};
///
/// let mut options = Options::default();
/// options.observer = Some(Observer::new(|progress| {
///     println!("{}: {:?}", progress.iteration, progress.parameters);
///     ControlFlow::Continue(())
/// }));
/// ```
#[derive(Clone)]
pub struct Observer(Arc<Callback>);

impl Observer {
    /// Calls `observe` after each iteration. [`ControlFlow::Break`] ends the fit with [`CalibrationError::Stopped`].
    pub fn new(observe: impl Fn(&Progress) -> ControlFlow<()> + Send + Sync + 'static) -> Self {
        Self(Arc::new(observe))
    }

    pub(crate) fn call(&self, progress: &Progress) -> Result<(), CalibrationError> {
        match (self.0)(progress) {
            ControlFlow::Continue(()) => Ok(()),
            ControlFlow::Break(()) => Err(CalibrationError::Stopped),
        }
    }
}

impl fmt::Debug for Observer {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Observer(..)")
    }
}
