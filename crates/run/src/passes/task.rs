//! What is to be simulated on one mesh.

use cable_dem::Mesh;
use ground_field::DuctMotion;

use crate::plan::{CableMethod, Plan};
use crate::scene::Scene;
use crate::{Progress, SavedState};

/// The passes of a scene on one mesh.
#[derive(Clone, Copy)]
pub struct Task<'a> {
    pub scene: &'a Scene,
    pub method: CableMethod,
    pub motions: &'a [DuctMotion],
    pub mesh: Mesh,
    /// The state that the passes begin with, if not as laid.
    pub start: Option<&'a SavedState>,
    /// Passes at which the cable is looked at.
    pub stages: &'a [u64],
    pub progress: Progress<'a>,
}

impl Plan<'_> {
    /// All passes of `scene`, whose ground is that of the plan, on `mesh`, without stages and
    /// progress.
    pub fn task<'a>(&'a self, scene: &'a Scene, mesh: Mesh) -> Task<'a> {
        Task {
            scene,
            method: self.choice.method.cable_method(),
            motions: &self.ground.motions,
            mesh,
            start: self.start,
            stages: &[],
            progress: Progress::default(),
        }
    }
}
