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
    /// In the order of the parameter.
    pub points: Vec<ProfilePoint>,
    /// Free variables at the lower and the upper end; `None` where the likelihood does not close.
    pub ends: [Option<f64>; 2],
    /// The points next to those ends.
    pub at_ends: Vec<ProfilePoint>,
}

impl Profile {
    /// Free variables and the rise at them, ascending, as far as the model has an answer.
    pub fn curve(&self) -> Vec<(f64, f64)> {
        let points = self.points.iter().chain(&self.at_ends);
        let all = points.map(|point| (point.point.free[self.parameter], point.rise));
        let mut curve: Vec<(f64, f64)> = all.filter(|(_, rise)| rise.is_finite()).collect();
        curve.sort_by(|a, b| a.0.total_cmp(&b.0));
        curve
    }

    /// Whether a point lies below both values between which it lies.
    fn lies_above(&self, point: &ProfilePoint) -> bool {
        let k = self.parameter;
        let is_before = |other: &ProfilePoint| other.point.free[k] < point.point.free[k];
        let next = self.points.partition_point(is_before);
        let mut around = self.points[next.saturating_sub(1)..].iter().take(2);
        around.all(|other| point.rise < other.rise - BETTER)
    }

    /// Points within reach of the optimum, which is at `here`, beyond some that are not.
    pub fn beyond_barrier(&self, here: f64, wanted: f64) -> impl Iterator<Item = &ProfilePoint> {
        let inside = move |point: &&ProfilePoint| point.root() < wanted;
        let is_below = |point: &ProfilePoint| point.point.free[self.parameter] < here;
        let (below, above) = self.points.split_at(self.points.partition_point(is_below));
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
    /// The profiles of the first `count` parameters. What one of them finds is true for all: where a point
    /// of another lies below a profile, that one is in a wrong valley there.
    pub fn profiles(&self, count: usize) -> Result<Vec<Profile>, CalibrationError> {
        let first = (0..count).map(|k| self.profile(k, &[]));
        let first = first.collect::<Result<Vec<_>, _>>()?;
        let again = |own: &Profile| {
            let others = first.iter().filter(|other| other.parameter != own.parameter);
            let within = others.flat_map(|other| &other.points);
            let within = within.filter(|point| point.root() < EXCLUSION * self.wanted);
            let below: Vec<Point> = within
                .filter(|point| own.lies_above(point))
                .map(|point| point.point.clone())
                .collect();
            if below.is_empty() {
                return Ok(own.clone());
            }
            self.profile(own.parameter, &below)
        };
        first.iter().map(again).collect()
    }

    /// The profile of parameter `k`, and through known points: from the optimum to both bounds, and from there to the other bound and
    /// back, of which the lower counts.
    fn profile(&self, k: usize, known: &[Point]) -> Result<Profile, CalibrationError> {
        let mut points = vec![ProfilePoint {
            point: self.optimum.point.clone(),
            rise: 0.0,
        }];
        for bound in [-FARTHEST, FARTHEST] {
            points.reverse();
            for z in self.values(k, bound) {
                points.push(self.fit_others(k, z, &points[points.len() - 1])?);
            }
        }
        // A valley elsewhere may be narrower than a step of the grid.
        let far = |point: &&Point| (&point.free - &self.optimum.point.free).amax() >= JUMP;
        let known = self.others.iter().filter(far).chain(known);
        points.extend(known.map(|point| self.at(point.clone())));
        points.sort_by(|a, b| a.point.free[k].total_cmp(&b.point.free[k]));
        for index in (0..points.len() - 1).rev() {
            self.lower(k, &mut points, index, index + 1)?;
        }
        for index in 1..points.len() {
            self.lower(k, &mut points, index, index - 1)?;
        }
        let (mut ends, mut at_ends) = ([None; 2], Vec::new());
        for end in &mut ends {
            if let Some((value, near)) = self.end(k, &points)? {
                *end = Some(value);
                at_ends.push(near);
            }
            points.reverse();
        }
        Ok(Profile {
            parameter: k,
            points,
            ends,
            at_ends,
        })
    }

    /// Half of the values of parameter `k` but its estimate: to a bound, at distances that grow by one
    /// factor from half a standard error on.
    fn values(&self, k: usize, bound: f64) -> Vec<f64> {
        let here = self.optimum.point.free[k];
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
        let mut start = from.point.free.clone();
        start[k] = z;
        let point = descend(self.likelihood, self.optimum.deviance, start, Some(k))?;
        Ok(self.at(point))
    }

    fn at(&self, point: Point) -> ProfilePoint {
        let rise = self.optimum.deviance.total(&point.residuals) - self.optimum.value();
        ProfilePoint { point, rise }
    }

    /// Takes what a neighbour leads to, if it is lower. Where the others move as one from point to point,
    /// both are the same.
    fn lower(
        &self,
        k: usize,
        points: &mut [ProfilePoint],
        index: usize,
        neighbour: usize,
    ) -> Result<(), CalibrationError> {
        let (here, there) = (&points[index].point.free, &points[neighbour].point.free);
        let mut moved = here - there;
        moved[k] = 0.0;
        if moved.amax() >= JUMP && points[neighbour].rise.is_finite() {
            let other = self.fit_others(k, here[k], &points[neighbour])?;
            if other.rise < points[index].rise {
                points[index] = other;
            }
        }
        Ok(())
    }

    /// The free variable at the end before the first of these points, which begin at a bound, and a point
    /// next to it: what lies beyond a barrier and is not excluded belongs to the interval.
    fn end(
        &self,
        k: usize,
        points: &[ProfilePoint],
    ) -> Result<Option<(f64, ProfilePoint)>, CalibrationError> {
        let inside = points.iter().position(|point| point.root() < self.wanted);
        let is_excluded = points[0].root() >= EXCLUSION * self.wanted;
        let Some(inside) = inside.filter(|&index| index > 0 && is_excluded) else {
            return Ok(None);
        };
        let mut around = [points[inside].clone(), points[inside - 1].clone()];
        let off = |point: &ProfilePoint| (point.root() - self.wanted).abs();
        for _ in 0..HALVINGS {
            if off(&around[0]).min(off(&around[1])) < ACCURACY * self.wanted {
                break;
            }
            let z = 0.5 * (around[0].point.free[k] + around[1].point.free[k]);
            let mut middle = [self.fit_others(k, z, &around[0])?, around[1].clone()];
            self.lower(k, &mut middle, 0, 1)?;
            let [middle, _] = middle;
            let place = usize::from(middle.root() >= self.wanted);
            around[place] = middle;
        }
        let [inner, outer] = around;
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
