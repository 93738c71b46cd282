//! Which passes of a period's traffic stand for the listed passes of the scene's.
//!
//! Where the period is the traffic's own they are the same. Where it only stands in for the traffic, a pass is shown by one
//! nearby that follows the same vehicles as far back as possible; and at random by the mean over a period.

use std::ops::RangeInclusive;

use cable_dem::{Order, PassOutcome};
use cycle_jump::Record;

use crate::Error;
use crate::cable::{LONGEST_ORDER, traffic};
use crate::plan::Period;
use crate::scene::Scene;

/// Periods at the start in which the scene's own vehicles drive.
const OWN_PERIODS: u64 = 7;

/// Listed passes, each with those whose mean is shown for it.
pub struct Listing {
    rows: Vec<(u64, RangeInclusive<u64>)>,
    /// The first vehicles of the scene's own traffic.
    own: Vec<usize>,
    /// Whether the scene's vehicles are drawn: then no pass is one of theirs.
    is_drawn: bool,
}

impl Listing {
    pub fn new(scene: &Scene, period: &Period, listed: &[u64]) -> Result<Self, Error> {
        let length = period.len() as u64;
        let count = scene.traffic.passes;
        let stands_in = period.other.is_some() || period.reordered;
        if !stands_in {
            return Ok(Self {
                rows: listed.iter().map(|&pass| (pass, pass..=pass)).collect(),
                own: Vec::new(),
                is_drawn: false,
            });
        }
        let window = |pass: u64| around(pass, length, count);
        if matches!(scene.traffic.order, Order::Random { .. }) {
            // The last passes too are the mean of a whole period: the last vehicle alone says nothing.
            let mean = |pass: u64| match window(pass) {
                shown if pass + length / 2 <= count => shown,
                _ => (count + 1).saturating_sub(length).max(1)..=count,
            };
            return Ok(Self {
                rows: listed.iter().map(|&pass| (pass, mean(pass))).collect(),
                own: Vec::new(),
                is_drawn: true,
            });
        }
        let traffic = traffic(scene, scene.traffic.order.clone())?;
        let last = listed.last().copied().unwrap_or(0);
        let own_passes = (OWN_PERIODS * length).min(count);
        // Vehicles of the last period before each listed pass, the newest last.
        let mut recent = Vec::new();
        let mut own = Vec::new();
        let mut rows = Vec::with_capacity(listed.len());
        let mut next = listed.iter().copied().peekable();
        for (vehicle, pass) in traffic.zip(1..=last.min(LONGEST_ORDER)) {
            if pass <= own_passes {
                own.push(vehicle);
            }
            recent.push(vehicle);
            if recent.len() > period.len() {
                recent.remove(0);
            }
            if next.next_if_eq(&pass).is_some() {
                let shown = if pass <= own_passes {
                    pass
                } else {
                    alike(period, &recent, pass, count)
                };
                rows.push((pass, shown..=shown));
            }
        }
        // So far on its order is not known: the mean of a period stands for it.
        rows.extend(next.map(|pass| (pass, window(pass))));
        Ok(Self {
            rows,
            own,
            is_drawn: false,
        })
    }

    /// The vehicle of the pass `number`, whose place in the period is `phase`.
    pub fn vehicle(&self, period: &Period, phase: usize, number: Option<u64>) -> usize {
        let own = number.and_then(|pass| self.own.get(pass as usize - 1));
        own.copied().unwrap_or(period.vehicles[phase])
    }

    /// Whether the pass of this number is that of the scene's own traffic.
    pub fn is_own(&self, pass: u64) -> bool {
        if self.is_drawn {
            return false;
        }
        let row = self.rows.binary_search_by_key(&pass, |(listed, _)| *listed);
        match row {
            Ok(row) => self.rows[row].1 == (pass..=pass),
            Err(_) => {
                self.own.is_empty()
                    && self
                        .rows
                        .iter()
                        .all(|(listed, shown)| *shown == (*listed..=*listed))
            }
        }
    }

    /// The passes that have to be known, ascending.
    pub fn wanted(&self) -> Vec<u64> {
        let mut wanted: Vec<u64> = self.rows.iter().flat_map(|(_, shown)| shown.clone()).collect();
        wanted.sort_unstable();
        wanted.dedup();
        wanted
    }

    /// The listed passes, from all that were wanted.
    pub fn records(&self, known: &[Record]) -> Vec<Record> {
        let of = |pass: u64| {
            known
                .binary_search_by_key(&pass, |record| record.pass)
                .map(|place| known[place].clone())
        };
        let row = |(pass, shown): &(u64, RangeInclusive<u64>)| {
            let shown: Vec<Record> = shown.clone().filter_map(|pass| of(pass).ok()).collect();
            let first = shown.first()?;
            Some(Record {
                pass: *pass,
                outcome: mean(&shown),
                interpolated: first.interpolated || shown.len() > 1 || first.pass != *pass,
            })
        };
        self.rows.iter().filter_map(row).collect()
    }
}

/// A whole period of `length` passes around `pass`, or as many on either side as there are of `count`.
fn around(pass: u64, length: u64, count: u64) -> RangeInclusive<u64> {
    let (before, after) = ((length - 1) / 2, length / 2);
    if pass > before && pass + after <= count {
        return pass - before..=pass + after;
    }
    let reach = before.min(pass - 1).min(count - pass);
    pass - reach..=pass + reach
}

/// The pass near `pass` that follows the vehicles `recent` as far back as possible in the period's traffic.
fn alike(period: &Period, recent: &[usize], pass: u64, count: u64) -> u64 {
    let length = period.len();
    let back = |phase: usize| {
        let same = |steps: &usize| {
            period.vehicles[(phase + length - steps % length) % length] == recent[recent.len() - 1 - steps]
        };
        (0..recent.len()).take_while(same).count()
    };
    let own = ((pass - 1) % length as u64) as usize;
    // The nearest of those that are equally alike: forward and backward by turns.
    let away = (0..length as i64).map(|k| if k % 2 == 0 { k / 2 } else { -(k + 1) / 2 });
    let place = |away: i64| (own as i64 + away).rem_euclid(length as i64) as usize;
    let best = away
        .filter(|away| (1..=count as i64).contains(&(pass as i64 + away)))
        .max_by_key(|&away| (back(place(away)), -away.abs()));
    (pass as i64 + best.unwrap_or(0)) as u64
}

/// Mean of what passes did.
fn mean(records: &[Record]) -> PassOutcome {
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
                let shown = around(pass, length, 200);
                assert!(shown.contains(&pass));
                assert_eq!(shown.count() as u64, length, "pass {pass}");
            }
            // At both ends as many on either side.
            assert_eq!(around(1, length, 200).count(), if length == 2 { 2 } else { 1 });
            assert_eq!(around(200, length, 200).count(), 1);
        }
    }
}
