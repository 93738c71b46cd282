//! One spring: the curve of force against movement, and where it crosses the limits.

use std::sync::Arc;

use rayon::prelude::*;

use super::limits::{self, DesignError};
use super::options::DesignOptions;
use super::pair;
use super::runs::{Runs, stiffnesses};
use super::trade_off::{Binding, Design, Side, TradeOff, in_duct};
use crate::ground::{Ground, road};
use crate::{Error, Limited, Limits, Place, Scene};

/// The curve has points in half decades.
const POINTS_PER_DECADE: i32 = 2;
/// Width of the last bracket around a stiffness, as a share of it.
pub const ACCURACY: f64 = 0.01;
/// Runs that finding the stiffness at a limit takes, about: only the progress depends on it.
const USUAL_STEPS: usize = 8;
/// Steps to the stiffness nearest to limits that none keeps, to 8 % of it; and the golden section.
const NEAREST_STEPS: usize = 7;
const GOLDEN: f64 = 0.618_033_988_749_894_9;

/// A limit and where it is.
pub type Limit = (Place, Limited, f64);

/// Finds the stiffnesses within the limits.
///
/// ```
/// use creepage::Scene;
/// use creepage::design::{DesignOptions, Limits, Place, design};
///
/// let mut scene = Scene::from_file("examples/scenes/full-scale-upper.toml")?;
/// scene.traffic.passes = 2;
/// let limits = Limits::both(Some(100.0), None);
/// let design = design(&scene, &DesignOptions::new(Place::Downstream, limits))?;
/// assert!(design.answer.is_some_and(|answer| answer.force_n <= 100.0));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
///
/// [`DesignError`] where limits or places have no meaning, a run fails, or a limit of one spring is crossed more than once.
pub fn design(scene: &Scene, options: &DesignOptions<'_>) -> Result<Design, DesignError> {
    limits::check(scene, options)?;
    scene.validate().map_err(Error::from)?;
    let ground = Arc::new(Ground::new(scene, None, road::reach(scene))?);
    if options.second.is_some() {
        return pair::design(scene, &ground, options);
    }
    let stiffnesses = stiffnesses(scene, options.place, &options.limits, POINTS_PER_DECADE);
    let limits: Vec<Limit> = options.limits.all().chain(in_duct(scene)).collect();
    let expected = stiffnesses.len() + USUAL_STEPS * limits.len() + 1;
    let runs = Runs::new(scene, &ground, options, options.progress, expected)?;
    let curve = stiffnesses
        .par_iter()
        .map(|&stiffness| runs.run(&[stiffness]))
        .collect::<Result<Vec<_>, _>>()?;
    let search = Search {
        runs: &runs,
        limits: &options.limits,
        stiffnesses: &stiffnesses,
        curve: &curve,
    };
    let widest = search.widest(&limits)?;
    let mut range = widest.map(|_| (stiffnesses[0], f64::INFINITY));
    let mut edges = Vec::new();
    for (limit, widest) in widest
        .iter()
        .flat_map(|widest| limits.iter().map(move |limit| (limit, *widest)))
    {
        let kept = search.kept(limit, widest)?;
        edges.push((limit, kept));
        range = range
            .zip(kept)
            .map(|((a, b), (c, d))| (f64::max(a, c), f64::min(b, d)));
    }
    let range = range.filter(|(from, to)| from <= to);
    let answer = range
        .map(|range| runs.run(&[choice(options.place, range)]))
        .transpose()?;
    // Between two stiffnesses that keep a limit every other does; the run has the last word.
    let answer = answer.filter(|answer| answer.within_limits);
    let answer = answer.map(|answer| runs.judged(&answer)).transpose()?;
    let nearest = match answer {
        Some(_) => None,
        None => Some(runs.judged(&search.nearest()?)?),
    };
    let binding = match (&answer, &nearest) {
        (Some(answer), _) => search.at_the_edges(answer, range, &edges),
        (_, Some(nearest)) => nearest.tightest(&options.limits),
        _ => Vec::new(),
    };
    Ok(Design {
        title: scene.title.clone(),
        place: options.place,
        places: options.places(),
        passes: scene.traffic.passes,
        limits: options.limits.clone(),
        range_n_per_m: range
            .filter(|(from, _)| from.is_finite())
            .map(|(from, to)| (from, to.is_finite().then_some(to))),
        answer,
        nearest,
        binding,
        runs: runs.count(),
        curve: runs.into_curve(),
    })
}

/// What to take of the stiffnesses that keep the limits. An end that may be fixed is fixed, and a clamp that is not needed is left
/// out; an end is held as stiffly as the force allows, or in the middle of the range where movement is limited too; a clamp
/// is as soft as may be.
fn choice(place: Place, (from, to): (f64, f64)) -> f64 {
    match place {
        Place::Clamp(_) => from,
        _ if to.is_infinite() || from == 0.0 => to,
        _ => (from * to).sqrt(),
    }
}

/// Where a curve crosses a limit: between the stiffness of this number and the one before.
enum Crossing {
    AllKeep,
    NoneKeeps,
    StifferKeep(usize),
    SofterKeep(usize),
}

struct Search<'a> {
    runs: &'a Runs<'a>,
    limits: &'a Limits,
    stiffnesses: &'a [f64],
    curve: &'a [TradeOff],
}

impl Search<'_> {
    /// The stiffness whose worst limit is exceeded by the smallest factor: by golden section between the neighbours of the best one.
    fn nearest(&self) -> Result<TradeOff, Error> {
        let excess = |point: &TradeOff| point.excess(self.limits);
        let nearer = |a: &TradeOff, b: &TradeOff| excess(a).total_cmp(&excess(b));
        let Self {
            stiffnesses, curve, ..
        } = self;
        let best = (0..curve.len())
            .min_by(|&a, &b| nearer(&curve[a], &curve[b]))
            .unwrap_or(0);
        let last = curve.len() - 1;
        let (below, above) = (
            stiffnesses[best.saturating_sub(1)],
            stiffnesses[(best + 1).min(last)],
        );
        if below > 0.0 && above.is_finite() {
            let (mut from, mut to) = (below.ln(), above.ln());
            for _ in 0..NEAREST_STEPS {
                let (a, b) = (to - GOLDEN * (to - from), from + GOLDEN * (to - from));
                if excess(&self.runs.run(&[a.exp()])?) < excess(&self.runs.run(&[b.exp()])?) {
                    to = b;
                } else {
                    from = a;
                }
            }
        }
        let points = self.runs.points();
        let nearest = points.iter().min_by(|a, b| nearer(a, b));
        Ok(nearest.unwrap_or(&curve[best]).clone())
    }

    /// The limits that softer and stiffer springs than those of `range` exceed, from the range of each.
    fn at_the_edges(
        &self,
        answer: &TradeOff,
        range: Option<(f64, f64)>,
        edges: &[(&Limit, Option<(f64, f64)>)],
    ) -> Vec<Binding> {
        let (Some((from, to)), first) = (range, self.stiffnesses[0]) else {
            return Vec::new();
        };
        let of = |(limit, kept): &(&Limit, Option<(f64, f64)>)| {
            let (least, most) = (*kept)?;
            if least > first && least == from {
                Some(answer.binding(**limit, Some(Side::Softer)))
            } else if most.is_finite() && most == to {
                Some(answer.binding(**limit, Some(Side::Stiffer)))
            } else {
                None
            }
        };
        edges.iter().filter_map(of).collect()
    }

    /// What of the curve keeps a limit, and where it is crossed.
    fn crossing(&self, limit: &Limit) -> Result<Crossing, DesignError> {
        let kept: Vec<bool> = self
            .curve
            .iter()
            .map(|point| point.share(*limit) <= 1.0)
            .collect();
        let crossings: Vec<usize> = (1..kept.len()).filter(|&i| kept[i] != kept[i - 1]).collect();
        match crossings[..] {
            [] if kept[0] => Ok(Crossing::AllKeep),
            [] => Ok(Crossing::NoneKeeps),
            [at] if kept[at] => Ok(Crossing::StifferKeep(at)),
            [at] => Ok(Crossing::SofterKeep(at)),
            _ => Err(DesignError::NotMonotone {
                what: limit.1.at(limit.0),
                crossings: crossings.len(),
            }),
        }
    }

    /// The stiffnesses beside which nothing keeps all `limits`, as far as the curve shows; `None` where nothing does.
    fn widest(&self, limits: &[Limit]) -> Result<Option<(f64, f64)>, DesignError> {
        let (mut from, mut to) = (self.stiffnesses[0], f64::INFINITY);
        let mut any = true;
        for limit in limits {
            match self.crossing(limit)? {
                Crossing::AllKeep => {}
                Crossing::NoneKeeps => any = false,
                Crossing::StifferKeep(at) => from = from.max(self.stiffnesses[at - 1]),
                Crossing::SofterKeep(at) => to = to.min(self.stiffnesses[at]),
            }
        }
        Ok((any && from < to).then_some((from, to)))
    }

    /// The least and the largest stiffness within one limit, as exactly as it matters where all limits leave what is `widest`.
    fn kept(&self, limit: &Limit, widest: (f64, f64)) -> Result<Option<(f64, f64)>, DesignError> {
        let stiffnesses = self.stiffnesses;
        let edge = |at: usize, kept_above| self.edge(stiffnesses[at - 1], stiffnesses[at], kept_above, limit);
        Ok(match self.crossing(limit)? {
            Crossing::AllKeep => Some((stiffnesses[0], f64::INFINITY)),
            Crossing::NoneKeeps => None,
            Crossing::StifferKeep(at) if stiffnesses[at] <= widest.0 => {
                Some((stiffnesses[at], f64::INFINITY))
            }
            Crossing::StifferKeep(at) => Some((edge(at, true)?, f64::INFINITY)),
            Crossing::SofterKeep(at) if stiffnesses[at - 1] >= widest.1 => {
                Some((stiffnesses[0], stiffnesses[at - 1]))
            }
            Crossing::SofterKeep(at) => Some((stiffnesses[0], edge(at, false)?)),
        })
    }

    /// The last stiffness within the limit, where it is crossed between two: by the law of a spring k against a spring, of which 1/u is linear
    /// in k and 1/F in 1/k, with the Illinois rule where one side is met twice (M. Dowell, P. Jarratt, BIT 11 (1971) 168).
    fn edge(&self, low: f64, high: f64, kept_above: bool, limit: &Limit) -> Result<f64, Error> {
        let room = |stiffness: f64| Ok::<_, Error>(1.0 / self.runs.run(&[stiffness])?.share(*limit) - 1.0);
        let ((mut low, mut below), (mut high, mut above)) = ((low, room(low)?), (high, room(high)?));
        let mut last = None;
        // Beyond the ends of the curve a stiffness means as little as none, or as much as a fixed end.
        while low > 0.0 && high.is_finite() && high > (1.0 + ACCURACY) * low {
            let share = below / (below - above);
            let crossing = match limit.1 {
                _ if !share.is_finite() => (low * high).sqrt(),
                Limited::Movement => low + share * (high - low),
                Limited::Force => 1.0 / (1.0 / low + share * (1.0 / high - 1.0 / low)),
            };
            // Two such steps are less than what is still searched.
            let least = 1.0 + 0.4 * ACCURACY;
            let between = crossing.clamp(low * least, high / least);
            let value = room(between)?;
            let is_above = (value >= 0.0) == kept_above;
            let again = if last.replace(is_above) == Some(is_above) {
                0.5
            } else {
                1.0
            };
            if is_above {
                (high, above, below) = (between, value, again * below);
            } else {
                (low, below, above) = (between, value, again * above);
            }
        }
        Ok(if kept_above { high } else { low })
    }
}
