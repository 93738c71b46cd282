//! Rounds of fit and size of the discrepancy.

use std::sync::Arc;

use crate::search::MAX_ROUNDS;
use crate::whitening::Whitening;
use crate::{Calibration, CalibrationError, Fit, Profiles};

/// Change of λ, as a share, at which the rounds end: an interval then moves by a few per cent at most.
const SETTLED: f64 = 0.1;
/// Rounds after which λ only grows; nearly all fits take three to five.
const WAVERING: usize = 8;

impl Calibration<'_> {
    /// Fits with a size of the discrepancy, by `fit`, until the residuals call for the size that was taken; then with the intervals asked for.
    /// Without a discrepancy once.
    pub(crate) fn with_size<T>(
        &self,
        mut fit: impl FnMut(&Self, Option<T>) -> Result<(Fit, T), CalibrationError>,
    ) -> Result<(Fit, T), CalibrationError> {
        let Some(discrepancy) = &self.discrepancy else {
            return fit(self, None);
        };
        let mut one = self.clone();
        let mut whitening = Whitening::new(discrepancy, &self.sigmas);
        one.options.profiles = Profiles::None;
        let (mut learned, mut evaluations) = (None, 0);
        for round in 0..MAX_ROUNDS {
            one.whitening = Some(Arc::new(whitening.clone()));
            let (mut found, last) = fit(&one, learned.take())?;
            evaluations += found.evaluations;
            found.evaluations = evaluations;
            let wanted = found.ratio;
            if found.discrepancy.is_none() {
                return Err(CalibrationError::InvalidOption {
                    name: "sigma of the discrepancy",
                    value: discrepancy.sigma,
                    allowed: "large enough to show beside the noise of the observations",
                });
            }
            let change = (wanted / whitening.ratio).ln();
            // Where two sizes are as likely, it may waver between them: then none is taken that is called too small.
            let settled = change.abs() < SETTLED || (round > WAVERING && change < 0.0);
            if settled && one.options.profiles == self.options.profiles {
                return Ok((found, last));
            }
            if settled {
                one.options.profiles = self.options.profiles;
            } else if (4..=WAVERING).contains(&round) {
                // Half of a change, so that the rounds hardly go in a circle.
                whitening.ratio = (whitening.ratio * wanted).sqrt();
            } else {
                whitening.ratio = wanted;
            }
            one.options.start = Some(found.values());
            one.options.scan = Some(0);
            learned = Some(last);
        }
        Err(CalibrationError::NotConverged {
            iterations: MAX_ROUNDS as u64,
            offset: f64::INFINITY,
        })
    }
}
