//! The way to the optimum: a scan of the emulator, descents from its best places, and the noise's scale.

use nalgebra::DVector;

use crate::covariance::parameters_from_data;
use crate::descent::{Optimum, descend};
use crate::deviance::Deviance;
use crate::likelihood::{Likelihood, Point};
use crate::tuning::{BETTER, SCALE_TOLERANCE, SCAN, STARTS};
use crate::{CalibrationError, parameter};

/// Repeats after which a loop is taken to go in a circle: those that end need half as many.
pub(crate) const MAX_ROUNDS: usize = 24;

/// `count` places all over the range, as shares of it, by the generalised golden ratio (M. Roberts, "The
/// unreasonable effectiveness of quasirandom sequences", 2018).
pub(crate) fn all_over(dimensions: usize, count: usize) -> Vec<DVector<f64>> {
    let mut ratio = 2.0_f64;
    for _ in 0..60 {
        ratio = (1.0 + ratio).powf(1.0 / (dimensions as f64 + 1.0));
    }
    let share = |index: usize, k: usize| (0.5 + (index + 1) as f64 * ratio.powi(-(k as i32) - 1)).fract();
    let place = |index| DVector::from_fn(dimensions, |k, _| share(index, k).clamp(0.005, 0.995));
    (0..count).map(place).collect()
}

/// −2 log likelihood under noise with heavy tails, whose scale is known or estimated from these residuals.
fn score(residuals: &DVector<f64>, data: usize, known_noise: bool) -> f64 {
    let sum: f64 = residuals.iter().take(data).map(|r| r.abs()).sum();
    let priors: f64 = residuals.iter().skip(data).map(|r| r * r).sum();
    if known_noise {
        2.0 * sum + priors
    } else {
        2.0 * data as f64 * sum.max(f64::MIN_POSITIVE).ln() + priors
    }
}

/// The optimum on the emulator, and where other descents ended; `start` is tried before the best places of
/// a scan.
///
/// # Errors
///
/// [`CalibrationError::NotConverged`] if no descent comes to an end.
pub(crate) fn optimum(
    likelihood: &Likelihood<'_>,
    start: Option<&DVector<f64>>,
) -> Result<(Optimum, Vec<Point>), CalibrationError> {
    let (problem, known) = (likelihood.problem, likelihood.problem.knows_noise);
    let dimensions = likelihood.of_model.len();
    let mut scanned = Vec::new();
    for place in all_over(dimensions, SCAN * (1 + dimensions)) {
        // Terms from the middle of their ranges.
        let mut free = DVector::zeros(problem.parameters.len());
        for (&k, &share) in likelihood.of_model.iter().zip(&place) {
            free[k] = parameter::free(share);
        }
        let point = likelihood.point(free);
        let score = score(&point.residuals, problem.observations.len(), known);
        if score.is_finite() {
            scanned.push((score, point.free));
        }
    }
    scanned.sort_by(|a, b| a.0.total_cmp(&b.0));
    let best_of_scan = scanned.into_iter().map(|(_, free)| free).take(STARTS);
    let mut best: Option<Optimum> = None;
    let mut others = Vec::new();
    for from in start.into_iter().cloned().chain(best_of_scan) {
        let lower = match &best {
            None => Some(from),
            Some(best) => {
                let other = descend(likelihood, best.deviance, from, None)?;
                let is_lower = best.deviance.total(&other.residuals) < best.value() - BETTER;
                others.push(if is_lower {
                    best.point.clone()
                } else {
                    other.clone()
                });
                is_lower.then_some(other.free)
            }
        };
        let found = lower.and_then(|from| refine(likelihood, from, known).ok());
        best = found.or(best);
    }
    Ok((best.ok_or(CalibrationError::NotConverged)?, others))
}

/// Descends, adapting the scale of the noise.
///
/// # Errors
///
/// As for [`optimum`].
pub(crate) fn refine(
    likelihood: &Likelihood<'_>,
    mut start: DVector<f64>,
    known_noise: bool,
) -> Result<Optimum, CalibrationError> {
    let problem = likelihood.problem;
    let data = problem.observations.len();
    let least = problem.model_noise().fold(f64::MIN_POSITIVE, f64::max);
    let mut deviance = Deviance {
        loss: problem.options.loss,
        data,
        spread: 1.0,
        normalisation: 1.0,
    };
    let freedom = (data as f64 - problem.asked as f64).max(1.0);
    let residuals = likelihood.point(start.clone()).residuals;
    deviance = deviance.scaled(&residuals, known_noise, freedom, least);
    for round in 0..MAX_ROUNDS {
        let point = descend(likelihood, deviance, start, None)?;
        let mut found = Optimum::at(likelihood, point, deviance);
        let freedom = (data as f64 - parameters_from_data(&found)).max(0.5);
        let mut next = deviance.scaled(&found.point.residuals, known_noise, freedom, least);
        if (next.noise() / deviance.noise()).ln().abs() < SCALE_TOLERANCE {
            found.deviance = next;
            return Ok(found);
        }
        if round > 1 {
            // Half of a change, so that the rounds cannot go in a circle.
            next.spread = (next.spread * deviance.spread).sqrt();
        }
        (deviance, start) = (next, found.point.free);
    }
    Err(CalibrationError::NotConverged)
}
