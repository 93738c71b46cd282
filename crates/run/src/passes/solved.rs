//! What a run has come to, whatever was simulated.

use cable_dem::{Mesh, Statistics};
use cycle_jump::Record;

use super::options::FixedMesh;
use super::simulation::Passes;
use crate::answer::error_estimate::ErrorParts;
use crate::answer::{DayExtremes, HeatRecord, RandomSpread};

/// Passes on the mesh that was good enough.
pub struct Solved {
    pub mesh: Mesh,
    pub passes: Passes,
    pub error: ErrorParts,
    /// What was found on the way.
    pub reasons: Vec<String>,
    /// Work on all meshes together.
    pub statistics: Statistics,
    pub random: Option<RandomSpread>,
    /// One more pass of each vehicle that comes too seldom for the period; in random order, passes
    /// of draws that show more.
    pub seldom: Vec<(usize, Record)>,
    /// What it has shown of its mesh.
    pub shown: Option<FixedMesh>,
    /// Of a cable that is heated every day.
    pub heat: Option<(Vec<DayExtremes>, HeatRecord)>,
}
