//! Runs of one scene with springs of different stiffness, all on one mesh, none of them twice.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use rayon::prelude::*;

use super::error::DesignError;
use super::trade_off::{Spring, TradeOff};
use creepage_plan::ground::Ground;
use creepage_run::{FixedMesh, Limits, Place, Progress, RunOptions, run::run_over};
use creepage_scene::Scene;

/// Stiffnesses go from this part of the cable's own stiffness EA/L to its inverse.
const DECADES: i32 = 2;

/// Tolerance of rough runs, if the scene's own is not looser.
pub const ROUGH: f64 = 0.05;

/// The scene with that tolerance.
pub fn rough(scene: &Scene) -> Scene {
    let mut rough = scene.clone();
    rough.solver.tolerance = scene.solver.tolerance.max(ROUGH);
    rough
}

/// A scene on the mesh that its stiffest variant needs, its ground, and what was run: runs that are
/// to be compared are made on the same ones, and where the end is nearly free there is no force
/// whose relative error a finer mesh could make small.
pub struct Runs<'a> {
    scene: Scene,
    ground: Arc<Ground>,
    /// What the run of the stiffest variant has shown of the mesh.
    shown: Option<FixedMesh>,
    limits: &'a Limits,
    progress: Progress<'a>,
    expected: usize,
    points: Mutex<Vec<TradeOff>>,
}

impl<'a> Runs<'a> {
    /// Finds the mesh by a run of `scene`, over its `ground`, with the ends among `places` fixed.
    /// `expected` runs are all of the progress.
    pub fn new(
        scene: &Scene,
        ground: &Arc<Ground>,
        places: &[Place],
        limits: &'a Limits,
        progress: Progress<'a>,
        expected: usize,
    ) -> Result<Self, DesignError> {
        // This run may be stopped, but its share of the work is not counted.
        let options = RunOptions {
            progress: progress.part(0.0, 0.0),
            ..RunOptions::default()
        };
        let ends = places.iter().filter(|place| place.end().is_some());
        let fixed: Vec<Spring> = ends.map(|place| Spring::new(*place, f64::INFINITY)).collect();
        let stiffest = Spring::hold(&fixed, scene)?;
        let run = run_over(&stiffest, Arc::clone(ground), &options)?;
        let mut scene = scene.clone();
        scene.solver.node_spacing.get_or_insert(run.plan.node_spacing_m);
        scene.solver.vehicle_step.get_or_insert(run.plan.vehicle_step_m);
        Ok(Self {
            scene,
            ground: Arc::clone(ground),
            shown: run.shown,
            limits,
            progress,
            expected,
            points: Mutex::default(),
        })
    }

    fn compute(&self, springs: &[Spring], mesh: Option<FixedMesh>) -> Result<TradeOff, DesignError> {
        let options = RunOptions {
            mesh,
            ..RunOptions::default()
        };
        let held = Spring::hold(springs, &self.scene)?;
        let run = run_over(&held, Arc::clone(&self.ground), &options)?;
        Ok(TradeOff::of(&self.scene, &run, springs, self.limits))
    }

    fn done(&self) -> MutexGuard<'_, Vec<TradeOff>> {
        self.points.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Runs the scene with these springs, or finds the run in what was done.
    pub fn run(&self, springs: &[Spring]) -> Result<TradeOff, DesignError> {
        let done = self.done().iter().find(|point| point.springs == springs).cloned();
        if let Some(done) = done {
            return Ok(done);
        }
        let point = self.compute(springs, self.shown)?;
        self.done().push(point.clone());
        let share = self.count() as f64 / self.expected as f64;
        self.progress.report(share.min(1.0))?;
        Ok(point)
    }

    /// The same of several, on all cores.
    pub fn run_all(&self, springs: Vec<Vec<Spring>>) -> Result<Vec<TradeOff>, DesignError> {
        let springs = springs.into_par_iter();
        springs.map(|springs| self.run(&springs)).collect()
    }

    /// The same `point` with its own error, from a run on coarser meshes and with jumps of its own,
    /// unless its forces so differ just enough to be on the other side of a limit.
    pub fn judged(&self, point: TradeOff) -> Result<TradeOff, DesignError> {
        let own = self.compute(&point.springs, None)?;
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
        self.done().len()
    }

    /// Everything that was run, by growing stiffness.
    pub fn points(&self) -> Vec<TradeOff> {
        let mut points = self.done().clone();
        points.sort_by(|a, b| {
            let pairs = a.springs.iter().zip(&b.springs);
            let orders = pairs.map(|(a, b)| a.stiffness().total_cmp(&b.stiffness()));
            orders.fold(std::cmp::Ordering::Equal, std::cmp::Ordering::then)
        });
        points
    }
}

/// Springs to try at `place`, by growing stiffness, so many a decade: from a free end to a fixed
/// one, from no clamp to a stiff one. Without a clamp it cannot be seen how far the cable moves
/// where it would be, which `limits` may need.
pub fn springs(scene: &Scene, place: Place, limits: &Limits, per_decade: i32) -> Vec<Spring> {
    let own = scene.cable.axial_stiffness / scene.duct.length;
    let steps = DECADES * per_decade;
    let grid = (-steps..=steps).map(|i| own * 10_f64.powf(f64::from(i) / f64::from(per_decade)));
    let mut clamps = limits.clamps.iter();
    let moves = clamps.any(|clamp| clamp.limits.movement_m.is_some() && place.is_clamp_at(clamp.position_m));
    let none = (!moves).then_some(0.0);
    let fixed = place.end().map(|_| f64::INFINITY);
    let stiffnesses = none.into_iter().chain(grid).chain(fixed);
    stiffnesses.map(|k| Spring::new(place, k)).collect()
}
