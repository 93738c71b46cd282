//! What is known of a parameter after a fit.

use std::fmt;

/// An interval; an end is `None` if the data do not close it.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Interval {
    /// Lower end.
    pub lower: Option<f64>,
    /// Upper end.
    pub upper: Option<f64>,
}

impl Interval {
    /// Whether both ends are closed.
    pub fn is_closed(&self) -> bool {
        self.lower.is_some() && self.upper.is_some()
    }

    /// Whether `value` lies in it.
    pub fn contains(&self, value: f64) -> bool {
        self.lower.is_none_or(|lower| lower <= value) && self.upper.is_none_or(|upper| value <= upper)
    }

    /// The least one that holds both.
    pub(crate) fn with(&self, other: &Self) -> Self {
        Self {
            lower: self.lower.zip(other.lower).map(|(a, b)| a.min(b)),
            upper: self.upper.zip(other.upper).map(|(a, b)| a.max(b)),
        }
    }
}

impl fmt::Display for Interval {
    /// What the open end of an interval, or both, leave.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match (self.lower, self.upper) {
            (Some(lower), Some(upper)) => write!(f, " from {lower:.4e} to {upper:.4e}"),
            (Some(lower), None) => write!(f, " above {lower:.4e}"),
            (None, Some(upper)) => write!(f, " below {upper:.4e}"),
            (None, None) => Ok(()),
        }
    }
}

/// A fitted parameter, in its own unit.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Estimate {
    /// The parameter's name.
    pub name: String,
    /// Best value.
    pub value: f64,
    /// Standard error by the slopes of the model at the optimum, by the interval where these contradict it;
    /// `None` if the data say nothing about the parameter there.
    pub standard_error: Option<f64>,
    /// Interval at the level of confidence asked.
    pub interval: Interval,
    /// Whether the data close the interval on both sides. If not, `value` is one of many that fit.
    pub identifiable: bool,
    /// Values and rise of the deviance at them, in squared standard errors, where a profile was computed;
    /// ascending.
    pub profile: Vec<(f64, f64)>,
}
