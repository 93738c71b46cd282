//! The passes of a scene on one mesh after the other, until their error is within the tolerance.

use std::sync::atomic::{AtomicU64, Ordering};
use std::thread;

use cable_dem::{CableError, Mesh, Statistics};
use ground_field::DuctMotion;

use super::cable::CableMethod;
use super::error::{self, ErrorParts, Scale, Shares, difference, measured, of_mesh};
use super::passes::{Passes, simulate};
use super::road;
use crate::planner::mesh::Levels;
use crate::{Error, Scene};

/// Nodes eliminated in all passes on one mesh beyond which no finer one is tried: about half a minute.
const MAX_NODE_UPDATES: usize = 2_000_000_000;
/// A mesh twice as fine takes about this many times the node updates.
const REFINEMENT_COST: usize = 4;
/// The coarsest level on which it is seen whether anything slips: 24 nodes a depth.
const SHARP: usize = 3;
/// Share of the tolerance that what the ground model leaves out may take of the force.
const GROUND_SHARE: f64 = 0.5;
/// The first passes tell what the ground model leaves out: this part of all, and at least so many. They are computed twice on the
/// coarsest mesh, which is to cost little beside the run.
const FIRST_PASSES: (u64, u64) = (16, 2);

/// A scene's passes, to be computed on whatever level.
pub struct Ladder<'a> {
    pub scene: &'a Scene,
    pub method: CableMethod,
    pub levels: Levels,
    pub motions: &'a [DuctMotion],
    /// Motions that leave nothing out, where `motions` do.
    pub exact: Option<&'a [DuctMotion]>,
    /// Accuracy of the motions, as a share of their peak.
    pub motion_error: f64,
    /// What the method leaves out, as a share of the force.
    pub method_error: f64,
    pub progress: Option<&'a (dyn Fn(f64) + Sync)>,
    /// Passes at which the cable is looked at.
    pub stages: &'a [u64],
}

/// Passes on the mesh that was good enough.
pub struct Solved {
    pub mesh: Mesh,
    pub passes: Passes,
    pub error: ErrorParts,
    /// Whether the motions left nothing out in the end.
    pub ground_is_exact: bool,
    /// What was found on the way.
    pub reasons: Vec<String>,
    /// Work on all meshes together.
    pub statistics: Statistics,
}

impl Ladder<'_> {
    /// Refines until the estimated error is within the tolerance, unless the scene says how fine to be.
    pub fn climb(mut self, verify: bool, warnings: &mut Vec<String>) -> Result<Solved, Error> {
        let tolerance = self.scene.solver.tolerance;
        let scale = self.scale();
        let mut statistics = Statistics::default();
        let mut reasons = Vec::new();
        let ground = self.ground_error(&mut statistics, &mut reasons)?;
        let mut error = ErrorParts {
            mesh: Shares::default(),
            ground,
            inertia: self.method_error,
            road: Shares::default(),
            measured: verify,
        };
        let within = |error: &ErrorParts| {
            let total = error.total();
            total.force.max(total.movement) <= tolerance
        };

        let mut level = self.levels.first();
        let (finest, coarser) = both(|| self.simulate(level, true), || self.coarser(level))?;
        let mut passes: Vec<Passes> = coarser;
        passes.push(finest);
        loop {
            if passes.len() > 1 {
                error.mesh = of_mesh(&passes, level, scale);
            }
            // A corner of an exact step is about as much work as a node.
            let last = passes.last().map_or(0, |passes| {
                passes.statistics.node_updates + passes.statistics.corners
            });
            let costly = REFINEMENT_COST.saturating_mul(last) > MAX_NODE_UPDATES;
            // One mesh alone tells nothing of its error.
            let told = passes.len() > 1 || self.levels.named();
            // Where nothing slips coarse meshes agree, but they see too little of how sharply the duct bends.
            let still = passes
                .last()
                .is_some_and(|passes| passes.outcomes.iter().all(|o| o.dissipated == 0.0));
            let seen = !still || level >= SHARP;
            if (told && seen && within(&error)) || costly || level >= self.levels.finest() {
                break;
            }
            level += 1;
            passes.push(self.simulate(level, true)?);
        }
        for passes in &passes {
            statistics += passes.statistics;
        }
        // One mesh alone tells nothing; and no mesh that the scene names is refused for what coarser ones say.
        let alone = passes.len() == 1;
        let doubtful = self.levels.named() && error::is_doubtful(error.total().force, tolerance);
        let mesh = self.levels.mesh(level)?;
        let finest = passes.pop().expect("the first level was computed");
        error.road = self.road_error(&finest, level, &mut statistics)?;
        if verify || alone || doubtful {
            if let Some(exact) = self.exact.take() {
                self.motions = exact;
                // Measured with the mesh. An exact model's own error stays: a finer mesh of the cable does not show it.
                error.ground = Shares::default();
            }
            let finer = self.simulate(level + 1, true)?;
            statistics += finer.statistics;
            error.mesh = measured(&finest, &finer, scale);
            error.measured = true;
        }
        self.judge(&error, warnings)?;
        reasons.push(self.mesh_reason(&mesh));
        Ok(Solved {
            mesh,
            passes: finest,
            error,
            ground_is_exact: self.exact.is_none(),
            reasons,
            statistics,
        })
    }

    /// What counts as nothing in this scene.
    fn scale(&self) -> Scale {
        let limit = self.scene.friction_limit();
        let peak = self
            .motions
            .iter()
            .map(DuctMotion::peak_longitudinal)
            .fold(0.0, f64::max);
        Scale::new(limit, peak)
    }

    /// What the ground model leaves out, as it comes through after the first passes on the coarsest mesh. Where it is too much,
    /// the exact motions take over.
    fn ground_error(
        &mut self,
        statistics: &mut Statistics,
        reasons: &mut Vec<String>,
    ) -> Result<Shares, Error> {
        let Some(exact) = self.exact else {
            return Ok(Shares::both(self.motion_error));
        };
        let mut scene = self.scene.clone();
        let (part, least) = FIRST_PASSES;
        scene.traffic.passes = scene.traffic.passes.min(least.max(scene.traffic.passes / part));
        let mut first_passes = |motions, level| {
            let passes = simulate(&scene, self.method, motions, self.levels.mesh(level)?, &[], || {})?;
            *statistics += passes.statistics;
            Ok::<_, Error>(passes)
        };
        // The coarsest mesh that knows anything of the duct.
        let mut coarsest = None;
        for level in (0..self.levels.first()).filter(|&level| self.levels.mesh(level).is_ok()) {
            match first_passes(exact, level) {
                Err(Error::Cable(CableError::CoarseMesh { .. })) => {}
                passes => {
                    coarsest = Some((level, passes?));
                    break;
                }
            }
        }
        let Some((level, passes)) = coarsest else {
            return Ok(Shares::both(self.motion_error));
        };
        let error = difference(&passes, &first_passes(self.motions, level)?, self.scale());
        if error.force.max(error.movement) <= GROUND_SHARE * self.scene.solver.tolerance {
            return Ok(error);
        }
        reasons.push(format!(
            "what the ground model leaves out changes the force by {:.2} %: the exact motion was taken after all",
            100.0 * error.force
        ));
        self.motions = exact;
        self.exact = None;
        Ok(Shares::default())
    }

    /// What an approach that the scene names leaves out: the passes once more on the same mesh, with the vehicles followed far
    /// enough. Where it is far enough already, nothing.
    fn road_error(
        &self,
        passes: &Passes,
        level: usize,
        statistics: &mut Statistics,
    ) -> Result<Shares, Error> {
        let mut scene = self.scene.clone();
        let Some(approach) = scene.solver.approach.take() else {
            return Ok(Shares::default());
        };
        if approach >= road::needed(&scene, self.motions)? {
            return Ok(Shares::default());
        }
        let mesh = self.levels.mesh(level)?;
        let farther = simulate(&scene, self.method, self.motions, mesh, &[], || {})?;
        *statistics += farther.statistics;
        Ok(difference(passes, &farther, self.scale()))
    }

    /// The passes on all levels below `level` that the duct is long enough for, and that are fine enough for its motion.
    fn coarser(&self, level: usize) -> Result<Vec<Passes>, Error> {
        (0..level)
            .filter(|&coarser| self.levels.mesh(coarser).is_ok())
            .map(|coarser| self.simulate(coarser, false))
            .filter(|passes| !matches!(passes, Err(Error::Cable(CableError::CoarseMesh { .. }))))
            .collect()
    }

    /// All passes on `level`; `shown` ones report their progress and their stages.
    fn simulate(&self, level: usize, shown: bool) -> Result<Passes, Error> {
        let done = AtomicU64::new(0);
        simulate(
            self.scene,
            self.method,
            self.motions,
            self.levels.mesh(level)?,
            if shown { self.stages } else { &[] },
            || {
                if let (true, Some(progress)) = (shown, self.progress) {
                    let done = done.fetch_add(1, Ordering::Relaxed) + 1;
                    progress(done as f64 / self.scene.traffic.passes as f64);
                }
            },
        )
    }

    /// Refuses an answer that is none, and warns of one that is not as good as asked.
    fn judge(&self, error: &ErrorParts, warnings: &mut Vec<String>) -> Result<(), Error> {
        let tolerance = self.scene.solver.tolerance;
        let total = error.total();
        error::judge(total.force, tolerance)?;
        for (share, of) in [(total.force, ""), (total.movement, " of the movement")] {
            if share > tolerance {
                warnings.push(format!(
                    "the estimated error{of} of {:.2} % exceeds the tolerance of {:.2} %",
                    100.0 * share,
                    100.0 * tolerance
                ));
            }
        }
        if !self.scene.friction.law.has_memory() {
            warnings.push(
                "the error is of the node spacing alone: the sigmoid's answer is one of its time step".into(),
            );
        }
        Ok(())
    }

    fn mesh_reason(&self, mesh: &Mesh) -> String {
        let depths = format!(
            "node spacing and vehicle step: {:.0} nodes per depth of the duct",
            self.scene.duct.depth / mesh.spacing()
        );
        if self.levels.named() {
            format!("{depths}, as the scene asks")
        } else {
            format!("{depths}; {} % asked", 100.0 * self.scene.solver.tolerance)
        }
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
