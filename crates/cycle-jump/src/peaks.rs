//! Passes that show larger forces or movements than the recorded ones around them.
//!
//! In a long period of the traffic few passes are wanted, and a heavy vehicle that comes seldom is
//! rarely among them.

use std::collections::BTreeSet;

use cable_dem::PassOutcome;

use crate::period::Period;
use crate::record::Record;

/// What is larger by this share of the largest of its kind counts as larger.
const NOTICEABLE: f64 = 1e-3;

/// Number of movements among the [`values`], which come first.
const MOVEMENTS: usize = 4;

/// Those of the `others` that show a noticeably larger force or movement than all `records` up to
/// the first after them, and than each other before; in ascending order.
pub fn peaks(records: &[Record], mut others: Vec<Record>) -> Vec<Record> {
    others.sort_by_key(|record| record.pass);
    let mut all = Vec::new();
    for record in records.iter().chain(&others) {
        raise(&mut all, &values(&record.outcome));
    }
    let largest = |values: &[f64]| values.iter().fold(0.0_f64, |most, value| most.max(*value));
    let (movements, forces) = all.split_at(MOVEMENTS.min(all.len()));
    let noticeable = [movements, forces].map(|values| NOTICEABLE * largest(values));
    let mut most = vec![0.0; all.len()];
    let mut next = 0;
    others.retain(|record| {
        let until = records.partition_point(|other| other.pass < record.pass) + 1;
        for other in records.iter().take(until).skip(next) {
            raise(&mut most, &values(&other.outcome));
        }
        next = next.max(until);
        let values = values(&record.outcome);
        let is_peak = values
            .iter()
            .zip(&most)
            .enumerate()
            .any(|(k, (value, most))| value - most > noticeable[usize::from(k >= MOVEMENTS)]);
        if is_peak {
            raise(&mut most, &values);
        }
        is_peak
    });
    others
}

/// The places of a `period` whose passes show the largest of some force or movement.
pub fn largest_places(period: &Period) -> BTreeSet<usize> {
    let mut largest: Vec<(f64, usize)> = Vec::new();
    for (place, outcome) in period.outcomes().iter().enumerate() {
        let values = values(outcome);
        largest.resize(values.len(), (f64::NEG_INFINITY, place));
        for (largest, value) in largest.iter_mut().zip(values) {
            *largest = if value >= largest.0 {
                (value, place)
            } else {
                *largest
            };
        }
    }
    largest.into_iter().map(|(_, place)| place).collect()
}

/// Raises each of `most` to the one of `values`; what is missing begins with zero.
fn raise(most: &mut Vec<f64>, values: &[f64]) {
    most.resize(most.len().max(values.len()), 0.0);
    for (most, value) in most.iter_mut().zip(values) {
        *most = most.max(*value);
    }
}

/// Movements and forces of which the largest counts, each with both signs.
fn values(outcome: &PassOutcome) -> Vec<f64> {
    let (force, peak, lowest) = (outcome.force, outcome.peak, outcome.lowest);
    let ends = [outcome.upstream_displacement, outcome.downstream_displacement];
    let rest = [force.upstream, force.downstream];
    let signed = ends
        .into_iter()
        .chain(rest)
        .chain(outcome.restraints.iter().copied());
    let during = [
        peak.upstream,
        peak.downstream,
        -lowest.upstream,
        -lowest.downstream,
    ];
    let on_clamps = outcome
        .restraint_ranges
        .iter()
        .flat_map(|[least, most]| [-least, *most]);
    let inside = [outcome.max_compression, outcome.max_tension];
    signed
        .flat_map(|value| [value, -value])
        .chain(during)
        .chain(on_clamps)
        .chain(inside)
        .collect()
}
