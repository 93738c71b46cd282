//! The curve of force against movement, and where it crosses the limits.

use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};

use argmin::core::{CostFunction, Executor};
use argmin::solver::brent::BrentRoot;
use rayon::prelude::*;

use super::limits::{self, DesignError, Place};
use super::options::DesignOptions;
use super::trade_off::{Design, Limit, TradeOff, limited};
use crate::{Error, Progress, RunOptions, Scene};

/// The curve goes from this part of the cable's own stiffness EA/L to its inverse, in half decades.
const DECADES: i32 = 2;
const POINTS_PER_DECADE: i32 = 2;
/// Width of the last bracket around a stiffness, as a share of it.
const ACCURACY: f64 = 0.01;
const MOST_STEPS: u64 = 40;
/// Runs that finding the stiffness at a limit takes, about: only the progress depends on it.
const USUAL_STEPS: usize = 8;
/// Steps to the stiffness nearest to limits that none keeps, to 8 % of it; and the golden section.
const NEAREST_STEPS: usize = 7;
const GOLDEN: f64 = 0.618_033_988_749_894_9;
/// Stiffnesses that differ by less than this share are the same: a logarithm there and back.
const SAME: f64 = 1e-9;

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
/// [`DesignError`] where limits or place have no meaning, a run fails, or a limit is crossed more than once.
pub fn design(scene: &Scene, options: &DesignOptions<'_>) -> Result<Design, DesignError> {
    limits::check(&options.limits)?;
    options.place.check(scene)?;
    let scene = on_one_mesh(scene, options.place, options.progress)?;
    let own = scene.cable.axial_stiffness / scene.duct.length;
    let steps = DECADES * POINTS_PER_DECADE;
    let grid = (-steps..=steps).map(|i| own * 10_f64.powf(f64::from(i) / f64::from(POINTS_PER_DECADE)));
    let last = match options.place {
        Place::Clamp(_) => None,
        _ => Some(f64::INFINITY),
    };
    let stiffnesses: Vec<f64> = [0.0].into_iter().chain(grid).chain(last).collect();
    let limits = limited(&options.limits);
    let search = Search {
        scene: &scene,
        options,
        points: Mutex::new(Vec::new()),
        runs: AtomicUsize::new(0),
        expected_runs: stiffnesses.len() + USUAL_STEPS * limits.len() + 1,
    };
    let curve = stiffnesses
        .par_iter()
        .map(|&stiffness| search.run(stiffness))
        .collect::<Result<Vec<_>, _>>()?;

    let mut range = Some((0.0, f64::INFINITY));
    for limit in &limits {
        let kept = search.kept(&stiffnesses, &curve, limit)?;
        range = range
            .zip(kept)
            .map(|((a, b), (c, d))| (f64::max(a, c), f64::min(b, d)));
    }
    let range = range.filter(|(from, to)| from <= to);
    let answer = range
        .map(|range| search.run(choice(options.place, range)))
        .transpose()?;
    // Between two stiffnesses that keep a limit every other does; the run has the last word.
    let answer = answer.filter(|answer| answer.within_limits);
    let nearest = match answer {
        Some(_) => None,
        None => Some(search.nearest(&stiffnesses, &curve)?),
    };
    let mut points = search.points.into_inner().unwrap_or_default();
    let key = |point: &TradeOff| point.stiffness_n_per_m.unwrap_or(f64::INFINITY);
    points.sort_by(|a, b| key(a).total_cmp(&key(b)));
    Ok(Design {
        title: scene.title.clone(),
        place: options.place,
        passes: scene.traffic.passes,
        limits: options.limits,
        range_n_per_m: range
            .filter(|(from, _)| from.is_finite())
            .map(|(from, to)| (from, to.is_finite().then_some(to))),
        answer,
        nearest,
        curve: points,
    })
}

/// The scene on the mesh that its stiffest variant needs: runs that are to be compared are made on the same one, and where the end
/// is nearly free there is no force whose relative error a finer mesh could make small.
pub(super) fn on_one_mesh(scene: &Scene, place: Place, progress: Progress<'_>) -> Result<Scene, Error> {
    // This run may be stopped, but its share of the work is not counted.
    let options = RunOptions {
        progress: progress.part(0.0, 0.0),
        ..RunOptions::default()
    };
    let plan = match place {
        Place::Clamp(_) => crate::run_with(scene, &options)?.plan,
        _ => crate::run_with(&place.held(scene, f64::INFINITY), &options)?.plan,
    };
    let mut scene = scene.clone();
    scene.solver.node_spacing.get_or_insert(plan.node_spacing_m);
    scene.solver.vehicle_step.get_or_insert(plan.vehicle_step_m);
    Ok(scene)
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

struct Search<'a> {
    scene: &'a Scene,
    options: &'a DesignOptions<'a>,
    points: Mutex<Vec<TradeOff>>,
    runs: AtomicUsize,
    expected_runs: usize,
}

impl Search<'_> {
    fn points(&self) -> MutexGuard<'_, Vec<TradeOff>> {
        self.points.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Runs the scene with this stiffness, or finds the run in what was done.
    fn run(&self, stiffness: f64) -> Result<TradeOff, Error> {
        let stated = stiffness.is_finite().then_some(stiffness);
        let same = |done: Option<f64>| match (done, stated) {
            (Some(a), Some(b)) => (a - b).abs() <= SAME * b,
            (a, b) => a == b,
        };
        if let Some(done) = self.points().iter().find(|point| same(point.stiffness_n_per_m)) {
            return Ok(done.clone());
        }
        let DesignOptions { place, limits, .. } = *self.options;
        let run = crate::run(&place.held(self.scene, stiffness))?;
        let point = TradeOff::of(&run, place, stated, &limits);
        self.points().push(point.clone());
        if let Some(tried) = self.options.tried {
            tried
                .lock()
                .unwrap_or_else(PoisonError::into_inner)
                .push(point.clone());
        }
        let runs = self.runs.fetch_add(1, Ordering::Relaxed) + 1;
        let share = runs as f64 / self.expected_runs as f64;
        self.options.progress.report(share.min(1.0))?;
        Ok(point)
    }

    /// The stiffness whose worst limit is exceeded by the smallest factor: by golden section between the neighbours of the best one.
    fn nearest(&self, stiffnesses: &[f64], curve: &[TradeOff]) -> Result<TradeOff, Error> {
        let excess = |point: &TradeOff| point.excess(&self.options.limits);
        let nearer = |a: &TradeOff, b: &TradeOff| excess(a).total_cmp(&excess(b));
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
                if excess(&self.run(a.exp())?) < excess(&self.run(b.exp())?) {
                    to = b;
                } else {
                    from = a;
                }
            }
        }
        let points = self.points();
        let nearest = points.iter().min_by(|a, b| nearer(a, b));
        Ok(nearest.unwrap_or(&curve[best]).clone())
    }

    /// The least and the largest stiffness within one limit; `None` where there is none.
    fn kept(
        &self,
        stiffnesses: &[f64],
        curve: &[TradeOff],
        limit: &Limit,
    ) -> Result<Option<(f64, f64)>, DesignError> {
        let kept: Vec<bool> = curve.iter().map(|point| limit.share(point) <= 1.0).collect();
        let crossings: Vec<usize> = (1..kept.len()).filter(|&i| kept[i] != kept[i - 1]).collect();
        match crossings[..] {
            [] => Ok(kept[0].then_some((0.0, f64::INFINITY))),
            [at] => {
                let edge = self.edge(stiffnesses[at - 1], stiffnesses[at], kept[at], limit)?;
                Ok(Some(if kept[at] {
                    (edge, f64::INFINITY)
                } else {
                    (0.0, edge)
                }))
            }
            _ => Err(DesignError::NotMonotone {
                what: limit.name(),
                crossings: crossings.len(),
            }),
        }
    }

    /// The last stiffness within the limit, where it is crossed between two.
    fn edge(&self, low: f64, high: f64, kept_above: bool, limit: &Limit) -> Result<f64, DesignError> {
        let safe = if kept_above { high } else { low };
        if low == 0.0 || high.is_infinite() {
            // Beyond the ends of the curve a stiffness means as little as none, or as much as a fixed end.
            return Ok(safe);
        }
        let failed = |error: argmin::core::Error| DesignError::Search(limit.name(), error.to_string().into());
        let solver = BrentRoot::new(low.ln(), high.ln(), ACCURACY);
        Executor::new(Excess(self, limit), solver)
            .configure(|state| state.param(low.ln()).max_iters(MOST_STEPS))
            .run()
            .map_err(failed)?;
        // Brent's last bracket holds a run on either side of the limit: the one that keeps it is the edge.
        let points = self.points();
        let kept = points.iter().filter(|point| limit.share(point) <= 1.0);
        let stiffnesses = kept
            .filter_map(|point| point.stiffness_n_per_m)
            .filter(|stiffness| (low..=high).contains(stiffness));
        let nearer = if kept_above { f64::min } else { f64::max };
        Ok(stiffnesses.fold(safe, nearer))
    }
}

/// By how much a limit is exceeded, over the logarithm of the stiffness.
struct Excess<'a, 'b>(&'a Search<'b>, &'a Limit);

impl CostFunction for Excess<'_, '_> {
    type Param = f64;
    type Output = f64;

    fn cost(&self, logarithm: &f64) -> Result<f64, argmin::core::Error> {
        Ok(self.1.share(&self.0.run(logarithm.exp())?) - 1.0)
    }
}
