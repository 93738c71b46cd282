//! Intervals from the profile likelihood.
//!
//! A parameter is held at a value, all others are fitted anew, and the rise of the deviance above its minimum is compared with the square
//! of Student's t (of Gauss's z where the noise is known), which is the likelihood-ratio test. Such an interval needs no symmetry and may
//! stay open on a side (D. M. Bates, D. G. Watts, Nonlinear Regression Analysis and Its Applications, 1988, section 6.1; A. Raue et al.,
//! Bioinformatics 25, 2009).
//!
//! An end is closed only if the data exclude what lies beyond it, up to the bound, by twice the distance that makes an interval: by four
//! standard errors. For a true value at the bound itself, one such distance would close one of forty intervals by chance.

use nalgebra::{DMatrix, DVector};

use crate::CalibrationError;
use crate::descent::{Descent, Optimum};
use crate::parameter::FARTHEST;
use crate::point::{Point, all_over};
use crate::search::{BETTER, FEW_ITERATIONS, MAX_ROUNDS, ROUGH, Search};
use crate::uncertainty::Covariance;

/// Distance at which the bound is excluded, in those that make an interval.
pub(crate) const EXCLUSION: f64 = 2.0;
/// Accuracy of the root of the rise at an end, as a share of it.
const ACCURACY: f64 = 0.03;
/// Least and largest factors by which the walk outwards goes on.
const STRIDES: (f64, f64) = (1.3, 2.5);
/// Best places of a scan from which the others are fitted at a station.
const STARTS: usize = 2;
/// Free variable up to which a start for the others goes: nearer to a bound the deviance hardly changes with it, and a descent stays.
const START_REACH: f64 = 7.0;

/// Distance in the free variable up to which what is known at one station holds at the next.
const NEAR: f64 = 2.0;
/// Rise that no fit of the others brings down to what an interval ends at: they may take away all but a ten-millionth.
const HOPELESS: f64 = 1e8;

/// The profile of one parameter.
#[derive(Debug, Default)]
pub(crate) struct Profile {
    /// Ends in the parameter's coordinate; `None` where the likelihood does not close.
    pub lower: Option<f64>,
    pub upper: Option<f64>,
    /// Coordinates and rises that were computed, ascending.
    pub curve: Vec<(f64, f64)>,
    /// What the ends rest on.
    pub witnesses: Vec<Witness>,
}

/// A point on which an answer rests.
#[derive(Debug, Clone)]
pub(crate) struct Witness {
    pub point: Point,
    /// Root of the rise that the answer compares it with.
    pub threshold: f64,
    /// The parameter whose bound it stands at, the upper one or the lower.
    pub bound: Option<(usize, bool)>,
}

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
struct Station {
    optimum: Optimum,
    /// Distance from the estimate in the parameter's coordinate.
    distance: f64,
    /// Root of the rise, less what the others might still gain.
    root: f64,
}

impl Profiler<'_> {
    /// The interval of parameter `k`.
    pub fn profile(&self, k: usize) -> Result<Profile, Stop> {
        let here = self.coordinate(k);
        let mut profile = Profile::default();
        for sign in [-1.0, 1.0] {
            let mut stations = vec![self.at_optimum()];
            stations.extend(self.at_rival(k, sign));
            let end = self
                .side(k, sign, &mut stations)?
                .map(|distance| here + sign * distance);
            *(if sign < 0.0 {
                &mut profile.lower
            } else {
                &mut profile.upper
            }) = end;
            if let Some(bound) = stations.last() {
                profile.witnesses.push(Witness {
                    point: bound.optimum.point.clone(),
                    threshold: EXCLUSION * self.wanted,
                    bound: Some((k, sign > 0.0)),
                });
            }
            let off = |station: &Station| (station.root - self.wanted).abs();
            let nearest = stations.iter().min_by(|a, b| off(a).total_cmp(&off(b)));
            profile.witnesses.extend(end.and(nearest).map(|nearest| Witness {
                point: nearest.optimum.point.clone(),
                threshold: self.wanted,
                bound: None,
            }));
            let curve = stations.iter().skip(usize::from(sign > 0.0));
            profile
                .curve
                .extend(curve.map(|station| (here + sign * station.distance, station.root.powi(2))));
        }
        profile.curve.sort_by(|a, b| a.0.total_cmp(&b.0));
        Ok(profile)
    }

    fn coordinate(&self, k: usize) -> f64 {
        self.search.evaluator.parameters[k].bounded(self.optimum.point.free[k])
    }

    fn at_optimum(&self) -> Station {
        Station {
            optimum: self.optimum.clone(),
            distance: 0.0,
            root: 0.0,
        }
    }

    /// The rival, if it lies on this side.
    fn at_rival(&self, k: usize, sign: f64) -> Option<Station> {
        let rival = self.rival?;
        let coordinate = self.search.evaluator.parameters[k].bounded(rival.free[k]);
        let distance = sign * (coordinate - self.coordinate(k));
        (distance > 0.0).then(|| Station {
            root: self.rise(rival).max(0.0).sqrt(),
            optimum: Optimum {
                point: rival.clone(),
                ..self.optimum.clone()
            },
            distance,
        })
    }

    /// Rise of the deviance from the optimum.
    fn rise(&self, point: &Point) -> f64 {
        self.optimum.deviance.total(&point.residuals) - self.optimum.value()
    }

    /// Distance of the end on one side, where it is closed. `stations` are those known, by distance, and stay so; the bound is the last.
    fn side(&self, k: usize, sign: f64, stations: &mut Vec<Station>) -> Result<Option<f64>, Stop> {
        let parameter = &self.search.evaluator.parameters[k];
        let excluded = EXCLUSION * self.wanted;
        let farthest = (parameter.bounded(sign * FARTHEST) - self.coordinate(k)).abs();
        // What the data do not exclude at the bound itself, they do not exclude.
        let bound = self.station(k, sign, farthest, stations)?;
        let open = bound.root < excluded;
        stations.push(bound);
        if open {
            return Ok(None);
        }
        // Outwards to what is excluded, from where the end is if the deviance is a parabola.
        let error = self
            .covariance
            .standard_error(k)
            .map(|error| error * parameter.bounded_slope(self.optimum.point.free[k]));
        let mut next = error.map_or(0.5 * farthest, |error| self.wanted * error);
        for _ in 0..MAX_ROUNDS {
            if next.is_nan() || next >= farthest {
                break;
            }
            let station = self.station(k, sign, next, stations)?;
            let stride = (1.1 * excluded / station.root).clamp(STRIDES.0, STRIDES.1);
            next = if station.root < excluded {
                stride * next
            } else {
                farthest
            };
            insert(stations, station);
        }
        for round in 0..MAX_ROUNDS {
            let (inner, outer) = self.bracket(stations);
            let place = self.crossing(stations, inner);
            let near = |station: &Station| (station.root - self.wanted).abs() < ACCURACY * self.wanted;
            let (inner, outer) = (&stations[inner], &stations[outer]);
            if near(inner) || near(outer) {
                return Ok(Some(place));
            }
            let middle = 0.5 * (inner.distance + outer.distance);
            let next = if round % 3 == 2 { middle } else { place };
            let station = self.station(k, sign, next, stations)?;
            insert(stations, station);
        }
        Ok(Some(stations[self.bracket(stations).1].distance))
    }

    /// The outermost stations between which the root of the rise crosses what is wanted: what lies beyond a barrier and is not excluded
    /// belongs to the interval.
    fn bracket(&self, stations: &[Station]) -> (usize, usize) {
        let inside = |station: &Station| station.root < self.wanted;
        let inner = stations.iter().rposition(inside).unwrap_or(0);
        (inner, (inner + 1).min(stations.len() - 1))
    }

    /// Where the root of the rise should cross what is wanted, beyond station `inner`: the root is nearly a straight line through the
    /// estimate, so that a parabola through three stations holds it; else the line through two, or their middle.
    fn crossing(&self, stations: &[Station], inner: usize) -> f64 {
        let at = |index: usize| (stations[index].distance, stations[index].root);
        let (a, b) = (at(inner), at((inner + 1).min(stations.len() - 1)));
        let inside = |place: &f64| *place > a.0 && *place < b.0;
        let line = |a: (f64, f64), b: (f64, f64)| a.0 + (self.wanted - a.1) / (b.1 - a.1) * (b.0 - a.0);
        let chord = Some(line(a, b)).filter(inside);
        let third = if inner > 0 { inner - 1 } else { inner + 2 };
        let parabola = (third < stations.len()).then(|| {
            // A. C. Aitken's scheme.
            let c = at(third);
            let (ab, ac) = (line(a, b), line(a, c));
            ab + (self.wanted - b.1) / (c.1 - b.1) * (ac - ab)
        });
        let middle = 0.5 * (a.0 + b.0);
        parabola.filter(inside).or(chord).unwrap_or(middle)
    }

    /// Fits all parameters but `k`, which lies `distance` away from its estimate.
    fn station(&self, k: usize, sign: f64, distance: f64, known: &[Station]) -> Result<Station, Stop> {
        let held = self.search.evaluator.parameters[k].free(self.coordinate(k) + sign * distance);
        let (near, jacobian) = self.near(k, held, known);
        let mut found = Optimum {
            point: self.best_of(near, 1)?.swap_remove(0),
            offset: 0.0,
            ..self.optimum.clone()
        };
        // Without an answer there, it is as good as excluded; without other parameters, there is nothing to fit.
        let others = found.point.free.len() - 1;
        if others > 0 && self.rise(&found.point) < HOPELESS {
            found = self.fit_others(k, found.point, jacobian.clone())?;
            let places = all_over(others, self.scan * others);
            let places = places
                .into_iter()
                .map(|place| place.insert_row(k, held))
                .collect();
            for start in self.best_of(places, STARTS)? {
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
        Descent {
            held: Some(k),
            verified: false,
            tolerance: ROUGH,
            iterations: FEW_ITERATIONS,
            ..self.search.descent(self.optimum.deviance, jacobian)
        }
        .run(start)
    }

    /// The `count` best points of `places`.
    fn best_of(&self, places: Vec<DVector<f64>>, count: usize) -> Result<Vec<Point>, CalibrationError> {
        let mut points = self.search.evaluator.points(places)?;
        points.sort_by(|a, b| self.rise(a).total_cmp(&self.rise(b)));
        points.truncate(count);
        Ok(points)
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
        let far = off(by_distance[0]) > NEAR;
        if far {
            places.push(free.clone());
        }
        for place in &mut places {
            place.apply(|z| {
                *z = if z.is_finite() {
                    z.clamp(-START_REACH, START_REACH)
                } else {
                    0.0
                }
            });
            place[k] = held;
        }
        (places, (!far).then(|| nearest.jacobian.clone()))
    }
}

/// Puts a station in its place.
fn insert(stations: &mut Vec<Station>, station: Station) {
    let place = stations.partition_point(|other| other.distance < station.distance);
    stations.insert(place, station);
}
