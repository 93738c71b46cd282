//! One loop over meshes, whatever is simulated on them: simulate, compare with the coarser mesh,
//! judge, refine.

use cable_dem::{CableError, Mesh, Statistics};

use super::budget::{allowed, max_node_updates};
use crate::answer::differences::Shares;
use crate::answer::error_estimate::{self, ErrorParts};
use crate::plan::Plan;
use crate::tuning::meshes::{MAX_NODE_UPDATES, REFINEMENT_COST, SHARP, VERIFIED};
use crate::{Error, Progress};

/// What is simulated on one mesh after the other.
pub trait OnMeshes {
    /// What it gives on one mesh.
    type Outcome;

    /// Simulates on `level`, given the outcome on the level below if that is known. An outcome that
    /// may be the `answer` holds all that an answer shows.
    fn simulate(
        &self,
        level: usize,
        below: Option<&Self::Outcome>,
        progress: Progress<'_>,
        answer: bool,
    ) -> Result<Self::Outcome, Error>;

    /// The outcome on `level` if it is known already, and its work counted.
    fn known(&self, level: usize) -> Option<Self::Outcome>;

    /// How many levels below `first` show the error of the first.
    fn levels_below(&self, first: usize) -> usize;

    /// Difference of outcomes on two meshes.
    fn difference(&self, one: &Self::Outcome, other: &Self::Outcome) -> Shares;

    /// Error on `level`, the last of these `outcomes` on two or more meshes from coarse to fine.
    fn mesh_error(&self, level: usize, outcomes: &[Self::Outcome]) -> Shares;

    /// Whether nothing slips in it.
    fn is_still(&self, outcome: &Self::Outcome) -> bool;

    /// What it has cost.
    fn work(outcome: &Self::Outcome) -> Statistics;
}

/// An outcome on the mesh that was good enough, and what all meshes have cost.
pub struct Refined<O> {
    pub level: usize,
    pub mesh: Mesh,
    pub outcome: O,
    pub statistics: Statistics,
}

/// The loop over the meshes of a plan.
pub struct MeshLoop<'a> {
    pub plan: &'a Plan<'a>,
    /// Whether a finer run is to measure the error of the mesh.
    pub verify: bool,
    /// The part of the progress that is its own.
    pub progress: Progress<'a>,
    /// The error of the first mesh, if another run has shown it: then there is no other mesh.
    pub known_error: Option<Shares>,
}

impl MeshLoop<'_> {
    /// Refines from `first` on until the tolerance leaves room for the error of the mesh, or finer
    /// meshes cost too much. The other parts of `error` are known but for that of the road.
    pub fn refine<S: OnMeshes>(
        &self,
        simulation: &S,
        first: usize,
        error: &mut ErrorParts,
    ) -> Result<Refined<S::Outcome>, Error> {
        let mut parts = self.progress.refining();
        let mut statistics = Statistics::default();
        let progress = parts();
        let mut outcomes = if self.known_error.is_some() {
            Vec::new()
        } else {
            self.coarser(simulation, first, progress, &mut statistics)?
        };
        let begin = share_below(first, first);
        let finest = simulation.simulate(first, outcomes.last(), progress.part(begin, 1.0), true)?;
        statistics += S::work(&finest);
        outcomes.push(finest);
        let mut level = first;
        if let Some(known) = self.known_error {
            error.mesh = known;
        } else {
            loop {
                if outcomes.len() > 1 {
                    error.mesh = simulation.mesh_error(level, &outcomes);
                }
                if self.is_good_enough(simulation, level, &outcomes, error)
                    || !self.may_refine::<S>(level, &outcomes, error)
                {
                    break;
                }
                let finer = match simulation.simulate(level + 1, outcomes.last(), parts(), true) {
                    // Jumps that fail on this mesh leave the answer of the coarser one.
                    Err(Error::Jumps(_)) if self.error_is_known(&outcomes) => break,
                    finer => finer?,
                };
                statistics += S::work(&finer);
                outcomes.push(finer);
                level += 1;
            }
        }
        let alone = outcomes.len() == 1 && self.known_error.is_none();
        let outcome = outcomes.pop().expect("the first level was computed");
        if self.is_to_measure(alone, error) {
            let finer = simulation.simulate(level + 1, Some(&outcome), parts(), true)?;
            statistics += S::work(&finer);
            error.mesh = simulation.difference(&outcome, &finer).times(VERIFIED);
            error.measured = true;
        }
        Ok(Refined {
            level,
            mesh: self.plan.levels.mesh(level)?,
            outcome,
            statistics,
        })
    }

    /// The outcomes on the levels below `first` that the duct is long enough for, and that are fine
    /// enough for its motion.
    fn coarser<S: OnMeshes>(
        &self,
        simulation: &S,
        first: usize,
        progress: Progress<'_>,
        statistics: &mut Statistics,
    ) -> Result<Vec<S::Outcome>, Error> {
        let mut outcomes: Vec<S::Outcome> = Vec::new();
        let lowest = first.saturating_sub(simulation.levels_below(first));
        for level in (lowest..first).filter(|&level| self.plan.levels.mesh(level).is_ok()) {
            if let Some(known) = simulation.known(level) {
                outcomes.push(known);
                continue;
            }
            let part = progress.part(share_below(level, first), share_below(level + 1, first));
            match simulation.simulate(level, outcomes.last(), part, false) {
                Err(Error::Cable(CableError::CoarseMesh { .. })) => {}
                outcome => {
                    outcomes.push(outcome?);
                    *statistics += outcomes.last().map_or(Statistics::default(), S::work);
                }
            }
        }
        Ok(outcomes)
    }

    /// Whether a finer run is to measure the error of the mesh. One mesh alone does not show it;
    /// and no mesh that the scene names is refused for what coarser ones show.
    fn is_to_measure(&self, alone: bool, error: &ErrorParts) -> bool {
        let Plan { scene, levels, .. } = self.plan;
        let refused = error_estimate::is_doubtful(error.total().force, scene.solver.tolerance);
        self.verify || alone || levels.named() && refused
    }

    /// Whether the `outcomes` on all meshes up to `level` leave an `error` of the last that the
    /// tolerance allows.
    fn is_good_enough<S: OnMeshes>(
        &self,
        simulation: &S,
        level: usize,
        outcomes: &[S::Outcome],
        error: &ErrorParts,
    ) -> bool {
        // Where nothing slips coarse meshes agree, but they see too little of how sharply the duct
        // bends.
        let still = outcomes
            .last()
            .is_some_and(|outcome| simulation.is_still(outcome));
        let others = error.passes + error.temperature + Shares::both(error.inertia);
        let of_mesh = error.total().less(others);
        let allowed = allowed(self.plan.scene.solver.tolerance, others);
        self.error_is_known(outcomes) && (!still || level >= SHARP) && of_mesh.is_within(allowed)
    }

    /// Whether there is a mesh after `level` that is not too costly.
    fn may_refine<S: OnMeshes>(&self, level: usize, outcomes: &[S::Outcome], error: &ErrorParts) -> bool {
        let tolerance = self.plan.scene.solver.tolerance;
        let last = outcomes.last().map_or(0, |outcome| S::work(outcome).node_updates);
        // A run whose error is above 10 % is refused: spend more before that.
        let most = if error_estimate::is_doubtful(error.total().force, tolerance) {
            MAX_NODE_UPDATES
        } else {
            max_node_updates(tolerance)
        };
        REFINEMENT_COST.saturating_mul(last) <= most && level < self.plan.levels.finest()
    }

    /// Whether `outcomes` show their error: on one mesh alone they do not.
    fn error_is_known<O>(&self, outcomes: &[O]) -> bool {
        outcomes.len() > 1 || self.plan.levels.named()
    }
}

/// The work on all levels below `coarser` as a share of that on all up to `level`, each of which
/// costs four times the one before.
fn share_below(coarser: usize, level: usize) -> f64 {
    let all_below = |level: usize| (REFINEMENT_COST as f64).powi(level as i32) - 1.0;
    all_below(coarser) / all_below(level + 1)
}
