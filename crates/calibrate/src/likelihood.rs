//! The likelihood on an emulator: residuals and their derivatives by the free variables.
//!
//! The residuals are (prediction − observation)/σ, followed by those of the priors. Where the model should
//! have no answer they are infinite, and the search stays away.

use nalgebra::{DMatrix, DVector};

use crate::parameter::{share, share_slope};
use crate::{Calibration, Emulator};

/// Free variables of all parameters and the residuals there.
#[derive(Debug, Clone)]
pub(crate) struct Point {
    pub free: DVector<f64>,
    pub residuals: DVector<f64>,
}

/// What is compared with the observations.
pub(crate) struct Likelihood<'a> {
    pub problem: &'a Calibration<'a>,
    pub emulator: &'a Emulator,
    /// Indices of the model's parameters.
    pub of_model: Vec<usize>,
}

impl<'a> Likelihood<'a> {
    pub fn new(problem: &'a Calibration<'a>, emulator: &'a Emulator) -> Self {
        Self {
            problem,
            emulator,
            of_model: problem.of_model(),
        }
    }

    /// Shares of the ranges of the model's parameters.
    pub fn place(&self, free: &DVector<f64>) -> DVector<f64> {
        DVector::from_fn(self.of_model.len(), |k, _| share(free[self.of_model[k]]))
    }

    /// The residuals by the emulator.
    pub fn point(&self, free: DVector<f64>) -> Point {
        let count = self.problem.observations.len() + self.problem.priors();
        let residuals = match self.emulator.at(&self.place(&free)) {
            Some(predicted) => self.residuals(&free, predicted.as_slice()),
            None => DVector::from_element(count, f64::INFINITY),
        };
        Point { free, residuals }
    }

    /// Residuals of predictions, to which the terms are still to be added.
    pub fn residuals(&self, free: &DVector<f64>, predicted: &[f64]) -> DVector<f64> {
        let problem = self.problem;
        let mut residuals = predicted.to_vec();
        for (parameter, &z) in problem.parameters.iter().zip(free) {
            let size = parameter.value(z);
            for (residual, entry) in residuals.iter_mut().zip(parameter.column().unwrap_or_default()) {
                *residual += size * entry;
            }
        }
        let readings = problem.observations.iter().zip(&problem.sigmas);
        for (residual, (observed, sigma)) in residuals.iter_mut().zip(readings) {
            *residual = (*residual - observed) / sigma;
        }
        let priors = problem.parameters.iter().zip(free);
        residuals.extend(priors.filter_map(|(parameter, &z)| Some(parameter.prior_residual(z)?[0])));
        DVector::from_vec(residuals)
    }

    /// Derivatives of the residuals by the free variables.
    pub fn jacobian(&self, free: &DVector<f64>) -> DMatrix<f64> {
        let problem = self.problem;
        let rows = problem.observations.len();
        let mut jacobian = DMatrix::zeros(rows + problem.priors(), free.len());
        let slopes = self.emulator.slopes(&self.place(free));
        for (column, &k) in slopes.column_iter().zip(&self.of_model) {
            let mut own = jacobian.view_mut((0, k), (rows, 1));
            own.copy_from(&(column * share_slope(free[k])));
        }
        let mut prior = rows;
        for (k, parameter) in problem.parameters.iter().enumerate() {
            for (row, entry) in parameter.column().unwrap_or_default().iter().enumerate() {
                jacobian[(row, k)] = parameter.slope(free[k]) * entry;
            }
            for (row, sigma) in problem.sigmas.iter().enumerate() {
                jacobian[(row, k)] /= sigma;
            }
            if let Some([_, slope]) = parameter.prior_residual(free[k]) {
                jacobian[(prior, k)] = slope;
                prior += 1;
            }
        }
        jacobian
    }
}
