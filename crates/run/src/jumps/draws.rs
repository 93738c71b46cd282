//! Vehicles in random order: the mean over several draws.
//!
//! An even order leaves other forces than a random one, above all where vehicles drive both ways.
//! What it changes is measured on a coarse mesh, where draws of the same vehicles are cheap, and
//! added to the even order's passes on the answer's mesh:
//!
//! ```text
//! E[F] ≈ F_even(fine) + (mean of F_k(coarse) over draws k − F_even(coarse))
//! ```
//!
//! (multilevel Monte Carlo with two levels: M. B. Giles, Oper. Res. 56 (2008) 607). Its error is
//! the draws' standard deviation over the root of their number.

use cable_dem::PassOutcome;
use cycle_jump::{Beyond, Record};

use crate::answer::differences::{Scale, Shares, differences};
use crate::answer::record_of;
use crate::passes::{Passes, mean};

/// Standard errors that are stated as the error.
const STATED: f64 = 2.0;

/// What random orders of a period's vehicles change in the mean, relative to an even one.
pub struct Draws {
    changes: Vec<Record>,
    /// Error of the mean.
    pub error: Shares,
}

impl Draws {
    /// From passes of an `even` order and those of two `draws` or more, on the same mesh. The
    /// passes up to `first` are each a draw of their own, and stay those of the even order.
    pub fn new(even: &[Record], draws: &[Vec<Record>], first: u64, scale: Scale) -> Self {
        let of_draws = |record: &Record| {
            let same = draws.iter().map(|draw| record_of(draw, record.pass));
            Some(Record {
                outcome: mean(&same.collect::<Option<Vec<_>>>()?),
                ..record.clone()
            })
        };
        let later = even.iter().filter(|record| record.pass > first);
        let mut changes: Vec<Record> = later.filter_map(of_draws).collect();
        let mut squares = vec![Shares::default(); changes.len()];
        for draw in draws {
            for (sum, off) in squares.iter_mut().zip(differences(&changes, draw, scale)) {
                *sum = sum.map(off, |sum, off| sum + off * off);
            }
        }
        let count = draws.len() as f64;
        let square: Shares = squares.into_iter().collect();
        let standard_error = |square: f64, _| (square / (count - 1.0) / count).sqrt();
        for mean in &mut changes {
            if let Some(even) = record_of(even, mean.pass) {
                mean.outcome = PassOutcome::combined(&[(1.0, &mean.outcome), (-1.0, &even.outcome)]);
            }
        }
        let error = square.map(square, standard_error).times(STATED);
        Self { changes, error }
    }

    /// Makes the `passes` of the even order on another mesh those of a random one in the mean.
    pub fn correct(&self, passes: &mut Passes) {
        for record in &mut passes.records {
            if let Some(change) = record_of(&self.changes, record.pass) {
                record.outcome = moved(&record.outcome, change);
                record.interpolated = true;
            }
        }
        if let (Some(Beyond { records, period }), Some(change)) = (&mut passes.beyond, self.changes.last()) {
            let later = records.iter_mut().map(|record| &mut record.outcome);
            for outcome in later.chain(period) {
                *outcome = moved(outcome, change);
            }
        }
    }
}

/// The `outcome` of the even order as that of random ones.
fn moved(outcome: &PassOutcome, change: &Record) -> PassOutcome {
    let mut moved = PassOutcome::combined(&[(1.0, outcome), (1.0, &change.outcome)]);
    moved.max_compression = moved.max_compression.max(0.0);
    moved.max_tension = moved.max_tension.max(0.0);
    moved.dissipated = moved.dissipated.max(0.0);
    moved.statistics = outcome.statistics;
    moved
}
