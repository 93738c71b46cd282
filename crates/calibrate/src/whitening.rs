//! Residuals whose covariance is that of independent noise and of a discrepancy, made independent.
//!
//! With a factor K = F Fᵀ of the discrepancy's covariance and the singular vectors U and values s of S⁻¹ F,
//! the standardised residuals have the covariance σ² (I + λ² U s² Uᵀ), λ = δ/σ. Its root whitens them, and
//! a fit of least squares goes on as without.

use nalgebra::{DMatrix, DVector, SymmetricEigen};

use crate::discrepancy::{Discrepancy, NOTHING};

/// Largest λ s: above there is no noise.
const LARGEST: f64 = 1e5;

/// The root of the standardised residuals' covariance, (I + λ² U s² Uᵀ)^(−1/2) and its inverse.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Whitening {
    /// U.
    vectors: DMatrix<f64>,
    /// s².
    variances: DVector<f64>,
    /// δ, in units of the sigmas.
    size: f64,
    /// Share of the variance along each singular vector that is the discrepancy's, λ²s²/(1 + λ²s²).
    shares: DVector<f64>,
}

impl Whitening {
    /// Of observations with these sigmas, beside a noise of one sigma.
    pub fn new(discrepancy: &Discrepancy, sigmas: &[f64]) -> Self {
        let mut factor = (*discrepancy.factor).clone();
        for (mut row, sigma) in factor.row_iter_mut().zip(sigmas) {
            row /= *sigma;
        }
        let eigen = SymmetricEigen::new(factor.tr_mul(&factor));
        let least = NOTHING * eigen.eigenvalues.iter().copied().fold(0.0, f64::max);
        let kept: Vec<usize> = (0..eigen.eigenvalues.len())
            .filter(|&k| eigen.eigenvalues[k] > least)
            .collect();
        let variances = DVector::from_fn(kept.len(), |k, _| eigen.eigenvalues[kept[k]]);
        let mut vectors = &factor * eigen.eigenvectors.select_columns(&kept);
        for (mut column, variance) in vectors.column_iter_mut().zip(variances.iter()) {
            column /= variance.sqrt();
        }
        let mut whitening = Self {
            vectors,
            shares: variances.clone(),
            variances,
            size: discrepancy.size,
        };
        whitening.set_noise(1.0);
        whitening
    }

    /// Sets λ by a noise in units of the sigmas.
    pub fn set_noise(&mut self, noise: f64) {
        let largest = LARGEST / self.variances.max().sqrt();
        let ratio = (self.size / noise).min(largest);
        self.shares = self.variances.map(|variance| {
            let part = ratio * ratio * variance;
            part / (1.0 + part)
        });
    }

    /// Degrees of freedom that the discrepancy takes from the residuals.
    pub fn freedom(&self) -> f64 {
        self.shares.sum()
    }

    /// Whitens what belongs to the observations, the first rows.
    pub fn apply(&self, values: &mut DVector<f64>) {
        self.scale(values, |share| (1.0 - share).sqrt());
    }

    /// What was whitened.
    pub fn undo(&self, values: &mut DVector<f64>) {
        self.scale(values, |share| 1.0 / (1.0 - share).sqrt());
    }

    /// The discrepancy's part of residuals that are not whitened, as it is most likely.
    pub fn smooth(&self, residuals: &DVector<f64>) -> DVector<f64> {
        &self.vectors * self.vectors.tr_mul(residuals).component_mul(&self.shares)
    }

    fn scale(&self, values: &mut DVector<f64>, factor: impl Fn(f64) -> f64) {
        let mut data = values.rows_mut(0, self.vectors.nrows());
        let along = self.vectors.tr_mul(&data);
        let change = along.component_mul(&self.shares.map(|share| factor(share) - 1.0));
        data += &self.vectors * change;
    }
}
