//! A fit that runs the model itself.

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
        let evaluator = Evaluator::new(self);
        let route = Route {
            scan: self.scan(),
            start: self.start(),
            profiles: self.options.profiles,
            scan_others: 0,
        };
        let solution = self.solve(&evaluator, &route)?;
        Ok(self.answer(&evaluator, solution))
    }
}
