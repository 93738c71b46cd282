//! Which passes of a period's traffic stand for the listed passes of the scene's: the same ones
//! where the period is the traffic's own. Where it only stands in for the traffic, a pass after the
//! first ones is shown by the mean over a period around it.

use std::ops::RangeInclusive;

use cable_dem::PassOutcome;
use cycle_jump::Record;

use crate::answer::record_of;
use creepage_plan::Period;

/// Listed passes, each with the range of those whose mean is shown for it.
pub struct Listing(Vec<(u64, RangeInclusive<u64>)>);

impl Listing {
    /// Of `count` passes in all.
    pub fn new(period: &Period, listed: impl IntoIterator<Item = u64>, count: u64) -> Self {
        let length = period.len() as u64;
        let shown = |pass: u64| match () {
            () if period.is_own() || pass <= period.first.len() as u64 => pass..=pass,
            () if pass + length / 2 <= count => around(pass, length),
            // The last passes are the mean of a whole period too: the last vehicle says nothing.
            () => (count + 1).saturating_sub(length).max(1)..=count,
        };
        Self(listed.into_iter().map(|pass| (pass, shown(pass))).collect())
    }

    /// The passes that have to be known.
    pub fn wanted(&self) -> impl Iterator<Item = u64> {
        self.0.iter().flat_map(|(_, shown)| shown.clone())
    }

    /// The listed passes from those that are `known`.
    pub fn records(&self, known: &[Record]) -> Vec<Record> {
        let row = |(pass, shown): &(u64, RangeInclusive<u64>)| {
            let shown: Vec<&Record> = shown.clone().filter_map(|pass| record_of(known, pass)).collect();
            Some(Record {
                pass: *pass,
                outcome: mean(&shown),
                interpolated: shown.first()?.interpolated || shown.len() > 1,
            })
        };
        self.0.iter().filter_map(row).collect()
    }
}

/// Passes of a whole period of `length` around `pass`, or as many on either side as there are.
fn around(pass: u64, length: u64) -> RangeInclusive<u64> {
    let before = (length - 1) / 2;
    if pass > before {
        pass - before..=pass + length / 2
    } else {
        1..=2 * pass - 1
    }
}

/// Mean of what passes did.
pub fn mean(records: &[&Record]) -> PassOutcome {
    if let [one] = records {
        return one.outcome.clone();
    }
    let share = 1.0 / records.len() as f64;
    let parts: Vec<_> = records.iter().map(|record| (share, &record.outcome)).collect();
    PassOutcome::combined(&parts)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mean_over_a_period_counts_every_vehicle_of_it_once() {
        for length in 1..=48 {
            for pass in 25..=176 {
                let shown: Vec<u64> = around(pass, length).collect();
                assert!(shown.contains(&pass));
                assert_eq!(shown.len() as u64, length, "pass {pass}");
            }
            // At the beginning as many on either side.
            assert_eq!(around(1, length).count(), if length == 2 { 2 } else { 1 });
        }
    }

    #[test]
    fn the_last_pass_of_stand_ins_is_the_mean_of_the_last_period() {
        let wanted = |reordered| -> Vec<u64> {
            let period = Period {
                vehicles: vec![0; 10],
                reordered,
                ..Period::default()
            };
            Listing::new(&period, [200], 200).wanted().collect()
        };
        assert_eq!(wanted(true), (191..=200).collect::<Vec<u64>>());
        assert_eq!(wanted(false), [200]);
    }
}
