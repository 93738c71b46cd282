//! Runs of one scene with springs of different stiffness, all on one mesh, none of them twice.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use rayon::prelude::*;

use super::options::{DesignError, DesignOptions};
use super::trade_off::{TradeOff, held};
use crate::shared_mesh::SharedMesh;
use creepage_plan::ground::Ground;
use creepage_run::{Limited, Place, Progress};
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

    /// A run with springs of this stiffness \[N/m\]; to be `judged`, with an error of its own.
    fn made(&self, stiffness: f64, judged: bool) -> Result<TradeOff, DesignError> {
        let held = held(&self.scene, &self.options.places, stiffness)?;
        let run = self.mesh.run(&held, &self.ground, judged)?;
        Ok(TradeOff::of(&self.scene, &run, stiffness, self.options))
    }

    /// Runs the scene with springs of this stiffness \[N/m\], or finds the run in what was done.
    pub fn run(&self, stiffness: f64) -> Result<TradeOff, DesignError> {
        let is_it = |point: &&TradeOff| point.stiffness() == stiffness;
        if let Some(done) = self.done().iter().find(is_it) {
            return Ok(done.clone());
        }
        let point = self.made(stiffness, false)?;
        let mut done = self.done();
        done.push(point.clone());
        let share = done.len() as f64 / self.expected as f64;
        drop(done);
        self.progress.report(share.min(1.0))?;
        Ok(point)
    }

    /// The same of several, on all cores.
    pub fn run_all(&self, stiffnesses: &[f64]) -> Result<Vec<TradeOff>, DesignError> {
        let all = stiffnesses.par_iter();
        all.map(|stiffness| self.run(*stiffness)).collect()
    }

    /// The same `point` with its own error, from a run on coarser meshes and with jumps of its own,
    /// unless its forces so differ just enough to be on the other side of a limit.
    pub fn judged(&self, point: TradeOff) -> Result<TradeOff, DesignError> {
        let own = self.made(point.stiffness(), true)?;
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
    let places = &options.places;
    let own = scene.cable.axial_stiffness / scene.duct.length;
    let steps = DECADES * POINTS_PER_DECADE;
    let step = |i: i32| own * 10_f64.powf(f64::from(i) / f64::from(POINTS_PER_DECADE));
    let needs_clamp = options.limits.all().any(|(place, quantity, _)| {
        let is_it = |varied: &Place| matches!(varied, Place::Clamp(at) if place.is_clamp_at(*at));
        quantity == Limited::Movement && places.iter().any(is_it)
    });
    let are_ends = places.iter().all(|place| place.end().is_some());
    let none = (!needs_clamp).then_some(0.0).into_iter();
    let fixed = are_ends.then_some(f64::INFINITY);
    none.chain((-steps..=steps).map(step)).chain(fixed).collect()
}
