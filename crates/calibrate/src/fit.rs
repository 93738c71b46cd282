//! What a calibration answers.

use std::sync::Arc;

use nalgebra::{DMatrix, DVector};

use crate::whitening::Whitening;
use crate::{Estimate, Warning};

/// A calibrated model.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Fit {
    /// The parameters, in the order in which they were given.
    pub estimates: Vec<Estimate>,
    /// Correlation of the parameters by the curvature at the optimum; `None` where one of them has no standard error.
    pub correlation: Vec<Vec<Option<f64>>>,
    /// Predictions of the calibrated model.
    pub fitted: Vec<f64>,
    /// Observation less prediction.
    pub residuals: Vec<f64>,
    /// How much each observation counts: 1 with least squares, less for an outlier in a robust fit.
    pub weights: Vec<f64>,
    /// Root of the mean square of the residuals, all counted alike.
    pub residual_rms: f64,
    /// Share of the observations' variance that the model explains; `None` where they do not vary.
    pub r_squared: Option<f64>,
    /// Standard deviation of the noise: in the observations' unit if it was estimated, else in units of the given sigmas.
    pub noise: f64,
    /// Observations less the parameters that they determine (a prior determines its share).
    pub degrees_of_freedom: f64,
    /// Whether the noise was estimated, so that intervals rest on Student's t.
    pub noise_estimated: bool,
    /// Deviance at the optimum.
    pub deviance: f64,
    /// Model runs.
    pub evaluations: usize,
    /// Iterations of the descent that led to the optimum.
    pub iterations: u64,
    /// Size of the discrepancy as it was given, where the calibration has one.
    pub discrepancy: Option<f64>,
    /// What of each residual is most likely the discrepancy; 0 without one.
    pub smooth: Vec<f64>,
    /// What the user should know.
    pub warnings: Vec<Warning>,
    /// The optimum in free variables and the derivatives of the standardised residuals by them.
    pub(crate) free: DVector<f64>,
    pub(crate) jacobian: DMatrix<f64>,
    /// Half the second derivative of the deviance by each of them.
    pub(crate) curvatures: Vec<f64>,
    pub(crate) whitening: Option<Arc<Whitening>>,
    pub(crate) sigmas: Vec<f64>,
    /// Covariance of the free variables.
    pub(crate) covariance: DMatrix<f64>,
}

impl Fit {
    /// The best values, in the order of the parameters.
    pub fn values(&self) -> Vec<f64> {
        self.estimates.iter().map(|estimate| estimate.value).collect()
    }

    /// Residuals in units of their sigmas.
    pub fn standardised_residuals(&self) -> Vec<f64> {
        self.residuals
            .iter()
            .zip(&self.sigmas)
            .map(|(residual, sigma)| residual / sigma)
            .collect()
    }

    /// Residuals without their smooth part, the discrepancy, in units of their sigmas.
    pub fn standardised_noise(&self) -> Vec<f64> {
        let parts = self.residuals.iter().zip(&self.smooth).zip(&self.sigmas);
        parts
            .map(|((residual, smooth), sigma)| (residual - smooth) / sigma)
            .collect()
    }

    /// What a change of the observations changes of the residuals; those it does not name stay.
    pub(crate) fn standardised(&self, change: &[f64]) -> DVector<f64> {
        let mut change = DVector::from_fn(self.sigmas.len(), |row, _| {
            change.get(row).map_or(0.0, |change| change / self.sigmas[row])
        });
        if let Some(whitening) = &self.whitening {
            whitening.apply(&mut change);
        }
        change
    }

    /// By how many standard errors each estimate would move, to first order, if the model predicted `change` more, in the
    /// observations' unit: what an error of the model does to the parameters. 0 for what has no standard error.
    pub fn shift(&self, change: &[f64]) -> Vec<f64> {
        let count = self.free.len();
        let mut gradient = DVector::zeros(count);
        for (row, (change, curvature)) in self.standardised(change).iter().zip(&self.curvatures).enumerate() {
            for k in 0..count {
                gradient[k] -= self.jacobian[(row, k)] * curvature * change;
            }
        }
        let moved = &self.covariance * gradient;
        (0..count)
            .map(|k| {
                let error = self.covariance[(k, k)].sqrt();
                if error > 0.0 { moved[k] / error } else { 0.0 }
            })
            .collect()
    }

    /// The estimate of the parameter called `name`.
    pub fn estimate(&self, name: &str) -> Option<&Estimate> {
        self.estimates.iter().find(|estimate| estimate.name == name)
    }
}
