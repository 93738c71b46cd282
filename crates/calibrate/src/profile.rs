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
    pub free: DVector<f64>,
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
pub(crate) struct Profile {
    /// In the order of the parameter.
    pub points: Vec<ProfilePoint>,
    /// Free variables at the lower and the upper end; `None` if the likelihood does not close.
    pub ends: [Option<f64>; 2],
    /// The points next to those ends.
    pub at_ends: Vec<ProfilePoint>,
}

/// Profiles parameters around an optimum.
pub(crate) struct Profiler<'a> {
    pub likelihood: &'a Likelihood<'a>,
    pub optimum: &'a Optimum,
    pub covariance: &'a Covariance,
    /// Where other descents ended.
    pub others: &'a [Point],
    /// Root of the rise at which an interval ends.
    pub wanted: f64,
}

impl Profiler<'_> {
    /// The profiles of the first `count` parameters. What any descent has found is true for all: where it lies
    /// below a profile, that one is in a wrong valley there.
    pub fn profiles(&self, count: usize) -> Result<Vec<Profile>, CalibrationError> {
        let first = (0..count).map(|k| self.points(k));
        let first = first.collect::<Result<Vec<_>, _>>()?;
        let others = self.others.iter().map(|other| self.at(other));
        let known: Vec<ProfilePoint> = first.iter().flatten().cloned().chain(others).collect();
        let profile = |(k, mut points): (usize, Vec<ProfilePoint>)| {
            let count = points.len();
            for point in &known {
                let next = points.partition_point(|other| other.free[k] < point.free[k]);
                let mut around = points[next.saturating_sub(1)..].iter().take(2);
                if around.all(|other| point.rise < other.rise - BETTER) {
                    points.insert(next, point.clone());
                }
            }
            if points.len() > count {
                self.spread(k, &mut points)?;
            }
            self.bounded(k, points)
        };
        first.into_iter().enumerate().map(profile).collect()
    }

    /// The profile of parameter `k` along its grid.
    fn points(&self, k: usize) -> Result<Vec<ProfilePoint>, CalibrationError> {
        let optimum = self.at(&self.optimum.point);
        let points = self.grid(k).into_iter().map(|z| self.fit_others(k, z, &optimum));
        let mut points = points.collect::<Result<Vec<_>, _>>()?;
        self.spread(k, &mut points)?;
        Ok(points)
    }

    /// To the right, each point from its neighbour, and back: at each the lower one counts. Where the others move
    /// as one from point to point, both are the same.
    fn spread(&self, k: usize, points: &mut [ProfilePoint]) -> Result<(), CalibrationError> {
        for _ in 0..2 {
            for index in 1..points.len() {
                let z = points[index].free[k];
                let mut moved = &points[index].free - &points[index - 1].free;
                moved[k] = 0.0;
                if moved.amax() >= JUMP {
                    let other = self.fit_others(k, z, &points[index - 1])?;
                    if other.rise < points[index].rise {
                        points[index] = other;
                    }
                }
            }
            points.reverse();
        }
        Ok(())
    }

    /// The profile through these points, with its ends.
    fn bounded(&self, k: usize, mut points: Vec<ProfilePoint>) -> Result<Profile, CalibrationError> {
        let (mut ends, mut at_ends) = ([None; 2], Vec::new());
        for end in &mut ends {
            if let Some((value, near)) = self.end(k, &points)? {
                *end = Some(value);
                at_ends.push(near);
            }
            points.reverse();
        }
        Ok(Profile {
            points,
            ends,
            at_ends,
        })
    }

    /// Values of the free variable k from bound to bound: its estimate, and on either side as many at
    /// distances that grow by one factor from half a standard error on.
    fn grid(&self, k: usize) -> Vec<f64> {
        let here = self.optimum.point.free[k];
        let error = self.covariance.standard_error(k).unwrap_or(f64::INFINITY);
        let (count, mut values) = (GRID / 2, vec![here]);
        for farthest in [-FARTHEST - here, FARTHEST - here] {
            let first = (0.5 * error / farthest.abs()).min(1.0 / count as f64);
            let share = |index: usize| first.powf(1.0 - index as f64 / (count - 1) as f64);
            if farthest != 0.0 {
                values.extend((0..count).map(|index| here + farthest * share(index)));
            }
        }
        values.sort_by(f64::total_cmp);
        values
    }

    /// Fits all parameters but `k`, held at `z`, from where a neighbour has them.
    fn fit_others(&self, k: usize, z: f64, from: &ProfilePoint) -> Result<ProfilePoint, CalibrationError> {
        let mut start = from.free.clone();
        start[k] = z;
        let point = descend(self.likelihood, self.optimum.deviance, start, Some(k))?;
        Ok(self.at(&point))
    }

    fn at(&self, Point { free, residuals }: &Point) -> ProfilePoint {
        let rise = self.optimum.deviance.total(residuals) - self.optimum.value();
        ProfilePoint {
            free: free.clone(),
            rise,
        }
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
        let (mut inner, mut outer) = (points[inside].clone(), points[inside - 1].clone());
        let off = |point: &ProfilePoint| (point.root() - self.wanted).abs();
        for _ in 0..HALVINGS {
            if off(&inner).min(off(&outer)) < ACCURACY * self.wanted {
                break;
            }
            let z = 0.5 * (inner.free[k] + outer.free[k]);
            let mut middle = self.fit_others(k, z, &inner)?;
            if outer.rise.is_finite() {
                let other = self.fit_others(k, z, &outer)?;
                middle = if other.rise < middle.rise { other } else { middle };
            }
            let is_inside = middle.root() < self.wanted;
            *(if is_inside { &mut inner } else { &mut outer }) = middle;
        }
        let (a, b) = (inner.free[k], outer.free[k]);
        // Beyond an infinite rise the model has no answer.
        let share = ((self.wanted - inner.root()) / (outer.root() - inner.root())).clamp(0.0, 1.0);
        let share = if outer.rise.is_finite() { share } else { 0.0 };
        let near = if off(&inner) < off(&outer) { inner } else { outer };
        Ok(Some((a + share * (b - a), near)))
    }
}
