//! The passes of a scene on one mesh after the other, until their error is within the tolerance.

use std::thread;

use cable_dem::{CableError, Mesh, PassOutcome, Statistics};
use ground_field::DuctMotion;

use super::passes::{Passes, simulate};
use crate::answer::error_estimate::{self, ErrorParts, Scale, Shares, difference, measured, of_mesh};
use crate::ground::road;
use crate::plan::{CableMethod, Levels, Plan};
use crate::shown::{exact_percent, percent};
use crate::{Error, Progress, Scene};

/// Nodes eliminated in all passes on one mesh beyond which no finer one is tried: about half a minute.
const MAX_NODE_UPDATES: usize = 2_000_000_000;
/// A mesh twice as fine takes about this many times the node updates.
const REFINEMENT_COST: usize = 4;
/// The coarsest level on which it is seen whether anything slips: 24 nodes a depth.
const SHARP: usize = 3;

/// A plan's passes, on whatever level.
pub struct Refinement<'a> {
    pub plan: &'a Plan<'a>,
    pub method: CableMethod,
    pub progress: Progress<'a>,
    /// Passes at which the cable is looked at.
    pub stages: &'a [u64],
}

/// Passes on the mesh that was good enough.
pub struct Solved {
    pub mesh: Mesh,
    pub passes: Passes,
    pub error: ErrorParts,
    /// What was found on the way.
    pub reasons: Vec<String>,
    /// Work on all meshes together.
    pub statistics: Statistics,
}

impl Refinement<'_> {
    /// Refines until the estimated error is within the tolerance, unless the scene says how fine to be.
    pub fn solve(&self, verify: bool, warnings: &mut Vec<String>) -> Result<Solved, Error> {
        let Plan {
            scene,
            ground,
            choice,
            levels,
            ..
        } = self.plan;
        let tolerance = scene.solver.tolerance;
        let scale = self.scale();
        let mut error = ErrorParts {
            mesh: Shares::default(),
            ground: Shares::both(ground.accuracy),
            inertia: choice.inertia,
            road: Shares::default(),
            measured: false,
        };
        let mut level = levels.first();
        let (finest, mut passes) = both(|| self.simulate(level, true), || self.coarser(level))?;
        passes.push(finest);
        loop {
            if passes.len() > 1 {
                let outcomes: Vec<&[PassOutcome]> = passes.iter().map(|p| &p.outcomes[..]).collect();
                error.mesh = of_mesh(&outcomes, Levels::typical_error(level), scale);
            }
            let last = &passes[passes.len() - 1];
            // A corner of an exact step is about as much work as a node.
            let work = last.statistics.node_updates + last.statistics.corners;
            let costly = REFINEMENT_COST.saturating_mul(work) > MAX_NODE_UPDATES;
            // One mesh alone does not show its error.
            let known = passes.len() > 1 || levels.named();
            // Where nothing slips coarse meshes agree, but they see too little of how sharply the duct bends.
            let still = last.outcomes.iter().all(|outcome| outcome.dissipated == 0.0);
            let seen = !still || level >= SHARP;
            let total = error.total();
            let within = total.force.max(total.movement) <= tolerance;
            if (known && seen && within) || costly || level >= levels.finest() {
                break;
            }
            level += 1;
            passes.push(self.simulate(level, true)?);
        }
        let mut statistics = Statistics::default();
        for passes in &passes {
            statistics += passes.statistics;
        }
        // One mesh alone does not show its error; and no mesh that the scene names is refused for what coarser ones show.
        let alone = passes.len() == 1;
        let doubtful = levels.named() && error_estimate::is_doubtful(error.total().force, tolerance);
        let mesh = levels.mesh(level)?;
        let finest = passes.pop().expect("the first level was computed");
        error.road = self.road_error(&finest, mesh, &mut statistics)?;
        if verify || alone || doubtful {
            let finer = self.simulate(level + 1, true)?;
            statistics += finer.statistics;
            error.mesh = measured(&finest.outcomes, &finer.outcomes, scale);
            error.measured = true;
        }
        self.judge(&error, warnings)?;
        Ok(Solved {
            reasons: vec![self.mesh_reason(&mesh)],
            mesh,
            passes: finest,
            error,
            statistics,
        })
    }

    /// What counts as nothing in this scene.
    fn scale(&self) -> Scale {
        let peaks = self.plan.ground.motions.iter().map(DuctMotion::peak_longitudinal);
        Scale::new(self.plan.scene.friction_limit(), peaks.fold(0.0, f64::max))
    }

    /// What an approach that the scene names leaves out: the passes once more on the same mesh, with the vehicles followed far
    /// enough. Where it is far enough already, nothing.
    fn road_error(&self, passes: &Passes, mesh: Mesh, statistics: &mut Statistics) -> Result<Shares, Error> {
        let motions = &self.plan.ground.motions;
        let Some(approach) = self.plan.scene.solver.approach else {
            return Ok(Shares::default());
        };
        if approach >= road::needed(self.plan.scene, motions)? {
            return Ok(Shares::default());
        }
        let mut scene: Scene = self.plan.scene.clone();
        scene.solver.approach = None;
        let farther = simulate(&scene, self.method, motions, mesh, &[], Progress::default())?;
        *statistics += farther.statistics;
        Ok(difference(&passes.outcomes, &farther.outcomes, self.scale()))
    }

    /// The passes on all levels below `level` that the duct is long enough for, and that are fine enough for its motion.
    fn coarser(&self, level: usize) -> Result<Vec<Passes>, Error> {
        (0..level)
            .filter(|&coarser| self.plan.levels.mesh(coarser).is_ok())
            .map(|coarser| self.simulate(coarser, false))
            .filter(|passes| !matches!(passes, Err(Error::Cable(CableError::CoarseMesh { .. }))))
            .collect()
    }

    /// All passes on `level`; `shown` ones report their progress and their stages.
    fn simulate(&self, level: usize, shown: bool) -> Result<Passes, Error> {
        let Plan {
            scene,
            ground,
            levels,
            ..
        } = self.plan;
        let (stages, progress) = if shown {
            (self.stages, self.progress)
        } else {
            Default::default()
        };
        simulate(
            scene,
            self.method,
            &ground.motions,
            levels.mesh(level)?,
            stages,
            progress,
        )
    }

    /// Refuses an answer that is none, and warns of one that is not as good as asked.
    fn judge(&self, error: &ErrorParts, warnings: &mut Vec<String>) -> Result<(), Error> {
        let scene = self.plan.scene;
        let tolerance = scene.solver.tolerance;
        let total = error.total();
        error_estimate::judge(total.force, tolerance)?;
        for (share, of) in [(total.force, ""), (total.movement, " of the movement")] {
            if share > tolerance {
                let (share, tolerance) = (percent(share), percent(tolerance));
                warnings.push(format!(
                    "the estimated error{of} of {share} exceeds the tolerance of {tolerance}"
                ));
            }
        }
        if !scene.friction.law.has_memory() {
            warnings.push(
                "the error is of the node spacing alone: the sigmoid law's result depends on the time step"
                    .into(),
            );
        }
        Ok(())
    }

    fn mesh_reason(&self, mesh: &Mesh) -> String {
        let Plan { scene, levels, .. } = self.plan;
        let nodes = scene.duct.depth / mesh.spacing();
        let why = if levels.named() {
            "as the scene asks".to_owned()
        } else {
            format!("for the requested {}", exact_percent(scene.solver.tolerance))
        };
        format!("node spacing and vehicle step: {nodes:.0} nodes per duct depth, {why}")
    }
}

/// Runs two computations side by side; the first error wins.
fn both<A: Send, B: Send>(
    first: impl FnOnce() -> Result<A, Error> + Send,
    second: impl FnOnce() -> Result<B, Error> + Send,
) -> Result<(A, B), Error> {
    thread::scope(|scope| {
        let handle = scope.spawn(second);
        let first = first();
        // A panic of the other thread goes on in this one.
        let second = handle
            .join()
            .unwrap_or_else(|panic| std::panic::resume_unwind(panic));
        Ok((first?, second?))
    })
}
