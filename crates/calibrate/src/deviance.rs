//! What is minimised, in units in which a rise by 1 is one standard error.
//!
//! With data residuals r in units of σ, their spread s, and u = r/s,
//!
//! D = κ · 2 Σ ρ(u) + Σ (prior residual)².
//!
//! κ makes D comparable with χ² whatever the loss and whether or not σ was known: κ = A/B with A the mean
//! of ψ′(u) and B = Σψ²(u)/(n − p) (P. J. Huber, Robust Statistics, 1981, section 7.6; for least squares κ
//! is 1/σ̂²). The inverse covariance is then κ A JᵀJ/s² plus that of the priors.

use nalgebra::{DMatrix, DVector};
use statrs::statistics::{Data, OrderStatistics};

use crate::Loss;

/// Makes the median of |r| under Gaussian noise a standard deviation.
const MEDIAN_TO_SIGMA: f64 = 1.4826;
/// Minimum share of residuals that count fully in a robust fit; below, its own statistics mean nothing.
const MIN_CURVATURE: f64 = 0.1;

/// The function that is minimised.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Deviance {
    pub loss: Loss,
    /// Number of data residuals; those of the priors follow.
    pub data: usize,
    /// s.
    pub spread: f64,
    /// κ.
    pub normalisation: f64,
}

impl Deviance {
    /// Before anything is known of the noise.
    pub fn new(loss: Loss, data: usize) -> Self {
        Self {
            loss,
            data,
            spread: 1.0,
            normalisation: 1.0,
        }
    }

    /// D of the residuals; infinite if the model has no answer.
    pub fn total(&self, residuals: &DVector<f64>) -> f64 {
        let (data, priors) = residuals.as_slice().split_at(self.data.min(residuals.len()));
        let data: f64 = data.iter().map(|r| self.loss.doubled(r / self.spread)).sum();
        let priors: f64 = priors.iter().map(|r| r * r).sum();
        let total = self.normalisation * data + priors;
        if total.is_nan() { f64::INFINITY } else { total }
    }

    /// w with ∂D/∂z = 2 Jᵀ(w ∘ r).
    pub fn weights(&self, residuals: &DVector<f64>) -> DVector<f64> {
        self.rows(residuals, |u| self.loss.weight(u))
    }

    /// Half the second derivative of D by each residual, its mean taken for the data.
    pub fn curvatures(&self, residuals: &DVector<f64>) -> DVector<f64> {
        let mean = self.mean_curvature(residuals);
        self.rows(residuals, |_| mean)
    }

    fn rows(&self, residuals: &DVector<f64>, data: impl Fn(f64) -> f64) -> DVector<f64> {
        let factor = self.normalisation / (self.spread * self.spread);
        DVector::from_fn(residuals.len(), |row, _| {
            if row < self.data {
                factor * data(residuals[row] / self.spread)
            } else {
                1.0
            }
        })
    }

    /// A.
    fn mean_curvature(&self, residuals: &DVector<f64>) -> f64 {
        let data = residuals.iter().take(self.data);
        let sum: f64 = data.map(|r| self.loss.curvature(r / self.spread)).sum();
        (sum / self.data as f64).max(MIN_CURVATURE)
    }

    /// The same with s, of a robust loss, and κ, of a noise that is not known, as these residuals have
    /// them. They have so many degrees of freedom and a noise of at least `least` in units of σ.
    pub fn scaled(mut self, residuals: &DVector<f64>, known: bool, freedom: f64, least: f64) -> Self {
        let data = || residuals.iter().take(self.data);
        if self.loss.is_robust() && !known {
            // Outliers do not move a median.
            let median = Data::new(data().map(|r| r.abs()).collect::<Vec<f64>>()).median();
            let lost = (self.data as f64 / freedom).sqrt();
            self.spread = (MEDIAN_TO_SIGMA * median * lost).max(least);
        }
        if self.loss.is_robust() || !known {
            let slope = |r: &f64| (self.loss.weight(r / self.spread) * r / self.spread).powi(2);
            let sum: f64 = residuals.iter().take(self.data).map(slope).sum();
            let mean = (sum / freedom).max((least / self.spread).powi(2));
            self.normalisation = self.mean_curvature(residuals) / mean;
        }
        self
    }

    /// Standard deviation of the noise in units of σ.
    pub fn noise(&self) -> f64 {
        if self.loss.is_robust() {
            self.spread
        } else {
            self.spread / self.normalisation.sqrt()
        }
    }
}

/// Jᵀ diag(w) J.
pub(crate) fn information(jacobian: &DMatrix<f64>, weights: &DVector<f64>) -> DMatrix<f64> {
    let mut weighted = jacobian.clone();
    for (mut row, weight) in weighted.row_iter_mut().zip(weights.iter()) {
        row *= *weight;
    }
    jacobian.tr_mul(&weighted)
}
