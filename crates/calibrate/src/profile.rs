//! Intervals from the profile likelihood.
//!
//! The parameter is held at a value, all others are fitted anew, and the rise of the deviance above its minimum is compared
//! with the square of Student's t (of Gauss's z where the noise is known), which is the likelihood-ratio test. Such an interval
//! needs no symmetry and may stay open on a side (D. M. Bates, D. G. Watts, Nonlinear Regression Analysis and Its
//! Applications, 1988, section 6.1; A. Raue et al., Bioinformatics 25, 2009).
//!
//! An end is closed only if the data exclude what lies beyond it, up to the bound, by twice the distance that makes an interval: by
//! four standard errors. For a true value at the bound itself, one such distance would close one of forty intervals by chance.

use crate::CalibrationError;
use crate::parameter::FARTHEST;
use crate::search::{Optimum, Point, Search};
use crate::station::Station;
use crate::uncertainty::{Covariance, quantile};
use crate::valley::Valley;

/// Distance at which the bound is excluded, in those that make an interval.
const EXCLUSION: f64 = 2.0;
/// Accuracy of an end, as a share of its distance from the estimate.
const END_ACCURACY: f64 = 0.03;
/// Stations on one side.
const MAX_STATIONS: usize = 24;
/// First point, in distances that would make the interval if the deviance were a parabola: then it is the end. The aim of the
/// further ones beyond what excludes, and the least and largest factors by which the next lies further from the estimate.
const FIRST: f64 = 1.0;
const AIM: f64 = 1.1;
const STRIDES: (f64, f64) = (1.3, 2.5);
/// The first point's share of that where the valley of the deviance is narrow.
const NARROW_SHARE: f64 = 0.35;
/// Least part of a bracket that a step between its ends leaves on either side, and root, in what is wanted, from which an end of it is too
/// far off for a line.
const LEAST_STEP: f64 = 0.01;
const STEEP: f64 = 4.0;
/// How often a point at which the others are not yet fitted is replaced by one halfway.
const MAX_HALVINGS: usize = 3;
/// Jump of the root, in distances that make an interval, across a bracket this narrow, that shows the others stuck; and how often they are
/// fitted again from within.
const JUMP: f64 = 0.5;
const JUMP_WIDTH: f64 = 0.003;
const MAX_JUMPS: usize = 3;

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
    /// A minimum elsewhere that is hardly higher: an interval reaches beyond it.
    pub rival: Option<&'a Point>,
    /// What earlier profiles know of the valley.
    pub valley: Valley,
    /// What the intervals found so far rest on.
    pub witnesses: Vec<Witness>,
}

/// A point on which an answer rests.
pub(crate) struct Witness {
    pub place: Place,
    /// Root of the rise that the answer compares it with.
    pub threshold: f64,
    pub point: Point,
}

/// Where a witness stands.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Place {
    /// At the end of an interval.
    End,
    /// At the bound of a parameter, the upper one or the lower.
    Bound((usize, bool)),
    /// At another minimum.
    Rival,
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
            let mut stations: Vec<Station> = self.at_rival(k, sign).into_iter().collect();
            match self.side(k, sign, &mut stations)? {
                Side::Closed(distance) => *end = Some(here + sign * distance),
                Side::Open => {}
                Side::Better(point) => return Ok(Outcome::Better(point)),
            }
            let wanted = self.wanted();
            let off = |station: &Station| (station.rise.sqrt() - wanted).abs();
            let nearest = stations.iter().min_by(|a, b| off(a).total_cmp(&off(b)));
            self.witnesses.extend(end.and(nearest).map(|nearest| Witness {
                place: Place::End,
                threshold: wanted,
                point: nearest.point.clone(),
            }));
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

    /// The rival, if it lies on this side.
    fn at_rival(&self, k: usize, sign: f64) -> Option<Station> {
        let rival = self.rival?;
        let parameter = &self.search.evaluator.parameters[k];
        let distance = sign * (parameter.bounded(rival.free[k]) - self.coordinate(k));
        (distance > 0.0).then(|| Station {
            point: rival.clone(),
            jacobian: None,
            distance,
            rise: self.rise(rival).max(0.0),
            settled: true,
        })
    }

    /// Distance that makes an interval.
    fn wanted(&self) -> f64 {
        quantile(0.5 * self.tail, self.degrees_of_freedom)
    }

    pub fn coordinate(&self, k: usize) -> f64 {
        self.search.evaluator.parameters[k].bounded(self.optimum.point.free[k])
    }

    fn side(&mut self, k: usize, sign: f64, stations: &mut Vec<Station>) -> Result<Side, CalibrationError> {
        let parameter = &self.search.evaluator.parameters[k];
        let wanted = self.wanted();
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
        self.witnesses.push(Witness {
            place: Place::Bound((k, sign > 0.0)),
            threshold: excluded,
            point: bound.point.clone(),
        });
        if bound.rise.sqrt() < excluded {
            stations.push(bound);
            return Ok(Side::Open);
        }
        let mut next = error.map_or(farthest, |error| (first * wanted * error).min(farthest));
        let (mut halvings, mut jumps) = (0, 0);
        for _ in 0..MAX_STATIONS {
            let reached = stations.last().map_or(0.0, |station| station.distance);
            let station = if next >= farthest {
                bound.clone()
            } else {
                match self.station(k, sign, next, stations)? {
                    Ok(station) => station,
                    Err(better) => return Ok(Side::Better(better)),
                }
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
            let off = |(_, root): (f64, f64)| (root - wanted).abs();
            let nearest = if off(inner) < off(outer) { inner } else { outer };
            if off(nearest) < END_ACCURACY * wanted {
                let secant = secant(stations, wanted).filter(|d| (inner.0..=outer.0).contains(d));
                return Ok(Side::Closed(secant.unwrap_or(nearest.0)));
            }
            next = crossing(stations, inner, outer, wanted);
            let width = (outer.0 - inner.0) / outer.0;
            let smooth = outer.1.is_infinite() || outer.1 - inner.1 < JUMP * wanted;
            if smooth && width < END_ACCURACY {
                return Ok(Side::Closed(next));
            }
            if width < JUMP_WIDTH {
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
}

/// Where the root of the rise should be `wanted`, well inside of the bracket. Where the line through the stations next to the wanted root
/// leads out of it, the one through its ends is taken, or its middle if one of them is far off.
fn crossing(stations: &[Station], inner: (f64, f64), outer: (f64, f64), wanted: f64) -> f64 {
    let margin = LEAST_STEP * (outer.0 - inner.0);
    let inside = |distance: &f64| *distance > inner.0 + margin && *distance < outer.0 - margin;
    let chord = (outer.1 < STEEP * wanted).then(|| line(inner, outer, wanted));
    secant(stations, wanted)
        .filter(inside)
        .or(chord.filter(inside))
        .unwrap_or(0.5 * (inner.0 + outer.0))
}

/// The same by the line through the two stations next to the wanted root: the root is nearly a straight line through the estimate.
fn secant(stations: &[Station], wanted: f64) -> Option<f64> {
    let mut next: Vec<(f64, f64)> = stations
        .iter()
        .map(|station| (station.distance, station.rise.sqrt()))
        .filter(|(_, root)| root.is_finite())
        .collect();
    next.push((0.0, 0.0));
    next.sort_by(|a, b| (a.1 - wanted).abs().total_cmp(&(b.1 - wanted).abs()));
    next.first().zip(next.get(1)).map(|(a, b)| line(*a, *b, wanted))
}

/// Where the line through two stations, as distance and root, is `wanted`.
fn line(a: (f64, f64), b: (f64, f64), wanted: f64) -> f64 {
    a.0 + (wanted - a.1) / (b.1 - a.1) * (b.0 - a.0)
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
