//! Two springs at once.
//!
//! Rough runs over a grid of both stiffnesses tell how everything that is limited depends on them,
//! and between them it is read as of a spring against a spring. On that map the best point is found by looking at all; a run with the scene's own
//! tolerance there scales the map, and the next best point is looked for until map and run agree
//! (space mapping: J. W. Bandler et al., IEEE Trans. Microwave Theory Tech. 42 (1994) 2536). Every
//! point of the answer is such a run.
//!
//! A map of all stiffnesses finds the best of several valleys, needs no monotony and its runs are
//! made on all cores at once.

use std::sync::Arc;

use rayon::prelude::*;

use super::error::DesignError;
use super::options::DesignOptions;
use super::runs::{Runs, springs};
use super::trade_off::{Limit, Spring, TradeOff, out_of_reach, with_duct};
use crate::shared_mesh::rough;
use crate::springs::read;
use creepage_plan::ground::Ground;
use creepage_run::{Limited, Place};
use creepage_scene::Scene;

/// Points of the grid, and of the map, in a decade of stiffness.
const POINTS_PER_DECADE: i32 = 1;
const FINE_PER_DECADE: i32 = 48;
/// Steps into which one of the map is divided around its best point.
const FINER: i32 = 10;
/// Share of the progress that the rough runs have.
const ROUGH_SHARE: f64 = 0.7;
/// Runs with the scene's own tolerance, at most; map and run agree within this share.
const MOST_RUNS: usize = 10;
const AGREES: f64 = 0.01;
/// Within this share of its limit a force is taken to stay within it.
const SAFE: f64 = 0.99;
/// Points whose margins differ by less than this share are equally good.
const EQUAL: f64 = 0.01;

/// The runs of the scene, the rough ones, and the pair with the largest margin to
/// the limits; where no movement is limited, the one with which the ends move least.
pub fn search<'a>(
    scene: &Scene,
    ground: &Arc<Ground>,
    places: [Place; 2],
    options: &'a DesignOptions<'a>,
) -> Result<(Runs<'a>, Vec<TradeOff>, Option<TradeOff>), DesignError> {
    let limits = &options.limits;
    let grid = |per_decade| places.map(|place| springs(scene, place, limits, per_decade));
    let levels = grid(POINTS_PER_DECADE);
    let mut pairs = Vec::new();
    for first in &levels[0] {
        pairs.extend(levels[1].iter().map(|second| vec![*first, *second]));
    }
    let progress = options.progress.part(0.0, ROUGH_SHARE);
    let rough_runs = Runs::new(&rough(scene), ground, &places, limits, progress, pairs.len())?;
    let map = Map {
        points: rough_runs.run_all(pairs)?,
        levels: levels.map(|springs| stiffnesses(&springs)),
        places,
        limits: with_duct(limits, scene),
        moves_freely: limits.all().all(|(_, quantity, _)| quantity == Limited::Force),
    };
    let progress = options.progress.part(ROUGH_SHARE, 1.0);
    let runs = Runs::new(scene, ground, &places, limits, progress, MOST_RUNS)?;
    let trials = grid(FINE_PER_DECADE).map(|springs| stiffnesses(&springs));
    let mut scale = vec![1.0; map.limits.len()];
    let is_hopeless = !out_of_reach(&map.points, limits).is_empty();
    for count in 0..if is_hopeless { 1 } else { MOST_RUNS } {
        let rough = map.best(&trials, &scale);
        let pair = map.best(&rough.map(around), &scale);
        let expected = map.shares(pair, &scale);
        let springs = [0, 1].map(|at| Spring::new(places[at], pair[at]));
        let shares = map.shares_of(&runs.run(&springs)?);
        let (said, is) = (largest(&expected), largest(&shares));
        let agree = (said - is).abs() <= AGREES * is && (said <= 1.0) == (is <= 1.0);
        // A run that was done says nothing new.
        if agree || runs.count() == count {
            break;
        }
        for ((scale, said), is) in scale.iter_mut().zip(expected).zip(shares) {
            if said > 0.0 && is > 0.0 {
                *scale *= is / said;
            }
        }
    }
    let badness = |point: &TradeOff| map.badness(&map.shares_of(point));
    let kept = runs.points().into_iter().filter(|point| point.within_limits);
    let chosen = kept.min_by(|a, b| badness(a).total_cmp(&badness(b)));
    Ok((runs, map.points, chosen))
}

fn largest(shares: &[f64]) -> f64 {
    shares.iter().copied().fold(0.0, f64::max)
}

fn stiffnesses(springs: &[Spring]) -> Vec<f64> {
    springs.iter().map(Spring::stiffness).collect()
}

/// What is known of all pairs of stiffnesses.
struct Map {
    places: [Place; 2],
    /// Stiffnesses of the grid, ascending; `points` has rows of the second.
    levels: [Vec<f64>; 2],
    points: Vec<TradeOff>,
    /// All limits, last the movements of the ends with which they still are in the duct.
    limits: Vec<Limit>,
    /// Whether only forces are limited.
    moves_freely: bool,
}

impl Map {
    fn shares_of(&self, point: &TradeOff) -> Vec<f64> {
        self.limits.iter().map(|limit| point.share(*limit)).collect()
    }

    /// What is to be small: the largest share of a limit, or, where only forces are limited and all
    /// are kept, the movement of the ends, which then counts less than any limit that is not.
    fn badness(&self, shares: &[f64]) -> f64 {
        let excess = largest(shares);
        if !self.moves_freely || excess > SAFE {
            return excess;
        }
        let moved = largest(&shares[shares.len() - 2..]);
        SAFE * moved / (1.0 + moved)
    }

    /// The best pair of these stiffnesses by the map, each share of it times its `scale`. Of equally
    /// good pairs that with the stiffest ends and the softest clamps.
    fn best(&self, [firsts, seconds]: &[Vec<f64>; 2], scale: &[f64]) -> [f64; 2] {
        let place = |index: usize| [index / seconds.len(), index % seconds.len()];
        let pair = |[first, second]: [usize; 2]| [firsts[first], seconds[second]];
        let all = (0..firsts.len() * seconds.len()).into_par_iter();
        let badness = all.map(|index| self.badness(&self.shares(pair(place(index)), scale)));
        let badness: Vec<f64> = badness.collect();
        let least = badness.iter().copied().fold(f64::INFINITY, f64::min);
        let most = least.max(((1.0 + EQUAL) * least).min(SAFE));
        let preferred = |index: &usize| -> i64 {
            let signed = |(held, at): (&Place, usize)| held.end().map_or(-(at as i64), |_| at as i64);
            self.places.iter().zip(place(*index)).map(signed).sum()
        };
        let good = (0..badness.len()).filter(|index| badness[*index] <= most);
        let best = good.max_by_key(preferred);
        best.map_or([0.0; 2], |index| pair(place(index)))
    }

    /// The shares of all limits of a pair.
    fn shares(&self, pair: [f64; 2], scale: &[f64]) -> Vec<f64> {
        let [rows, columns] = &self.levels;
        let share = |(&limit, scale): (&Limit, &f64)| {
            let of_row = |row: usize| {
                let of_pair = |column: usize| self.points[row * columns.len() + column].share(limit);
                read(columns, pair[1], limit.1, of_pair)
            };
            scale * read(rows, pair[0], limit.1, of_row)
        };
        self.limits.iter().zip(scale).map(share).collect()
    }
}

/// Finer steps around a stiffness, to the next of the map; only itself where there is no spring, or
/// a fixed end.
fn around(stiffness: f64) -> Vec<f64> {
    if stiffness == 0.0 || stiffness.is_infinite() {
        return vec![stiffness];
    }
    let finer = |i| stiffness * 10_f64.powf(f64::from(i) / f64::from(FINE_PER_DECADE * FINER));
    (-FINER..=FINER).map(finer).collect()
}
