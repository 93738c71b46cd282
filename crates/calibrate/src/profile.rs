//! Intervals from the profile likelihood.
//!
//! The parameter is held at a value, all others are fitted anew, and the rise of the deviance above its minimum is compared
//! with the square of Student's t (of Gauss's z where the noise is known), which is the likelihood-ratio test. Such an interval
//! needs no symmetry and may stay open on a side (D. M. Bates, D. G. Watts, Nonlinear Regression Analysis and Its
//! Applications, 1988, section 6.1; A. Raue et al., Bioinformatics 25, 2009).
//!
//! An end is closed only if the data exclude what lies beyond it, up to the bound, by twice the distance that makes an interval: by
//! four standard errors. For a true value at the bound itself, one such distance would close one of forty intervals by chance.

use nalgebra::{DMatrix, DVector};

use crate::CalibrationError;
use crate::levenberg_marquardt::LevenbergMarquardt;
use crate::parameter::FARTHEST;
use crate::search::{BETTER, Optimum, Point, Search};
use crate::uncertainty::{Covariance, quantile};
use crate::valley::Valley;

/// Distance at which the bound is excluded, in those that make an interval.
const EXCLUSION: f64 = 2.0;
/// Accuracy of an end, as a share of its distance from the estimate.
const END_ACCURACY: f64 = 0.03;
/// Stations on one side.
const MAX_STATIONS: usize = 24;
/// Accuracy of the other parameters, in standard errors: an eighth of a squared one, which is a sixtieth of an end's distance.
const TOLERANCE: f64 = 0.35;
/// Iterations of the others at one value.
const MAX_ITERATIONS: u64 = 6;
/// First point, in distances that would make the interval if the deviance were a parabola: then it is the end. The aim of the
/// further ones beyond what excludes, and the least and largest factors by which the next lies further from the estimate.
const FIRST: f64 = 1.0;
const AIM: f64 = 1.1;
const STRIDES: (f64, f64) = (1.3, 2.5);
/// Correlation from which the valley of the deviance is so narrow that it must be followed in shorter steps, and their share.
const NARROW: f64 = 0.97;
const NARROW_SHARE: f64 = 0.35;
/// Standard error in the free variable up to which it is straight all the same.
const STRAIGHT: f64 = 1e-3;
/// What the others may still gain, and the share of the rise, at a point that is taken as it is; and how often one that is not so far
/// is replaced by one halfway.
const LEFT: f64 = 0.5;
const LEFT_SHARE: f64 = 0.1;
const MAX_HALVINGS: usize = 3;
/// Root of the rise from one station to the next that a start may show without a look for a better one.
const CONTINUED: f64 = 3.0;
/// Jump of the root across the narrowest bracket, in distances that make an interval, that shows the others stuck; and how often they are
/// fitted again from within.
const JUMP: f64 = 0.5;
const MAX_JUMPS: usize = 3;
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
struct Station {
    point: Point,
    /// J there, where the other parameters were fitted.
    jacobian: Option<DMatrix<f64>>,
    /// Distance from the estimate in the parameter's coordinate.
    distance: f64,
    rise: f64,
    /// Whether the others have been fitted so far that the rise means something.
    settled: bool,
}

/// The profile of one parameter.
pub(crate) struct ProfileInterval {
    /// Ends in the parameter's coordinate; `None` where the likelihood does not close.
    pub lower: Option<f64>,
    pub upper: Option<f64>,
    /// Coordinates and rises that were computed, ascending.
    pub curve: Vec<(f64, f64)>,
}

/// What a profile found.
pub(crate) enum Outcome {
    Interval(ProfileInterval),
    /// A point lower than the optimum.
    Better(Point),
}

/// Profiles parameters around an optimum.
pub(crate) struct Profiler<'a> {
    pub search: &'a Search<'a>,
    pub optimum: &'a Optimum,
    pub covariance: &'a Covariance,
    pub degrees_of_freedom: Option<f64>,
    /// Probability outside of the interval.
    pub tail: f64,
    /// What earlier profiles know of the valley.
    pub valley: Valley,
}

/// One side of an interval.
enum Side {
    Closed(f64),
    Open,
    Better(Point),
}

impl Profiler<'_> {
    /// The interval of parameter `k`.
    pub fn interval(&mut self, k: usize) -> Result<Outcome, CalibrationError> {
        let here = self.coordinate(k);
        let mut curve = vec![(here, 0.0)];
        let mut ends = [None, None];
        for (end, sign) in ends.iter_mut().zip([-1.0, 1.0]) {
            let mut stations = Vec::new();
            match self.side(k, sign, &mut stations)? {
                Side::Closed(distance) => *end = Some(here + sign * distance),
                Side::Open => {}
                Side::Better(point) => return Ok(Outcome::Better(point)),
            }
            curve.extend(
                stations
                    .iter()
                    .map(|station| (here + sign * station.distance, station.rise)),
            );
        }
        curve.sort_by(|a, b| a.0.total_cmp(&b.0));
        let [lower, upper] = ends;
        Ok(Outcome::Interval(ProfileInterval { lower, upper, curve }))
    }

    fn coordinate(&self, k: usize) -> f64 {
        self.search.evaluator.parameters[k].bounded(self.optimum.point.free[k])
    }

    fn side(&mut self, k: usize, sign: f64, stations: &mut Vec<Station>) -> Result<Side, CalibrationError> {
        let parameter = &self.search.evaluator.parameters[k];
        let wanted = quantile(0.5 * self.tail, self.degrees_of_freedom);
        let excluded = EXCLUSION * wanted;
        let farthest = (parameter.bounded(sign * FARTHEST) - self.coordinate(k)).abs();
        let error = self
            .covariance
            .standard_error(k)
            .map(|error| error * parameter.bounded_slope(self.optimum.point.free[k]));
        let first = if self.is_narrow(k) {
            NARROW_SHARE * FIRST
        } else {
            FIRST
        };
        // What the data do not exclude at the bound itself, they do not exclude.
        let bound = match self.station(k, sign, farthest, stations)? {
            Ok(station) => station,
            Err(better) => return Ok(Side::Better(better)),
        };
        if bound.rise.sqrt() < excluded {
            stations.push(bound);
            return Ok(Side::Open);
        }
        let mut next = error.map_or(farthest, |error| (first * wanted * error).min(farthest));
        let (mut halvings, mut jumps) = (0, 0);
        for _ in 0..MAX_STATIONS {
            let reached = stations.last().map_or(0.0, |station| station.distance);
            let station = match self.station(k, sign, next, stations)? {
                Ok(station) => station,
                Err(better) => return Ok(Side::Better(better)),
            };
            if station.settled {
                self.valley.add(station.point.free.clone());
            }
            let outward = next > reached;
            if outward && !station.settled && halvings < MAX_HALVINGS {
                halvings += 1;
                next = 0.5 * (reached + next);
                continue;
            }
            let place = stations.partition_point(|other| other.distance < station.distance);
            stations.insert(place, station);
            let farthest_root = stations.last().map_or(0.0, |station| station.rise.sqrt());
            if farthest_root < excluded {
                let reached = stations.last().map_or(0.0, |station| station.distance);
                if reached >= farthest {
                    return Ok(Side::Open);
                }
                let stride = (AIM * excluded / farthest_root).clamp(STRIDES.0, STRIDES.1);
                next = (stride * reached).min(farthest);
                continue;
            }
            let (inner, outer) = bracket(stations, wanted);
            let distance = crossing(stations, inner, outer, wanted);
            let near = |(_, root): (f64, f64)| (root - wanted).abs() < END_ACCURACY * wanted;
            if near(inner) || near(outer) {
                return Ok(Side::Closed(distance));
            }
            next = distance;
            if outer.0 - inner.0 < END_ACCURACY * outer.0 {
                if outer.1.is_infinite() || outer.1 - inner.1 < JUMP * wanted {
                    return Ok(Side::Closed(distance));
                }
                // The rise has no jumps: beyond this one the others were stuck, and are fitted again from within.
                if jumps == MAX_JUMPS {
                    return Ok(Side::Open);
                }
                jumps += 1;
                stations.retain(|station| station.distance <= inner.0);
                let here = self.coordinate(k);
                self.valley
                    .forget(|point| sign * (parameter.bounded(point[k]) - here) > inner.0);
                next = if inner.0 > 0.0 {
                    STRIDES.0 * inner.0
                } else {
                    0.5 * outer.0
                };
                next = next.min(farthest);
            }
        }
        // Where it did not settle, nothing is excluded.
        Ok(Side::Open)
    }

    /// Fits all parameters but `k`, which lies `distance` away from its estimate, as `stations` nearer or farther do.
    fn station(
        &self,
        k: usize,
        sign: f64,
        distance: f64,
        stations: &[Station],
    ) -> Result<Result<Station, Point>, CalibrationError> {
        let evaluator = self.search.evaluator;
        let deviance = self.optimum.deviance;
        let held = evaluator.parameters[k].free(self.coordinate(k) + sign * distance);
        let mut fixed = vec![false; self.optimum.point.free.len()];
        fixed[k] = true;
        let start = self.start(k, held, distance, stations)?;
        // Without an answer there, it is as good as excluded; without other parameters, there is nothing to fit.
        // Nor where it is so far up that no fit can bring it down.
        let rise = deviance.total(&start.residuals) - self.optimum.value();
        let hopeless = rise.is_nan() || rise > HOPELESS;
        let done = hopeless || fixed.len() == 1;
        let mut left = 0.0;
        let (point, jacobian) = if done {
            (start, None)
        } else {
            let mut solver = LevenbergMarquardt::new(deviance, fixed.clone(), TOLERANCE);
            // Toward the estimate the Jacobian of a station further out is good enough.
            let outer = stations.iter().find(|station| station.distance > distance);
            solver = match outer.and_then(|outer| outer.jacobian.clone()) {
                Some(known) => solver.with_jacobian(Some(known), false).unverified(),
                // In a narrow valley the optimum's own only serves for the size of steps.
                None if self.is_narrow(k) => solver.with_slopes(self.optimum.jacobian.clone()).unverified(),
                None => solver.with_jacobian(Some(self.optimum.jacobian.clone()), false),
            };
            let mut found = self
                .search
                .attempt(solver, &fixed, deviance, start, MAX_ITERATIONS)?;
            if let Some(free) = self.away_from_bounds(k, &found.point.free) {
                let residuals = evaluator.residuals(&free)?;
                let start = Point { free, residuals };
                // A start that is far up leads back to where the first one came.
                if deviance.total(&start.residuals) - self.optimum.value() < WORTH {
                    let solver = LevenbergMarquardt::new(deviance, fixed.clone(), TOLERANCE);
                    let other = self
                        .search
                        .attempt(solver, &fixed, deviance, start, MAX_ITERATIONS)?;
                    if other.value() < found.value() {
                        found = other;
                    }
                }
            }
            // What the others might still gain is taken as gained, which widens the interval at most.
            left = found.offset.powi(2);
            (found.point, Some(found.jacobian))
        };
        let found = deviance.total(&point.residuals) - self.optimum.value();
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

    /// Where to fit the others from: the floor of the valley, unless the others as they were nearer to the estimate are better.
    fn start(
        &self,
        k: usize,
        held: f64,
        distance: f64,
        stations: &[Station],
    ) -> Result<Point, CalibrationError> {
        let evaluator = self.search.evaluator;
        let point = |free: DVector<f64>| {
            let residuals = evaluator.residuals(&free)?;
            Ok::<_, CalibrationError>(Point { free, residuals })
        };
        let rise = |point: &Point| self.optimum.deviance.total(&point.residuals) - self.optimum.value();
        let floor = self.valley.floor(k, held, &self.drift(k));
        let floor = point(floor.map(|z| z.clamp(-FARTHEST, FARTHEST)))?;
        let inner = stations.iter().rev().find(|station| station.distance < distance);
        let (mut free, known) = match inner {
            Some(inner) => (inner.point.free.clone(), inner.rise),
            None => (self.optimum.point.free.clone(), 0.0),
        };
        if rise(&floor).max(0.0).sqrt() < known.sqrt() + CONTINUED {
            return Ok(floor);
        }
        free[k] = held;
        let near = point(free)?;
        let nearer = rise(&near) < rise(&floor);
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
    fn is_narrow(&self, k: usize) -> bool {
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

/// Where the root of the rise should be `wanted`. It is nearly a straight line through the estimate; where it is not, the line
/// through the two stations next to the wanted root is better than the one through the bracket's ends.
fn crossing(stations: &[Station], inner: (f64, f64), outer: (f64, f64), wanted: f64) -> f64 {
    let mut next: Vec<(f64, f64)> = stations
        .iter()
        .map(|station| (station.distance, station.rise.sqrt()))
        .filter(|(_, root)| root.is_finite())
        .collect();
    next.push((0.0, 0.0));
    next.sort_by(|a, b| (a.1 - wanted).abs().total_cmp(&(b.1 - wanted).abs()));
    let line = |a: (f64, f64), b: (f64, f64)| a.0 + (wanted - a.1) / (b.1 - a.1) * (b.0 - a.0);
    let inside = |distance: &f64| *distance > inner.0 && *distance < outer.0;
    let secant = next.first().zip(next.get(1)).map(|(a, b)| line(*a, *b));
    secant
        .filter(inside)
        .or(Some(line(inner, outer)).filter(inside))
        .unwrap_or(0.5 * (inner.0 + outer.0))
}

/// The outermost place where the root of the rise crosses what is `wanted`: the stations on either side of it, as distance and root.
/// What lies beyond a barrier and is not excluded belongs to the interval.
fn bracket(stations: &[Station], wanted: f64) -> ((f64, f64), (f64, f64)) {
    let mut inner = (0.0, 0.0);
    let mut outer = (f64::INFINITY, f64::INFINITY);
    for station in stations.iter().rev() {
        let root = station.rise.sqrt();
        if root < wanted {
            inner = (station.distance, root);
            break;
        }
        outer = (station.distance, root);
    }
    (inner, outer)
}
