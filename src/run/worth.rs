//! What a finer mesh may cost, and what error is left to it.

use crate::answer::error_estimate::Shares;

/// Most nodes eliminated in all passes on one mesh: about ten seconds.
pub const MAX_NODE_UPDATES: usize = 2_000_000_000;
/// The same on a mesh finer than the first, at this tolerance.
const FINER: (usize, f64) = (1_000_000_000, 0.01);
/// A mesh twice as fine takes about this many times the node updates.
pub const REFINEMENT_COST: usize = 4;
/// And at most about this many.
pub const MOST_REFINEMENT_COST: usize = 6;
/// Node updates that a mesh takes at least for the mesh after it to be begun beside it, on another thread: a third of a second.
pub const WORTH_A_THREAD: usize = 50_000_000;
/// What is left to the mesh at least, as a share of the tolerance, or of the largest other error where that is beyond it.
const LEAST_SHARE: f64 = 0.5;

/// Node updates that a finer mesh is worth: the more the less error is asked for.
pub fn worth(tolerance: f64) -> usize {
    let (updates, at) = FINER;
    ((updates as f64 * at / tolerance) as usize).clamp(updates, MAX_NODE_UPDATES)
}

/// What of the `tolerance` is left beside `others`, which no finer mesh takes away.
pub fn allowed(tolerance: f64, others: Shares) -> Shares {
    Shares::both(tolerance).less(others).max(Shares::both(
        LEAST_SHARE * tolerance.max(others.force).max(others.movement),
    ))
}
