//! What a run gives: the cable after passes, and where it leads.

use cable_dem::{CableState, PassOutcome};

/// The cable after one pass.
#[derive(Debug, Clone, PartialEq)]
pub struct Record {
    /// Number of the pass, from 1.
    pub pass: u64,
    /// What it did.
    pub outcome: PassOutcome,
    /// Whether it lies within a jump, or among rounds of a period that were not simulated.
    pub interpolated: bool,
}

/// The cable over all passes.
#[derive(Debug, Clone)]
pub struct Evolution {
    /// The passes that were wanted, ascending. Where a period has several passes, between them the
    /// other simulated ones, and within jumps some of the vehicles that make the largest forces and
    /// movements: candidates for [`peaks`](crate::peaks).
    pub records: Vec<Record>,
    /// What each pass of the last whole period did; empty if nothing was jumped.
    pub period: Vec<PassOutcome>,
    /// The cable after the last pass.
    pub state: CableState,
    /// Movement of a cable that nothing holds as a whole, which `state` leaves out \[m\].
    pub offset: f64,
    /// Periods after which each repeats the one before but for a movement as a whole \[m\], if that
    /// was found. Days alone are judged by it.
    pub repeats: Option<(u64, f64)>,
    /// Passes simulated.
    pub simulated: u64,
    /// Lengths of the jumps \[periods\] in their order, 0 for a simulated period between.
    pub schedule: Vec<u64>,
    /// Whether a jump was taken back: what it has shown of the slope is not in a run that follows the others.
    pub has_rejected: bool,
    /// The most that a jump had missed before it was corrected, as a share of the largest force or
    /// movement: that of another run, on another mesh, tells how far its error is that of this one.
    pub missed: f64,
    /// The most that a jump has changed of the forces, as a share of the largest.
    pub changed: f64,
    /// Where the forces lead; `None` if nothing beyond the last pass was wanted, or they do not
    /// become steady.
    pub beyond: Option<Beyond>,
}

/// Where the forces lead.
#[derive(Debug, Clone)]
pub struct Beyond {
    /// The passes that were wanted.
    pub records: Vec<Record>,
    /// What each pass of a period does once the forces no longer change from period to period.
    pub period: Vec<PassOutcome>,
}
