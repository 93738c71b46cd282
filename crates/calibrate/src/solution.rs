//! From the runs of a model, or of its emulator, to an optimum and what is known around it.

use nalgebra::DVector;
use statrs::distribution::{ChiSquared, ContinuousCDF};

use crate::descent::Optimum;
use crate::estimate::{Estimate, Interval};
use crate::evaluator::Evaluator;
use crate::interval::{Profile, Witness};
use crate::parameter::FARTHEST;
use crate::point::Point;
use crate::search::{MAX_ROUNDS, Search};
use crate::station::{Profiler, Stop};
use crate::uncertainty::{Covariance, parameters_from_data, quantile};
use crate::{Calibration, CalibrationError, Loss, Parameter, Profiles, Warning};

/// Probability of residuals as large as these under the given sigmas, below which the sigmas are not believed.
const MISFIT: f64 = 0.001;

pub(crate) struct Route {
    /// Free variables to try first.
    pub start: Option<DVector<f64>>,
    /// Points all over the range to try.
    pub scan: usize,
    pub profiles: Profiles,
    /// Points to try for each of the others along a profile, see [`Profiler::scan`].
    pub scan_others: usize,
}

/// An optimum and what is known around it.
pub(crate) struct Solution {
    pub optimum: Optimum,
    pub covariance: Covariance,
    pub estimates: Vec<Estimate>,
    /// A minimum elsewhere that is hardly higher.
    pub rival: Option<Point>,
    /// What the answer rests on.
    pub witnesses: Vec<Witness>,
    /// Whether the noise was estimated from the residuals, and if so, because the sigmas are not believed.
    pub noise_estimated: bool,
    pub misfit: Option<Warning>,
}

impl Solution {
    /// Distance between prediction and run, in standard errors of all readings together.
    pub fn distance(&self, expected: &Point, seen: &Point) -> f64 {
        let off = &expected.residuals - &seen.residuals;
        let weights = self.optimum.deviance.weights(&expected.residuals);
        off.component_mul(&off).dot(&weights).sqrt()
    }

    /// Root of the rise of the deviance from `optimum`.
    pub fn root(&self, point: &Point, optimum: &Point) -> f64 {
        let deviance = &self.optimum.deviance;
        let rise = deviance.total(&point.residuals) - deviance.total(&optimum.residuals);
        rise.max(0.0).sqrt()
    }

    /// How far the optimum would move, in standard errors, if the model everywhere missed the emulator as it does there.
    pub fn shift(&self, seen: &Point) -> f64 {
        let optimum = &self.optimum;
        let off = &seen.residuals - &optimum.point.residuals;
        let curvatures = optimum.deviance.curvatures(&optimum.point.residuals);
        let gradient = optimum.jacobian.tr_mul(&off.component_mul(&curvatures));
        let square = gradient.dot(&(&self.covariance.matrix * &gradient));
        square.max(0.0).sqrt()
    }
}

impl Calibration<'_> {
    /// Searches the optimum and describes it.
    pub(crate) fn solve(
        &self,
        evaluator: &Evaluator<'_>,
        route: &Route,
    ) -> Result<Solution, CalibrationError> {
        let mut search = Search::new(evaluator);
        let scan = search.scan(route.start.clone(), route.scan)?;
        let (mut optimum, rival) = search.best(&scan)?;
        for _ in 0..MAX_ROUNDS {
            let misfit = self.misfit(&optimum);
            if misfit.is_some() {
                // The sigmas are not believed: only their ratios are.
                search.known_noise = false;
                optimum = search.refine(optimum.point.clone(), Some(optimum.jacobian.clone()))?;
            }
            match self.describe(&search, &optimum, rival.as_ref(), route) {
                Ok(solution) => return Ok(Solution { misfit, ..solution }),
                Err(Stop::Better(point)) => {
                    search.known_noise = self.knows_noise;
                    optimum = search.refine(point, None)?;
                }
                Err(Stop::Failed(error)) => return Err(error),
            }
        }
        Err(CalibrationError::NotConverged {
            iterations: optimum.iterations,
            offset: f64::INFINITY,
        })
    }

    /// Whether the residuals are larger than known sigmas allow. A robust loss judges its own spread.
    fn misfit(&self, optimum: &Optimum) -> Option<Warning> {
        if !self.knows_noise || self.options.loss != Loss::Squares {
            return None;
        }
        let residuals = optimum.point.residuals.iter().take(optimum.deviance.data);
        let freedom = self.freedom(optimum);
        let sum: f64 = residuals.map(|r| r * r).sum();
        let probability = 1.0 - ChiSquared::new(freedom).ok()?.cdf(sum);
        // Residuals within the model's own rounding are no misfit.
        (freedom >= 1.0 && probability < MISFIT).then_some(Warning::Misfit {
            reduced_chi_square: sum / freedom,
            probability,
        })
    }

    /// Observations less the parameters that they determine.
    pub(crate) fn freedom(&self, optimum: &Optimum) -> f64 {
        (self.observations.len() as f64 - parameters_from_data(optimum)).max(0.0)
    }

    /// The optimum with estimates and their intervals.
    fn describe(
        &self,
        search: &Search<'_>,
        optimum: &Optimum,
        rival: Option<&Point>,
        route: &Route,
    ) -> Result<Solution, Stop> {
        let covariance = Covariance::of(optimum);
        let noise_estimated = !search.known_noise || self.options.loss.rho().is_robust();
        let tail = 1.0 - self.options.confidence;
        let natural = quantile(0.5 * tail, noise_estimated.then(|| self.freedom(optimum)));
        let profiler = Profiler {
            search,
            optimum,
            covariance: &covariance,
            wanted: natural,
            rival,
            scan: route.scan_others,
        };
        let mut estimates = Vec::new();
        let mut shares = vec![1.0; self.parameters.len()];
        let mut witnesses: Vec<Witness> = rival
            .map(|point| Witness {
                point: point.clone(),
                threshold: natural,
                bound: None,
            })
            .into_iter()
            .collect();
        for (k, parameter) in self.parameters.iter().enumerate() {
            let free = optimum.point.free[k];
            let coordinate = parameter.bounded(free);
            let error = covariance
                .standard_error(k)
                .map(|error| error * parameter.bounded_slope(free));
            let profile = match route.profiles {
                Profiles::All => profiler.profile(k)?,
                Profiles::None => {
                    symmetric(parameter, coordinate, error.map(|error| error * profiler.wanted))
                }
            };
            let value = |coordinate: f64| parameter.value(coordinate);
            let [lower, upper] = profile.ends.map(|end| end.map(value));
            let interval = Interval { lower, upper };
            let by_slopes = error.map(|error| error * parameter.value_slope(coordinate));
            let error = consistent(by_slopes, interval, profiler.wanted);
            if let (Some(by_slopes), Some(error)) = (by_slopes, error) {
                shares[k] = error / by_slopes;
            }
            estimates.push(Estimate {
                name: parameter.name().to_owned(),
                value: value(coordinate),
                standard_error: error,
                interval,
                identifiable: interval.is_closed(),
                profile: profile
                    .curve
                    .iter()
                    .filter(|(_, rise)| rise.is_finite())
                    .map(|&(s, rise)| (value(s), rise))
                    .collect(),
            });
            witnesses.extend(profile.witnesses);
        }
        Ok(Solution {
            optimum: optimum.clone(),
            covariance: covariance.times(&shares),
            estimates,
            rival: rival.cloned(),
            witnesses,
            noise_estimated,
            misfit: None,
        })
    }
}

/// The standard error from the slopes of the model, unless it reaches, `quantile` times, beyond the whole interval to either side: where the
/// model is steepest nowhere near, as at its largest value, only the interval tells how exactly the parameter is known.
fn consistent(error: Option<f64>, interval: Interval, quantile: f64) -> Option<f64> {
    let Interval {
        lower: Some(lower),
        upper: Some(upper),
    } = interval
    else {
        return error;
    };
    let width = upper - lower;
    match error {
        Some(error) if quantile * error <= width => Some(error),
        _ => Some(0.5 * width / quantile),
    }
}

/// The interval of `reach` to either side; open where it would leave the bounds.
fn symmetric(parameter: &Parameter, coordinate: f64, reach: Option<f64>) -> Profile {
    let [lowest, highest] = [-FARTHEST, FARTHEST].map(|free| parameter.bounded(free));
    let inside = |end: &f64| (lowest..=highest).contains(end);
    let end = |sign: f64| reach.map(|reach| coordinate + sign * reach).filter(inside);
    Profile {
        ends: [-1.0, 1.0].map(end),
        ..Profile::default()
    }
}
