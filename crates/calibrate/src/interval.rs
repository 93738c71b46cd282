//! Intervals from the profile likelihood.
//!
//! A parameter is held at a value, all others are fitted anew, and the rise of the deviance above its minimum is compared with the square
//! of Student's t (of Gauss's z where the noise is known), which is the likelihood-ratio test. Such an interval needs no symmetry and may
//! stay open on a side (D. M. Bates, D. G. Watts, Nonlinear Regression Analysis and Its Applications, 1988, section 6.1; A. Raue et al.,
//! Bioinformatics 25, 2009).
//!
//! An end is closed only if the data exclude what lies beyond it, up to the bound, by twice the distance that makes an interval: by four
//! standard errors. For a true value at the bound itself, one such distance would close one of forty intervals by chance.

use crate::descent::Optimum;
use crate::parameter::FARTHEST;
use crate::point::Point;
use crate::search::MAX_ROUNDS;
use crate::station::{Profiler, Station, Stop};

/// Distance at which the bound is excluded, in those that make an interval.
pub(crate) const EXCLUSION: f64 = 2.0;
/// Accuracy of the root of the rise at a station next to an end, as a share of it; a parabola through three stations then has the end
/// ten times as exactly: 1e-3 of the interval at the worst of a hundred (tests/calibration_coverage.rs).
pub(crate) const ACCURACY: f64 = 0.03;
/// Least and largest factors by which the walk outwards goes on: it must not step over a barrier, nor crawl.
const STRIDES: (f64, f64) = (1.3, 2.5);
/// The profile of one parameter.
#[derive(Debug, Default)]
pub(crate) struct Profile {
    /// Lower and upper end in the parameter's coordinate; `None` where the likelihood does not close.
    pub ends: [Option<f64>; 2],
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

impl Profiler<'_> {
    /// The interval of parameter `k`.
    pub fn profile(&self, k: usize) -> Result<Profile, Stop> {
        let here = self.coordinate(k);
        let mut profile = Profile::default();
        for (index, sign) in [-1.0, 1.0].into_iter().enumerate() {
            let mut stations = vec![Station {
                optimum: self.optimum.clone(),
                distance: 0.0,
                root: 0.0,
            }];
            stations.extend(self.at_rival(k, sign));
            let end = self
                .side(k, sign, &mut stations)?
                .map(|distance| here + sign * distance);
            profile.ends[index] = end;
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
            let curve = stations.iter().skip(index);
            profile
                .curve
                .extend(curve.map(|station| (here + sign * station.distance, station.root.powi(2))));
        }
        profile.curve.sort_by(|a, b| a.0.total_cmp(&b.0));
        Ok(profile)
    }

    /// The rival, if it lies on this side.
    fn at_rival(&self, k: usize, sign: f64) -> Option<Station> {
        let rival = self.rival?;
        let coordinate = self.parameter(k).bounded(rival.free[k]);
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

    /// Distance of the end on one side, where it is closed. `stations` are those known, by distance, and stay so; the bound is the last.
    fn side(&self, k: usize, sign: f64, stations: &mut Vec<Station>) -> Result<Option<f64>, Stop> {
        let parameter = self.parameter(k);
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
            let width = outer.distance - inner.distance;
            let narrow = width < ACCURACY * outer.distance;
            // Beyond an infinite rise the model has no answer.
            if near(inner) || near(outer) || (narrow && outer.root.is_infinite()) {
                return Ok(Some(place));
            }
            if narrow {
                // The rise has no jumps: where it seems to, the others are stuck, unless from here they find the way.
                let again = self.station(k, sign, outer.distance, std::slice::from_ref(inner))?;
                if again.root < outer.root {
                    let index = stations.partition_point(|other| other.distance < again.distance);
                    stations[index] = again;
                    continue;
                }
            }
            let middle = inner.distance + 0.5 * width;
            let next = if round % 3 == 2 { middle } else { place };
            let station = self.station(k, sign, next, stations)?;
            insert(stations, station);
        }
        // Where the others are stuck, nothing is excluded.
        Ok(None)
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
}

fn insert(stations: &mut Vec<Station>, station: Station) {
    let place = stations.partition_point(|other| other.distance < station.distance);
    stations.insert(place, station);
}
