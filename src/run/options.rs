//! How a run is to be carried out.

use ground_field::GroundField;

use crate::Progress;

/// How to run.
#[derive(Default, Clone, Copy)]
pub struct RunOptions<'a> {
    /// Measure the error by a run on a mesh twice as fine instead of estimating it.
    pub verify: bool,
    /// The mesh's error, where the scene names its mesh and another run on it has shown this: then no coarser ones are computed.
    pub mesh_error: Option<f64>,
    /// Called after each pass; it may stop the run.
    pub progress: Progress<'a>,
    /// A ground model of one's own, in place of the scene's.
    pub ground: Option<&'a dyn GroundField>,
    /// Passes at which to look at the cable, for [`crate::Run::stages`]; those beyond the scene's are left out.
    pub stages: &'a [u64],
}
