//! One mesh for runs that are compared with each other.

use std::sync::Arc;

use creepage_plan::ground::Ground;
use creepage_run::run::run_over;
use creepage_run::{Error, FixedMesh, Progress, Run, RunOptions};
use creepage_scene::Scene;

/// Tolerance of rough runs, if the scene's own is not looser.
pub const ROUGH: f64 = 0.05;

/// The scene with that tolerance.
pub fn rough(scene: &Scene) -> Scene {
    let mut rough = scene.clone();
    rough.solver.tolerance = scene.solver.tolerance.max(ROUGH);
    rough
}

/// The mesh that one run has needed, and what it has shown of it.
pub struct SharedMesh {
    node_spacing: f64,
    vehicle_step: f64,
    shown: Option<FixedMesh>,
}

impl SharedMesh {
    /// That of a run of `scene` over its `ground`, which `progress` may stop: its share of the work
    /// is not counted.
    pub fn of(scene: &Scene, ground: &Arc<Ground>, progress: Progress<'_>) -> Result<Self, Error> {
        let options = RunOptions {
            progress: progress.part(0.0, 0.0),
            ..RunOptions::default()
        };
        let run = run_over(scene, Arc::clone(ground), &options)?;
        Ok(Self {
            node_spacing: run.plan.node_spacing_m,
            vehicle_step: run.plan.vehicle_step_m,
            shown: run.shown,
        })
    }

    /// Runs `scene`, over its `ground`, on this mesh: with the error that it has shown, or, to be
    /// `judged`, with one of its own, by runs on coarser meshes and with jumps of its own.
    pub fn run(&self, scene: &Scene, ground: &Arc<Ground>, judged: bool) -> Result<Run, Error> {
        let mut scene = scene.clone();
        scene.solver.node_spacing.get_or_insert(self.node_spacing);
        scene.solver.vehicle_step.get_or_insert(self.vehicle_step);
        let options = RunOptions {
            mesh: self.shown.filter(|_| !judged),
            ..RunOptions::default()
        };
        run_over(&scene, Arc::clone(ground), &options)
    }
}
