//! Residuals whose covariance is that of independent noise and of a discrepancy, made independent.

use nalgebra::{DMatrix, DVector, SymmetricEigen};

use crate::discrepancy::{Discrepancy, NOTHING};

/// The root of the standardised residuals' covariance, (I + λ² U s² Uᵀ)^(−1/2) and its inverse.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Whitening {
    /// U.
    pub vectors: DMatrix<f64>,
    /// s².
    pub variances: DVector<f64>,
    /// λ.
    pub ratio: f64,
}

impl Whitening {
    /// Of observations with these sigmas; nothing is whitened yet.
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
        Self {
            vectors,
            variances,
            ratio: 0.0,
        }
    }

    /// Share of the variance along each singular vector that is the discrepancy's.
    pub fn shares(&self, ratio: f64) -> DVector<f64> {
        self.variances.map(|variance| {
            let part = ratio * ratio * variance;
            part / (1.0 + part)
        })
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
        &self.vectors
            * self
                .vectors
                .tr_mul(residuals)
                .component_mul(&self.shares(self.ratio))
    }

    /// Whitens each column of a matrix with a row for each observation, as [`apply`](Self::apply) does.
    pub fn apply_to_columns(&self, columns: &mut DMatrix<f64>) {
        for k in 0..columns.ncols() {
            let mut column = columns.column(k).into_owned();
            self.apply(&mut column);
            columns.set_column(k, &column);
        }
    }

    fn scale(&self, values: &mut DVector<f64>, factor: impl Fn(f64) -> f64) {
        let mut data = values.rows_mut(0, self.vectors.nrows());
        let along = self.vectors.tr_mul(&data);
        let change = along.component_mul(&self.shares(self.ratio).map(|share| factor(share) - 1.0));
        data += &self.vectors * change;
    }
}
