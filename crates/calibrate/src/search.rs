//! The way to the optimum: a scan of the emulator, descents from its best places, and the noise's scale.

use nalgebra::DVector;
use statrs::distribution::{ChiSquared, ContinuousCDF};

use crate::covariance::parameters_from_data;
use crate::descent::{Optimum, descend};
use crate::deviance::Deviance;
use crate::likelihood::{Likelihood, Point};
use crate::tuning::{BETTER, FAR, SCALE_TOLERANCE, SCAN, SETTLED, STARTS};
use crate::{Calibration, CalibrationError, Loss, Warning, parameter};

/// Repeats after which a loop is taken to go in a circle. Those that end need a few; thirty where noise and
/// discrepancy explain the same residuals, and one slowly makes room for the other.
const MAX_ROUNDS: usize = 200;
/// Probability of residuals as large as these under the given sigmas, below which the sigmas are not
/// believed.
const MISFIT: f64 = 0.001;

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

/// The optimum on the emulator, and where other descents ended. The `last` one stays, unless another is better
/// by more than a fraction of a standard error. Where the sigmas are not believed, only their ratios are.
pub(crate) fn optimum(
    likelihood: &Likelihood<'_>,
    last: Option<&DVector<f64>>,
) -> Result<(Optimum, Vec<Point>), CalibrationError> {
    let problem = likelihood.problem;
    let (mut best, mut ends): (Option<Optimum>, _) = (None, Vec::new());
    for mut from in last.into_iter().cloned().chain(best_of_scan(likelihood)) {
        if let Some(best) = &best {
            let end = descend(likelihood, best.deviance, from, None)?;
            let is_lower = best.deviance.total(&end.residuals) < best.value() - BETTER;
            from = end.free.clone();
            ends.push(end);
            if !is_lower {
                continue;
            }
        }
        if let Ok(found) = refine(likelihood, from, problem.knows_noise) {
            ends.extend(best.replace(found).map(|worse| worse.point));
        }
    }
    let mut best = best.ok_or(CalibrationError::NotConverged)?;
    if misfit(problem, &best).is_some() {
        best = refine(likelihood, best.point.free, false)?;
    }
    if let Some(last) = last.map(|last| likelihood.point(last.clone()))
        && best.deviance.total(&last.residuals) - best.value() < settled(problem, &best)
    {
        best = Optimum::at(likelihood, last, best.deviance);
    }
    Ok((best, ends))
}

/// Gain of the deviance from which on an optimum moves: of the ripple between runs, the parameters follow
/// their share, up to a small part of a standard error.
pub(crate) fn settled(problem: &Calibration<'_>, optimum: &Optimum) -> f64 {
    let share = problem.asked as f64 / problem.observations.len() as f64;
    (share * noise(problem, optimum)).clamp(SETTLED * SETTLED, FAR * FAR)
}

/// Variance of the model's own noise, in squared standard errors of all readings together.
pub(crate) fn noise(problem: &Calibration<'_>, optimum: &Optimum) -> f64 {
    let weights = optimum.deviance.weights(&optimum.point.residuals);
    let squares = problem.model_noise().zip(&weights);
    squares.map(|(noise, weight)| weight * noise * noise).sum()
}

/// Places of the emulator all over the range at which noise with heavy tails, of a scale that is estimated
/// from the residuals, has the largest likelihood; terms are in the middle of their ranges.
fn best_of_scan(likelihood: &Likelihood<'_>) -> impl Iterator<Item = DVector<f64>> {
    let (problem, dimensions) = (likelihood.problem, likelihood.of_model.len());
    let data = problem.observations.len();
    let mut scanned = Vec::new();
    for place in all_over(dimensions, SCAN * (1 + dimensions)) {
        let mut free = DVector::zeros(problem.parameters.len());
        for (&k, &share) in likelihood.of_model.iter().zip(&place) {
            free[k] = parameter::free(share);
        }
        let point = likelihood.point(free);
        let sum: f64 = point.residuals.iter().take(data).map(|r| r.abs()).sum();
        let priors: f64 = point.residuals.iter().skip(data).map(|r| r * r).sum();
        let score = 2.0 * data as f64 * sum.max(f64::MIN_POSITIVE).ln() + priors;
        if score.is_finite() {
            scanned.push((score, point.free));
        }
    }
    scanned.sort_by(|a, b| a.0.total_cmp(&b.0));
    scanned.into_iter().map(|(_, free)| free).take(STARTS)
}

/// Descends, adapting the scale of the noise.
fn refine(
    likelihood: &Likelihood<'_>,
    mut start: DVector<f64>,
    known_noise: bool,
) -> Result<Optimum, CalibrationError> {
    let problem = likelihood.problem;
    let data = problem.observations.len();
    let least = problem.model_noise().fold(f64::MIN_POSITIVE, f64::max);
    let freedom = (data as f64 - problem.asked as f64).max(1.0);
    let residuals = likelihood.point(start.clone()).residuals;
    let first = Deviance::new(problem.loss, data);
    let mut deviance = first.scaled(&residuals, known_noise, freedom, least);
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

/// Observations less the parameters that they determine.
pub(crate) fn freedom(problem: &Calibration<'_>, optimum: &Optimum) -> f64 {
    (problem.observations.len() as f64 - parameters_from_data(optimum)).max(0.0)
}

/// Whether the residuals are larger than known sigmas allow. A robust loss judges its own spread.
pub(crate) fn misfit(problem: &Calibration<'_>, optimum: &Optimum) -> Option<Warning> {
    if !problem.knows_noise || problem.loss != Loss::Squares {
        return None;
    }
    let residuals = optimum.point.residuals.iter().take(optimum.deviance.data);
    let freedom = freedom(problem, optimum);
    let sum: f64 = residuals.map(|r| r * r).sum();
    let probability = 1.0 - ChiSquared::new(freedom).ok()?.cdf(sum);
    (freedom >= 1.0 && probability < MISFIT).then_some(Warning::Misfit {
        reduced_chi_square: sum / freedom,
        probability,
    })
}
