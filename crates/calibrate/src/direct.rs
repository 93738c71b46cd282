//! A fit that runs the model itself.

use nalgebra::DVector;

use crate::evaluator::Evaluator;
use crate::solution::Route;
use crate::{Calibration, CalibrationError, Fit};

impl Calibration<'_> {
    /// Fits, running the model wherever the search asks for it.
    ///
    /// # Errors
    ///
    /// [`CalibrationError`] where there are too few observations, the model has no answer anywhere, the fit does not converge or needs
    /// more model runs than allowed.
    pub fn fit(&self) -> Result<Fit, CalibrationError> {
        self.check_count()?;
        self.fit_directly(&Evaluator::new(self), self.start())
    }

    /// The fit by `evaluator`, which may have run before, from `start` and all over the range.
    pub(crate) fn fit_directly(
        &self,
        evaluator: &Evaluator<'_>,
        start: Option<DVector<f64>>,
    ) -> Result<Fit, CalibrationError> {
        let route = Route {
            scan: self.scan(),
            start,
            profiles: self.options.profiles,
            scan_others: 0,
        };
        let solution = self.solve(evaluator, &route)?;
        Ok(self.answer(evaluator, solution))
    }
}
