//! Covariance of the free variables from the Jacobian at the optimum.
//!
//! The inverse covariance is half the second derivative of the deviance, Jᵀ diag(c) J. Directions of which
//! neither data nor priors know anything have no covariance: parameters along them are marked as unknown,
//! not given a large number.

use nalgebra::DMatrix;
use statrs::distribution::{ContinuousCDF, Normal, StudentsT};

use crate::descent::Optimum;
use crate::deviance::information;

/// Added to the diagonal of the information, scaled to 1: rounding makes no larger eigenvalues.
const ROUNDING: f64 = 1e-13;
/// Variance relative to that with all others known from which on a parameter counts as unknown.
const UNKNOWN: f64 = 1e9;

/// Covariance of the free variables.
#[derive(Debug, Clone)]
pub(crate) struct Covariance {
    pub matrix: DMatrix<f64>,
    /// Whether anything is known of each.
    pub known: Vec<bool>,
}

impl Covariance {
    /// Around `optimum`.
    pub fn of(optimum: &Optimum) -> Self {
        let curvatures = optimum.deviance.curvatures(&optimum.point.residuals);
        let information = information(&optimum.jacobian, &curvatures);
        let scale = information.diagonal().map(f64::sqrt);
        // What is not positive has a NaN for its root.
        let is_seen = |k: usize| scale[k] > 1e-150 && scale[k] < 1e150;
        let scaled = information.map_with_location(|i, j, value| {
            if i == j {
                1.0 + ROUNDING
            } else if is_seen(i) && is_seen(j) {
                value / (scale[i] * scale[j])
            } else {
                0.0
            }
        });
        let none = || DMatrix::from_element(scale.len(), scale.len(), f64::INFINITY);
        let inverse = scaled.cholesky().map_or_else(none, |factor| factor.inverse());
        let is_known = |k: usize| is_seen(k) && inverse[(k, k)] < UNKNOWN;
        let known: Vec<bool> = (0..scale.len()).map(is_known).collect();
        // Rounding leaves an inverse that is not quite symmetric.
        let inverse = 0.5 * (&inverse + inverse.transpose());
        let matrix = inverse.map_with_location(|i, j, value| {
            if known[i] && known[j] {
                value / (scale[i] * scale[j])
            } else {
                0.0
            }
        });
        Self { matrix, known }
    }

    /// Standard error of a free variable.
    pub fn standard_error(&self, k: usize) -> Option<f64> {
        self.known[k].then(|| self.matrix[(k, k)].max(0.0).sqrt())
    }

    /// Correlation of two.
    pub fn correlation(&self, i: usize, j: usize) -> Option<f64> {
        if i == j {
            return Some(1.0);
        }
        let size = (self.matrix[(i, i)] * self.matrix[(j, j)]).sqrt();
        (self.known[i] && self.known[j] && size > 0.0).then(|| (self.matrix[(i, j)] / size).clamp(-1.0, 1.0))
    }
}

/// Number of parameters that the data determine; the rest is the priors' doing.
pub(crate) fn parameters_from_data(optimum: &Optimum) -> f64 {
    let Optimum {
        jacobian, deviance, ..
    } = optimum;
    let covariance = Covariance::of(optimum);
    let priors = jacobian.rows(deviance.data, jacobian.nrows() - deviance.data);
    jacobian.ncols() as f64 - (covariance.matrix * priors.transpose() * priors).trace()
}

/// The value that a standardised estimate exceeds with probability `tail`: Student's t where the noise was
/// estimated with these degrees of freedom, else Gauss's.
pub(crate) fn quantile(tail: f64, degrees_of_freedom: Option<f64>) -> f64 {
    // From a million on both are the same, and statrs's search for a quantile does not end with many more.
    let student =
        degrees_of_freedom.and_then(|freedom| StudentsT::new(0.0, 1.0, freedom.clamp(0.5, 1e6)).ok());
    match student {
        Some(student) => student.inverse_cdf(1.0 - tail),
        None => Normal::standard().inverse_cdf(1.0 - tail),
    }
}
