//! A mesh whose error other runs have shown.

use crate::scene::{Order, Scene};

/// A mesh and its error, which runs of scenes nearby have shown: a run on it alone costs a fraction of one that has to find its error out.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct KnownMesh {
    /// 0 has three nodes a depth of the duct, every further level twice as many.
    pub level: usize,
    /// Its error as a share of the forces, with that of jumps over passes on it.
    pub error: f64,
}

impl KnownMesh {
    /// Whether `scene` may be computed on such a mesh: heat has meshes of its own, as has a law without memory, what the scene says
    /// counts, and a random order scatters by itself.
    pub fn fits(scene: &Scene) -> bool {
        let solver = &scene.solver;
        let is_named = solver.node_spacing.is_some() || solver.vehicle_step.is_some();
        let is_random = matches!(scene.traffic.order, Order::Random { .. });
        !is_named && !is_random && scene.friction.law.has_memory() && scene.warming().is_none()
    }
}
