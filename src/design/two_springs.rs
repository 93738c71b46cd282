//! Two springs at once.
//!
//! Rough runs over a grid of both stiffnesses tell how everything that is limited depends on them, and between them formulas that are
//! exact for a spring against a spring: 1/u is linear in k, and 1/F in 1/k. On that map the best point is found by looking at all; a
//! run with the scene's own tolerance there scales the map, and the next best point is looked for until map and run agree (space
//! mapping: J. W. Bandler et al., IEEE Trans. Microwave Theory Tech. 42 (1994) 2536). Where that pair exceeds a limit by less than a step of
//! the map may change, finer steps around it are looked at. Every point of the answer is such a run.
//!
//! A map of all stiffnesses finds the best of several valleys, needs no monotony and its runs are made on all cores at once.

use std::sync::Arc;

use rayon::prelude::*;

use super::limits::DesignError;
use super::options::DesignOptions;
use super::runs::{Runs, stiffnesses};
use super::trade_off::{Design, TradeOff, in_duct};
use crate::ground::Ground;
use crate::{CableEnd, Error, Limited, Limits, Place, Progress, Scene};

/// Points of the grid, and of the map, in a decade of stiffness.
const POINTS_PER_DECADE: i32 = 1;
const FINE_PER_DECADE: i32 = 48;
/// Points of the finer steps in a step of the map, on how many such steps to either side, and their runs, at most.
const FINER: i32 = 10;
const STEPS_BESIDE: i32 = 2;
const FINER_RUNS: usize = 6;
/// Tolerance of the rough runs, if the scene's own is not looser, and their share of the progress.
const ROUGH: f64 = 0.05;
const ROUGH_SHARE: f64 = 0.7;
/// Runs with the scene's own tolerance, at most; map and run agree within this share.
const MOST_RUNS: usize = 8;
const AGREES: f64 = 0.01;
/// Within this share of its limit a force is taken to stay within it.
const SAFE: f64 = 0.99;
/// Points whose margins differ by less than this share are equally good.
const EQUAL: f64 = 0.01;

/// Over the `ground` of `scene`, finds the pair with the largest margin to the limits; where no movement is limited, the one with which the ends move least.
pub fn design(
    scene: &Scene,
    ground: &Arc<Ground>,
    options: &DesignOptions<'_>,
) -> Result<Design, DesignError> {
    let (places, limits) = (options.places(), &options.limits);
    let grid = |per_decade| [0, 1].map(|axis: usize| stiffnesses(scene, places[axis], limits, per_decade));
    let levels = grid(POINTS_PER_DECADE);
    let all = levels[0].len() * levels[1].len();
    let mut rough = scene.clone();
    rough.solver.tolerance = scene.solver.tolerance.max(ROUGH);
    let progress = options.progress.part(0.0, ROUGH_SHARE);
    let runs = Runs::new(&rough, ground, options, progress, all + 1)?;
    let points = (0..all)
        .into_par_iter()
        .map(|index| {
            let (row, column) = (index / levels[1].len(), index % levels[1].len());
            runs.run(&[levels[0][row], levels[1][column]])
        })
        .collect::<Result<Vec<_>, _>>()?;
    let rough_runs = runs.count();
    let map = Map {
        points,
        trials: grid(FINE_PER_DECADE),
        levels,
        places: [places[0], places[1]],
        aim: Aim::new(limits, scene),
    };
    let progress: Progress<'_> = options.progress.part(ROUGH_SHARE, 1.0);
    let runs = Runs::new(scene, ground, options, progress, MOST_RUNS + 1)?;
    map.follow(&runs)?;
    map.refine(&runs)?;
    let points = runs.points().clone();
    let best = |points: &mut dyn Iterator<Item = &TradeOff>| {
        let worth = |point: &&TradeOff| map.aim.worth(&map.aim.values(point));
        points.min_by(|a, b| worth(a).total_cmp(&worth(b))).cloned()
    };
    let answer = best(&mut points.iter().filter(|point| point.within_limits));
    let nearer = |a: &&TradeOff, b: &&TradeOff| a.excess(limits).total_cmp(&b.excess(limits));
    let nearest = points.iter().min_by(nearer).filter(|_| answer.is_none());
    let judged = |point: &TradeOff| runs.judged(point);
    let nearest = nearest.map(judged).transpose()?;
    let answer = answer.as_ref().map(judged).transpose()?;
    let found = answer.as_ref().or(nearest.as_ref());
    Ok(Design {
        title: scene.title.clone(),
        place: options.place,
        places,
        passes: scene.traffic.passes,
        limits: limits.clone(),
        range_n_per_m: None,
        binding: found.map_or_else(Vec::new, |found| found.tightest(limits)),
        answer,
        nearest,
        runs: rough_runs + runs.count(),
        curve: runs.into_curve(),
    })
}

/// What is looked for.
struct Aim {
    /// What has to be known of a point: what is limited, and then the movement of the ends, with which they still are in the duct.
    wanted: Vec<(Place, Limited)>,
    limits: Vec<f64>,
    moves_freely: bool,
}

impl Aim {
    fn new(limits: &Limits, scene: &Scene) -> Self {
        let all = || limits.all().chain(in_duct(scene));
        Self {
            wanted: all().map(|(place, quantity, _)| (place, quantity)).collect(),
            limits: all().map(|(.., limit)| limit).collect(),
            moves_freely: limits.all().all(|(_, quantity, _)| quantity == Limited::Force),
        }
    }

    fn values(&self, point: &TradeOff) -> Vec<f64> {
        let value = |&(place, quantity): &(Place, Limited)| point.value(place, quantity);
        self.wanted.iter().map(value).collect()
    }

    /// The largest share of a limit.
    fn excess(&self, values: &[f64]) -> f64 {
        let shares = values
            .iter()
            .zip(&self.limits)
            .map(|(value, limit)| value / limit);
        shares.fold(0.0, f64::max)
    }

    /// What is to be small: the largest share of a limit, or, where only forces are limited and all are kept, the movement of the ends,
    /// which then counts less than any limit that is not.
    fn worth(&self, values: &[f64]) -> f64 {
        let excess = self.excess(values);
        if !self.moves_freely || excess > SAFE {
            return excess;
        }
        let ends = &values[values.len() - CableEnd::ALL.len()..];
        let moved = ends.iter().copied().fold(0.0, f64::max);
        SAFE * moved / (1.0 + moved)
    }
}

/// What is known of all pairs of stiffnesses.
struct Map {
    places: [Place; 2],
    /// Stiffnesses of the grid, ascending; `points` has rows of the second.
    levels: [Vec<f64>; 2],
    points: Vec<TradeOff>,
    /// Stiffnesses that are looked at.
    trials: [Vec<f64>; 2],
    aim: Aim,
}

impl Map {
    /// Runs the best pair, scales the map by that run and goes on, until both agree.
    fn follow(&self, runs: &Runs<'_>) -> Result<(), Error> {
        let mut scale = vec![1.0; self.aim.wanted.len()];
        for _ in 0..MOST_RUNS {
            let (pair, expected) = self.best(&self.trials, &scale);
            if runs.done(&pair).is_some() {
                break;
            }
            let values = self.aim.values(&runs.run(&pair)?);
            let (said, is) = (self.aim.excess(&expected), self.aim.excess(&values));
            if (said - is).abs() <= AGREES * is && (said <= 1.0) == (is <= 1.0) {
                break;
            }
            fit(&mut scale, &expected, &values);
        }
        Ok(())
    }

    /// Looks between the trials where the best run exceeds a limit by less than one step: no value grows faster than a stiffness.
    fn refine(&self, runs: &Runs<'_>) -> Result<(), Error> {
        let mut scale = vec![1.0; self.aim.wanted.len()];
        let excess = |point: &TradeOff| self.aim.excess(&self.aim.values(point));
        let least = |a: &&TradeOff, b: &&TradeOff| excess(a).total_cmp(&excess(b));
        let Some(mut point) = runs.points().iter().min_by(least).cloned() else {
            return Ok(());
        };
        let close = 1.0..=1.0 + step(FINE_PER_DECADE);
        for _ in 0..FINER_RUNS {
            if point.within_limits || !close.contains(&excess(&point)) {
                break;
            }
            let pair = [0, 1].map(|axis: usize| point.springs[axis].stiffness());
            let said = self.values(pair, &scale);
            fit(&mut scale, &said, &self.aim.values(&point));
            let (pair, _) = self.best(&pair.map(around), &scale);
            if runs.done(&pair).is_some() {
                break;
            }
            point = runs.run(&pair)?;
        }
        Ok(())
    }

    /// The best pair of `trials` by the map, each value of it times its `scale`: of equally good ones that with the stiffest ends and the
    /// softest clamps.
    fn best(&self, trials: &[Vec<f64>; 2], scale: &[f64]) -> ([f64; 2], Vec<f64>) {
        let [rows, columns] = trials;
        let pairs: Vec<([usize; 2], Vec<f64>)> = (0..rows.len() * columns.len())
            .into_par_iter()
            .map(|index| {
                let at = [index / columns.len(), index % columns.len()];
                (at, self.values([rows[at[0]], columns[at[1]]], scale))
            })
            .collect();
        let worth = |pair: &&([usize; 2], Vec<f64>)| self.aim.worth(&pair.1);
        let least = pairs
            .iter()
            .map(|pair| worth(&pair))
            .fold(f64::INFINITY, f64::min);
        let most = if least < SAFE {
            ((1.0 + EQUAL) * least).min(SAFE)
        } else {
            least
        };
        let preferred = |pair: &&([usize; 2], Vec<f64>)| -> i64 {
            let sides = self.places.iter().zip(pair.0);
            sides
                .map(|(place, at)| match place {
                    Place::Clamp(_) => -(at as i64),
                    _ => at as i64,
                })
                .sum()
        };
        let good = pairs.iter().filter(|pair| worth(pair) <= most);
        let (at, values) = good.max_by_key(preferred).expect("the least is among them");
        ([rows[at[0]], columns[at[1]]], values.clone())
    }

    /// What is wanted of a pair.
    fn values(&self, pair: [f64; 2], scale: &[f64]) -> Vec<f64> {
        let value = |(&(place, quantity), scale): (&(Place, Limited), &f64)| {
            let sides = [0, 1].map(|axis| between(&self.levels[axis], pair[axis], quantity));
            let mut inverse = 0.0;
            for (row, share) in sides[0] {
                for (column, part) in sides[1] {
                    let weight = share * part;
                    if weight > 0.0 {
                        let point = &self.points[row * self.levels[1].len() + column];
                        inverse += weight / point.value(place, quantity);
                    }
                }
            }
            scale / inverse
        };
        self.aim.wanted.iter().zip(scale).map(value).collect()
    }
}

/// By what share a stiffness differs from the next, so many a decade.
fn step(per_decade: i32) -> f64 {
    10_f64.powf(1.0 / f64::from(per_decade)) - 1.0
}

/// The smallest step, as a share of the stiffness.
pub fn finest_step() -> f64 {
    step(FINE_PER_DECADE * FINER)
}

/// Changes `scale` so that what the map said becomes what is.
fn fit(scale: &mut [f64], said: &[f64], is: &[f64]) {
    for ((scale, said), is) in scale.iter_mut().zip(said).zip(is) {
        if *said > 0.0 && *is > 0.0 {
            *scale *= is / said;
        }
    }
}

/// Finer steps around a stiffness; only itself where there is no spring, or a fixed end.
fn around(stiffness: f64) -> Vec<f64> {
    if stiffness == 0.0 || stiffness.is_infinite() {
        return vec![stiffness];
    }
    let (steps, per_decade) = (STEPS_BESIDE * FINER, f64::from(FINE_PER_DECADE * FINER));
    (-steps..=steps)
        .map(|i| stiffness * 10_f64.powf(f64::from(i) / per_decade))
        .collect()
}

/// The levels on both sides of `stiffness`, with their weights in the mean of the inverse.
fn between(levels: &[f64], stiffness: f64, quantity: Limited) -> [(usize, f64); 2] {
    let above = levels
        .partition_point(|level| *level < stiffness)
        .min(levels.len() - 1);
    let below = above.saturating_sub(1);
    let (low, high) = (levels[below], levels[above]);
    if high <= stiffness || low == 0.0 || high.is_infinite() || above == below {
        return [(above, 1.0), (above, 0.0)];
    }
    let share = match quantity {
        Limited::Movement => (stiffness - low) / (high - low),
        Limited::Force => (1.0 / low - 1.0 / stiffness) / (1.0 / low - 1.0 / high),
    };
    [(below, 1.0 - share), (above, share)]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A spring k in series with one of stiffness c that is compressed by d together: u = c d / (k + c), F = k u.
    #[test]
    fn a_spring_against_a_spring_is_read_exactly() {
        let (c, d) = (3e5, 0.01);
        let levels = [0.0, 1e4, 1e5, 1e6, f64::INFINITY];
        let movement = |k: f64| c * d / (k + c);
        let force = |k: f64| if k.is_infinite() { c * d } else { k * movement(k) };
        for k in [1e4, 2e4, 1e5, 7e5, 1e6, f64::INFINITY] {
            for (quantity, of) in [
                (Limited::Movement, &movement as &dyn Fn(f64) -> f64),
                (Limited::Force, &force),
            ] {
                let inverse: f64 = between(&levels, k, quantity)
                    .into_iter()
                    .filter(|(_, weight)| *weight > 0.0)
                    .map(|(level, weight)| weight / of(levels[level]))
                    .sum();
                let read = 1.0 / inverse;
                assert!((read - of(k)).abs() <= 1e-12 * of(k), "{k} {quantity:?}: {read}");
            }
        }
    }
}
