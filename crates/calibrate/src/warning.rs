//! What the user should know before trusting a fit.

use crate::Interval;

/// What the user should know before trusting a fit.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Warning {
    /// The interval is open.
    #[error("{name} is not identifiable from these data: any value{interval} fits")]
    NotIdentifiable {
        /// The parameter.
        name: String,
        /// Its interval.
        interval: Interval,
    },
    /// The residuals are larger than the given sigmas allow.
    #[error(
        "the residuals are {:.2} times the given sigmas, which chance explains with a probability of \
         {probability:.1e}: the model does not fit or the sigmas are too small; the errors are scaled up to the \
         residuals",
        reduced_chi_square.sqrt()
    )]
    Misfit {
        /// Residual variance over that of the sigmas.
        reduced_chi_square: f64,
        /// Probability of so large a one by chance.
        probability: f64,
    },
    /// The best value lies at a bound.
    #[error("the best {name}, {value:.4e}, lies at a bound")]
    AtBound {
        /// The parameter.
        name: String,
        /// Its best value.
        value: f64,
    },
    /// Two parameters are hardly distinguishable.
    #[error("{first} and {second} are hardly distinguishable: their correlation is {correlation:.4}")]
    Correlated {
        /// One.
        first: String,
        /// The other.
        second: String,
        /// Their correlation.
        correlation: f64,
    },
    /// Observations that hardly count in a robust fit, by their indices from 0.
    #[error("{} observations look like outliers, index {}", .0.len(), listed(.0, ToString::to_string))]
    Outliers(Vec<usize>),
    /// Other values of the parameters, in their order and far from the best ones, fit about as well. The
    /// intervals hold both.
    #[error("other values, far from the best ones, fit about as well: {}", listed(.0, |v| format!("{v:.4e}")))]
    Ambiguous(Vec<f64>),
    /// So few degrees of freedom are left that the noise itself is hardly known.
    #[error("only {0:.1} degrees of freedom are left to estimate the noise")]
    FewObservations(f64),
}

fn listed<T>(values: &[T], word: impl Fn(&T) -> String) -> String {
    values.iter().map(word).collect::<Vec<_>>().join(" ")
}
