//! An optimum on the emulator, and what is known around it.

use nalgebra::DVector;
use statrs::distribution::{ChiSquared, ContinuousCDF};

use crate::covariance::{Covariance, parameters_from_data, quantile};
use crate::descent::Optimum;
use crate::estimate::{Estimate, Interval};
use crate::likelihood::{Likelihood, Point};
use crate::problem::Problem;
use crate::profile::{EXCLUSION, Profile, ProfilePoint, Profiler};
use crate::search::{self, MAX_ROUNDS};
use crate::tuning::{BETTER, FAR, HIDDEN, HIGH, NEAR, SETTLED, SURE};
use crate::{CalibrationError, Loss, Parameter, Scale, Warning};

/// Probability of residuals as large as these under the given sigmas, below which the sigmas are not
/// believed.
const MISFIT: f64 = 0.001;

pub(crate) struct Solution {
    pub optimum: Optimum,
    pub covariance: Covariance,
    pub estimates: Vec<Estimate>,
    /// Whether the intervals are those that were asked for.
    pub is_complete: bool,
    /// Places on which it rests, and the standard error of all readings together up to which the emulator
    /// is believed there.
    pub supports: Vec<(DVector<f64>, f64)>,
    /// A minimum elsewhere that fits about as well.
    pub rival: Option<Point>,
    /// Whether the noise was estimated from the residuals, and if so, because the sigmas are not believed.
    pub noise_estimated: bool,
    pub misfit: Option<Warning>,
}

/// Searches the optimum on a likelihood and describes it: with profiles, if they are asked for, once it lies
/// near the start, which is the optimum if no other is better by more than a fraction of a standard error.
///
/// # Errors
///
/// [`CalibrationError::NotConverged`].
pub(crate) fn solve(
    likelihood: &Likelihood<'_>,
    start: Option<&DVector<f64>>,
) -> Result<Solution, CalibrationError> {
    let problem = likelihood.problem;
    let (mut optimum, others) = search::optimum(likelihood, start)?;
    let last = start.map(|start| likelihood.point(start.clone()));
    for _ in 0..MAX_ROUNDS {
        let misfit = misfit(problem, &optimum);
        if misfit.is_some() {
            // The sigmas are not believed: only their ratios are.
            optimum = search::refine(likelihood, optimum.point.free, false)?;
        }
        let value = |point: &Point| optimum.deviance.total(&point.residuals);
        let gain = last
            .as_ref()
            .map_or(f64::INFINITY, |last| value(last) - optimum.value());
        // Of the ripple between runs, the parameters follow their share.
        let share = (problem.asked as f64 / problem.observations.len() as f64).sqrt();
        let least = SETTLED.max(FAR.min(share * noise(problem, &optimum))).powi(2);
        if let Some(last) = last.clone().filter(|_| gain < least) {
            optimum = Optimum::at(likelihood, last, optimum.deviance);
        }
        let is_near = gain < NEAR || problem.coarse.is_some();
        let is_profiled = problem.options.profiles && is_near;
        let noise_estimated = !problem.knows_noise || misfit.is_some() || problem.options.loss.is_robust();
        let tail = 0.5 * (1.0 - problem.options.confidence);
        let covariance = Covariance::of(&optimum);
        let profiler = Profiler {
            likelihood,
            wanted: quantile(tail, noise_estimated.then(|| freedom(problem, &optimum))),
            optimum: &optimum,
            covariance: &covariance,
            others: &others,
        };
        let profiles = profiler.profiles(if is_profiled { problem.asked } else { 0 })?;
        let points = profiles.iter().flat_map(|profile| &profile.points);
        let lowest = points.min_by(|a, b| a.rise.total_cmp(&b.rise));
        if let Some(lower) = lowest.filter(|lowest| lowest.rise < -least.max(BETTER)) {
            optimum = search::refine(likelihood, lower.point.free.clone(), problem.knows_noise)?;
            continue;
        }
        return Ok(Solution {
            estimates: estimates(&profiler, &profiles),
            is_complete: is_profiled || !problem.options.profiles,
            supports: supports(&profiler, &profiles),
            rival: rival(&profiler, &profiles),
            noise_estimated,
            misfit,
            covariance,
            optimum,
        });
    }
    Err(CalibrationError::NotConverged)
}

/// The model's own noise, in standard errors of all readings together.
fn noise(problem: &Problem<'_>, optimum: &Optimum) -> f64 {
    let weights = optimum.deviance.weights(&optimum.point.residuals);
    let squares = problem.model_noise().zip(&weights);
    let squares = squares.map(|(noise, weight)| weight * noise * noise);
    squares.sum::<f64>().sqrt()
}

/// Whether the residuals are larger than known sigmas allow. A robust loss judges its own spread.
fn misfit(problem: &Problem<'_>, optimum: &Optimum) -> Option<Warning> {
    if !problem.knows_noise || problem.options.loss != Loss::Squares {
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

/// Observations less the parameters that they determine.
pub(crate) fn freedom(problem: &Problem<'_>, optimum: &Optimum) -> f64 {
    (problem.observations.len() as f64 - parameters_from_data(optimum)).max(0.0)
}

/// All parameters that are asked for; without profiles, their intervals are symmetric.
fn estimates(profiler: &Profiler<'_>, profiles: &[Profile]) -> Vec<Estimate> {
    let (problem, wanted) = (profiler.likelihood.problem, profiler.wanted);
    let one = |(k, parameter): (usize, &Parameter)| {
        let free = profiler.optimum.point.free[k];
        let (best, profile) = (parameter.value(free), profiles.get(k));
        let error = profiler.covariance.standard_error(k);
        let error = error.map(|error| error * parameter.slope(free));
        let symmetric = |sign: f64| {
            let reach = sign * wanted * error?;
            let end = match parameter.scale {
                Scale::Linear => best + reach,
                Scale::Logarithmic => best * (reach / best).exp(),
            };
            (parameter.lower < end && end < parameter.upper).then_some(end)
        };
        let [lower, upper] = match profile {
            Some(profile) => profile.ends.map(|end| end.map(|free| parameter.value(free))),
            None => [-1.0, 1.0].map(symmetric),
        };
        // Where the model is steepest nowhere near, as at its largest value, only the interval tells how
        // exactly the parameter is known.
        let half = lower
            .zip(upper)
            .map(|(lower, upper)| 0.5 * (upper - lower) / wanted);
        let by_slopes = error.filter(|error| half.is_none_or(|half| *error <= 2.0 * half));
        let curve = profile.map_or_else(Vec::new, Profile::curve);
        let interval = Interval { lower, upper };
        Estimate {
            name: parameter.name().to_owned(),
            value: best,
            standard_error: by_slopes.or(half),
            interval,
            identifiable: interval.is_closed(),
            profile: curve
                .into_iter()
                .map(|(free, rise)| (parameter.value(free), rise))
                .collect(),
        }
    };
    problem.parameters[..problem.asked]
        .iter()
        .enumerate()
        .map(one)
        .collect()
}

/// The ends of the intervals, the bounds that they leave out, and all low places: there the emulator may err
/// by a part of what would make another answer.
fn supports(profiler: &Profiler<'_>, profiles: &[Profile]) -> Vec<(DVector<f64>, f64)> {
    let Profiler {
        likelihood,
        optimum,
        wanted,
        ..
    } = *profiler;
    // Of the model's own noise nothing can be learned far out.
    let hidden = HIDDEN.max(noise(likelihood.problem, optimum));
    let support = |point: &ProfilePoint, least: f64, threshold: f64| {
        let allowed = least.max(0.25 * (point.root() - threshold).abs());
        (likelihood.place(&point.point.free), allowed)
    };
    let mut supports = Vec::new();
    for profile in profiles {
        supports.extend(profile.at_ends.iter().map(|point| support(point, SURE, wanted)));
        let bounds = [profile.points.first(), profile.points.last()]
            .into_iter()
            .flatten();
        supports.extend(bounds.map(|point| support(point, SURE, EXCLUSION * wanted)));
        if likelihood.problem.coarse.is_none() {
            let low = profile.points.iter().filter(|point| point.root() < HIGH);
            supports.extend(low.map(|point| support(point, hidden, wanted)));
        }
    }
    supports
}

/// The lowest place beyond a barrier that an interval does not hold, but where a parameter fits about as well.
fn rival(profiler: &Profiler<'_>, profiles: &[Profile]) -> Option<Point> {
    let free = &profiler.optimum.point.free;
    let beyond = profiles.iter().zip(free);
    let beyond = beyond.flat_map(|(profile, &here)| profile.beyond_barrier(here, profiler.wanted));
    let lowest = beyond.min_by(|a, b| a.rise.total_cmp(&b.rise));
    lowest.map(|lowest| lowest.point.clone())
}
