//! Intervals from the profile likelihood.
//!
//! A parameter is held at each value of a grid, all others are fitted anew, and the rise of the deviance
//! above its minimum is compared with the square of Student's t (of Gauss's z where the noise is known),
//! which is the likelihood-ratio test. Such an interval needs no symmetry and may stay open on a side
//! (D. M. Bates, D. G. Watts, Nonlinear Regression Analysis and Its Applications, 1988, section 6.1; A.
//! Raue et al., Bioinformatics 25, 2009).
//!
//! An end is closed only if the data exclude what lies beyond it, up to the bound, by twice the distance
//! that makes an interval: by four standard errors. For a true value at the bound itself, one such distance
//! would close one of forty intervals by chance.

use nalgebra::DVector;

use crate::CalibrationError;
use crate::covariance::Covariance;
use crate::descent::{Optimum, descend};
use crate::likelihood::{Likelihood, Point};
use crate::parameter::FARTHEST;
use crate::tuning::{ACCURACY, BETTER, GRID, JUMP};

/// Distance at which the bound is excluded, in those that make an interval.
pub(crate) const EXCLUSION: f64 = 2.0;
/// Halvings of a step of the grid after which an end is as exact as numbers are.
const HALVINGS: usize = 40;

/// A point of a profile: one parameter held, all others fitted.
#[derive(Debug, Clone)]
pub(crate) struct ProfilePoint {
    pub point: Point,
    /// The deviance there above that of the optimum; negative where the optimum is none.
    pub rise: f64,
}

impl ProfilePoint {
    /// Root of the rise.
    pub fn root(&self) -> f64 {
        self.rise.max(0.0).sqrt()
    }
}

/// The profile of one parameter.
#[derive(Clone)]
pub(crate) struct Profile {
    parameter: usize,
    /// Index of the optimum.
    middle: usize,
    /// In the order of the parameter.
    pub points: Vec<ProfilePoint>,
    /// Free variables at the lower and the upper end; `None` where the likelihood does not close.
    pub ends: [Option<f64>; 2],
    /// The points next to those ends.
    pub at_ends: Vec<ProfilePoint>,
}

impl Profile {
    /// Free variables and the rise at them, ascending, as far as the model has an answer.
    pub fn curve(&self) -> impl Iterator<Item = (f64, f64)> {
        let k = self.parameter;
        let mut points: Vec<&ProfilePoint> = self.points.iter().chain(&self.at_ends).collect();
        points.sort_by(|a, b| a.point.free[k].total_cmp(&b.point.free[k]));
        let finite = points.into_iter().filter(|point| point.rise.is_finite());
        finite.map(move |point| (point.point.free[k], point.rise))
    }

    /// Whether a point lies below both values between which it lies.
    fn lies_above(&self, point: &ProfilePoint) -> bool {
        let k = self.parameter;
        let next = self
            .points
            .partition_point(|other| other.point.free[k] < point.point.free[k]);
        let around = [next.checked_sub(1), Some(next)];
        let mut around = around
            .into_iter()
            .flatten()
            .filter_map(|index| self.points.get(index));
        around.all(|other| point.rise < other.rise - BETTER)
    }

    /// Points within reach of the optimum, beyond some that are not.
    pub fn beyond_barrier(&self, wanted: f64) -> impl Iterator<Item = &ProfilePoint> {
        let inside = move |point: &&ProfilePoint| point.root() < wanted;
        let (below, above) = self.points.split_at(self.middle);
        let below = below.iter().rev().skip_while(inside).filter(inside);
        below.chain(above.iter().skip_while(inside).filter(inside))
    }
}

/// Profiles parameters around an optimum.
pub(crate) struct Profiler<'a> {
    pub likelihood: &'a Likelihood<'a>,
    pub optimum: &'a Optimum,
    pub covariance: &'a Covariance,
    /// Where descents from elsewhere ended.
    pub others: &'a [Point],
    /// Root of the rise at which an interval ends.
    pub wanted: f64,
}

impl Profiler<'_> {
    /// The profiles of the first `count` parameters. What one of them finds is true for all: where a
    /// point of another, or a minimum elsewhere, lies below a profile, the others are in a wrong valley
    /// there.
    pub fn profiles(&self, count: usize) -> Result<Vec<Profile>, CalibrationError> {
        let first = (0..count)
            .map(|k| self.profile(k, &[]))
            .collect::<Result<Vec<_>, _>>()?;
        let minima: Vec<ProfilePoint> = self.others.iter().cloned().map(|point| self.at(point)).collect();
        let again = |profile: &Profile| {
            let foreign = first.iter().filter(|other| other.parameter != profile.parameter);
            let within = foreign.flat_map(|other| &other.points).chain(&minima);
            let within = within.filter(|point| point.root() < EXCLUSION * self.wanted);
            let below: Vec<&ProfilePoint> = within.filter(|point| profile.lies_above(point)).collect();
            if below.is_empty() {
                return Ok(profile.clone());
            }
            self.profile(profile.parameter, &below)
        };
        first.iter().map(again).collect()
    }

    /// The profile of parameter `k`, from the optimum to both bounds, and from there and from `known`
    /// points back.
    fn profile(&self, k: usize, known: &[&ProfilePoint]) -> Result<Profile, CalibrationError> {
        let here = self.optimum.point.free[k];
        let mut points = vec![ProfilePoint {
            point: self.optimum.point.clone(),
            rise: 0.0,
        }];
        for bound in [-FARTHEST, FARTHEST] {
            for z in self.values(k, here, bound) {
                points.push(self.fit_others(k, z, &points[points.len() - 1])?);
            }
            points.reverse();
        }
        points.extend(known.iter().map(|&point| point.clone()));
        points.sort_by(|a, b| a.point.free[k].total_cmp(&b.point.free[k]));
        for index in (0..points.len() - 1).rev() {
            points[index] = self.lower(k, &points[index], &points[index + 1])?;
        }
        for index in 1..points.len() {
            points[index] = self.lower(k, &points[index], &points[index - 1])?;
        }
        let mut profile = Profile {
            parameter: k,
            middle: points
                .iter()
                .take_while(|point| point.point.free[k] < here)
                .count(),
            points,
            ends: [None; 2],
            at_ends: Vec::new(),
        };
        for upper in [false, true] {
            if let Some((end, near)) = self.end(k, &profile.points, upper)? {
                profile.ends[usize::from(upper)] = Some(end);
                profile.at_ends.push(near);
            }
        }
        Ok(profile)
    }

    /// Half of the values of parameter `k` but its estimate: to a bound, at distances that grow by one
    /// factor from half a standard error on.
    fn values(&self, k: usize, here: f64, bound: f64) -> Vec<f64> {
        let (count, farthest) = (GRID / 2, bound - here);
        let error = self.covariance.standard_error(k).unwrap_or(f64::INFINITY);
        let first = (0.5 * error / farthest.abs()).min(1.0 / count as f64);
        let share = |index: usize| first.powf(1.0 - index as f64 / (count - 1) as f64);
        if farthest == 0.0 {
            return Vec::new();
        }
        (0..count).map(|index| here + farthest * share(index)).collect()
    }

    /// Fits all parameters but `k`, held at `z`, from where a neighbour has them.
    fn fit_others(&self, k: usize, z: f64, from: &ProfilePoint) -> Result<ProfilePoint, CalibrationError> {
        let mut start: DVector<f64> = from.point.free.clone();
        start[k] = z;
        let point = descend(self.likelihood, self.optimum.deviance, start, Some(k))?;
        Ok(self.at(point))
    }

    fn at(&self, point: Point) -> ProfilePoint {
        let rise = self.optimum.deviance.total(&point.residuals) - self.optimum.value();
        ProfilePoint { point, rise }
    }

    /// The lower of a point and what its neighbour leads to there. Where the others move as one from
    /// point to point, both are the same.
    fn lower(
        &self,
        k: usize,
        point: &ProfilePoint,
        neighbour: &ProfilePoint,
    ) -> Result<ProfilePoint, CalibrationError> {
        let (here, there) = (&point.point.free, &neighbour.point.free);
        let moved = (0..here.len())
            .filter(|&other| other != k)
            .map(|other| (here[other] - there[other]).abs());
        if moved.fold(0.0, f64::max) < JUMP || !neighbour.rise.is_finite() {
            return Ok(point.clone());
        }
        let other = self.fit_others(k, here[k], neighbour)?;
        Ok(if other.rise < point.rise {
            other
        } else {
            point.clone()
        })
    }

    /// The free variable at an end, and a point next to it: what lies beyond a barrier and is not excluded
    /// belongs to the interval.
    fn end(
        &self,
        k: usize,
        points: &[ProfilePoint],
        upper: bool,
    ) -> Result<Option<(f64, ProfilePoint)>, CalibrationError> {
        let inward: Vec<&ProfilePoint> = if upper {
            points.iter().rev().collect()
        } else {
            points.iter().collect()
        };
        let inside = inward.iter().position(|point| point.root() < self.wanted);
        let Some(inside) = inside.filter(|&index| index > 0 && inward[0].root() >= EXCLUSION * self.wanted)
        else {
            return Ok(None);
        };
        let (mut inner, mut outer) = (inward[inside].clone(), inward[inside - 1].clone());
        let off = |point: &ProfilePoint| (point.root() - self.wanted).abs();
        for _ in 0..HALVINGS {
            if off(&inner).min(off(&outer)) < ACCURACY * self.wanted {
                break;
            }
            let z = 0.5 * (inner.point.free[k] + outer.point.free[k]);
            let middle = self.lower(k, &self.fit_others(k, z, &inner)?, &outer)?;
            if middle.root() < self.wanted {
                inner = middle;
            } else {
                outer = middle;
            }
        }
        let (a, b) = (inner.point.free[k], outer.point.free[k]);
        // Beyond an infinite rise the model has no answer.
        let share = ((self.wanted - inner.root()) / (outer.root() - inner.root())).clamp(0.0, 1.0);
        let end = if outer.rise.is_finite() {
            a + share * (b - a)
        } else {
            a
        };
        let near = if off(&inner) < off(&outer) { inner } else { outer };
        Ok(Some((end, near)))
    }
}
