//! Runs of one scene with springs of different stiffness, all on one mesh, none of them twice.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use rayon::prelude::*;

use super::options::{DesignError, DesignOptions};
use super::trade_off::{TradeOff, held};
use crate::shared_mesh::SharedMesh;
use creepage_plan::ground::Ground;
use creepage_run::{Place, Progress};
use creepage_scene::Scene;

/// Stiffnesses go from this part of the cable's own stiffness EA/L to its inverse.
const DECADES: i32 = 2;
/// Points of the curve in a decade.
const POINTS_PER_DECADE: i32 = 2;

/// A scene on the mesh that its stiffest variant needs, its ground, and what was run: runs that are
/// to be compared are made on the same ones, and where the end is nearly free there is no force
/// whose relative error a finer mesh could make small.
pub struct Runs<'a> {
    scene: Scene,
    ground: Arc<Ground>,
    mesh: SharedMesh,
    options: &'a DesignOptions<'a>,
    progress: Progress<'a>,
    expected: usize,
    points: Mutex<Vec<TradeOff>>,
}

impl<'a> Runs<'a> {
    /// Finds the mesh by a run of `scene`, over its `ground`, with the ends that are varied fixed.
    /// `expected` runs are all of the progress.
    pub fn new(
        scene: &Scene,
        ground: &Arc<Ground>,
        options: &'a DesignOptions<'a>,
        progress: Progress<'a>,
        expected: usize,
    ) -> Result<Self, DesignError> {
        let ends = options.places.iter().filter(|place| place.end().is_some());
        let ends: Vec<Place> = ends.copied().collect();
        let stiffest = held(scene, &ends, f64::INFINITY)?;
        Ok(Self {
            mesh: SharedMesh::of(&stiffest, ground, progress)?,
            scene: scene.clone(),
            ground: Arc::clone(ground),
            options,
            progress,
            expected,
            points: Mutex::default(),
        })
    }

    fn done(&self) -> MutexGuard<'_, Vec<TradeOff>> {
        self.points.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Runs the scene with springs of this stiffness \[N/m\], or finds the run in what was done.
    pub fn run(&self, stiffness: f64) -> Result<TradeOff, DesignError> {
        let done = self
            .done()
            .iter()
            .find(|point| point.stiffness() == stiffness)
            .cloned();
        if let Some(done) = done {
            return Ok(done);
        }
        let held = held(&self.scene, &self.options.places, stiffness)?;
        let run = self.mesh.run(&held, &self.ground)?;
        let point = TradeOff::of(&self.scene, &run, stiffness, self.options);
        self.done().push(point.clone());
        let share = self.done().len() as f64 / self.expected as f64;
        self.progress.report(share.min(1.0))?;
        Ok(point)
    }

    /// The same of several, on all cores.
    pub fn run_all(&self, stiffnesses: &[f64]) -> Result<Vec<TradeOff>, DesignError> {
        stiffnesses
            .par_iter()
            .map(|stiffness| self.run(*stiffness))
            .collect()
    }

    /// The same `point` with its own error, from a run on coarser meshes and with jumps of its own,
    /// unless its forces so differ just enough to be on the other side of a limit.
    pub fn judged(&self, point: TradeOff) -> Result<TradeOff, DesignError> {
        let held = held(&self.scene, &self.options.places, point.stiffness())?;
        let run = self.mesh.judged(&held, &self.ground)?;
        let own = TradeOff::of(&self.scene, &run, point.stiffness(), self.options);
        if own.within_limits == point.within_limits {
            return Ok(own);
        }
        let error_estimate = own.error_estimate;
        Ok(TradeOff {
            error_estimate,
            ..point
        })
    }

    /// Everything that was run, by growing stiffness.
    pub fn points(&self) -> Vec<TradeOff> {
        let mut points = self.done().clone();
        points.sort_by(|a, b| a.stiffness().total_cmp(&b.stiffness()));
        points
    }
}

/// Stiffnesses to try \[N/m\], ascending: from free ends to fixed ones, from no clamp to a stiff one.
/// Without a clamp it cannot be seen how far the cable moves where it would be, which a limit may
/// need.
pub fn stiffnesses(scene: &Scene, options: &DesignOptions<'_>) -> Vec<f64> {
    let (places, limits) = (&options.places, &options.limits);
    let own = scene.cable.axial_stiffness / scene.duct.length;
    let steps = DECADES * POINTS_PER_DECADE;
    let step = |i: i32| own * 10_f64.powf(f64::from(i) / f64::from(POINTS_PER_DECADE));
    let is_varied = |position| places.iter().any(|place| place.is_clamp_at(position));
    let mut clamps = limits.clamps.iter();
    let moves = clamps.any(|clamp| clamp.limits.movement_m.is_some() && is_varied(clamp.position_m));
    let are_ends = places.iter().all(|place| place.end().is_some());
    let none = (!moves).then_some(0.0);
    let fixed = are_ends.then_some(f64::INFINITY);
    none.into_iter()
        .chain((-steps..=steps).map(step))
        .chain(fixed)
        .collect()
}
