//! What the user should know before trusting a fit.

use std::fmt;

use crate::Interval;

/// What the user should know before trusting a fit.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Warning {
    /// The interval is open.
    NotIdentifiable {
        /// The parameter.
        name: String,
        /// Its interval.
        interval: Interval,
    },
    /// The residuals are larger than the given sigmas allow.
    Misfit {
        /// Residual variance over that of the sigmas.
        reduced_chi_square: f64,
        /// Probability of so large a one by chance.
        probability: f64,
    },
    /// The best value lies at a bound.
    AtBound {
        /// The parameter.
        name: String,
        /// Its best value.
        value: f64,
    },
    /// Two parameters are hardly distinguishable.
    Correlated {
        /// One.
        first: String,
        /// The other.
        second: String,
        /// Their correlation.
        correlation: f64,
    },
    /// Observations that hardly count in a robust fit.
    Outliers {
        /// Their indices, from 0.
        indices: Vec<usize>,
    },
    /// The model is too noisy to find the minimum exactly.
    Rough {
        /// How far the next step would still go, in standard errors.
        offset: f64,
    },
    /// Other values, far from the best ones, fit about as well. The intervals hold both as long as they are as likely as that.
    Ambiguous {
        /// These values, in the order of the parameters.
        values: Vec<f64>,
    },
    /// Few degrees of freedom: the noise itself is hardly known.
    FewObservations {
        /// Degrees of freedom.
        degrees_of_freedom: f64,
    },
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotIdentifiable { name, interval } => {
                write!(f, "{name} is not identifiable from these data: ")?;
                match (interval.lower, interval.upper) {
                    (Some(lower), _) => write!(f, "any value above {lower:.4e} fits"),
                    (None, Some(upper)) => write!(f, "any value below {upper:.4e} fits"),
                    (None, None) => write!(f, "any value fits"),
                }
            }
            Self::Misfit {
                reduced_chi_square,
                probability,
            } => write!(
                f,
                "the residuals are {:.2} times the given sigmas, which chance explains with a probability of {probability:.1e}: the \
                 model does not fit or the sigmas are too small; the errors are scaled up to the residuals",
                reduced_chi_square.sqrt()
            ),
            Self::AtBound { name, value } => write!(f, "the best {name}, {value:.4e}, lies at a bound"),
            Self::Correlated {
                first,
                second,
                correlation,
            } => write!(
                f,
                "{first} and {second} are hardly distinguishable: their correlation is {correlation:.4}"
            ),
            Self::Outliers { indices } => {
                write!(f, "{} observations look like outliers, index", indices.len())?;
                indices.iter().try_for_each(|index| write!(f, " {index}"))
            }
            Self::Rough { offset } => write!(
                f,
                "noise of the model hides the last {offset:.2} standard errors on the way to the best fit"
            ),
            Self::Ambiguous { values } => {
                write!(f, "other values, far from the best ones, fit about as well:")?;
                values.iter().try_for_each(|value| write!(f, " {value:.4e}"))
            }
            Self::FewObservations { degrees_of_freedom } => write!(
                f,
                "only {degrees_of_freedom:.1} degrees of freedom are left to estimate the noise"
            ),
        }
    }
}
