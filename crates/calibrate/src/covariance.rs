//! Covariance of the free variables from the Jacobian at the optimum.
//!
//! The inverse covariance is half the second derivative of the deviance, Jᵀ diag(c) J. Directions of which
//! neither data nor priors know anything have no covariance: parameters along them are marked as unknown,
//! not given a large number.

use nalgebra::{DMatrix, SymmetricEigen};
use statrs::distribution::{ContinuousCDF, Normal, StudentsT};

use crate::descent::Optimum;
use crate::deviance::information;

/// Eigenvalues of the information, scaled to a unit diagonal, below which a direction counts as unknown:
/// rounding makes no larger ones. A parameter with more than its fourth root in such a direction is
/// unknown.
const UNKNOWN: f64 = 1e-12;

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
        let count = information.nrows();
        let scale = information.diagonal().map(f64::sqrt);
        // What is not positive has a NaN for its root.
        let mut known: Vec<bool> = scale.iter().map(|&size| size > 0.0 && size.is_finite()).collect();
        // Beside the scales of what is known; 0 for the rest.
        let over_scales = |matrix: DMatrix<f64>, known: &[bool]| {
            matrix.map_with_location(|i, j, value| {
                let size = scale[i] * scale[j];
                if known[i] && known[j] && size > 0.0 {
                    value / size
                } else {
                    0.0
                }
            })
        };
        let scaled = over_scales(information, &known);
        let eigen = SymmetricEigen::new(scaled);
        let mut matrix = DMatrix::zeros(count, count);
        for (index, &value) in eigen.eigenvalues.iter().enumerate() {
            let direction = eigen.eigenvectors.column(index);
            if value > UNKNOWN {
                matrix += direction * direction.transpose() / value;
            } else {
                for (known, share) in known.iter_mut().zip(direction.iter()) {
                    *known &= share * share < UNKNOWN.sqrt();
                }
            }
        }
        let matrix = over_scales(matrix, &known);
        Self { matrix, known }
    }

    /// The same with the standard error of each multiplied by its share.
    pub fn times(mut self, shares: &[f64]) -> Self {
        let scaled = |i: usize, j: usize, value| shares[i] * shares[j] * value;
        self.matrix = self.matrix.map_with_location(scaled);
        self
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
