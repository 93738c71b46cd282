//! What can go wrong in a fit.

use calibrate::CalibrationError;

use crate::Error;
use crate::readings::DataError;

/// Error of a fit, by where it comes from.
#[derive(Debug)]
pub(super) enum FitError {
    Analysis(Error),
    Calibration(CalibrationError),
}

impl From<Error> for FitError {
    fn from(error: Error) -> Self {
        Self::Analysis(error)
    }
}

impl From<DataError> for FitError {
    fn from(error: DataError) -> Self {
        Self::Analysis(error.into())
    }
}

impl From<CalibrationError> for FitError {
    fn from(error: CalibrationError) -> Self {
        Self::Calibration(error)
    }
}

impl From<FitError> for Error {
    fn from(error: FitError) -> Self {
        match error {
            FitError::Analysis(error) => error,
            FitError::Calibration(error) => Self::Study {
                is_bad_input: error.is_bad_input(),
                error: error.into(),
            },
        }
    }
}
