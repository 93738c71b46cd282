//! A point of a profile: a parameter held at a value, all others fitted.

use nalgebra::{DMatrix, DVector};

use crate::descent::Optimum;
use crate::parameter::FARTHEST;
use crate::point::{Point, all_over};
use crate::search::{BETTER, Search};
use crate::step::LONGEST_STEP;
use crate::uncertainty::Covariance;
use crate::{CalibrationError, Parameter};

/// Best places of a scan from which the others are fitted at a station. With none, one end of μ_d in a hundred is off by a tenth of its
/// interval and the worst by 0.4; 4 change nothing more (tests/calibration_coverage.rs).
const STARTS: usize = 2;

/// Why a profile was not finished.
pub(crate) enum Stop {
    /// A point lower than the optimum.
    Better(Point),
    Failed(CalibrationError),
}

impl From<CalibrationError> for Stop {
    fn from(error: CalibrationError) -> Self {
        Self::Failed(error)
    }
}

/// Profiles parameters around an optimum.
pub(crate) struct Profiler<'a> {
    pub search: &'a Search<'a>,
    pub optimum: &'a Optimum,
    pub covariance: &'a Covariance,
    /// Root of the rise at which an interval ends.
    pub wanted: f64,
    /// A minimum elsewhere that is hardly higher: an interval reaches beyond it.
    pub rival: Option<&'a Point>,
    /// Places all over the ranges of the others, for each of them, from the best of which they are fitted as well: what a narrow and bent
    /// valley needs, where a run costs nothing.
    pub scan: usize,
}

/// A point of the profile.
#[derive(Debug, Clone)]
pub(crate) struct Station {
    pub optimum: Optimum,
    /// Distance from the estimate in the parameter's coordinate.
    pub distance: f64,
    /// Root of the rise, less what the others might still gain.
    pub root: f64,
}

impl Profiler<'_> {
    /// The estimate of parameter `k` in its coordinate.
    pub fn coordinate(&self, k: usize) -> f64 {
        self.parameter(k).bounded(self.optimum.point.free[k])
    }

    pub fn parameter(&self, k: usize) -> &Parameter {
        &self.search.evaluator.calibration.parameters[k]
    }

    /// Rise of the deviance from the optimum.
    pub fn rise(&self, point: &Point) -> f64 {
        self.optimum.deviance.total(&point.residuals) - self.optimum.value()
    }

    /// Fits all parameters but `k`, which lies `distance` away from its estimate.
    pub fn station(&self, k: usize, sign: f64, distance: f64, known: &[Station]) -> Result<Station, Stop> {
        let held = self.parameter(k).free(self.coordinate(k) + sign * distance);
        let (near, jacobian) = self.near(k, held, known);
        let mut found = Optimum {
            point: self
                .best_of(self.search.evaluator.points(near)?, 1)
                .swap_remove(0),
            offset: 0.0,
            ..self.optimum.clone()
        };
        // Without an answer there, it is as good as excluded; without other parameters, there is nothing to fit.
        let others = found.point.free.len() - 1;
        if others > 0 && self.rise(&found.point).is_finite() {
            found = self.fit_others(k, found.point, jacobian.clone())?;
            let places = all_over(others, self.scan * others);
            let places = places
                .into_iter()
                .map(|place| place.insert_row(k, held))
                .collect();
            let points = self.search.evaluator.points_with_terms(places, Some(k))?;
            for start in self.best_of(points, STARTS) {
                let other = self.fit_others(k, start, jacobian.clone())?;
                if other.value() < found.value() {
                    found = other;
                }
            }
        }
        let rise = self.rise(&found.point);
        if rise < -BETTER {
            return Err(Stop::Better(found.point));
        }
        Ok(Station {
            // What the others might still gain is taken as gained, which widens the interval at most.
            root: (rise - found.offset.powi(2)).max(0.0).sqrt(),
            distance,
            optimum: found,
        })
    }

    fn fit_others(
        &self,
        k: usize,
        start: Point,
        jacobian: Option<DMatrix<f64>>,
    ) -> Result<Optimum, CalibrationError> {
        let deviance = self.optimum.deviance;
        self.search.brief_descent(deviance, jacobian, Some(k)).run(start)
    }

    /// The `count` best of the points.
    fn best_of(&self, mut points: Vec<Point>, count: usize) -> Vec<Point> {
        points.sort_by(|a, b| self.rise(a).total_cmp(&self.rise(b)));
        points.truncate(count);
        points
    }

    /// Where the others should be by what is known nearby, and J there.
    fn near(&self, k: usize, held: f64, known: &[Station]) -> (Vec<DVector<f64>>, Option<DMatrix<f64>>) {
        let off = |station: &Station| (station.optimum.point.free[k] - held).abs();
        let mut by_distance: Vec<&Station> = known.iter().collect();
        by_distance.sort_by(|a, b| off(a).total_cmp(&off(b)));
        let nearest = &by_distance[0].optimum;
        let free = &nearest.point.free;
        // Along the line through the two nearest stations, or the tangent at the optimum.
        let slope = match by_distance.get(1).map(|other| &other.optimum.point.free) {
            Some(other) if by_distance[0].distance > 0.0 => (other - free) / (other[k] - free[k]),
            _ => self.covariance.drift(k),
        };
        let mut places = vec![free + slope * (held - free[k])];
        let far = off(by_distance[0]) > LONGEST_STEP;
        if far {
            places.push(free.clone());
        }
        for place in &mut places {
            place.apply(|z| {
                *z = if z.is_finite() {
                    z.clamp(-FARTHEST, FARTHEST)
                } else {
                    0.0
                }
            });
            place[k] = held;
        }
        (places, (!far).then(|| nearest.jacobian.clone()))
    }
}
