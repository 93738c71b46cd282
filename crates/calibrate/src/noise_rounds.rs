//! The noise beside a discrepancy of given size.
//!
//! Where the noise σ of the observations is known, so is λ = δ/σ, and one fit does. Where it is to be
//! estimated, fits with a λ and estimates of σ from what is left of their residuals without the smooth part,
//! e, take turns:
//!
//! σ² = eᵀe/(n − p − Σ λ²s²/(1 + λ²s²)),
//!
//! whose last term counts the smooth functions that the discrepancy has taken from the residuals (W. H.
//! Fellner, "Robust estimation of variance components", Technometrics 28, 1986).

use std::sync::Arc;

use crate::search::MAX_ROUNDS;
use crate::whitening::Whitening;
use crate::{Calibration, CalibrationError, Fit, Profiles};

/// Change of λ, as a share, at which the rounds end: an interval then moves by a few per cent at most.
const SETTLED: f64 = 0.1;
/// Largest λ, in units in which the discrepancy's largest variance is that of the noise: above there is no
/// noise.
const LARGEST: f64 = 1e5;

impl Calibration<'_> {
    /// Fits beside the discrepancy, by `fit`; without one once.
    pub(crate) fn beside_discrepancy<T>(
        &self,
        mut fit: impl FnMut(&Self, Option<T>) -> Result<(Fit, T), CalibrationError>,
    ) -> Result<(Fit, T), CalibrationError> {
        let Some(discrepancy) = &self.discrepancy else {
            return fit(self, None);
        };
        let mut whitening = Whitening::new(discrepancy, &self.sigmas);
        let largest = LARGEST / whitening.variances.max().sqrt();
        let ratio = |noise: f64| (discrepancy.size / noise).min(largest);
        let mut one = self.clone();
        let (mut learned, mut evaluations) = (None, 0);
        if self.knows_noise {
            whitening.ratio = ratio(1.0);
            one.whitening = Some(Arc::new(whitening));
            return fit(&one, None);
        }
        one.options.profiles = Profiles::None;
        for _ in 0..MAX_ROUNDS {
            one.whitening = Some(Arc::new(whitening.clone()));
            let (mut found, last) = fit(&one, learned.take())?;
            evaluations += found.evaluations;
            found.evaluations = evaluations;
            let wanted = ratio(whitening.noise(&found).max(self.least_noise()));
            let settled = (wanted / whitening.ratio).ln().abs() < SETTLED;
            if settled && one.options.profiles == self.options.profiles {
                return Ok((found, last));
            }
            if settled {
                one.options.profiles = self.options.profiles;
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

impl Whitening {
    /// σ as `found` leaves it, in units of the sigmas.
    fn noise(&self, found: &Fit) -> f64 {
        let square: f64 = found.standardised_noise().iter().map(|r| r * r).sum();
        let freedom = found.degrees_of_freedom - self.shares(self.ratio).sum();
        (square / freedom.max(1.0)).sqrt()
    }
}
