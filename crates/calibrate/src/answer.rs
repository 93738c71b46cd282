//! A fit that runs the model itself, and what the user reads of any: residuals, statistics, warnings.

use nalgebra::DVector;

use crate::evaluator::Evaluator;
use crate::fit::Fit;
use crate::interval::EXCLUSION;
use crate::parameter::{FARTHEST, physical};
use crate::search::ROUGH;
use crate::solution::{Route, Solution};
use crate::{Calibration, CalibrationError, Warning};

/// Correlation from which two parameters count as hardly distinguishable.
const CORRELATED: f64 = 0.99;
/// Weight below which an observation counts as an outlier: of Tukey's loss at three sigmas.
const OUTLIER: f64 = 0.35;
/// Degrees of freedom below which the noise is hardly known: its own standard error is a third.
const FEW: f64 = 5.0;

impl Calibration<'_> {
    /// Fits, running the model wherever the search asks for it.
    ///
    /// # Errors
    ///
    /// [`CalibrationError`] where there are too few observations, the model has no answer anywhere, the fit does not converge or needs
    /// more model runs than allowed.
    pub fn fit(&self) -> Result<Fit, CalibrationError> {
        self.check_count()?;
        let fit = |one: &Self, _| Ok((one.fit_directly(&Evaluator::new(one), one.start())?, ()));
        Ok(self.beside_discrepancy(fit)?.0)
    }

    /// The fit by `evaluator`, which may have run before, from `start` and all over the range.
    pub(crate) fn fit_directly(
        &self,
        evaluator: &Evaluator<'_>,
        start: Option<DVector<f64>>,
    ) -> Result<Fit, CalibrationError> {
        let route = Route {
            scan: self.scan(),
            start,
            profiles: self.options.profiles,
            scan_others: 0,
        };
        let solution = self.solve(evaluator, &route)?;
        Ok(self.answer(evaluator, solution))
    }

    pub(crate) fn answer(&self, evaluator: &Evaluator<'_>, solution: Solution) -> Fit {
        let deviance = solution.optimum.deviance;
        let standardised = &solution.optimum.point.residuals;
        let observed = &self.observations;
        let mut plain = standardised.clone();
        let mut smooth = vec![0.0; observed.len()];
        if let Some(whitening) = &self.whitening {
            whitening.undo(&mut plain);
            let parts = whitening.smooth(&plain.rows(0, observed.len()).into_owned());
            smooth = parts
                .iter()
                .zip(&self.sigmas)
                .map(|(part, sigma)| -part * sigma)
                .collect();
        }
        let residuals: Vec<f64> = plain
            .iter()
            .zip(&self.sigmas)
            .map(|(r, sigma)| -r * sigma)
            .collect();
        let square: f64 = residuals.iter().map(|r| r * r).sum();
        let mean = observed.iter().sum::<f64>() / observed.len() as f64;
        let variation: f64 = observed.iter().map(|y| (y - mean).powi(2)).sum();
        let loss = self.options.loss.rho();
        let weights: Vec<f64> = standardised
            .iter()
            .take(observed.len())
            .map(|r| loss.weight(r / deviance.spread))
            .collect();
        let curvatures = deviance.curvatures(standardised);
        let degrees_of_freedom = self.freedom(&solution.optimum);
        let parameters = 0..self.parameters.len();
        Fit {
            warnings: self.warnings(&solution, &weights, degrees_of_freedom),
            correlation: parameters
                .clone()
                .map(|i| {
                    let correlation = |j| solution.covariance.correlation(i, j);
                    parameters.clone().map(correlation).collect()
                })
                .collect(),
            fitted: observed.iter().zip(&residuals).map(|(y, r)| y - r).collect(),
            residual_rms: (square / observed.len() as f64).sqrt(),
            r_squared: (variation > 0.0).then(|| 1.0 - square / variation),
            residuals,
            weights,
            noise: if solution.noise_estimated {
                deviance.noise(standardised)
            } else {
                1.0
            },
            degrees_of_freedom,
            noise_estimated: solution.noise_estimated,
            deviance: solution.optimum.value(),
            evaluations: evaluator.count(),
            iterations: solution.optimum.iterations,
            discrepancy: self.discrepancy.as_ref().map(|discrepancy| discrepancy.size),
            smooth,
            whitening: self.whitening.clone(),
            curvatures: curvatures.iter().take(observed.len()).copied().collect(),
            sigmas: self.sigmas.clone(),
            estimates: solution.estimates,
            free: solution.optimum.point.free,
            jacobian: solution.optimum.jacobian,
            covariance: solution.covariance.matrix,
        }
    }

    fn warnings(&self, solution: &Solution, weights: &[f64], degrees_of_freedom: f64) -> Vec<Warning> {
        let mut warnings: Vec<Warning> = solution.misfit.iter().cloned().collect();
        warnings.extend(self.ambiguity(solution));
        for (k, estimate) in solution.estimates.iter().enumerate() {
            if !estimate.identifiable {
                warnings.push(Warning::NotIdentifiable {
                    name: estimate.name.clone(),
                    interval: estimate.interval,
                });
            } else if solution.optimum.point.free[k].abs() >= FARTHEST {
                warnings.push(Warning::AtBound {
                    name: estimate.name.clone(),
                    value: estimate.value,
                });
            }
            for (index, other) in solution.estimates.iter().take(k).enumerate() {
                let correlation = solution.covariance.correlation(k, index);
                if let Some(correlation) = correlation.filter(|c| c.abs() > CORRELATED) {
                    warnings.push(Warning::Correlated {
                        first: other.name.clone(),
                        second: estimate.name.clone(),
                        correlation,
                    });
                }
            }
        }
        let indices: Vec<usize> = (0..weights.len()).filter(|&i| weights[i] < OUTLIER).collect();
        if !indices.is_empty() {
            warnings.push(Warning::Outliers { indices });
        }
        let offset = solution.optimum.offset;
        if offset > ROUGH {
            warnings.push(Warning::Rough { offset });
        }
        if solution.noise_estimated && degrees_of_freedom < FEW {
            warnings.push(Warning::FewObservations { degrees_of_freedom });
        }
        warnings
    }

    /// A rival that is no part of the optimum's own surroundings, which are twice what excludes a bound, where the intervals are all closed: one that is open says more.
    fn ambiguity(&self, solution: &Solution) -> Option<Warning> {
        let rival = solution.rival.as_ref()?;
        let own = |k: usize| {
            let reach = 2.0 * EXCLUSION * solution.covariance.standard_error(k).unwrap_or(f64::INFINITY);
            (rival.free[k] - solution.optimum.point.free[k]).abs() <= reach
        };
        let closed = solution.estimates.iter().all(|estimate| estimate.identifiable);
        (closed && !(0..rival.free.len()).all(own)).then(|| Warning::Ambiguous {
            values: physical(&self.parameters, &rival.free),
        })
    }
}
