//! The likelihood on an emulator: residuals and their derivatives by the free variables.
//!
//! The residuals are (prediction − observation)/σ, whitened where the model has a discrepancy, followed by
//! those of the priors. Where the model should have no answer they are infinite, and the search stays away.

use nalgebra::{DMatrix, DVector};

use crate::Emulator;
use crate::parameter::share;
use crate::problem::Problem;
use crate::whitening::Whitening;

/// Free variables of all parameters and the residuals there.
#[derive(Debug, Clone)]
pub(crate) struct Point {
    pub free: DVector<f64>,
    pub residuals: DVector<f64>,
}

/// What is compared with the observations.
pub(crate) struct Likelihood<'a> {
    pub problem: &'a Problem<'a>,
    pub emulator: &'a Emulator,
    pub whitening: Option<Whitening>,
    of_model: Vec<usize>,
}

impl<'a> Likelihood<'a> {
    /// On an emulator, beside the problem's discrepancy if it has one.
    pub fn new(problem: &'a Problem<'a>, emulator: &'a Emulator) -> Self {
        let whitening = |discrepancy| Whitening::new(discrepancy, &problem.sigmas);
        Self {
            problem,
            emulator,
            whitening: problem.discrepancy.as_ref().map(whitening),
            of_model: problem.of_model(),
        }
    }

    /// Shares of the ranges of the model's parameters.
    pub fn place(&self, free: &DVector<f64>) -> DVector<f64> {
        DVector::from_fn(self.of_model.len(), |k, _| share(free[self.of_model[k]]))
    }

    /// The residuals by the emulator.
    pub fn point(&self, free: DVector<f64>) -> Point {
        let predicted = self.emulator.at(&self.place(&free));
        let none = || {
            DVector::from_element(
                self.problem.observations.len() + self.problem.priors(),
                f64::INFINITY,
            )
        };
        let residuals = predicted.map_or_else(none, |predicted| self.residuals(&free, predicted.as_slice()));
        Point { free, residuals }
    }

    /// Residuals of predictions, to which the terms are still to be added.
    pub fn residuals(&self, free: &DVector<f64>, predicted: &[f64]) -> DVector<f64> {
        let problem = self.problem;
        let mut residuals: Vec<f64> = predicted
            .iter()
            .zip(&problem.observations)
            .map(|(p, o)| p - o)
            .collect();
        for (parameter, &z) in problem.parameters.iter().zip(free.iter()) {
            let size = parameter.value(share(z));
            for (residual, entry) in residuals.iter_mut().zip(parameter.column().unwrap_or_default()) {
                *residual += size * entry;
            }
        }
        for (residual, sigma) in residuals.iter_mut().zip(&problem.sigmas) {
            *residual /= sigma;
        }
        for (parameter, &z) in problem.parameters.iter().zip(free.iter()) {
            residuals.extend(parameter.prior_residual(share(z)).map(|[off, _]| off));
        }
        let mut residuals = DVector::from_vec(residuals);
        if let Some(whitening) = &self.whitening {
            whitening.apply(&mut residuals);
        }
        residuals
    }

    /// Derivatives of the residuals by the free variables.
    pub fn jacobian(&self, free: &DVector<f64>) -> DMatrix<f64> {
        let (problem, shares) = (self.problem, free.map(share));
        let (rows, priors) = (problem.observations.len(), problem.priors());
        let slopes = self.emulator.slopes(&self.place(free));
        let mut jacobian = DMatrix::zeros(rows + priors, free.len());
        let (mut of_model, mut prior) = (0, rows);
        for (k, parameter) in problem.parameters.iter().enumerate() {
            let mut column = DVector::zeros(rows + priors);
            if let Some(entries) = parameter.column() {
                let slope = parameter.slope(shares[k]);
                for (row, entry) in entries.iter().enumerate() {
                    column[row] = slope * entry / problem.sigmas[row];
                }
            } else {
                let slope = shares[k] * (1.0 - shares[k]);
                for row in 0..rows {
                    column[row] = slope * slopes[(row, of_model)] / problem.sigmas[row];
                }
                of_model += 1;
            }
            if let Some(whitening) = &self.whitening {
                whitening.apply(&mut column);
            }
            if let Some([_, slope]) = parameter.prior_residual(shares[k]) {
                column[prior] = slope;
                prior += 1;
            }
            jacobian.set_column(k, &column);
        }
        jacobian
    }
}
