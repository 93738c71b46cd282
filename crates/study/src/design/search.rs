//! The search for a design.

use std::sync::Arc;

use super::answer::{ACCURACY, Design};
use super::options::{DesignError, DesignOptions};
use super::runs::{Runs, stiffnesses};
use super::trade_off::{Binding, Limit, Side, TradeOff, out_of_reach, with_duct};
use crate::shared_mesh::{ROUGH, rough};
use creepage_plan::ground::{Ground, road};
use creepage_run::{Error, Limits, Place};
use creepage_scene::Scene;

/// Share of the progress of the rough runs, which come first if the scene's tolerance is below theirs; and by what factor of its limits a
/// rough run leaves open whether they are kept.
const ROUGH_SHARE: f64 = 0.2;
const NEAR: f64 = 1.5;
/// Runs that halve half a decade to that width, at two ends: only the progress depends on it.
const HALVINGS: usize = 14;

/// Finds the stiffnesses within the limits.
///
/// ```
/// use creepage_scene::Scene;
/// use creepage_study::design::{DesignOptions, Limits, Place, design};
///
/// let mut scene = Scene::from_file("../../examples/scenes/full-scale-upper.toml")?;
/// scene.traffic.passes = 2;
/// let limits = Limits::both(Some(100.0), None);
/// let design = design(&scene, &DesignOptions::new(Place::Downstream, limits))?;
/// assert!(design.answer.is_some_and(|answer| answer.force_n <= 100.0));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
///
/// [`DesignError`] if limits or places have no meaning, a run fails, or the limits are kept in
/// several ranges of stiffness.
pub fn design(scene: &Scene, options: &DesignOptions<'_>) -> Result<Design, DesignError> {
    options.check(scene)?;
    scene.validate().map_err(Error::from)?;
    let ground = Arc::new(Ground::new(scene, None, road::reach(scene))?);
    let limits = &options.limits;
    let (runs, rough, chosen) = search(scene, &ground, options)?;
    let curve = runs.points();
    // Between two stiffnesses that keep a limit every other does; the run has the last word.
    let answer = chosen.filter(|answer| answer.within_limits);
    let answer = answer.map(|answer| runs.judged(answer)).transpose()?;
    let nearest = nearest(&curve, |point| point.excess(limits));
    let nearest = answer
        .is_none()
        .then(|| runs.judged(curve[nearest].clone()))
        .transpose()?;
    let kept = kept(&curve);
    let binding = match (&answer, &nearest, kept) {
        (Some(answer), _, Some(kept)) => binding(answer, &curve, kept, &with_duct(limits, scene)),
        (answer, nearest, _) => {
            let found = answer.as_ref().or(nearest.as_ref());
            found.map_or(Vec::new(), |found| found.tightest(limits))
        }
    };
    let range = kept
        .map(|kept| range(&curve, kept))
        .filter(|(from, _)| from.is_finite());
    let all = [&rough[..], &curve].concat();
    Ok(Design {
        title: scene.title.clone(),
        place: options.places[0],
        places: options.places.clone(),
        passes: scene.traffic.passes,
        limits: limits.clone(),
        range_n_per_m: range.map(|(from, to)| (from, Some(to).filter(|to| to.is_finite()))),
        out_of_reach: nearest
            .as_ref()
            .map_or(Vec::new(), |_| out_of_reach(&all, limits)),
        answer,
        nearest,
        binding,
        // Those of the meshes and of the answer too.
        runs: rough.len() + usize::from(!rough.is_empty()) + curve.len() + 2,
        curve,
    })
}

/// The runs of the scene, the rough ones, and what to take of those within all limits. If the
/// curve shows none, bisection finds the stiffness at which the worst limit of softer springs is
/// exceeded by as much as that of stiffer ones.
fn search<'a>(
    scene: &Scene,
    ground: &Arc<Ground>,
    options: &'a DesignOptions<'a>,
) -> Result<(Runs<'a>, Vec<TradeOff>, Option<TradeOff>), DesignError> {
    let limits = &options.limits;
    let mut tried = stiffnesses(scene, options);
    let mut rough_runs = Vec::new();
    let mut progress = options.progress;
    if scene.solver.tolerance < ROUGH {
        let part = progress.part(0.0, ROUGH_SHARE);
        rough_runs = Runs::new(&rough(scene), ground, options, part, tried.len())?.run_all(&tried)?;
        tried = decisive(&rough_runs, limits);
        progress = progress.part(ROUGH_SHARE, 1.0);
    }
    let runs = Runs::new(scene, ground, options, progress, tried.len() + HALVINGS)?;
    let curve = runs.run_all(&tried)?;
    if !out_of_reach(&rough_runs, limits).is_empty() {
        return Ok((runs, rough_runs, None));
    }
    let pieces = curve.chunk_by(|a, b| a.within_limits == b.within_limits);
    match pieces.filter(|piece| piece[0].within_limits).count() {
        0 => approach(&runs, &curve, &with_duct(limits, scene))?,
        1 => {}
        ranges => return Err(DesignError::NotMonotone(ranges)),
    }
    for pair in runs.points().windows(2) {
        let is_upper = |point: &TradeOff| point.within_limits == pair[1].within_limits;
        if !is_upper(&pair[0]) {
            halve(&runs, [&pair[0], &pair[1]], is_upper)?;
        }
    }
    let points = runs.points();
    // No clamp is fixed.
    let stiffest = points.last().map_or(f64::INFINITY, TradeOff::stiffness);
    let chosen = kept(&points).map(|kept| choice(&options.places, range(&points, kept)));
    let chosen = chosen.map(|chosen| runs.run(chosen.min(stiffest))).transpose()?;
    Ok((runs, rough_runs, chosen))
}

/// The place of the point that exceeds limits least.
fn nearest(points: &[TradeOff], excess: impl Fn(&TradeOff) -> f64) -> usize {
    let by_excess = |a: &usize, b: &usize| excess(&points[*a]).total_cmp(&excess(&points[*b]));
    (0..points.len()).min_by(by_excess).unwrap_or_default()
}

/// Stiffnesses that a curve of rough runs leaves open: those near a limit, those whose neighbour is
/// on the other side of one, the best and its neighbours, and both ends of the curve; the best one
/// alone if a limit is out of reach.
fn decisive(curve: &[TradeOff], limits: &Limits) -> Vec<f64> {
    let best = nearest(curve, |point| point.excess(limits));
    let is_hopeless = !out_of_reach(curve, limits).is_empty();
    let is_open = |at: &usize| {
        let around = &curve[at.saturating_sub(1)..(at + 2).min(curve.len())];
        let is_within = curve[*at].within_limits;
        let turns = around.iter().any(|other| other.within_limits != is_within);
        let is_near = (1.0 / NEAR..NEAR).contains(&curve[*at].excess(limits));
        // The search bisects next to the best, which may be the next one on a finer mesh.
        around.len() < 3 || turns || is_near || at.abs_diff(best) <= 2
    };
    let open = (0..curve.len()).filter(|at| if is_hopeless { *at == best } else { is_open(at) });
    open.map(|at| curve[at].stiffness()).collect()
}

/// Bisects, next to the best point of a curve that keeps no limits, for the stiffness at which the
/// worst limit of softer springs is exceeded by as much as that of stiffer ones.
fn approach(runs: &Runs<'_>, curve: &[TradeOff], limits: &[Limit]) -> Result<(), DesignError> {
    let by_share = |point: &TradeOff, a: &Limit, b: &Limit| point.share(*a).total_cmp(&point.share(*b));
    let worst = |point: &TradeOff| limits.iter().copied().max_by(|a, b| by_share(point, a, b));
    let best = nearest(curve, |point| {
        worst(point).map_or(0.0, |limit| point.share(limit))
    });
    let around = [best.saturating_sub(1), (best + 1).min(curve.len() - 1)].map(|at| &curve[at]);
    halve(runs, around, |point| {
        worst(point).is_none_or(|limit| around[1].share(limit) > around[0].share(limit))
    })
}

/// Bisection in ln k between two runs, of which the stiffer one `is_upper`, until they differ by
/// [`ACCURACY`]. Beyond the ends of the curve a stiffness means as little as none, or as much as a
/// fixed end.
fn halve(
    runs: &Runs<'_>,
    ends: [&TradeOff; 2],
    is_upper: impl Fn(&TradeOff) -> bool,
) -> Result<(), DesignError> {
    let [mut softer, mut stiffer] = ends.map(TradeOff::stiffness);
    while softer > 0.0 && stiffer.is_finite() && stiffer > (1.0 + ACCURACY) * softer {
        let middle = (softer * stiffer).sqrt();
        if is_upper(&runs.run(middle)?) {
            stiffer = middle;
        } else {
            softer = middle;
        }
    }
    Ok(())
}

/// The first and the last point within the limits.
fn kept(curve: &[TradeOff]) -> Option<[usize; 2]> {
    let is_kept = |point: &TradeOff| point.within_limits;
    Some([curve.iter().position(is_kept)?, curve.iter().rposition(is_kept)?])
}

/// The stiffnesses from the first to the last point that is kept \[N/m\]; to infinity where the
/// stiffest is.
fn range(curve: &[TradeOff], [first, last]: [usize; 2]) -> (f64, f64) {
    let beyond = curve.get(last + 1);
    let to = beyond.map_or(f64::INFINITY, |_| curve[last].stiffness());
    (curve[first].stiffness(), to)
}

/// The limits that the neighbours of the range exceed.
fn binding(answer: &TradeOff, curve: &[TradeOff], kept: [usize; 2], limits: &[Limit]) -> Vec<Binding> {
    let softer = curve[..kept[0]].last().map(|point| (point, Side::Softer));
    let stiffer = curve.get(kept[1] + 1).map(|point| (point, Side::Stiffer));
    let mut binding = Vec::new();
    for (point, side) in softer.into_iter().chain(stiffer) {
        let exceeded = limits.iter().filter(|limit| point.share(**limit) > 1.0);
        binding.extend(exceeded.map(|limit| answer.binding(*limit, Some(side))));
    }
    binding
}

/// What to take of the stiffnesses that keep the limits. Ends that may be fixed are fixed, and a
/// clamp that is not needed is left out; ends are held as stiffly as the force allows, or in the
/// middle of the range where movement is limited too; clamps alone are as soft as may be.
fn choice(places: &[Place], (from, to): (f64, f64)) -> f64 {
    match to {
        _ if places.iter().all(|place| place.end().is_none()) => from,
        _ if to.is_infinite() || from == 0.0 => to,
        _ => (from * to).sqrt(),
    }
}
