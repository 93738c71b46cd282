//! Parameters, their bounds, and what is known of them before the data.
//!
//! A parameter is fitted in a *coordinate* s, its value or the logarithm of it. Bounds hold by a
//! transformation: the fit moves a free variable z without bounds, whose *share* of the range is
//!
//! u = 1/(1 + e^(−z)), s = s_lower + (s_upper − s_lower) u.

use std::sync::Arc;

use crate::CalibrationError;

/// Farthest that the free variable goes: within a thousandth of the range from a bound.
pub(crate) const FARTHEST: f64 = 7.0;

/// In what a parameter is fitted.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Scale {
    /// Its value.
    Linear,
    /// The logarithm of its value, for what may vary by powers of ten.
    Logarithmic,
}

/// Knowledge of a parameter that does not come from the data: a Gaussian in its coordinate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Prior {
    /// Most likely value, in the parameter's unit.
    pub value: f64,
    /// Standard deviation: in the parameter's unit if its scale is linear, relative (of the logarithm)
    /// if logarithmic.
    pub sigma: f64,
}

/// A parameter to be fitted.
///
/// ```
/// use calibrate::{Parameter, Prior, Scale};
///
/// // Between 1e5 and 1e9, and about 2e6 by what is known of it: a factor of e^0.5 either way.
/// let steepness = Parameter::new("steepness", 1e5, 1e9, Scale::Logarithmic)?.with_prior(Prior { value: 2e6, sigma: 0.5 })?;
/// assert_eq!(steepness.name(), "steepness");
/// # Ok::<(), calibrate::CalibrationError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Parameter {
    name: String,
    pub(crate) lower: f64,
    pub(crate) upper: f64,
    pub(crate) scale: Scale,
    pub(crate) prior: Option<Prior>,
    /// What a value of 1 adds to each prediction, where that is all that it does.
    term: Option<Arc<[f64]>>,
}

impl Parameter {
    /// A parameter between `lower` and `upper`.
    ///
    /// # Errors
    ///
    /// [`CalibrationError::Invalid`] unless the bounds are finite, in order, and positive with a logarithmic scale.
    pub fn new(name: &str, lower: f64, upper: f64, scale: Scale) -> Result<Self, CalibrationError> {
        let error = |quantity, value, allowed| Err(invalid(name, quantity, value, allowed));
        if !lower.is_finite() || (scale == Scale::Logarithmic && lower <= 0.0) {
            let allowed = "finite, and positive with a logarithmic scale";
            return error("lower bound", lower, allowed);
        }
        let parameter = Self {
            name: name.to_owned(),
            lower,
            upper,
            scale,
            prior: None,
            term: None,
        };
        // The logarithms of bounds that nearly touch are the same number.
        let width = (upper - lower).min(parameter.range().1);
        if !(width > 0.0 && (upper - lower).is_finite()) {
            return error("upper bound", upper, "finite and above the lower bound");
        }
        Ok(parameter)
    }

    /// A parameter that adds its value times `column` to the predictions, an entry each: an error of the
    /// instrument, such as its zero. The
    /// [`Model`](crate::Model) is not given it, so that it costs no runs.
    ///
    /// # Errors
    ///
    /// [`CalibrationError::Invalid`] unless the bounds are finite and in order and the column is finite.
    pub fn term(name: &str, lower: f64, upper: f64, column: &[f64]) -> Result<Self, CalibrationError> {
        let parameter = Self::new(name, lower, upper, Scale::Linear)?;
        if let Some(&value) = column.iter().find(|value| !value.is_finite()) {
            return Err(invalid(name, "entry of its column", value, "finite"));
        }
        Ok(Self {
            term: Some(column.into()),
            ..parameter
        })
    }

    /// The same parameter with prior knowledge.
    ///
    /// # Errors
    ///
    /// [`CalibrationError::Invalid`] unless the prior's value lies within the bounds and its sigma is finite and
    /// positive.
    pub fn with_prior(mut self, prior: Prior) -> Result<Self, CalibrationError> {
        let error = |quantity, value, allowed| Err(invalid(&self.name, quantity, value, allowed));
        if !(self.lower..=self.upper).contains(&prior.value) {
            return error("prior", prior.value, "a value within the bounds");
        }
        if !(prior.sigma.is_finite() && prior.sigma > 0.0) {
            return error("sigma of the prior", prior.sigma, "finite and positive");
        }
        self.prior = Some(prior);
        Ok(self)
    }

    /// Name.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// What a value of 1 adds to each prediction; `None` for a parameter of the model.
    pub fn column(&self) -> Option<&[f64]> {
        self.term.as_deref()
    }

    /// s of a value.
    fn coordinate(&self, value: f64) -> f64 {
        match self.scale {
            Scale::Linear => value,
            Scale::Logarithmic => value.ln(),
        }
    }

    /// Lowest s and the range of s.
    fn range(&self) -> (f64, f64) {
        let lower = self.coordinate(self.lower);
        (lower, self.coordinate(self.upper) - lower)
    }

    /// Value at a share of the range.
    pub(crate) fn value_at(&self, share: f64) -> f64 {
        let (lower, range) = self.range();
        let coordinate = lower + range * share;
        let value = match self.scale {
            Scale::Linear => coordinate,
            Scale::Logarithmic => coordinate.exp(),
        };
        value.clamp(self.lower, self.upper)
    }

    /// Value at a free variable.
    pub(crate) fn value(&self, free: f64) -> f64 {
        self.value_at(share(free))
    }

    /// Derivative of the value by the free variable.
    pub(crate) fn slope(&self, free: f64) -> f64 {
        let by_coordinate = match self.scale {
            Scale::Linear => 1.0,
            Scale::Logarithmic => self.value(free),
        };
        by_coordinate * self.range().1 * share_slope(free)
    }

    /// Distance from the prior in its sigmas, and its derivative by the free variable.
    pub(crate) fn prior_residual(&self, free: f64) -> Option<[f64; 2]> {
        let prior = self.prior?;
        let (lower, range) = self.range();
        let off = lower + range * share(free) - self.coordinate(prior.value);
        Some([off, range * share_slope(free)].map(|length| length / prior.sigma))
    }
}

/// Share of the range at a free variable; beyond the farthest nothing changes.
pub(crate) fn share(free: f64) -> f64 {
    1.0 / (1.0 + (-free.clamp(-FARTHEST, FARTHEST)).exp())
}

/// Derivative of the share by the free variable.
pub(crate) fn share_slope(free: f64) -> f64 {
    if free.abs() > FARTHEST {
        return 0.0;
    }
    share(free) * (1.0 - share(free))
}

/// Free variable at a share.
pub(crate) fn free(share: f64) -> f64 {
    let share = share.clamp(0.0, 1.0);
    (share / (1.0 - share)).ln().clamp(-FARTHEST, FARTHEST)
}

fn invalid(name: &str, quantity: &str, value: f64, allowed: &'static str) -> CalibrationError {
    CalibrationError::invalid(format!("{quantity} of parameter {name}"), value, allowed)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::{Parameter, Scale, free, share};

    proptest! {
        /// There and back, within the bounds, with the slope that differences give.
        #[test]
        fn transformation(lower in 1e-3..10.0_f64, ratio in 1.5..1e6_f64, z in -6.5..6.5_f64, logarithmic: bool) {
            let scale = if logarithmic { Scale::Logarithmic } else { Scale::Linear };
            let parameter = Parameter::new("p", lower, lower * ratio, scale).unwrap();
            let value = parameter.value(z);
            prop_assert!((lower..=lower * ratio).contains(&value));
            prop_assert!((free(share(z)) - z).abs() < 1e-6);
            let h = 1e-4;
            let slope = (parameter.value(z + h) - parameter.value(z - h)) / (2.0 * h);
            prop_assert!((slope / parameter.slope(z) - 1.0).abs() < 1e-4);
        }
    }
}
