//! An optimum on the emulator, and what is known around it.

use nalgebra::DVector;

use crate::covariance::{Covariance, quantile};
use crate::descent::Optimum;
use crate::estimate::{Estimate, Interval};
use crate::likelihood::{Likelihood, Point};
use crate::profile::{EXCLUSION, Profile, ProfilePoint, Profiler};
use crate::search::{freedom, misfit, noise, settled};
use crate::tuning::{BETTER, HIDDEN, HIGH, SURE};
use crate::{Calibration, CalibrationError, Parameter};

/// Probability that an interval leaves out the true value on a side.
const TAIL: f64 = 0.025;

pub(crate) struct Solution {
    pub optimum: Optimum,
    pub covariance: Covariance,
    /// Of the parameters that are asked for, if profiles are.
    pub profiles: Vec<Profile>,
    /// Whether the noise is estimated from the residuals.
    pub noise_estimated: bool,
    /// Root of the rise at which an interval ends.
    wanted: f64,
}

impl Solution {
    /// What is known around an optimum, where descents ended at `others` too.
    pub fn around(
        likelihood: &Likelihood<'_>,
        optimum: Optimum,
        others: &[Point],
    ) -> Result<Self, CalibrationError> {
        let problem = likelihood.problem;
        let is_robust = problem.loss.is_robust();
        let noise_estimated = !problem.knows_noise || is_robust || misfit(problem, &optimum).is_some();
        let covariance = Covariance::of(&optimum);
        let wanted = quantile(TAIL, noise_estimated.then(|| freedom(problem, &optimum)));
        let profiler = Profiler {
            likelihood,
            optimum: &optimum,
            covariance: &covariance,
            others,
            wanted,
        };
        let count = Some(problem.asked).filter(|_| problem.has_profiles);
        let profiles = profiler.profiles(count.unwrap_or(0))?;
        Ok(Self {
            optimum,
            covariance,
            profiles,
            noise_estimated,
            wanted,
        })
    }

    /// A place of a profile that is a better optimum.
    pub fn lower(&self, problem: &Calibration<'_>) -> Option<&DVector<f64>> {
        let points = self.profiles.iter().flat_map(|profile| &profile.points);
        let lowest = points.min_by(|a, b| a.rise.total_cmp(&b.rise))?;
        let is_lower = lowest.rise < -settled(problem, &self.optimum).max(BETTER);
        is_lower.then_some(&lowest.free)
    }

    /// Places on which it rests, each with the standard error of all readings together up to which the emulator
    /// is believed there: the ends of the intervals, the bounds that they leave out, and all low places.
    pub fn supports(&self, likelihood: &Likelihood<'_>) -> Vec<(DVector<f64>, f64)> {
        // Of the model's own noise nothing can be learned far out.
        let hidden = HIDDEN.max(noise(likelihood.problem, &self.optimum).sqrt());
        let support = |point: &ProfilePoint, least: f64, threshold: f64| {
            let allowed = least.max(0.25 * (point.root() - threshold).abs());
            (likelihood.place(&point.free), allowed)
        };
        let mut supports = Vec::new();
        for Profile { points, at_ends, .. } in &self.profiles {
            supports.extend(at_ends.iter().map(|point| support(point, SURE, self.wanted)));
            let bounds = points.first().into_iter().chain(points.last());
            supports.extend(bounds.map(|point| support(point, SURE, EXCLUSION * self.wanted)));
            // A coarser model has shown where the others lie.
            if likelihood.emulator.coarse_optimum.is_none() {
                let low = points.iter().filter(|point| point.root() < HIGH);
                supports.extend(low.map(|point| support(point, hidden, self.wanted)));
            }
        }
        supports
    }

    /// The lowest place that an interval holds beyond some that fit worse, where a parameter fits about as
    /// well.
    pub fn rival(&self) -> Option<&DVector<f64>> {
        let mut rivals = Vec::new();
        for (k, profile) in self.profiles.iter().enumerate() {
            let is_below = |point: &ProfilePoint| point.free[k] < self.optimum.point.free[k];
            let inside = |point: &&ProfilePoint| point.root() < self.wanted;
            let (below, above) = profile.points.split_at(profile.points.partition_point(is_below));
            rivals.extend(below.iter().rev().skip_while(inside).filter(inside));
            rivals.extend(above.iter().skip_while(inside).filter(inside));
        }
        let lowest = rivals.into_iter().min_by(|a, b| a.rise.total_cmp(&b.rise));
        lowest.map(|lowest| &lowest.free)
    }

    /// Of all parameters that are asked for.
    pub fn estimates(&self, problem: &Calibration<'_>) -> Vec<Estimate> {
        let asked = problem.parameters.iter().take(problem.asked).enumerate();
        asked.map(|(k, parameter)| self.estimate(k, parameter)).collect()
    }

    fn estimate(&self, k: usize, parameter: &Parameter) -> Estimate {
        let (free, profile) = (self.optimum.point.free[k], self.profiles.get(k));
        let ends = profile.map_or([None; 2], |profile| profile.ends);
        let [lower, upper] = ends.map(|end| end.map(|free| parameter.value(free)));
        let interval = Interval { lower, upper };
        // Where the model is steepest nowhere near, as at its largest value, only the interval tells how
        // exactly the parameter is known.
        let width = lower.zip(upper).map(|(lower, upper)| upper - lower);
        let half = width.map(|width| 0.5 * width / self.wanted);
        let error = self.covariance.standard_error(k);
        let by_slopes = error.map(|error| error * parameter.slope(free));
        let by_slopes = by_slopes.filter(|error| half.is_none_or(|half| *error <= 2.0 * half));
        let points = profile
            .iter()
            .flat_map(|profile| profile.points.iter().chain(&profile.at_ends));
        let finite = points.filter(|point| point.rise.is_finite());
        let curve = finite.map(|point| (parameter.value(point.free[k]), point.rise));
        let mut curve: Vec<(f64, f64)> = curve.collect();
        curve.sort_by(|a, b| a.0.total_cmp(&b.0));
        Estimate {
            name: parameter.name().to_owned(),
            value: parameter.value(free),
            standard_error: by_slopes.or(half),
            interval,
            identifiable: interval.is_closed(),
            profile: curve,
        }
    }
}
