//! One spring: the curve of force against movement, and the range of stiffness in which it keeps
//! the limits.

use std::sync::Arc;

use super::answer::ACCURACY;
use super::error::DesignError;
use super::request::DesignOptions;
use super::runs::{Found, Runs, stiffnesses};
use super::trade_off::{Limit, Side, TradeOff, with_duct};
use crate::ground::Ground;
use crate::{Error, Place, Scene};

/// The curve has points in half decades.
const POINTS_PER_DECADE: i32 = 2;
/// Runs that halve half a decade to that width, at two ends: only the progress depends on it.
const HALVINGS: usize = 14;

/// The runs of the scene, none of them rough, and the stiffnesses within all limits. Where the
/// curve shows none, the stiffness is halved in on at which the worst limit of softer springs is as
/// far exceeded as that of stiffer ones.
pub fn search<'a>(
    scene: &Scene,
    ground: &Arc<Ground>,
    options: &'a DesignOptions<'a>,
) -> Result<(Runs<'a>, usize, Found), DesignError> {
    let limits = &options.limits;
    let all = with_duct(limits, scene);
    let stiffnesses = stiffnesses(scene, options.place, limits, POINTS_PER_DECADE);
    let expected = stiffnesses.len() + HALVINGS;
    let runs = Runs::new(scene, ground, options, options.progress, expected)?;
    let grid: Vec<Vec<f64>> = stiffnesses.iter().map(|stiffness| vec![*stiffness]).collect();
    let curve = runs.run_all(&grid)?;
    let begins = |i: &usize| curve[*i].within_limits && (*i == 0 || !curve[*i - 1].within_limits);
    match (0..curve.len()).filter(begins).count() {
        0 => approach(&runs, &curve, &all)?,
        1 => {}
        ranges => return Err(DesignError::NotMonotone(ranges)),
    }
    let points = runs.points();
    let is_kept = |point: &TradeOff| point.within_limits;
    let (Some(first), Some(last)) = (points.iter().position(is_kept), points.iter().rposition(is_kept))
    else {
        return Ok((runs, 0, Found::default()));
    };
    let (mut range, mut exceeded) = ((stiffnesses[0], f64::INFINITY), Vec::new());
    let beyond = |point: TradeOff, side| {
        let exceeds = all.iter().filter(move |limit| point.share(**limit) > 1.0);
        exceeds.map(|limit| (*limit, side)).collect::<Vec<_>>()
    };
    if first > 0 {
        let pair = [first - 1, first].map(|at| points[at].clone());
        let [outside, inside] = halve(&runs, pair, is_kept)?;
        range.0 = inside.stiffness();
        exceeded.extend(beyond(outside, Side::Softer));
    }
    if last + 1 < points.len() {
        let pair = [last, last + 1].map(|at| points[at].clone());
        let [inside, outside] = halve(&runs, pair, |point| !is_kept(point))?;
        range.1 = inside.stiffness();
        exceeded.extend(beyond(outside, Side::Stiffer));
    }
    let chosen = Some(runs.run(&[choice(options.place, range)])?);
    let found = Found {
        chosen,
        range: Some(range),
        exceeded,
    };
    Ok((runs, 0, found))
}

/// Halves in, beside the best point of a curve that keeps no limits, on the stiffness at which the
/// worst limit of softer springs is as far exceeded as that of stiffer ones.
fn approach(runs: &Runs<'_>, curve: &[TradeOff], all: &[Limit]) -> Result<(), Error> {
    let worst = |point: &TradeOff| {
        let by_share = |a: &&Limit, b: &&Limit| point.share(**a).total_cmp(&point.share(**b));
        all.iter().max_by(by_share).copied()
    };
    let excess = |i: &usize| worst(&curve[*i]).map_or(0.0, |limit| curve[*i].share(limit));
    let best = (0..curve.len()).min_by(|a, b| excess(a).total_cmp(&excess(b)));
    let best = best.unwrap_or(0);
    let around = [best.saturating_sub(1), (best + 1).min(curve.len() - 1)].map(|at| &curve[at]);
    halve(runs, around.map(Clone::clone), |point| {
        worst(point).is_none_or(|limit| around[1].share(limit) > around[0].share(limit))
    })?;
    Ok(())
}

/// What to take of the stiffnesses that keep the limits. An end that may be fixed is fixed, and a
/// clamp that is not needed is left out; an end is held as stiffly as the force allows, or in the
/// middle of the range where movement is limited too; a clamp is as soft as may be.
fn choice(place: Place, (from, to): (f64, f64)) -> f64 {
    match place {
        Place::Clamp(_) => from,
        _ if to.is_infinite() || from == 0.0 => to,
        _ => (from * to).sqrt(),
    }
}

/// Bisection in ln k between two runs, of which the stiffer one `is_upper`, until they differ by
/// [`ACCURACY`]. Beyond the ends of the curve a stiffness means as little as none, or as much as a
/// fixed end.
fn halve(
    runs: &Runs<'_>,
    [mut low, mut high]: [TradeOff; 2],
    is_upper: impl Fn(&TradeOff) -> bool,
) -> Result<[TradeOff; 2], Error> {
    loop {
        let (softer, stiffer) = (low.stiffness(), high.stiffness());
        if softer == 0.0 || stiffer.is_infinite() || stiffer <= (1.0 + ACCURACY) * softer {
            return Ok([low, high]);
        }
        let middle = runs.run(&[(softer * stiffer).sqrt()])?;
        if is_upper(&middle) {
            high = middle;
        } else {
            low = middle;
        }
    }
}
