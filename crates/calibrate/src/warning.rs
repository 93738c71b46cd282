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
    /// Other values of the parameters, in their order and far from the best ones, fit about as well. The
    /// intervals hold both.
    #[error("other values, far from the best ones, fit about as well: {}", listed(.0))]
    Ambiguous(Vec<f64>),
}

fn listed(values: &[f64]) -> String {
    let words: Vec<String> = values.iter().map(|value| format!("{value:.4e}")).collect();
    words.join(" ")
}
