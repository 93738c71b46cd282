//! What a finer mesh may cost, and what error is left to it.

use crate::answer::differences::Shares;

/// Most nodes eliminated in all passes on one mesh: about ten seconds.
pub const MAX_NODE_UPDATES: usize = 2_000_000_000;
/// The same on a mesh finer than the first, at this tolerance.
const FINER: (usize, f64) = (1_000_000_000, 0.01);
/// A mesh twice as fine takes about this many times the node updates.
pub const REFINEMENT_COST: usize = 4;
/// What is left to the mesh at least, as a share of the tolerance, or of the largest other error if that is beyond it.
const LEAST_SHARE: f64 = 0.5;

/// Most node updates on a finer mesh: the more the less error is asked for.
pub fn max_node_updates(tolerance: f64) -> usize {
    let (updates, at) = FINER;
    ((updates as f64 * at / tolerance) as usize).clamp(updates, MAX_NODE_UPDATES)
}

/// What `others`, which no finer mesh takes away, leave of the `tolerance`.
pub fn allowed(tolerance: f64, others: Shares) -> Shares {
    Shares::both(tolerance).less(others).max(Shares::both(
        LEAST_SHARE * tolerance.max(others.force).max(others.movement),
    ))
}
