//! Model runs: residuals and their derivatives by the free variables.
//!
//! The residuals are (prediction − observation)/σ, whitened where the model has a discrepancy, followed by those of the priors. Where the model has no answer they are
//! infinite, and the optimiser stays away. Derivatives are central differences. Their step is at least the cube root of the
//! model's relative noise, which balances rounding against curvature, and so long that the noise stays small beside the change.

use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

use crate::parameter::of_model;
use crate::point::Point;
use crate::{Calibration, CalibrationError, Model, ModelError};

/// Smallest and largest step of a derivative, in the free variable: rounding spoils shorter ones, curvature longer ones.
const STEPS: (f64, f64) = (1e-4, 0.5);
/// Added to the diagonal of the terms' normal equations, as a share.
const HELD_BACK: f64 = 1e-9;
/// Change of the residuals over a step, in their noise.
const CHANGE_TO_NOISE: f64 = 5.0;

/// The model, what it is compared with, and how often it has run.
pub(crate) struct Evaluator<'a> {
    pub calibration: &'a Calibration<'a>,
    /// The calibration's own, or an emulator of it.
    model: &'a dyn Model,
    relative_noise: f64,
    limit: usize,
    count: AtomicUsize,
    failure: Mutex<Option<ModelError>>,
}

impl<'a> Evaluator<'a> {
    pub fn new(calibration: &'a Calibration<'a>) -> Self {
        Self {
            calibration,
            model: calibration.model,
            relative_noise: calibration.options.relative_noise,
            limit: calibration.options.max_evaluations,
            count: AtomicUsize::new(0),
            failure: Mutex::new(None),
        }
    }

    /// The same for an emulator of the model: smooth, and free to run.
    pub fn emulated(calibration: &'a Calibration<'a>, emulator: &'a dyn Model) -> Self {
        Self {
            model: emulator,
            relative_noise: 0.0,
            limit: usize::MAX,
            ..Self::new(calibration)
        }
    }

    /// Model runs so far.
    pub fn count(&self) -> usize {
        self.count.load(Ordering::Relaxed)
    }

    /// Standardised residuals; all infinite where the model has no answer.
    pub fn residuals(&self, free: &DVector<f64>) -> Result<DVector<f64>, CalibrationError> {
        let predicted = self.predict(free)?;
        Ok(predicted.map_or_else(
            || self.no_answer(),
            |predicted| self.standardised(free, &predicted),
        ))
    }

    fn no_answer(&self) -> DVector<f64> {
        let count = self.calibration.observations.len() + self.calibration.priors();
        DVector::from_element(count, f64::INFINITY)
    }

    /// Runs the model; nothing where it has no answer. Terms are not in it yet.
    pub fn predict(&self, free: &DVector<f64>) -> Result<Option<Vec<f64>>, CalibrationError> {
        if self.count.fetch_add(1, Ordering::Relaxed) >= self.limit {
            return Err(CalibrationError::EvaluationLimit { limit: self.limit });
        }
        let predicted = match self.model.predict(&of_model(&self.calibration.parameters, free)) {
            Ok(predicted) => predicted,
            Err(error) => {
                self.remember(error);
                return Ok(None);
            }
        };
        let (found, expected) = (predicted.len(), self.calibration.observations.len());
        if found != expected {
            return Err(CalibrationError::PredictionLength { expected, found });
        }
        if let Some(index) = predicted.iter().position(|value| !value.is_finite()) {
            self.remember(Box::new(NotFinite { index }));
            return Ok(None);
        }
        Ok(Some(predicted))
    }

    /// Residuals of predictions with their terms, in sigmas, and of the priors.
    pub fn standardised(&self, free: &DVector<f64>, predicted: &[f64]) -> DVector<f64> {
        let parameters = self.calibration.parameters.iter().zip(free.iter());
        let terms: Vec<(f64, &[f64])> = parameters
            .filter_map(|(parameter, &z)| Some((parameter.physical(z), parameter.column()?)))
            .collect();
        let added = |row: usize| terms.iter().map(|(size, column)| size * column[row]).sum::<f64>();
        let data = predicted
            .iter()
            .zip(self.data())
            .enumerate()
            .map(|(row, (predicted, (observed, sigma)))| (predicted + added(row) - observed) / sigma);
        let parameters = self.calibration.parameters.iter().zip(free.iter());
        let priors = parameters.filter_map(|(parameter, &z)| parameter.prior_residual(z));
        let mut residuals = DVector::from_vec(data.chain(priors).collect());
        if let Some(whitening) = &self.calibration.whitening {
            whitening.apply(&mut residuals);
        }
        residuals
    }

    /// The observations with their sigmas.
    fn data(&self) -> impl Iterator<Item = (&f64, &f64)> {
        let calibration = self.calibration;
        calibration.observations.iter().zip(&calibration.sigmas)
    }

    /// The residuals at many places, in parallel.
    pub fn points(&self, places: Vec<DVector<f64>>) -> Result<Vec<Point>, CalibrationError> {
        let point = |free| {
            let residuals = self.residuals(&free)?;
            Ok(Point { free, residuals })
        };
        places.into_par_iter().map(point).collect()
    }

    /// As [`points`](Self::points), with the terms that fit best at each place by least squares; `held` stays where it is.
    pub fn points_with_terms(
        &self,
        places: Vec<DVector<f64>>,
        held: Option<usize>,
    ) -> Result<Vec<Point>, CalibrationError> {
        let parameters = &self.calibration.parameters;
        let is_free = |&k: &usize| parameters[k].column().is_some() && Some(k) != held;
        let terms: Vec<usize> = (0..parameters.len()).filter(is_free).collect();
        let point = |free| match self.predict(&free)? {
            Some(predicted) => Ok(self.fitted_terms(free, &predicted, &terms)),
            None => Ok(Point {
                residuals: self.no_answer(),
                free,
            }),
        };
        places.into_par_iter().map(point).collect()
    }

    /// The place with these `terms` as they fit best, a little held back so that columns which are nearly one have an answer.
    pub fn fitted_terms(&self, mut free: DVector<f64>, predicted: &[f64], terms: &[usize]) -> Point {
        if terms.is_empty() {
            return Point {
                residuals: self.standardised(&free, predicted),
                free,
            };
        }
        let parameters = &self.calibration.parameters;
        let rows = self.calibration.observations.len();
        let mut columns = DMatrix::from_fn(rows, terms.len(), |row, k| {
            parameters[terms[k]].column().map_or(0.0, |column| column[row]) / self.calibration.sigmas[row]
        });
        if let Some(whitening) = &self.calibration.whitening {
            whitening.apply_to_columns(&mut columns);
        }
        let left = self.standardised(&free, predicted);
        let mut square = columns.tr_mul(&columns);
        for k in 0..terms.len() {
            square[(k, k)] *= 1.0 + HELD_BACK;
        }
        if let Some(change) = square
            .cholesky()
            .map(|solved| solved.solve(&columns.tr_mul(&left.rows(0, rows))))
        {
            for (&k, change) in terms.iter().zip(change.iter()) {
                let value = parameters[k].physical(free[k]) - change;
                let inside = value.clamp(parameters[k].lower(), parameters[k].upper());
                free[k] = parameters[k].free(parameters[k].coordinate(inside));
            }
        }
        Point {
            residuals: self.standardised(&free, predicted),
            free,
        }
    }

    /// Steps of derivatives, or a `share` of them; where derivatives `near` here are known, so long that the model's noise stays small beside
    /// the change.
    pub fn steps(&self, weights: &DVector<f64>, near: Option<&DMatrix<f64>>, share: f64) -> Vec<f64> {
        let least = self.relative_noise.cbrt().clamp(STEPS.0, STEPS.1);
        let noise = CHANGE_TO_NOISE * self.noise(weights);
        let slope = |near: &DMatrix<f64>, k: usize| {
            let column = near.column(k);
            column.component_mul(&column).dot(weights).sqrt()
        };
        (0..self.calibration.parameters.len())
            .map(|k| match near.map(|near| slope(near, k)) {
                Some(slope) if slope > 0.0 => (noise / slope).clamp(least, STEPS.1),
                Some(_) => STEPS.1,
                None => least,
            })
            .map(|step| (share * step).max(STEPS.0))
            .collect()
    }

    /// Length of the model's own noise in the weighted residuals.
    pub fn noise(&self, weights: &DVector<f64>) -> f64 {
        let square = |((value, sigma), weight)| weight * f64::powi(self.relative_noise * value / sigma, 2);
        self.data().zip(weights.iter()).map(square).sum::<f64>().sqrt()
    }

    /// Derivatives of the residuals by the free variables over `steps`; the column of one that is `held` is 0.
    pub fn jacobian(
        &self,
        free: &DVector<f64>,
        steps: &[f64],
        held: Option<usize>,
    ) -> Result<DMatrix<f64>, CalibrationError> {
        let (terms, moving): (Vec<usize>, Vec<usize>) = (0..free.len())
            .filter(|&k| Some(k) != held)
            .partition(|&k| self.calibration.parameters[k].column().is_some());
        let places = moving
            .iter()
            .flat_map(|&k| [(k, steps[k]), (k, -steps[k])])
            .map(|(k, step)| {
                let mut point = free.clone();
                point[k] += step;
                point
            })
            .collect();
        let residuals: Vec<DVector<f64>> = self
            .points(places)?
            .into_iter()
            .map(|point| point.residuals)
            .collect();
        let mut middle = None;
        let rows = self.calibration.observations.len() + self.calibration.priors();
        let mut jacobian = DMatrix::zeros(rows, free.len());
        for (pair, &k) in residuals.chunks_exact(2).zip(&moving) {
            let column = match (feasible(&pair[0]), feasible(&pair[1])) {
                (true, true) => (&pair[0] - &pair[1]) / (2.0 * steps[k]),
                (false, false) => {
                    let parameter = &self.calibration.parameters[k];
                    return Err(CalibrationError::NoDerivative {
                        name: parameter.name().to_owned(),
                        value: parameter.physical(free[k]),
                        source: self.last_failure(),
                    });
                }
                (ahead, _) => {
                    let here = match &middle {
                        Some(here) => here,
                        None => middle.insert(self.residuals(free)?),
                    };
                    if ahead {
                        (&pair[0] - here) / steps[k]
                    } else {
                        (here - &pair[1]) / steps[k]
                    }
                }
            };
            jacobian.set_column(k, &column);
        }
        // Terms take no run: whatever the model predicts, they add the same.
        let nothing = vec![0.0; self.calibration.observations.len()];
        for k in terms {
            let [ahead, behind] = [STEPS.0, -STEPS.0].map(|step| {
                let mut point = free.clone();
                point[k] += step;
                self.standardised(&point, &nothing)
            });
            jacobian.set_column(k, &((ahead - behind) / (2.0 * STEPS.0)));
        }
        Ok(jacobian)
    }

    /// Why the model failed last.
    pub fn last_failure(&self) -> ModelError {
        self.failure
            .lock()
            .ok()
            .and_then(|mut failure| failure.take())
            .unwrap_or_else(|| Box::new(Unknown))
    }

    fn remember(&self, error: ModelError) {
        if let Ok(mut failure) = self.failure.lock() {
            *failure = Some(error);
        }
    }
}

/// Whether the model had an answer.
pub(crate) fn feasible(residuals: &DVector<f64>) -> bool {
    residuals.iter().all(|residual| residual.is_finite())
}

#[derive(Debug, thiserror::Error)]
#[error("prediction {index} is not a finite number")]
struct NotFinite {
    index: usize,
}

#[derive(Debug, thiserror::Error)]
#[error("it gave no reason")]
struct Unknown;
