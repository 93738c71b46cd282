//! Which passes of a period's traffic stand for the listed passes of the scene's.
//!
//! Where the period is the traffic's own they are the same. Where it only stands in for the traffic, the scene's own vehicles drive at the
//! beginning and at the end, and between them a pass is shown by one nearby of the same vehicle that follows the same vehicles as far back as
//! possible; in random order it is shown by the mean over a period.

use cable_dem::{Order, PassOutcome};
use cycle_jump::{Evolution, Record, peaks};

use super::order::OwnOrder;
use crate::Error;
use crate::answer::simulated;
use crate::cable::{known_order, traffic};
use crate::plan::Period;
use crate::scene::Scene;

/// Passes at the beginning in which the scene's own vehicles drive, at least; at the end, and the last of them that show those vehicles: the
/// first ones still follow other vehicles.
const FIRST: u64 = 100;
const LAST: u64 = 150;
const LAST_SHOWN: u64 = 12;
/// Periods that jumps need at least beside those at the beginning and the end.
const PERIODS_OF_A_JUMP: u64 = 3;
/// Passes of a longer period whose mean stands for it, evenly over it.
const OF_A_MEAN: u64 = 48;
/// Passes that are nearly alike and are compared with each other.
const ALIKE: usize = 4;

/// The passes that a run lists whose traffic has this `period`: where it is the traffic's own, all of the last period among them.
pub fn listed_passes(scene: &Scene, period: &Period) -> Vec<u64> {
    simulated(&scene.traffic, if period.is_own() { period.len() } else { 1 })
}

/// Listed passes, each with those whose mean is shown for it.
pub struct Listing<'a> {
    rows: Vec<(u64, Vec<u64>)>,
    /// Where other vehicles than those of the period drive at the beginning and at the end.
    own: Option<OwnOrder<'a>>,
    /// Passes at the beginning and at the end in which they drive.
    pub one_by_one: (u64, u64),
    count: u64,
    /// Whether the scene's vehicles are drawn: then no pass is one of theirs.
    is_drawn: bool,
}

impl<'a> Listing<'a> {
    /// Of a run that begins with so many periods.
    pub fn new(scene: &Scene, period: &'a Period, first_periods: u64, listed: &[u64]) -> Result<Self, Error> {
        let length = period.len() as u64;
        let count = scene.traffic.passes;
        let mut listing = Self {
            rows: Vec::with_capacity(listed.len()),
            own: None,
            one_by_one: (0, 0),
            count,
            is_drawn: matches!(scene.order(), Order::Random { .. }),
        };
        // The last passes too are the mean of a whole period: the last vehicle alone says nothing.
        let around = |pass: u64| match mean_around(pass, length, count) {
            shown if pass + length / 2 <= count => shown,
            _ => sampled((count + 1).saturating_sub(length).max(1), count),
        };
        if period.is_own() || listing.is_drawn {
            let shown = |pass: u64| {
                if listing.is_drawn {
                    around(pass)
                } else {
                    vec![pass]
                }
            };
            listing.rows = listed.iter().map(|&pass| (pass, shown(pass))).collect();
            return Ok(listing);
        }
        let known = count.min(known_order(scene));
        let vehicles = traffic(scene, scene.order())?.take(known as usize);
        let own = OwnOrder {
            vehicles: vehicles.map(|vehicle| vehicle as u32).collect(),
            period,
        };
        // In the first period of many vehicles, or in several of few.
        let first = if length > FIRST {
            FIRST
        } else {
            FIRST.div_ceil(length) * length
        };
        let last = if known == count { LAST.min(count) } else { 0 };
        listing.one_by_one = if first + (first_periods + PERIODS_OF_A_JUMP) * length + last >= count {
            (known, 0)
        } else {
            (first, last)
        };
        for &pass in listed {
            if listing.shows_own(pass) {
                listing.rows.push((pass, vec![pass]));
            } else if let Some(shown) = own.shown_by(pass, first + 1..=count - last) {
                listing.rows.push((pass, vec![shown]));
            } else if pass == count {
                listing.rows.push((pass, around(pass)));
            }
        }
        listing.own = Some(own);
        Ok(listing)
    }

    /// The vehicle of the pass `number`, whose place in the period is `phase`.
    pub fn vehicle(&self, period: &Period, phase: usize, number: Option<u64>) -> usize {
        let (first, last) = self.one_by_one;
        let own = self.own.as_ref().zip(number).and_then(|(own, pass)| {
            let drives = pass <= first || pass + last > self.count;
            own.vehicles.get(pass as usize - 1).filter(|_| drives)
        });
        own.map_or(period.vehicles[phase], |&vehicle| vehicle as usize)
    }

    /// Whether `pass` is the scene's own and follows its own vehicles.
    fn shows_own(&self, pass: u64) -> bool {
        let (first, last) = self.one_by_one;
        pass <= first || last > 0 && pass + LAST_SHOWN > self.count
    }

    /// Whether the pass of this number is that of the scene's own traffic.
    pub fn is_own(&self, pass: u64) -> bool {
        !self.is_drawn && (self.own.is_none() || self.shows_own(pass))
    }

    /// The passes that have to be known, ascending.
    pub fn wanted(&self) -> Vec<u64> {
        let mut wanted: Vec<u64> = self.rows.iter().flat_map(|(_, shown)| shown.clone()).collect();
        wanted.sort_unstable();
        wanted.dedup();
        wanted
    }

    /// The listed passes of an `evolution`.
    pub fn records(&self, evolution: &Evolution) -> Vec<Record> {
        let known = &evolution.records;
        let of = |pass: u64| {
            known
                .binary_search_by_key(&pass, |record| record.pass)
                .map(|place| known[place].clone())
        };
        let row = |(pass, shown): &(u64, Vec<u64>)| {
            let shown: Vec<Record> = shown.iter().filter_map(|&pass| of(pass).ok()).collect();
            let first = shown.first()?;
            Some(Record {
                pass: *pass,
                outcome: mean(&shown),
                interpolated: first.interpolated || shown.len() > 1 || first.pass != *pass,
            })
        };
        self.rows.iter().filter_map(row).collect()
    }

    /// The passes of the period in an `evolution` that show more than the `rows`.
    pub fn peaks(&self, evolution: &Evolution, rows: &[Record]) -> Vec<Record> {
        let mut others = evolution.records.clone();
        if self.is_drawn || self.own.is_some() {
            // The first and the last passes of the period follow other vehicles, or precede them.
            let (first, last) = self.one_by_one;
            let period = self.own.as_ref().map_or(0, |own| own.period.len() as u64);
            let first = if first > 0 {
                first.div_ceil(period) * period + period + 1
            } else {
                0
            };
            let of_period = first..=self.count - last;
            others.retain(|record| of_period.contains(&record.pass));
        }
        peaks(rows, others)
    }

    /// The passes of `records` for which other passes of the period, nearly as much alike, show a force or a movement that differs
    /// by more than `allowed` of the largest in the period.
    pub fn doubtful(&self, evolution: &Evolution, records: &[Record], allowed: f64) -> Vec<u64> {
        let Some(own) = self.own.as_ref().filter(|_| !evolution.period.is_empty()) else {
            return Vec::new();
        };
        let of_place = |place: &usize| shown_values(&evolution.period[*place]);
        let mut largest = [0.0_f64; 2];
        for outcome in &evolution.period {
            for (most, values) in largest.iter_mut().zip(shown_values(outcome)) {
                *most = values.iter().fold(*most, |most, value| most.max(value.abs()));
            }
        }
        let is_doubtful = |pass: &u64| {
            let alike = own.most_alike(*pass, ALIKE);
            let first = of_place(&alike[0]);
            alike.iter().any(|place| {
                let pairs = of_place(place).into_iter().zip(&first).zip(largest);
                pairs.into_iter().any(|((values, first), largest)| {
                    values
                        .iter()
                        .zip(first)
                        .any(|(a, b)| (a - b).abs() > allowed * largest)
                })
            })
        };
        let shown = records.iter().map(|record| record.pass);
        let others = shown
            .filter(|&pass| !self.is_own(pass) && pass < self.count && pass <= own.vehicles.len() as u64);
        others.filter(is_doubtful).collect()
    }
}

/// Forces on the ends after and during a pass and the largest inside; movements of the ends.
fn shown_values(outcome: &PassOutcome) -> [Vec<f64>; 2] {
    let PassOutcome {
        force, peak, lowest, ..
    } = outcome;
    let ends = [force, peak, lowest]
        .into_iter()
        .flat_map(|force| [force.upstream, force.downstream]);
    [
        ends.chain([outcome.max_compression]).collect(),
        vec![outcome.upstream_displacement, outcome.downstream_displacement],
    ]
}

/// Passes of a whole period of `length` around `pass`, or as many on either side as there are of `count`.
fn mean_around(pass: u64, length: u64, count: u64) -> Vec<u64> {
    let (before, after) = ((length - 1) / 2, length / 2);
    if pass > before && pass + after <= count {
        return sampled(pass - before, pass + after);
    }
    let reach = before.min(pass - 1).min(count - pass);
    sampled(pass - reach, pass + reach)
}

/// These passes, or some of many, evenly.
fn sampled(from: u64, to: u64) -> Vec<u64> {
    let all = to - from + 1;
    if all <= OF_A_MEAN {
        return (from..=to).collect();
    }
    (0..OF_A_MEAN)
        .map(|k| from + (2 * k + 1) * all / (2 * OF_A_MEAN))
        .collect()
}

/// Mean of what passes did.
pub fn mean(records: &[Record]) -> PassOutcome {
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
                let shown = mean_around(pass, length, 200);
                assert!(shown.contains(&pass));
                assert_eq!(shown.len() as u64, length, "pass {pass}");
            }
            // At both ends as many on either side.
            assert_eq!(mean_around(1, length, 200).len(), if length == 2 { 2 } else { 1 });
            assert_eq!(mean_around(200, length, 200).len(), 1);
        }
        let long = mean_around(5000, 1000, 10_000);
        assert_eq!(long.len(), 48);
        assert!(long.is_sorted() && long[0] > 4500 && long[47] <= 5500, "{long:?}");
    }
}
