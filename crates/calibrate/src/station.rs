//! One point of a profile: a parameter held at a value, all others fitted.
//!
//! Where runs are dear, the others are fitted from one start, the floor of the valley, no better than an interval needs. On a
//! stand-in, where runs cost nothing, they are fitted from several starts all over their ranges.

use nalgebra::{DMatrix, DVector};

use crate::CalibrationError;
use crate::levenberg_marquardt::LevenbergMarquardt;
use crate::parameter::FARTHEST;
use crate::profile::Profiler;
use crate::search::{BETTER, Optimum, Point, all_over};

/// Accuracy of the other parameters, in standard errors: an eighth of a squared one, which is a sixtieth of an end's distance.
pub(crate) const TOLERANCE: f64 = 0.35;
/// Iterations of the others at one value.
const MAX_ITERATIONS: u64 = 6;
/// The same where runs cost nothing; points scanned for each of the others, and the best of them that are fitted from.
const FINE_TOLERANCE: f64 = 0.02;
const MORE_ITERATIONS: u64 = 60;
const SCAN: usize = 24;
const STARTS: usize = 2;
/// Correlation from which the valley of the deviance is so narrow that it must be followed in shorter steps.
const NARROW: f64 = 0.97;
/// Standard error in the free variable up to which it is straight all the same.
const STRAIGHT: f64 = 1e-3;
/// What the others may still gain, and the share of the rise, at a point that is taken as it is.
const LEFT: f64 = 0.5;
const LEFT_SHARE: f64 = 0.1;
/// Root of the rise from one station to the next that a start may show without a look for a better one.
const CONTINUED: f64 = 3.0;
/// Rise that no fit of the others can bring down to what an interval ends at: they may take away all but a thousandth.
const HOPELESS: f64 = 2e4;
/// Free variable beyond which another parameter counts as near its bound: the outer twentieth of the range.
const NEAR_BOUND: f64 = 3.0;
/// Rise up to which such a start is worth a descent.
const WORTH: f64 = 50.0;
/// Standard error in the free variable from which the data hardly know a parameter.
const VAGUE: f64 = 0.5;

/// A point of the profile: the parameter's free variable, the others fitted to it, and the rise of the deviance.
#[derive(Debug, Clone)]
pub(crate) struct Station {
    pub point: Point,
    /// J there, where the other parameters were fitted.
    pub jacobian: Option<DMatrix<f64>>,
    /// Distance from the estimate in the parameter's coordinate.
    pub distance: f64,
    pub rise: f64,
    /// Whether the others have been fitted so far that the rise means something.
    pub settled: bool,
}

impl Profiler<'_> {
    /// Fits all parameters but `k`, which lies `distance` away from its estimate, as `stations` nearer or farther do.
    pub fn station(
        &self,
        k: usize,
        sign: f64,
        distance: f64,
        stations: &[Station],
    ) -> Result<Result<Station, Point>, CalibrationError> {
        let held = self.search.evaluator.parameters[k].free(self.coordinate(k) + sign * distance);
        let start = self.start(k, held, distance, stations)?;
        // Without an answer there, it is as good as excluded; without other parameters, there is nothing to fit.
        // Nor where it is so far up that no fit can bring it down.
        let rise = self.rise(&start);
        let hopeless = rise.is_nan() || rise > HOPELESS;
        let done = hopeless || start.free.len() == 1;
        let mut left = 0.0;
        let (point, jacobian) = if done {
            (start, None)
        } else {
            let found = if self.search.dear {
                let outer = stations.iter().find(|station| station.distance > distance);
                self.fit_sparingly(k, start, outer.and_then(|outer| outer.jacobian.clone()))?
            } else {
                self.fit_thoroughly(k, held, start)?
            };
            // What the others might still gain is taken as gained, which widens the interval at most.
            left = found.offset.powi(2);
            (found.point, Some(found.jacobian))
        };
        let found = self.rise(&point);
        if found < -BETTER {
            return Ok(Err(point));
        }
        Ok(Ok(Station {
            point,
            jacobian,
            distance,
            rise: (found - left).max(0.0),
            settled: left <= LEFT.max(LEFT_SHARE * found),
        }))
    }

    /// Rise of the deviance from the optimum.
    pub fn rise(&self, point: &Point) -> f64 {
        self.optimum.deviance.total(&point.residuals) - self.optimum.value()
    }

    fn point(&self, free: DVector<f64>) -> Result<Point, CalibrationError> {
        let residuals = self.search.evaluator.residuals(&free)?;
        Ok(Point { free, residuals })
    }

    /// Fits all but `k` from `start`.
    fn fit(
        &self,
        k: usize,
        start: Point,
        iterations: u64,
        tolerance: f64,
        prepare: impl FnOnce(LevenbergMarquardt) -> LevenbergMarquardt,
    ) -> Result<Optimum, CalibrationError> {
        let deviance = self.optimum.deviance;
        let mut fixed = vec![false; start.free.len()];
        fixed[k] = true;
        let solver = prepare(LevenbergMarquardt::new(deviance, fixed.clone(), tolerance));
        self.search.attempt(solver, &fixed, deviance, start, iterations)
    }

    /// With few runs: from `start`, with J from a station `farther` out if there is one.
    fn fit_sparingly(
        &self,
        k: usize,
        start: Point,
        farther: Option<DMatrix<f64>>,
    ) -> Result<Optimum, CalibrationError> {
        let near = self.optimum.jacobian.clone();
        let found = self.fit(k, start, MAX_ITERATIONS, TOLERANCE, |solver| match farther {
            // Toward the estimate the Jacobian of a station further out is good enough.
            Some(known) => solver.with_jacobian(Some(known), false).unverified(),
            // In a narrow valley the optimum's own only serves for the size of steps.
            None if self.is_narrow(k) => solver.with_slopes(near).unverified(),
            None => solver.with_jacobian(Some(near), false),
        })?;
        let Some(free) = self.away_from_bounds(k, &found.point.free) else {
            return Ok(found);
        };
        let start = self.point(free)?;
        // A start that is far up leads back to where the first one came.
        if self.rise(&start) >= WORTH {
            return Ok(found);
        }
        let other = self.fit(k, start, MAX_ITERATIONS, TOLERANCE, |solver| solver)?;
        Ok(if other.value() < found.value() {
            other
        } else {
            found
        })
    }

    /// From `start` and from the best of points all over the ranges of the others.
    fn fit_thoroughly(&self, k: usize, held: f64, start: Point) -> Result<Optimum, CalibrationError> {
        let others = start.free.len() - 1;
        let places: Vec<DVector<f64>> = all_over(others, SCAN * others)
            .into_iter()
            .map(|place| place.insert_row(k, held))
            .collect();
        let mut points: Vec<Point> = places
            .iter()
            .cloned()
            .zip(self.search.evaluator.all(&places)?)
            .map(|(free, residuals)| Point { free, residuals })
            .collect();
        points.sort_by(|a, b| self.rise(a).total_cmp(&self.rise(b)));
        points.truncate(STARTS);
        let fit = |start| self.fit(k, start, MORE_ITERATIONS, FINE_TOLERANCE, |solver| solver);
        let mut best = fit(start)?;
        for point in points {
            let other = fit(point)?;
            if other.value() < best.value() {
                best = other;
            }
        }
        Ok(best)
    }

    /// Where to fit the others from: the floor of the valley, unless the others as they were nearer to the estimate are better.
    fn start(
        &self,
        k: usize,
        held: f64,
        distance: f64,
        stations: &[Station],
    ) -> Result<Point, CalibrationError> {
        let floor = self.valley.floor(k, held, &self.drift(k));
        let floor = self.point(floor.map(|z| z.clamp(-FARTHEST, FARTHEST)))?;
        let inner = stations.iter().rev().find(|station| station.distance < distance);
        let (mut free, known) = match inner {
            Some(inner) => (inner.point.free.clone(), inner.rise),
            None => (self.optimum.point.free.clone(), 0.0),
        };
        if self.rise(&floor).max(0.0).sqrt() < known.sqrt() + CONTINUED {
            return Ok(floor);
        }
        free[k] = held;
        let near = self.point(free)?;
        let nearer = self.rise(&near) < self.rise(&floor);
        Ok(if nearer { near } else { floor })
    }

    /// Another start for the others where one that the data hardly know lies near a bound: in the middle of its range. The deviance
    /// hardly changes with the free variable at a bound, so that a descent that comes there stays, and the profile would close too
    /// early.
    fn away_from_bounds(&self, k: usize, free: &DVector<f64>) -> Option<DVector<f64>> {
        let stuck = |index: usize| {
            let vague = |error: f64| error > VAGUE;
            index != k
                && free[index].abs() > NEAR_BOUND
                && self.covariance.standard_error(index).is_none_or(vague)
        };
        (0..free.len()).any(stuck).then(|| {
            DVector::from_fn(
                free.len(),
                |index, _| if stuck(index) { 0.0 } else { free[index] },
            )
        })
    }

    /// Whether another parameter can make up for nearly all that `k` does, over a distance at which the valley bends.
    pub fn is_narrow(&self, k: usize) -> bool {
        let bends = |error: f64| error > STRAIGHT;
        self.covariance.standard_error(k).is_none_or(bends)
            && (0..self.covariance.known.len())
                .filter(|&other| other != k)
                .filter_map(|other| self.covariance.correlation(k, other))
                .any(|correlation| correlation.abs() > NARROW)
    }

    /// How the other free variables follow that of `k`, to first order.
    fn drift(&self, k: usize) -> DVector<f64> {
        let matrix = &self.covariance.matrix;
        let own = matrix[(k, k)];
        if own > 0.0 {
            matrix.column(k) / own
        } else {
            DVector::zeros(matrix.nrows())
        }
    }
}
