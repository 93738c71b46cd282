//! What the user should know before trusting a fit.

use crate::Interval;
use crate::parameter::{FARTHEST, share};
use crate::problem::Problem;
use crate::solution::Solution;

/// Correlation from which two parameters count as hardly distinguishable.
const CORRELATED: f64 = 0.99;
/// Weight below which an observation counts as an outlier: of Tukey's loss at three sigmas.
const OUTLIER: f64 = 0.35;
/// Degrees of freedom below which the noise is hardly known: its own standard error is a third.
const FEW: f64 = 5.0;

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

/// What is to be said of a solution with these weights of the observations.
pub(crate) fn warnings(
    problem: &Problem<'_>,
    solution: &Solution,
    weights: &[f64],
    degrees_of_freedom: f64,
) -> Vec<Warning> {
    let mut warnings: Vec<Warning> = solution.misfit.iter().cloned().collect();
    // An interval that is open says more than another minimum does.
    let closed = solution.estimates.iter().all(|estimate| estimate.identifiable);
    let rival = solution.rival.as_ref().filter(|_| closed);
    warnings.extend(rival.map(|rival| {
        let pairs = problem.parameters.iter().zip(rival.free.iter());
        Warning::Ambiguous(pairs.map(|(parameter, &z)| parameter.value(share(z))).collect())
    }));
    for (k, estimate) in solution.estimates.iter().enumerate() {
        let name = || estimate.name.clone();
        if !estimate.identifiable {
            let interval = estimate.interval;
            warnings.push(Warning::NotIdentifiable {
                name: name(),
                interval,
            });
        } else if solution.optimum.point.free[k].abs() >= FARTHEST {
            let value = estimate.value;
            warnings.push(Warning::AtBound { name: name(), value });
        }
        for (index, other) in solution.estimates.iter().take(k).enumerate() {
            let correlation = solution.covariance.correlation(k, index);
            if let Some(correlation) = correlation.filter(|c| c.abs() > CORRELATED) {
                let first = other.name.clone();
                warnings.push(Warning::Correlated {
                    first,
                    second: name(),
                    correlation,
                });
            }
        }
    }
    let indices: Vec<usize> = (0..weights.len()).filter(|&i| weights[i] < OUTLIER).collect();
    if !indices.is_empty() {
        warnings.push(Warning::Outliers(indices));
    }
    if solution.noise_estimated && degrees_of_freedom < FEW {
        warnings.push(Warning::FewObservations(degrees_of_freedom));
    }
    warnings
}
