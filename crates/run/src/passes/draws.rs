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
use cycle_jump::{Beyond, Record, peaks};

use super::listing::mean;
use super::simulation::Passes;
use crate::answer::differences::{Scale, Shares, differences};
use crate::tuning::jumps::STATED;

/// The passes of a draw of vehicles, by jumps over them as a period.
pub struct Draw {
    pub vehicles: Vec<usize>,
    pub passes: Passes,
}

/// What random orders of a period's vehicles leave in the mean, relative to an even one.
#[derive(Clone)]
pub struct Draws {
    even: Vec<Record>,
    mean: Vec<Record>,
    /// Single passes that show more than the even order, and their vehicles.
    pub peaks: Vec<(usize, Record)>,
    /// Error of the mean.
    pub error: Shares,
}

impl Draws {
    /// From passes of an `even` order and those of two draws or more, on the same mesh. The passes
    /// up to `first` are each a draw of their own, and stay those of the even order.
    pub fn new(even: &Passes, draws: &[Draw], first: u64, scale: Scale) -> Self {
        let of_draws = |record: &Record| {
            let same = |draw: &Draw| at(&draw.passes.records, record.pass).cloned();
            let all: Option<Vec<Record>> = draws.iter().map(same).collect();
            let outcome = mean(&all?);
            Some(Record {
                outcome,
                ..record.clone()
            })
        };
        let later = even.records.iter().filter(|record| record.pass > first);
        let mean: Vec<Record> = later.filter_map(of_draws).collect();
        let mut squares = vec![Shares::default(); mean.len()];
        for draw in draws {
            for (sum, off) in squares
                .iter_mut()
                .zip(differences(&mean, &draw.passes.records, scale))
            {
                *sum = sum.map(off, |sum, off| sum + off * off);
            }
        }
        let count = draws.len() as f64;
        let square = squares.into_iter().fold(Shares::default(), Shares::max);
        let error = square.map(square, |square, _| {
            STATED * (square / (count - 1.0) / count).sqrt()
        });
        // Whatever the number of its pass: larger than all of the even order.
        let of_even = even.records.iter().chain(&even.peaks);
        let shown: Vec<Record> = of_even
            .map(|record| Record {
                pass: 0,
                ..record.clone()
            })
            .collect();
        let single = draws.iter().flat_map(|draw| {
            let of_period = |record: &Record| draw.vehicles[(record.pass - 1) as usize % draw.vehicles.len()];
            draw.passes
                .peaks
                .iter()
                .map(move |record| (of_period(record), record.clone()))
        });
        let single: Vec<(usize, Record)> = single.collect();
        let larger = peaks(&shown, single.iter().map(|(_, record)| record.clone()).collect());
        let peaks = single
            .into_iter()
            .filter(|(_, record)| larger.contains(record))
            .collect();
        Self {
            even: even.records.clone(),
            mean,
            peaks,
            error,
        }
    }

    /// Makes the `passes` of the even order on another mesh those of a random one in the mean.
    pub fn correct(&self, passes: &mut Passes) {
        for record in &mut passes.records {
            if let (Some(even), Some(mean)) = (at(&self.even, record.pass), at(&self.mean, record.pass)) {
                record.outcome = moved(&record.outcome, even, mean);
                record.interpolated = true;
            }
        }
        if let (Some(Beyond { records, period }), Some(even), Some(mean)) =
            (&mut passes.beyond, self.even.last(), self.mean.last())
        {
            let later = records.iter_mut().map(|record| &mut record.outcome);
            for outcome in later.chain(period) {
                *outcome = moved(outcome, even, mean);
            }
        }
    }
}

/// The record of this `pass`.
fn at(records: &[Record], pass: u64) -> Option<&Record> {
    let place = records.binary_search_by_key(&pass, |record| record.pass);
    place.ok().map(|place| &records[place])
}

/// The `outcome` of the even order as that of random ones.
fn moved(outcome: &PassOutcome, even: &Record, mean: &Record) -> PassOutcome {
    let mut moved = PassOutcome::combined(&[(1.0, outcome), (-1.0, &even.outcome), (1.0, &mean.outcome)]);
    for positive in [
        &mut moved.max_compression,
        &mut moved.max_tension,
        &mut moved.dissipated,
    ] {
        *positive = positive.max(0.0);
    }
    moved.statistics = outcome.statistics;
    moved
}
