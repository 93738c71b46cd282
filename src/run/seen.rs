//! What passes on some meshes say of the last: whether it is good enough, and what to compute next.

use cycle_jump::Record;

use super::jumps;
use super::passes::Passes;
use super::vehicle_steps::VehicleSteps;
use super::worth::{MAX_NODE_UPDATES, MOST_REFINEMENT_COST, REFINEMENT_COST, WORTH_A_THREAD, allowed, worth};
use crate::answer::error_estimate::{self, ErrorParts, Scale, Shares, of_mesh};
use crate::plan::Levels;

/// The coarsest level on which it is seen whether anything slips: 24 nodes a depth.
pub const SHARP: usize = 3;

/// What passes on some meshes say of the last.
pub struct Seen {
    pub is_within: bool,
    pub would_be_with_smaller_jumps: bool,
    /// Meshes to compute next: none where the next is too costly, two where it takes long and cannot be good enough, whatever it shows, and the
    /// one after it is affordable.
    pub more: usize,
}

impl Seen {
    /// On `passes` on all of `levels` up to `level`, for a `tolerance`; sets the mesh's part of their `error`.
    pub fn on(
        passes: &[Passes],
        levels: &Levels,
        (level, steps): (usize, VehicleSteps),
        (tolerance, scale): (f64, Scale),
        error: &mut ErrorParts,
    ) -> Self {
        let mut of_next = Shares::default();
        if passes.len() > 1 {
            let records: Vec<&[Record]> = passes.iter().map(|p| &p.records[..]).collect();
            let of_level;
            (of_level, of_next) = of_mesh(&records, Levels::typical_error(level), scale);
            error.mesh = of_level + steps.hidden_error(level);
        }
        let last = &passes[passes.len() - 1];
        // A corner of an exact step is about as much work as a node.
        let work = last.statistics.node_updates + last.statistics.corners;
        let next = REFINEMENT_COST.saturating_mul(work);
        // Where nothing slips coarse meshes agree, but they see too little of how sharply the duct bends.
        let still = scale.is_still(&last.records);
        let is_seen = is_known(passes, levels) && (!still || level >= SHARP);
        let others = error.total().less(error.passes);
        let smaller = Shares::both((1.0 - jumps::SMALLER_SHARE) * tolerance);
        let allowed = allowed(tolerance, error.passes);
        // Any answer is worth more than none.
        let most = if error_estimate::is_doubtful(error.total().force, tolerance) {
            MAX_NODE_UPDATES
        } else {
            worth(tolerance)
        };
        // So that the mesh after the next would not be too costly once the next is computed.
        let after_next = MOST_REFINEMENT_COST.saturating_mul(next);
        let takes_long = next > WORTH_A_THREAD && after_next <= worth(tolerance);
        let may_do = (others.less(error.mesh) + of_next).is_within(allowed);
        let more = if next > most || level >= levels.finest() {
            0
        } else if takes_long && !may_do && level + 2 <= levels.finest() {
            2
        } else {
            1
        };
        Self {
            is_within: is_seen && others.is_within(allowed),
            would_be_with_smaller_jumps: is_seen && others.is_within(smaller),
            more,
        }
    }
}

/// Whether `passes` show their error: on one mesh alone they do not.
pub fn is_known(passes: &[Passes], levels: &Levels) -> bool {
    passes.len() > 1 || levels.named()
}
