//! What is to be simulated on one mesh.

use cable_dem::{CableError, CableState, DuctedCable, Mesh};
use ground_field::DuctMotion;

use crate::cable::cable;
use crate::plan::Plan;
use crate::scene::{Scene, SolverMethod};
use crate::{Progress, SavedState};

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

impl Task<'_> {
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

impl Plan<'_> {
    /// All passes of `scene`, whose ground is that of the plan, on `mesh`, without stages and
    /// progress.
    pub fn task<'a>(&'a self, scene: &'a Scene, mesh: Mesh) -> Task<'a> {
        Task {
            scene,
            method: self.method,
            motions: &self.ground.motions,
            mesh,
            start: self.start,
            stages: &[],
            progress: Progress::default(),
        }
    }
}
