//! How a run is to be carried out.

use cycle_jump::Guide;
use ground_field::GroundField;

use crate::Progress;
use crate::answer::{FixedMesh, JumpSize};
use creepage_plan::{Period, SavedState};

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

/// How jumps are taken.
#[derive(Debug, Clone, Copy)]
pub struct Jumping<'a> {
    pub period: &'a Period,
    pub size: JumpSize,
    /// Passes after which it is given up.
    pub most_passes: u64,
    pub guide: Guide<'a>,
    /// Whether it is followed where the forces lead.
    pub beyond: bool,
}
