//! What is to be simulated on one mesh.

use cable_dem::{CableError, CableState, DuctedCable, Mesh};
use ground_field::DuctMotion;

use crate::Progress;
use creepage_plan::{Plan, SavedState, cable::cable};
use creepage_scene::{Scene, SolverMethod};

/// The passes of a scene on one mesh.
#[derive(Clone, Copy)]
pub struct Task<'a> {
    pub scene: &'a Scene,
    pub method: SolverMethod,
    pub motions: &'a [DuctMotion],
    pub mesh: Mesh,
    /// The state that the passes begin with, if not as laid.
    pub start: Option<&'a SavedState>,
    /// Passes at which the cable is looked at.
    pub stages: &'a [u64],
    pub progress: Progress<'a>,
}

impl<'a> Task<'a> {
    /// All passes of `scene`, whose ground is that of the plan, on `mesh`, without stages and
    /// progress.
    pub fn of(plan: &'a Plan<'_>, scene: &'a Scene, mesh: Mesh) -> Self {
        Self {
            scene,
            method: plan.method,
            motions: &plan.ground.motions,
            mesh,
            start: plan.start,
            stages: &[],
            progress: Progress::default(),
        }
    }

    /// The cable, held where the passes begin.
    pub fn cable(&self) -> Result<DuctedCable, CableError> {
        self.start
            .map_or_else(|| cable(self.scene), |start| start.cable(self.scene))
    }

    /// The cable before the first pass, if not as laid.
    pub fn begin(&self) -> Result<Option<CableState>, CableError> {
        self.start
            .map(|start| start.on(self.scene, &self.mesh))
            .transpose()
    }
}
