//! What can go wrong in a fit.

use std::borrow::Cow;

use calibrate::CalibrationError;

use creepage_run::Error;

/// What the statistics cannot do.
pub fn study(error: CalibrationError) -> Error {
    Error::Study {
        is_bad_input: error.is_bad_input(),
        error: error.into(),
    }
}

/// What scene, readings and options ask for that does not fit together: the key, what was found, and why.
pub fn unfit<T>(
    key: &'static str,
    found: &'static str,
    reason: impl Into<Cow<'static, str>>,
) -> Result<T, Error> {
    Err(Error::unfit(key, found, reason))
}
