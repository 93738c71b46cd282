//! What can go wrong in a fit.

use calibrate::CalibrationError;

use creepage_run::Error;

/// What the statistics cannot do.
pub fn study(error: CalibrationError) -> Error {
    Error::Study {
        is_bad_input: error.is_bad_input(),
        error: error.into(),
    }
}
