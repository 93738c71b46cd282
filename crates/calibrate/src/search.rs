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

/// The optimum on the emulator, and where other descents ended; `start` is tried before the best places
/// of a scan.
///
/// # Errors
///
/// [`CalibrationError::NotConverged`] where no descent comes to an end.
pub(crate) fn optimum(
    likelihood: &mut Likelihood<'_>,
    start: Option<DVector<f64>>,
    known_noise: bool,
) -> Result<(Optimum, Vec<Point>), CalibrationError> {
    let (data, count) = (
        likelihood.problem.observations.len(),
        likelihood.problem.parameters.len(),
    );
    let places = all_over(count, SCAN * (1 + count));
    let mut points: Vec<(f64, Point)> = places
        .into_iter()
        .map(|place| likelihood.point(place.map(parameter::free)))
        .map(|point| (score(&point.residuals, data, known_noise), point))
        .filter(|(score, _)| score.is_finite())
        .collect();
    points.sort_by(|a, b| a.0.total_cmp(&b.0));
    let scanned = points.into_iter().map(|(_, point)| point.free);
    let starts = start.into_iter().chain(scanned.take(STARTS));
    let mut best: Result<Optimum, CalibrationError> = Err(CalibrationError::NotConverged);
    let mut others = Vec::new();
    for start in starts {
        best = match best {
            Err(_) => refine(likelihood, start, known_noise),
            Ok(best) => {
                let other = descend(likelihood, best.deviance, start, None)?;
                others.push(other.clone());
                if best.deviance.total(&other.residuals) < best.value() - BETTER {
                    others.push(best.point.clone());
                    refine(likelihood, other.free, known_noise).or(Ok(best))
                } else {
                    Ok(best)
                }
            }
        };
    }
    Ok((best?, others))
}

/// Descends, adapting the scale of the noise: of the residuals beside a discrepancy without its smooth part
/// e, σ² = eᵀe/(n − p − Σ λ²s²/(1 + λ²s²)), whose last term counts the smooth functions that it has taken
/// from them (W. H. Fellner, "Robust estimation of variance components", Technometrics 28, 1986).
///
/// # Errors
///
/// As for [`optimum`].
pub(crate) fn refine(
    likelihood: &mut Likelihood<'_>,
    mut start: DVector<f64>,
    known_noise: bool,
) -> Result<Optimum, CalibrationError> {
    let problem = likelihood.problem;
    let (data, least) = (problem.observations.len(), problem.least_noise());
    let first = Deviance {
        loss: problem.options.loss,
        data,
        spread: 1.0,
        normalisation: 1.0,
    };
    let residuals = likelihood.point(start.clone()).residuals;
    let freedom = (data as f64 - problem.parameters.len() as f64).max(1.0);
    let mut deviance = first.scaled(&residuals, known_noise, freedom, least);
    for round in 0..MAX_ROUNDS {
        let point = descend(likelihood, deviance, start, None)?;
        let jacobian = likelihood.jacobian(&point.free);
        let mut found = Optimum {
            point,
            jacobian,
            deviance,
        };
        let freedom = data as f64 - parameters_from_data(&found);
        let residuals = &found.point.residuals;
        let change = |new: f64, old: f64| (new / old).ln().abs();
        let mut whitened = 0.0;
        if let Some(whitening) = likelihood.whitening.as_mut().filter(|_| !known_noise) {
            let mut plain = residuals.clone();
            whitening.undo(&mut plain);
            let data = plain.rows(0, data).into_owned();
            let square = (&data - whitening.smooth(&data)).norm_squared();
            let taken = whitening.freedom();
            whitening.set_noise((square / (freedom - taken).max(1.0)).sqrt().max(least));
            whitened = (whitening.freedom() - taken).abs();
        }
        let mut next = deviance.scaled(residuals, known_noise, freedom.max(0.5), least);
        let moved = change(next.spread, deviance.spread);
        // κ jumps as a residual crosses the loss's threshold, and only weighs data against priors.
        let weighed = change(next.normalisation, deviance.normalisation);
        if moved < SCALE_TOLERANCE && weighed < 10.0 * SCALE_TOLERANCE && whitened < 0.1 {
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
