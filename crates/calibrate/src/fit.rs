//! What a calibration answers.

use nalgebra::{DMatrix, DVector};

use crate::parameter::FARTHEST;
use crate::search::{freedom, misfit};
use crate::solution::Solution;
use crate::{Calibration, Emulator, Estimate, Warning};

/// A calibrated model.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Fit {
    /// The parameters, in the order in which they were given.
    pub estimates: Vec<Estimate>,
    /// Correlation of the parameters by the curvature at the optimum; `None` if one of them has no
    /// standard error.
    pub correlation: Vec<Vec<Option<f64>>>,
    /// Predictions of the calibrated model.
    pub fitted: Vec<f64>,
    /// Observation less prediction.
    pub residuals: Vec<f64>,
    /// What of each residual is most likely the discrepancy; 0 without one.
    pub smooth: Vec<f64>,
    /// How much each observation counts: 1 with least squares, less for an outlier in a robust fit.
    pub weights: Vec<f64>,
    /// Standard deviation of the noise: in the observations' unit if it was estimated, else in units of the
    /// given sigmas.
    pub noise: f64,
    /// Observations less the parameters that they determine (a prior determines its share).
    pub degrees_of_freedom: f64,
    /// Whether the noise was estimated, so that intervals rest on Student's t.
    pub noise_estimated: bool,
    /// Model runs.
    pub evaluations: usize,
    /// What the user should know.
    pub warnings: Vec<Warning>,
    /// What was learned of the model.
    pub emulator: Emulator,
    /// Derivatives of the observations' standardised residuals by the free variables at the optimum.
    pub(crate) jacobian: DMatrix<f64>,
    /// Half the second derivative of the deviance by each of these residuals.
    pub(crate) curvatures: DVector<f64>,
    /// Covariance of the free variables.
    pub(crate) covariance: DMatrix<f64>,
    sigmas: DVector<f64>,
}

impl Fit {
    /// The answer of a solution at whose optimum the model ran.
    pub(crate) fn new(
        problem: &Calibration<'_>,
        emulator: Emulator,
        solution: Solution,
        estimates: Vec<Estimate>,
    ) -> Self {
        let (optimum, count) = (&solution.optimum, problem.observations.len());
        let deviance = optimum.deviance;
        let observed = DVector::from_column_slice(&problem.observations);
        let sigmas = DVector::from_column_slice(&problem.sigmas);
        let standardised = optimum.point.residuals.rows(0, count).into_owned();
        let mut smooth = DVector::zeros(count);
        let pairs = problem.parameters.iter().zip(&optimum.point.free);
        for (parameter, &z) in pairs.skip(problem.asked) {
            let column = DVector::from_column_slice(parameter.column().unwrap_or_default());
            smooth += column * parameter.value(z);
        }
        let residuals = &smooth - standardised.component_mul(&sigmas);
        let weight = |r: &f64| deviance.loss.weight(r / deviance.spread);
        let curvatures = deviance.curvatures(&optimum.point.residuals);
        let covariance = &solution.covariance;
        let correlations = |i| (0..problem.asked).map(|j| covariance.correlation(i, j)).collect();
        Self {
            warnings: warnings(problem, &solution, &estimates),
            correlation: (0..problem.asked).map(correlations).collect(),
            fitted: (&observed - &residuals).data.into(),
            residuals: residuals.data.into(),
            smooth: smooth.data.into(),
            weights: standardised.iter().map(weight).collect(),
            noise: if solution.noise_estimated {
                deviance.noise()
            } else {
                1.0
            },
            degrees_of_freedom: freedom(problem, optimum),
            noise_estimated: solution.noise_estimated,
            evaluations: emulator.evaluations(),
            emulator,
            jacobian: optimum.jacobian.rows(0, count).into_owned(),
            curvatures: curvatures.rows(0, count).into_owned(),
            covariance: solution.covariance.matrix,
            estimates,
            sigmas,
        }
    }

    /// The best values, in the order of the parameters.
    pub fn values(&self) -> Vec<f64> {
        self.estimates.iter().map(|estimate| estimate.value).collect()
    }

    /// The estimate of the parameter called `name`.
    pub fn estimate(&self, name: &str) -> Option<&Estimate> {
        self.estimates.iter().find(|estimate| estimate.name == name)
    }

    /// Residuals without their smooth part, the discrepancy, in units of their sigmas.
    pub fn standardised_noise(&self) -> Vec<f64> {
        let parts = self.residuals.iter().zip(&self.smooth).zip(&self.sigmas);
        let noise = parts.map(|((residual, smooth), sigma)| (residual - smooth) / sigma);
        noise.collect()
    }

    /// What an error of the model by which it predicts `change` more, in the observations' unit, does to the
    /// parameters, to first order: by how many standard errors each estimate would move (0 for what has
    /// none), and how many standard errors of all readings together no move of them would make good.
    pub fn shift(&self, change: &[f64]) -> (Vec<f64>, f64) {
        let entry = |row: usize| change.get(row).map_or(0.0, |value| value / self.sigmas[row]);
        let change = DVector::from_fn(self.sigmas.len(), |row, _| entry(row));
        let weighted = change.component_mul(&self.curvatures);
        let across = self.jacobian.tr_mul(&weighted);
        let moved = -(&self.covariance * &across);
        let shift = |k: usize| {
            let error = self.covariance[(k, k)].sqrt();
            if error > 0.0 { moved[k] / error } else { 0.0 }
        };
        let left = change.dot(&weighted) + across.dot(&moved);
        let shifts = (0..self.estimates.len()).map(shift);
        (shifts.collect(), left.max(0.0).sqrt())
    }
}

/// What is to be said of a solution.
fn warnings(problem: &Calibration<'_>, solution: &Solution, estimates: &[Estimate]) -> Vec<Warning> {
    let mut warnings: Vec<Warning> = misfit(problem, &solution.optimum).into_iter().collect();
    for (estimate, free) in estimates.iter().zip(&solution.optimum.point.free) {
        let (name, interval, value) = (estimate.name.clone(), estimate.interval, estimate.value);
        if !estimate.identifiable && problem.has_profiles {
            warnings.push(Warning::NotIdentifiable { name, interval });
        } else if free.abs() >= FARTHEST {
            warnings.push(Warning::AtBound { name, value });
        }
    }
    // An interval that is open says more than another minimum does.
    let closed = estimates.iter().all(|estimate| estimate.identifiable);
    warnings.extend(solution.rival().filter(|_| closed).map(|rival| {
        let pairs = problem.parameters.iter().take(problem.asked).zip(rival);
        Warning::Ambiguous(pairs.map(|(parameter, &z)| parameter.value(z)).collect())
    }));
    warnings
}
