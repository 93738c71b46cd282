//! One loop over meshes, whatever is simulated on them: simulate, compare with the coarser mesh,
//! judge, refine.

mod judge;

use std::cell::RefCell;

use cable_dem::{CableError, Mesh, Statistics};

use judge::is_refused;
pub use judge::judge;

use crate::Progress;
use crate::answer::FixedMesh;
use crate::answer::differences::{Scale, Shares};
use crate::answer::error_estimate::ErrorParts;
use crate::answer::{HeatRecord, RandomSpread};
use crate::passes::{Passes, RunOptions};
use crate::tuning::meshes::{MIN_SHARE, REFINEMENT_COST, SHARP};
use creepage_plan::tuning::meshes::MAX_NODE_UPDATES;
use creepage_plan::{Error, Levels, Plan, ground::road};
use creepage_scene::Scene;

/// The error relative to the difference to a mesh twice as fine, at second order.
const VERIFIED: f64 = 4.0 / 3.0;

/// Below this tolerance a finer mesh may cost three times as much.
const USUAL: f64 = 0.01;

/// And so many times as much as then, before a run is refused: of six random scenes that were
/// refused for their mesh four are answered, in 23 to 51 s; one is refused after twice the time.
const BEFORE_REFUSAL: usize = 2;

/// What is simulated on one mesh after the other: every pass, passes with jumps, or days.
pub trait OnMeshes {
    /// Simulates the passes of `scene`, which is that of the plan or one like it, on `level`; the
    /// passes on the level below may guide it. Passes that may be the `answer` hold all that an
    /// answer shows.
    fn simulate(
        &self,
        scene: &Scene,
        level: usize,
        below: Option<&Passes>,
        progress: Progress<'_>,
        answer: bool,
    ) -> Result<Passes, Error>;

    /// Difference of passes on two meshes.
    fn difference(&self, one: &Passes, other: &Passes) -> Shares;

    /// What passes that are not simulated leave wrong in `passes`, if that was `found` on another mesh.
    fn passes_error(&self, _passes: &Passes, found: Shares) -> Shares {
        found
    }

    /// Error on `level`, the last of these two or more meshes from coarse to fine.
    fn mesh_error(&self, level: usize, meshes: &[Passes]) -> Shares;
}

/// What all that was simulated has cost.
pub type Work = RefCell<Statistics>;

/// What a run has come to, whatever was simulated: passes on the mesh that was good enough.
pub struct Solved {
    pub level: usize,
    pub mesh: Mesh,
    pub passes: Passes,
    pub error: ErrorParts,
    /// Work on all meshes together.
    pub statistics: Statistics,
    /// What was found on the way.
    pub reasons: Vec<String>,
    pub warnings: Vec<String>,
    pub random: Option<RandomSpread>,
    /// What it has shown of its mesh.
    pub shown: Option<FixedMesh>,
    /// Of a cable that is heated every day.
    pub heat: Option<HeatRecord>,
}

impl Solved {
    /// Passes on the mesh of `level`, and nothing else as yet.
    pub fn new(level: usize, mesh: Mesh, passes: Passes, error: ErrorParts, reason: String) -> Self {
        Self {
            level,
            mesh,
            statistics: passes.statistics,
            passes,
            error,
            reasons: vec![reason],
            warnings: Vec::new(),
            random: None,
            shown: None,
            heat: None,
        }
    }
}

/// The loop over the meshes of a plan.
pub struct MeshLoop<'a, S> {
    pub plan: &'a Plan<'a>,
    pub options: &'a RunOptions<'a>,
    pub simulation: &'a S,
    /// How many levels below the first show its error.
    pub below: usize,
    /// The error of the first mesh, if another run has shown it: then there is no other mesh.
    pub known_error: Option<Shares>,
}

impl<S: OnMeshes> MeshLoop<'_, S> {
    /// Refines from the level `first` on until the tolerance leaves room for the error of the mesh,
    /// or finer meshes cost too much. The other parts of `error` are known but for that of the
    /// road.
    pub fn refine(
        &self,
        first: usize,
        mut progress: Progress<'_>,
        mut error: ErrorParts,
    ) -> Result<Solved, Error> {
        let (plan, simulation) = (self.plan, self.simulation);
        // Mostly the first mesh is good enough.
        let mut next = || progress.next(0.8);
        let (mut level, begin, mut meshes) = (first, next(), Vec::new());
        for level in plan.levels.below(first, self.below).chain([first]) {
            // Each level costs a quarter of the next.
            let share = |level: usize| (REFINEMENT_COST as f64).powi(level as i32 - first as i32 - 1);
            let part = begin.part(share(level), share(level + 1));
            let passes = simulation.simulate(plan.scene, level, meshes.last(), part, level == first);
            meshes.extend(unless_coarse(passes, level < first)?);
        }
        let found = error.passes;
        loop {
            if let Some(last) = meshes.last() {
                error.passes = simulation.passes_error(last, found);
            }
            error.mesh = match self.known_error {
                Some(known) => known,
                None if meshes.len() > 1 => simulation.mesh_error(level, &meshes),
                None => error.mesh,
            };
            if self.is_good_enough(level, &meshes, &error) || !self.may_refine(level, &meshes, &error) {
                break;
            }
            match simulation.simulate(plan.scene, level + 1, meshes.last(), next(), true) {
                // Jumps that fail on this mesh leave the answer of the coarser one.
                Err(Error::Jumps(_)) if self.error_is_known(&meshes) => break,
                finer => meshes.push(finer?),
            }
            level += 1;
        }
        // One mesh alone does not show its error; and no mesh that the scene names is refused for
        // what coarser ones show.
        let alone = meshes.len() == 1 && self.known_error.is_none();
        let passes = meshes.pop().ok_or(Error::NoPass)?;
        let refused = is_refused(&error, plan, &passes);
        if self.options.verify || alone || plan.levels.named && refused {
            let finer = simulation.simulate(plan.scene, level + 1, Some(&passes), next(), true)?;
            error.mesh = simulation.difference(&passes, &finer).times(VERIFIED);
            error.measured = true;
        }
        let motions = &plan.ground.motions;
        if road::approach(plan.scene, motions)? < road::needed(plan.scene, motions)? {
            let mut far = plan.scene.clone();
            far.solver.approach = None;
            let farther = simulation.simulate(&far, level, Some(&passes), progress.still(), false)?;
            error.road = simulation.difference(&passes, &farther);
        }
        let mesh = plan.levels.mesh(level)?;
        Ok(Solved::new(
            level,
            mesh,
            passes,
            error,
            judge::mesh_reason(plan, &mesh),
        ))
    }

    /// Whether the passes on all `meshes` up to `level` leave an `error` of the last that the
    /// tolerance allows.
    fn is_good_enough(&self, level: usize, meshes: &[Passes], error: &ErrorParts) -> bool {
        // If nothing slips coarse meshes agree, but they see too little of how sharply the duct
        // bends.
        let scale = Scale::new(self.plan.scene, &self.plan.ground.motions);
        let still = meshes
            .last()
            .is_some_and(|passes| scale.is_still(&passes.records));
        let others = error.passes + error.days + error.inertia;
        let of_mesh = error.total().less(others);
        // What these, which no finer mesh takes away, leave of the tolerance.
        let tolerance = self.plan.scene.solver.tolerance;
        let least = Shares::both(MIN_SHARE * tolerance.max(others.worse()));
        let allowed = Shares::both(tolerance).less(others).max(least);
        self.error_is_known(meshes) && (!still || level >= SHARP) && of_mesh.is_within(allowed)
    }

    /// Whether there is a mesh after `level` that is not too costly.
    fn may_refine(&self, level: usize, meshes: &[Passes], error: &ErrorParts) -> bool {
        let Some(last) = meshes.last() else {
            return false;
        };
        let most = match () {
            () if is_refused(error, self.plan, last) => BEFORE_REFUSAL * MAX_NODE_UPDATES,
            () if self.plan.scene.solver.tolerance < USUAL => MAX_NODE_UPDATES,
            () => MAX_NODE_UPDATES / 3,
        };
        self.known_error.is_none()
            && REFINEMENT_COST.saturating_mul(last.statistics.work()) <= most
            && level < self.plan.levels.finest
    }

    /// Whether `meshes` show their error: one alone does not.
    fn error_is_known(&self, meshes: &[Passes]) -> bool {
        meshes.len() > 1 || self.plan.levels.named
    }
}

/// What was simulated on the coarsest of `below` levels below `first` that is not too coarse, or on
/// `first`; and that level.
pub fn on_coarse_level(
    levels: &Levels,
    first: usize,
    below: usize,
    mut simulate: impl FnMut(usize) -> Result<Passes, Error>,
) -> Result<(usize, Passes), Error> {
    for level in levels.below(first, below) {
        if let Some(passes) = unless_coarse(simulate(level), true)? {
            return Ok((level, passes));
        }
    }
    Ok((first, simulate(first)?))
}

/// `None` if a mesh that `may_fail` is too coarse for the duct's motion.
fn unless_coarse(passes: Result<Passes, Error>, may_fail: bool) -> Result<Option<Passes>, Error> {
    match passes {
        Err(Error::Cable(CableError::CoarseMesh { .. })) if may_fail => Ok(None),
        passes => passes.map(Some),
    }
}
