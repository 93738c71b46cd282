//! Runs of one scene with springs of different stiffness, all on one mesh, none of them twice.

use std::cmp::Ordering;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use rayon::prelude::*;

use super::error::DesignError;
use super::trade_off::{Spring, TradeOff};
use crate::shared_mesh::SharedMesh;
use creepage_plan::ground::Ground;
use creepage_run::{Limits, Place, Progress};
use creepage_scene::Scene;

/// Stiffnesses go from this part of the cable's own stiffness EA/L to its inverse.
const DECADES: i32 = 2;

/// A scene on the mesh that its stiffest variant needs, its ground, and what was run: runs that are
/// to be compared are made on the same ones, and where the end is nearly free there is no force
/// whose relative error a finer mesh could make small.
pub struct Runs<'a> {
    scene: Scene,
    ground: Arc<Ground>,
    mesh: SharedMesh,
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
        let ends = places.iter().filter(|place| place.end().is_some());
        let fixed: Vec<Spring> = ends.map(|place| Spring::new(*place, f64::INFINITY)).collect();
        Ok(Self {
            mesh: SharedMesh::of(&Spring::hold(&fixed, scene)?, ground, progress)?,
            scene: scene.clone(),
            ground: Arc::clone(ground),
            limits,
            progress,
            expected,
            points: Mutex::default(),
        })
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
        let run = self
            .mesh
            .run(&Spring::hold(springs, &self.scene)?, &self.ground)?;
        let point = TradeOff::of(&self.scene, &run, springs, self.limits);
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
        let held = Spring::hold(&point.springs, &self.scene)?;
        let run = self.mesh.judged(&held, &self.ground)?;
        let own = TradeOff::of(&self.scene, &run, &point.springs, self.limits);
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
            orders.fold(Ordering::Equal, Ordering::then)
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
