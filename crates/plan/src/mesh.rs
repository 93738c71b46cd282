//! Meshes of a scene, from coarse to fine.
//!
//! The length scale is that over which the duct's motion changes: its depth right under the wheels,
//! more beside the lane or under a stiff slab, where the cable slips far enough to see it. Level 0
//! has three nodes per length scale and two steps of the vehicle per node spacing; each further
//! level halves both. Every tolerance takes the same levels and stops at its own, so that a looser
//! one never costs more, and the coarser levels give the error of the last.

use cable_dem::{CableError, Mesh};
use ground_field::DuctMotion;

use crate::error::Error;
use crate::ground::{length_scale, peak};
use crate::tuning::meshes::{MAX_NODE_UPDATES, MOVED, SLIPS, TYPICAL};
use creepage_scene::{Scene, SolverMethod};

/// Nodes per length scale on level 0.
const COARSEST: f64 = 3.0;
/// The finest level that is tried where it is affordable: a cable that slips a tenth of a metre on
/// a deep duct needs it.
const FINEST: usize = 10;
/// The level that a mesh named by the scene counts as: two coarser ones tell its error.
const NAMED: usize = 2;

/// The meshes that a scene may be computed on.
#[derive(Debug, Clone, Copy)]
pub struct Levels {
    length: f64,
    depth: f64,
    /// Length over which the duct's motion changes under the vehicle that moves it most sharply
    /// \[m\].
    pub length_scale: f64,
    /// How far vehicles drive in one pass \[m\].
    road: f64,
    /// Spacing and vehicle step on level 0 \[m\].
    spacing: f64,
    step: f64,
    /// Whether the vehicle's step follows the spacing; a law without memory depends on it.
    steps_follow: bool,
    /// The level to begin with.
    pub first: usize,
    /// The finest one to try.
    pub finest: usize,
    /// Whether the scene says how fine to be.
    pub named: bool,
    /// Whether the spacing follows from the duct's depth and length.
    spacing_follows: bool,
}

impl Levels {
    /// Of a scene whose vehicles begin and end `approach` \[m\] outside the duct.
    pub fn new(scene: &Scene, motions: &[DuctMotion], approach: f64) -> Self {
        let solver = &scene.solver;
        let length = scene.duct.length;
        let steps_follow = scene.friction.law().has_memory();
        let by_time_step = solver.method == SolverMethod::Explicit && solver.time_step.is_some();
        // The answer of a law without memory depends on its time step: there is no limit to refine
        // towards.
        let by_steps = solver.node_spacing.is_some() || solver.vehicle_step.is_some();
        let named = by_steps || by_time_step || !steps_follow;
        let length_scale = resolved(scene, motions);
        let coarsest = (length_scale / COARSEST).min(length / Mesh::MIN_ELEMENTS);
        let (mut spacing, mut step) = (coarsest, coarsest / Mesh::STEPS_PER_SPACING);
        if named {
            // Level 0 is so much coarser than the mesh that is named.
            let refinement = f64::from(1 << NAMED);
            let least = (coarsest / refinement).max(solver.vehicle_step.unwrap_or(0.0));
            let named = solver
                .node_spacing
                .unwrap_or(least.min(length / Mesh::MIN_ELEMENTS));
            step = solver.vehicle_step.unwrap_or(named / Mesh::STEPS_PER_SPACING);
            spacing = refinement * named;
            step *= if steps_follow { refinement } else { 1.0 };
        }
        let wanted = TYPICAL.iter().position(|&error| error <= solver.tolerance);
        let wanted = wanted.unwrap_or(TYPICAL.len() - 1);
        Self {
            length,
            depth: scene.duct.depth,
            length_scale,
            road: length + 2.0 * approach,
            spacing,
            step,
            steps_follow,
            first: if named { NAMED } else { wanted.max(1) },
            finest: if named { NAMED } else { FINEST },
            named,
            spacing_follows: solver.node_spacing.is_none(),
        }
    }

    /// At most `count` levels below `first` that the duct is long enough for, from coarse to fine.
    pub fn below(&self, first: usize, count: usize) -> impl Iterator<Item = usize> {
        (first.saturating_sub(count)..first).filter(|&level| self.mesh(level).is_ok())
    }

    /// Passes on `level` that are not too costly.
    pub fn affordable_passes(&self, level: usize) -> u64 {
        (MAX_NODE_UPDATES as f64 / self.node_updates(level)) as u64
    }

    /// Node spacing and vehicle step on `level` \[m\].
    pub fn spacing(&self, level: usize) -> (f64, f64) {
        let share = 0.5_f64.powi(level as i32);
        let of_step = if self.steps_follow { share } else { 1.0 };
        (share * self.spacing, of_step * self.step)
    }

    /// The level with as many nodes per length scale of a scene that leaves the mesh to the plan.
    pub fn fineness(&self, level: usize) -> usize {
        let nodes = 1.001 * self.length_scale / self.spacing(level).0;
        (nodes / COARSEST).log2() as usize
    }

    /// The mesh of `level`; an error where the duct is too short for one so coarse, or what the
    /// scene asks for is out of range.
    ///
    /// # Errors
    ///
    /// [`Error`] when the mesh would have too many nodes or none.
    pub fn mesh(&self, level: usize) -> Result<Mesh, Error> {
        let (spacing, step) = self.spacing(level);
        Mesh::new(self.length, spacing, step).map_err(|error| match error {
            // The spacing is ours: what it follows from is what the scene says.
            CableError::InvalidParameter { .. } if self.spacing_follows => Error::TooManyNodes {
                length: self.length,
                depth: self.depth,
                nodes: self.length / spacing,
            },
            error => error.into(),
        })
    }

    /// Typical error of the force on `level`, as a share of it.
    pub fn typical_error(level: usize) -> f64 {
        TYPICAL[level.min(TYPICAL.len() - 1)]
    }

    /// Error to expect on `level` before anything is computed; `None` on a mesh that the scene
    /// names.
    pub fn expected_error(&self, level: usize) -> Option<f64> {
        (!self.named).then(|| Self::typical_error(level))
    }

    /// About how many nodes are solved for in a pass on `level`, without inertia.
    pub fn node_updates(&self, level: usize) -> f64 {
        let moved = (MOVED * self.length_scale).min(self.length);
        self.whole_cable_updates(level) * moved / self.length
    }

    /// Nodes of the whole cable times steps of the vehicle in a pass on `level`.
    pub fn whole_cable_updates(&self, level: usize) -> f64 {
        let (spacing, step) = self.spacing(level);
        self.road / step * self.length / spacing
    }
}

/// Length that meshes resolve \[m\]: a cable slips past a duct that is displaced by D over the slip
/// length √(2 EA D/q), which no mesh may pass over.
fn resolved(scene: &Scene, motions: &[DuctMotion]) -> f64 {
    let depth = scene.duct.depth;
    let limits = scene.sections().into_iter().map(|section| section.limit);
    let largest = limits.fold(0.0, f64::max);
    let slip = (2.0 * scene.cable.axial_stiffness * peak(motions) / largest).sqrt();
    length_scale(motions, depth).min(SLIPS * slip).max(depth)
}
