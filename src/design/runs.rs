//! Runs of one scene with springs of different stiffness, all on one mesh, none of them twice.

use std::sync::{Arc, Mutex, PoisonError};

use rayon::prelude::*;

use super::request::DesignOptions;
use super::trade_off::{Limit, Side, Spring, TradeOff};
use crate::ground::Ground;
use crate::run::{run_over, run_shown};
use crate::{Error, FixedMesh, Limits, Place, Progress, RunOptions, Scene};

/// Stiffnesses go from this part of the cable's own stiffness EA/L to its inverse.
const DECADES: i32 = 2;

/// A scene on the mesh that its stiffest variant needs, and its ground: runs that are to be
/// compared are made on the same ones, and where the end is nearly free there is no force whose
/// relative error a finer mesh could make small.
pub struct OneMesh {
    scene: Scene,
    ground: Arc<Ground>,
    /// What the run of the stiffest variant has shown of it.
    shown: Option<FixedMesh>,
}

impl OneMesh {
    /// Finds the mesh by a run of `scene`, over its `ground`, with the ends among `places` fixed.
    pub fn new(
        scene: &Scene,
        ground: &Arc<Ground>,
        places: &[Place],
        progress: Progress<'_>,
    ) -> Result<Self, Error> {
        // This run may be stopped, but its share of the work is not counted.
        let options = RunOptions {
            progress: progress.part(0.0, 0.0),
            ..RunOptions::default()
        };
        let ends = places.iter().filter(|place| place.end().is_some());
        let fixed: Vec<Spring> = ends.map(|place| Spring::new(*place, f64::INFINITY)).collect();
        let stiffest = Spring::hold(&fixed, scene)?;
        let (run, shown) = run_shown(&stiffest, Arc::clone(ground), &options)?;
        let mut scene = scene.clone();
        scene.solver.node_spacing.get_or_insert(run.plan.node_spacing_m);
        scene.solver.vehicle_step.get_or_insert(run.plan.vehicle_step_m);
        Ok(Self {
            scene,
            ground: Arc::clone(ground),
            shown,
        })
    }

    /// Runs the scene with `springs`, on coarser meshes too where its own error `is_judged`.
    pub fn run(&self, springs: &[Spring], limits: &Limits, is_judged: bool) -> Result<TradeOff, Error> {
        let options = RunOptions {
            mesh: self.shown.filter(|_| !is_judged),
            ..RunOptions::default()
        };
        let held = Spring::hold(springs, &self.scene)?;
        let run = run_over(&held, Arc::clone(&self.ground), &options)?;
        Ok(TradeOff::of(&self.scene, &run, springs, limits))
    }
}

/// What was run, and what is needed to run more.
pub struct Runs<'a> {
    mesh: OneMesh,
    places: Vec<Place>,
    limits: &'a Limits,
    progress: Progress<'a>,
    expected: usize,
    points: Mutex<Vec<TradeOff>>,
}

/// What a search has found.
#[derive(Default)]
pub struct Found {
    /// What to take, if anything keeps the limits.
    pub chosen: Option<TradeOff>,
    /// Of one spring, the stiffnesses within all limits \[N/m\].
    pub range: Option<(f64, f64)>,
    /// The limits that springs beside that range exceed.
    pub exceeded: Vec<(Limit, Side)>,
}

impl<'a> Runs<'a> {
    /// Of `scene` over its `ground`; `expected` runs are all of the progress.
    pub fn new(
        scene: &Scene,
        ground: &Arc<Ground>,
        options: &'a DesignOptions<'a>,
        progress: Progress<'a>,
        expected: usize,
    ) -> Result<Self, Error> {
        let places = options.places();
        Ok(Self {
            mesh: OneMesh::new(scene, ground, &places, progress)?,
            places,
            limits: &options.limits,
            progress,
            expected,
            points: Mutex::default(),
        })
    }

    /// Runs the scene with a spring of these stiffnesses \[N/m\] at each place, or finds the run in
    /// what was done.
    pub fn run(&self, stiffnesses: &[f64]) -> Result<TradeOff, Error> {
        let locked = || self.points.lock().unwrap_or_else(PoisonError::into_inner);
        let springs = self.places.iter().zip(stiffnesses);
        let springs: Vec<Spring> = springs.map(|(place, k)| Spring::new(*place, *k)).collect();
        let done = locked().iter().find(|point| point.springs == springs).cloned();
        if let Some(done) = done {
            return Ok(done);
        }
        let point = self.mesh.run(&springs, self.limits, false)?;
        locked().push(point.clone());
        let share = self.count() as f64 / self.expected as f64;
        self.progress.report(share.min(1.0))?;
        Ok(point)
    }

    /// The same of several stiffnesses, on all cores.
    pub fn run_all(&self, stiffnesses: &[Vec<f64>]) -> Result<Vec<TradeOff>, Error> {
        stiffnesses.par_iter().map(|each| self.run(each)).collect()
    }

    /// The same `point` with its own error, from a run on coarser meshes and with jumps of its own,
    /// unless its forces so differ just enough to be on the other side of a limit.
    pub fn judged(&self, point: TradeOff) -> Result<TradeOff, Error> {
        let own = self.mesh.run(&point.springs, self.limits, true)?;
        if own.within_limits == point.within_limits {
            return Ok(own);
        }
        let error_estimate = own.error_estimate;
        Ok(TradeOff {
            error_estimate,
            ..point
        })
    }

    /// How many were made.
    pub fn count(&self) -> usize {
        self.points.lock().unwrap_or_else(PoisonError::into_inner).len()
    }

    /// Everything that was run, by growing stiffness.
    pub fn points(&self) -> Vec<TradeOff> {
        let points = self.points.lock().unwrap_or_else(PoisonError::into_inner);
        let mut points = points.clone();
        points.sort_by(|a, b| {
            let pairs = a.springs.iter().zip(&b.springs);
            let orders = pairs.map(|(a, b)| a.stiffness().total_cmp(&b.stiffness()));
            orders.fold(std::cmp::Ordering::Equal, std::cmp::Ordering::then)
        });
        points
    }
}

/// Stiffnesses to try at `place` \[N/m\], ascending, so many a decade: from a free end to a fixed
/// one, from no clamp to a stiff one. Without a clamp it cannot be seen how far the cable moves
/// where it would be, which `limits` may need.
pub fn stiffnesses(scene: &Scene, place: Place, limits: &Limits, per_decade: i32) -> Vec<f64> {
    let own = scene.cable.axial_stiffness / scene.duct.length;
    let steps = DECADES * per_decade;
    let grid = (-steps..=steps).map(|i| own * 10_f64.powf(f64::from(i) / f64::from(per_decade)));
    let moves = |position: f64| {
        let mut limited = limits
            .clamps
            .iter()
            .filter(|clamp| clamp.limits.movement_m.is_some());
        limited.any(|clamp| Place::Clamp(clamp.position_m).is_clamp_at(position))
    };
    let (first, last) = match place {
        Place::Clamp(position) => ((!moves(position)).then_some(0.0), None),
        _ => (Some(0.0), Some(f64::INFINITY)),
    };
    first.into_iter().chain(grid).chain(last).collect()
}
