//! What a finer mesh may cost, and what error is left to it.

use crate::answer::differences::Shares;
use crate::tuning::meshes::{FINER, LEAST_SHARE, MAX_NODE_UPDATES};

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
