//! What a calibration answers.

use nalgebra::{DMatrix, DVector};

use crate::learning::Learner;
use crate::parameter::{FARTHEST, share};
use crate::problem::Problem;
use crate::solution::{Solution, freedom};
use crate::whitening::Whitening;
use crate::{Emulator, Estimate, Warning};

/// Correlation from which two parameters count as hardly distinguishable.
const CORRELATED: f64 = 0.99;
/// Weight below which an observation counts as an outlier: of Tukey's loss at three sigmas.
const OUTLIER: f64 = 0.35;
/// Degrees of freedom below which the noise is hardly known: its own standard error is a third.
const FEW: f64 = 5.0;

/// A calibrated model.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Fit {
    /// The parameters, in the order in which they were given.
    pub estimates: Vec<Estimate>,
    /// Correlation of the parameters by the curvature at the optimum; `None` where one of them has no
    /// standard error.
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
    /// Standard deviation of the noise: in the observations' unit if it was estimated, else in units of the
    /// given sigmas.
    pub noise: f64,
    /// Observations less the parameters that they determine (a prior determines its share).
    pub degrees_of_freedom: f64,
    /// Whether the noise was estimated, so that intervals rest on Student's t.
    pub noise_estimated: bool,
    /// Model runs.
    pub evaluations: usize,
    /// Size of the discrepancy as it was given, where the calibration has one.
    pub discrepancy: Option<f64>,
    /// What of each residual is most likely the discrepancy; 0 without one.
    pub smooth: Vec<f64>,
    /// What the user should know.
    pub warnings: Vec<Warning>,
    /// What was learned of the model.
    pub emulator: Emulator,
    /// Derivatives of the standardised residuals by the free variables at the optimum.
    pub(crate) jacobian: DMatrix<f64>,
    /// Half the second derivative of the deviance by each of them.
    pub(crate) curvatures: Vec<f64>,
    sigmas: Vec<f64>,
    whitening: Option<Whitening>,
    /// Covariance of the free variables.
    pub(crate) covariance: DMatrix<f64>,
}

impl Fit {
    /// The answer of a solution at whose optimum the model ran.
    pub(crate) fn new(learner: Learner<'_>, solution: Solution, whitening: Option<Whitening>) -> Self {
        let (problem, optimum) = (learner.problem, &solution.optimum);
        let (observed, deviance) = (&problem.observations, optimum.deviance);
        let standardised = optimum.point.residuals.rows(0, observed.len()).into_owned();
        let mut plain = standardised.clone();
        let mut smooth = DVector::zeros(observed.len());
        if let Some(whitening) = &whitening {
            whitening.undo(&mut plain);
            smooth = whitening.smooth(&plain);
        }
        let in_units = |values: &DVector<f64>| -> Vec<f64> {
            values
                .iter()
                .zip(&problem.sigmas)
                .map(|(r, sigma)| -r * sigma)
                .collect()
        };
        let residuals = in_units(&plain);
        let count = observed.len() as f64;
        let square: f64 = residuals.iter().map(|r| r * r).sum();
        let mean = observed.iter().sum::<f64>() / count;
        let variation: f64 = observed.iter().map(|y| (y - mean).powi(2)).sum();
        let weight = |r: &f64| deviance.loss.weight(r / deviance.spread);
        let weights: Vec<f64> = standardised.iter().map(weight).collect();
        let curvatures = deviance.curvatures(&optimum.point.residuals);
        let degrees_of_freedom = freedom(problem, optimum);
        let all = 0..problem.parameters.len();
        let correlations = |i| {
            all.clone()
                .map(|j| solution.covariance.correlation(i, j))
                .collect()
        };
        Self {
            warnings: warnings(problem, &solution, &weights, degrees_of_freedom),
            correlation: all.clone().map(correlations).collect(),
            fitted: observed.iter().zip(&residuals).map(|(y, r)| y - r).collect(),
            residual_rms: (square / count).sqrt(),
            r_squared: (variation > 0.0).then(|| 1.0 - square / variation),
            residuals,
            weights,
            noise: if solution.noise_estimated {
                deviance.noise()
            } else {
                1.0
            },
            degrees_of_freedom,
            noise_estimated: solution.noise_estimated,
            evaluations: learner.evaluations,
            discrepancy: problem.discrepancy.as_ref().map(|discrepancy| discrepancy.size),
            smooth: in_units(&smooth),
            whitening,
            curvatures: curvatures.iter().take(observed.len()).copied().collect(),
            sigmas: problem.sigmas.clone(),
            estimates: solution.estimates,
            jacobian: solution.optimum.jacobian,
            covariance: solution.covariance.matrix,
            emulator: learner.emulator,
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

    /// Residuals in units of their sigmas.
    pub fn standardised_residuals(&self) -> Vec<f64> {
        let pairs = self.residuals.iter().zip(&self.sigmas);
        pairs.map(|(residual, sigma)| residual / sigma).collect()
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

    /// By how many standard errors each estimate would move, to first order, if the model predicted
    /// `change` more, in the observations' unit: what an error of the model does to the parameters. 0
    /// for what has no standard error.
    pub fn shift(&self, change: &[f64]) -> Vec<f64> {
        let curvatures = DVector::from_column_slice(&self.curvatures);
        let weighted = self.standardised(change).component_mul(&curvatures);
        let gradient = self.jacobian.rows(0, weighted.len()).tr_mul(&weighted);
        let moved = -(&self.covariance * gradient);
        let errors = self.covariance.diagonal().map(f64::sqrt);
        let shift = moved.iter().zip(errors.iter());
        shift
            .map(|(moved, &error)| if error > 0.0 { moved / error } else { 0.0 })
            .collect()
    }
}

/// What is to be said of a solution with these weights of the observations.
fn warnings(
    problem: &Problem<'_>,
    solution: &Solution,
    weights: &[f64],
    degrees_of_freedom: f64,
) -> Vec<Warning> {
    let mut warnings: Vec<Warning> = solution.misfit.iter().cloned().collect();
    // An interval that is open says more than another minimum does.
    let closed = solution.estimates.iter().all(|estimate| estimate.identifiable);
    let rival = solution.rival.as_ref().filter(|_| closed);
    warnings.extend(rival.map(|rival| {
        let pairs = problem.parameters.iter().zip(rival.free.iter());
        Warning::Ambiguous(pairs.map(|(parameter, &z)| parameter.value(share(z))).collect())
    }));
    for (k, estimate) in solution.estimates.iter().enumerate() {
        let name = || estimate.name.clone();
        if !estimate.identifiable {
            let interval = estimate.interval;
            warnings.push(Warning::NotIdentifiable {
                name: name(),
                interval,
            });
        } else if solution.optimum.point.free[k].abs() >= FARTHEST {
            let value = estimate.value;
            warnings.push(Warning::AtBound { name: name(), value });
        }
        for (index, other) in solution.estimates.iter().take(k).enumerate() {
            let correlation = solution.covariance.correlation(k, index);
            if let Some(correlation) = correlation.filter(|c| c.abs() > CORRELATED) {
                let first = other.name.clone();
                warnings.push(Warning::Correlated {
                    first,
                    second: name(),
                    correlation,
                });
            }
        }
    }
    let indices: Vec<usize> = (0..weights.len()).filter(|&i| weights[i] < OUTLIER).collect();
    if !indices.is_empty() {
        warnings.push(Warning::Outliers(indices));
    }
    if solution.noise_estimated && degrees_of_freedom < FEW {
        warnings.push(Warning::FewObservations(degrees_of_freedom));
    }
    warnings
}
