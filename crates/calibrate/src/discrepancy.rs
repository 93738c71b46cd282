//! Where the model is not the truth: a smooth error of it, as a part of the residuals' covariance.
//!
//! Observations are the model, noise of covariance σ² S², and δ f, where f is a Gaussian process of mean 0
//! and known covariance K (M. C. Kennedy, A. O'Hagan, "Bayesian calibration of computer models", Journal of
//! the Royal Statistical Society B 63, 2001; J. Brynjarsdóttir, A. O'Hagan, "Learning about physical
//! parameters: the importance of model discrepancy", Inverse Problems 30, 2014).

use std::sync::Arc;

use nalgebra::{DMatrix, DVector};

use crate::CalibrationError;

/// Variance beside the largest one below which nothing is left of K: far less than readings show.
pub(crate) const NOTHING: f64 = 1e-10;

/// A smooth error of the model, of given size.
///
/// ```
/// use calibrate::{Calibration, Discrepancy, ModelError, Parameter, Scale};
///
/// // A line of slope 1 with a wave on it, read to 0.01; the model is the line alone.
/// let places: Vec<f64> = (1..=20).map(|k| 0.05 * f64::from(k)).collect();
/// let noise = |k: usize| if k % 2 == 0 { 0.01 } else { -0.01 };
/// let measured = places.iter().enumerate().map(|(k, x)| x + 0.05 * (4.0 * x).cos() + noise(k)).collect();
/// let line = |p: &[f64]| -> Result<Vec<f64>, ModelError> { Ok(places.iter().map(|x| p[0] * x).collect()) };
/// let slope = Parameter::new("slope", 0.0, 10.0, Scale::Linear)?;
/// let plain = Calibration::new(&line, vec![slope], measured)?;
/// let smooth = |i: usize, j: usize| (-0.5 * ((places[i] - places[j]) / 0.5).powi(2)).exp();
/// let allowed = plain.clone().with_discrepancy(Discrepancy::new(20, smooth, 0.1)?)?;
/// assert!(!plain.fit()?.estimates[0].interval.contains(1.0));
/// assert!(allowed.fit()?.estimates[0].interval.contains(1.0));
/// # Ok::<(), calibrate::CalibrationError>(())
/// ```
#[derive(Debug, Clone)]
pub struct Discrepancy {
    /// F.
    pub(crate) factor: Arc<DMatrix<f64>>,
    /// δ.
    pub(crate) size: f64,
}

impl Discrepancy {
    /// A process with this covariance between `count` observations where δ is 1, and this `size` δ. It
    /// is given, not fitted: few independent values of a smooth error are seen in a series, so that
    /// observations hardly tell its size.
    ///
    /// # Errors
    ///
    /// [`CalibrationError::Invalid`] unless `size` is finite and positive and the covariance finite,
    /// with variances of at least 0 and one above it.
    pub fn new(
        count: usize,
        covariance: impl Fn(usize, usize) -> f64,
        size: f64,
    ) -> Result<Self, CalibrationError> {
        let invalid = |what: &str, value, allowed| CalibrationError::invalid(what, value, allowed);
        if !(size.is_finite() && size > 0.0) {
            return Err(invalid("size of the discrepancy", size, "finite and positive"));
        }
        let mut left: Vec<f64> = (0..count).map(|row| covariance(row, row)).collect();
        if let Some(&value) = left.iter().find(|value| !(value.is_finite() && **value >= 0.0)) {
            return Err(invalid(
                "variance of the discrepancy",
                value,
                "finite and at least 0",
            ));
        }
        let least = NOTHING * left.iter().copied().fold(0.0, f64::max);
        // Cholesky's factorisation with pivots: few columns hold all of a smooth process.
        let mut columns: Vec<DVector<f64>> = Vec::new();
        while let Some(pivot) = (0..count).max_by(|&a, &b| left[a].total_cmp(&left[b]))
            && left[pivot] > least
            && columns.len() < count
        {
            let explained = |row: usize| {
                columns
                    .iter()
                    .map(|column| column[row] * column[pivot])
                    .sum::<f64>()
            };
            let column = DVector::from_fn(count, |row, _| {
                (covariance(row, pivot) - explained(row)) / left[pivot].sqrt()
            });
            if let Some(&value) = column.iter().find(|value| !value.is_finite()) {
                return Err(invalid("covariance of the discrepancy", value, "finite"));
            }
            for (left, entry) in left.iter_mut().zip(column.iter()) {
                *left -= entry * entry;
            }
            left[pivot] = 0.0;
            columns.push(column);
        }
        if columns.is_empty() {
            return Err(invalid("largest variance of the discrepancy", 0.0, "positive"));
        }
        let factor = DMatrix::from_fn(count, columns.len(), |row, column| columns[column][row]);
        Ok(Self {
            factor: Arc::new(factor),
            size,
        })
    }

    pub(crate) fn count(&self) -> usize {
        self.factor.nrows()
    }
}
