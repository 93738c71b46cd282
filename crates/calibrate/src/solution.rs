//! An optimum on the emulator, and what is known around it.

use nalgebra::DVector;
use statrs::distribution::{ChiSquared, ContinuousCDF};

use crate::covariance::{Covariance, parameters_from_data, quantile};
use crate::descent::{Optimum, descend};
use crate::estimate::{Estimate, Interval};
use crate::likelihood::{Likelihood, Point};
use crate::parameter::share;
use crate::problem::Problem;
use crate::profile::{EXCLUSION, Profile, ProfilePoint, Profiler};
use crate::search::{self, MAX_ROUNDS};
use crate::tuning::BETTER;
use crate::{CalibrationError, Loss, Parameter, Profiles, Scale, Warning};

/// Probability of residuals as large as these under the given sigmas, below which the sigmas are not
/// believed.
const MISFIT: f64 = 0.001;

/// A place on which the answer rests.
pub(crate) struct CheckPoint {
    pub point: Point,
    /// Root of the rise of the deviance, and the one with which the answer compares it.
    pub root: f64,
    pub threshold: f64,
    /// Whether it is an end of an interval, not a bound.
    pub is_end: bool,
}

pub(crate) struct Solution {
    pub optimum: Optimum,
    pub covariance: Covariance,
    pub estimates: Vec<Estimate>,
    /// Ends of intervals and the bounds that they leave out.
    pub checks: Vec<CheckPoint>,
    /// All places of the profiles, each beside the root of its rise.
    pub scan: Vec<(DVector<f64>, f64)>,
    /// A minimum elsewhere that fits about as well.
    pub rival: Option<Point>,
    /// Whether the noise was estimated from the residuals, and if so, because the sigmas are not believed.
    pub noise_estimated: bool,
    pub misfit: Option<Warning>,
}

impl Solution {
    /// How far the optimum would move, in standard errors, if the model everywhere missed the emulator
    /// as it does there.
    pub fn shift(&self, seen: &DVector<f64>) -> f64 {
        let optimum = &self.optimum;
        let off = seen - &optimum.point.residuals;
        let curvatures = optimum.deviance.curvatures(&optimum.point.residuals);
        let gradient = optimum.jacobian.tr_mul(&off.component_mul(&curvatures));
        gradient
            .dot(&(&self.covariance.matrix * &gradient))
            .max(0.0)
            .sqrt()
    }
}

/// Searches the optimum on a likelihood, from `start` too, and describes it.
///
/// # Errors
///
/// [`CalibrationError::NotConverged`].
pub(crate) fn solve(
    likelihood: &mut Likelihood<'_>,
    start: Option<DVector<f64>>,
    kind: Profiles,
) -> Result<Solution, CalibrationError> {
    let problem = likelihood.problem;
    let (mut optimum, others) = search::optimum(likelihood, start, problem.knows_noise)?;
    for _ in 0..MAX_ROUNDS {
        let misfit = misfit(problem, &optimum);
        if misfit.is_some() {
            // The sigmas are not believed: only their ratios are.
            optimum = search::refine(likelihood, optimum.point.free, false)?;
        }
        let noise_estimated = !problem.knows_noise || misfit.is_some() || problem.options.loss.is_robust();
        let tail = 0.5 * (1.0 - problem.options.confidence);
        let profiler = Profiler {
            likelihood,
            wanted: quantile(tail, noise_estimated.then(|| freedom(problem, &optimum))),
            optimum: &optimum,
            covariance: &Covariance::of(&optimum),
            others: &others,
        };
        let wanted = if kind == Profiles::All {
            problem.parameters.len()
        } else {
            0
        };
        let profiles = profiler.profiles(wanted)?;
        let points = profiles.iter().flat_map(|profile| &profile.points);
        let lowest = points.min_by(|a, b| a.rise.total_cmp(&b.rise));
        if let Some(lower) = lowest.filter(|lowest| lowest.rise < -BETTER) {
            let free = lower.point.free.clone();
            optimum = search::refine(likelihood, free, problem.knows_noise)?;
        } else {
            return Ok(Solution {
                noise_estimated,
                misfit,
                ..describe(&profiler, &profiles)?
            });
        }
    }
    Err(CalibrationError::NotConverged)
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

/// The optimum with estimates and their intervals; without profiles, these are symmetric.
fn describe(profiler: &Profiler<'_>, profiles: &[Profile]) -> Result<Solution, CalibrationError> {
    let (optimum, wanted) = (profiler.optimum, profiler.wanted);
    let covariance = profiler.covariance.clone();
    let (mut estimates, mut shares) = (Vec::new(), Vec::new());
    for (k, parameter) in profiler.likelihood.problem.parameters.iter().enumerate() {
        let error = covariance.standard_error(k);
        let estimate = estimate(parameter, optimum.point.free[k], error, profiles.get(k), wanted);
        let by_slopes = error.map(|error| error * parameter.slope(share(optimum.point.free[k])));
        let ratio = by_slopes
            .filter(|error| *error > 0.0)
            .zip(estimate.standard_error);
        shares.push(ratio.map_or(1.0, |(by_slopes, error)| error / by_slopes));
        estimates.push(estimate);
    }
    let check = |point: &ProfilePoint, is_end: bool| CheckPoint {
        point: point.point.clone(),
        root: point.root(),
        threshold: if is_end { wanted } else { EXCLUSION * wanted },
        is_end,
    };
    let mut checks = Vec::new();
    for profile in profiles {
        checks.extend(profile.at_ends.iter().map(|point| check(point, true)));
        let bounds = profile.points.first().into_iter().chain(profile.points.last());
        checks.extend(bounds.map(|point| check(point, false)));
    }
    let points = profiles.iter().flat_map(|profile| &profile.points);
    Ok(Solution {
        optimum: optimum.clone(),
        covariance: covariance.times(&shares),
        estimates,
        checks,
        scan: points
            .map(|point| (point.point.free.clone(), point.root()))
            .collect(),
        rival: rival(profiler, profiles)?,
        noise_estimated: false,
        misfit: None,
    })
}

/// The estimate of one parameter at its free variable, where it has this standard error.
fn estimate(
    parameter: &Parameter,
    free: f64,
    error: Option<f64>,
    profile: Option<&Profile>,
    wanted: f64,
) -> Estimate {
    let value = |free: f64| parameter.value(share(free));
    let best = value(free);
    let error = error.map(|error| error * parameter.slope(share(free)));
    let ends = match profile {
        Some(profile) => profile.ends.map(|end| end.map(value)),
        None => [-1.0, 1.0].map(|sign| {
            let reach = sign * wanted * error?;
            let end = match parameter.scale() {
                Scale::Linear => best + reach,
                Scale::Logarithmic => best * (reach / best).exp(),
            };
            (parameter.lower() < end && end < parameter.upper()).then_some(end)
        }),
    };
    let interval = Interval {
        lower: ends[0],
        upper: ends[1],
    };
    Estimate {
        name: parameter.name().to_owned(),
        value: best,
        standard_error: consistent(error, interval, wanted),
        interval,
        identifiable: interval.is_closed(),
        profile: profile.map_or_else(Vec::new, |profile| {
            profile.curve().map(|(free, rise)| (value(free), rise)).collect()
        }),
    }
}

/// The standard error from the slopes of the model, unless it reaches, `quantile` times, beyond the whole
/// interval to either side: where the model is steepest nowhere near, as at its largest value, only the
/// interval tells how exactly the parameter is known.
fn consistent(error: Option<f64>, interval: Interval, quantile: f64) -> Option<f64> {
    let Some(width) = interval
        .upper
        .zip(interval.lower)
        .map(|(upper, lower)| upper - lower)
    else {
        return error;
    };
    Some(
        error
            .filter(|error| quantile * error <= width)
            .unwrap_or(0.5 * width / quantile),
    )
}

/// The best fit beyond a barrier that an interval does not hold, but where a parameter fits about as well.
fn rival(profiler: &Profiler<'_>, profiles: &[Profile]) -> Result<Option<Point>, CalibrationError> {
    let beyond = profiles
        .iter()
        .flat_map(|profile| profile.beyond_barrier(profiler.wanted));
    let Some(lowest) = beyond.min_by(|a, b| a.rise.total_cmp(&b.rise)) else {
        return Ok(None);
    };
    let (likelihood, optimum) = (profiler.likelihood, profiler.optimum);
    let point = descend(likelihood, optimum.deviance, lowest.point.free.clone(), None)?;
    Ok(Some(point))
}
