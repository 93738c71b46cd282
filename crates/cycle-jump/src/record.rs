//! What a run gives: the cable after passes, and where it leads.

use cable_dem::{CableState, PassOutcome};

use crate::period::{Period, phase_of};

/// The cable after one pass.
#[derive(Debug, Clone, PartialEq)]
pub struct Record {
    /// Number of the pass, from 1.
    pub pass: u64,
    /// What it did.
    pub outcome: PassOutcome,
    /// Whether it lies within a jump.
    pub interpolated: bool,
}

/// The cable over all passes.
#[derive(Debug, Clone)]
pub struct Evolution {
    /// The passes that were wanted.
    pub records: Vec<Record>,
    /// Where a period has several passes, others that were simulated, and within jumps those of the vehicles that show the largest of something:
    /// which show more than what is listed, [`peaks`](crate::peaks) says.
    pub others: Vec<Record>,
    /// What each pass of the last whole period did; none where so few were simulated that nothing was jumped.
    pub period: Vec<PassOutcome>,
    /// The cable after the last pass.
    pub state: CableState,
    /// What a cable that nothing holds has moved as a whole beside that \[m\].
    pub offset: f64,
    /// Periods after which each is like the one before but for this movement as a whole \[m\], if that was found.
    pub repeats: Option<(u64, f64)>,
    /// Passes simulated.
    pub simulated: u64,
    /// Lengths of the jumps \[periods\] in their order, 0 for a simulated period between.
    pub schedule: Vec<u64>,
    /// Where it leads; `None` where nothing beyond the last pass was wanted, or it does not become steady.
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

impl Beyond {
    /// From the records, and the passes of the last `period`.
    pub(crate) fn new(records: Vec<Record>, period: &Period) -> Self {
        Self {
            records,
            period: period.outcomes().cloned().collect(),
        }
    }

    /// Where forces no longer change: the passes `wanted` do what those of the last `period` did. (A cable that nothing holds moves on; its
    /// movement is not told.)
    pub(crate) fn unchanged(wanted: &[u64], period: &Period) -> Self {
        let record = |&pass: &u64| Record {
            pass,
            outcome: period.phase(phase_of(pass, period.len())).outcome.clone(),
            interpolated: true,
        };
        Self::new(wanted.iter().map(record).collect(), period)
    }
}
