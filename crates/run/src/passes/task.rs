//! What is to be simulated on one mesh, and how.

use cable_dem::{CableError, CableState, DuctedCable, Mesh, laid};
use cycle_jump::Guide;
use ground_field::{DuctMotion, GroundField};

use crate::Progress;
use crate::answer::{FixedMesh, JumpSize};
use creepage_plan::{Period, Plan, SavedState, cable::cable};
use creepage_scene::{Scene, SolverMethod};

/// How to run.
#[derive(Default, Clone, Copy)]
pub struct RunOptions<'a> {
    /// Measure the error by a run on a mesh twice as fine instead of estimating it.
    pub verify: bool,
    /// What another run has shown of the mesh that the scene names: then no coarser ones are
    /// computed, and no jumps are looked for.
    pub mesh: Option<FixedMesh>,
    /// Called after each pass; it may stop the run.
    pub progress: Progress<'a>,
    /// A ground model of one's own, in place of the scene's.
    pub ground: Option<&'a dyn GroundField>,
    /// The state that another run has left, with which this one begins; else the cable as laid.
    pub start: Option<&'a SavedState>,
    /// Passes at which to look at the cable, for [`crate::Run::stages`]; those beyond the scene's
    /// are left out.
    pub stages: &'a [u64],
}

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

    /// The cable before the first pass.
    pub fn begin(&self) -> Result<CableState, CableError> {
        match self.start {
            Some(start) => start.on(self.scene, &self.mesh),
            None => laid(&self.cable()?, &self.mesh),
        }
    }
}

/// How jumps are taken.
#[derive(Debug, Clone, Copy)]
pub struct Jumping<'a> {
    pub period: &'a Period,
    pub size: JumpSize,
    /// Passes after which it is given up.
    pub max_passes: u64,
    pub guide: Guide<'a>,
    /// Whether it is followed where the forces lead.
    pub beyond: bool,
}

impl<'a> Jumping<'a> {
    /// Free jumps of this `size` over `period`, whatever they cost.
    pub fn new(period: &'a Period, size: JumpSize) -> Self {
        Self {
            period,
            size,
            max_passes: u64::MAX,
            guide: Guide::Free,
            beyond: false,
        }
    }
}
