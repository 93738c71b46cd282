//! Passes that show larger forces or movements than those that are recorded before and soon after them.
//!
//! In a long period of the traffic few passes are wanted, and a heavy vehicle that comes seldom is rarely among them.

use cable_dem::PassOutcome;

use crate::period::Period;
use crate::record::Record;

/// What is larger by this share of the largest of its kind counts as larger.
const NOTICEABLE: f64 = 1e-3;

/// Those of the `others` that show a larger force or movement than all `records` up to the first after them, and than each other before,
/// ascending.
pub fn peaks(records: &[Record], mut others: Vec<Record>) -> Vec<Record> {
    others.sort_by_key(|record| record.pass);
    let all = || records.iter().chain(&others);
    let largest = all().fold(Extent::default(), |extent, record| extent.with(&record.outcome));
    let mut seen = Extent::default();
    let mut next = 0;
    let mut peaks = Vec::new();
    for record in &others {
        let until = records.partition_point(|other| other.pass < record.pass) + 1;
        for other in records.iter().take(until).skip(next) {
            seen = seen.with(&other.outcome);
        }
        next = next.max(until);
        let with = seen.clone().with(&record.outcome);
        if with.exceeds(&seen, &largest) {
            seen = with;
            peaks.push(record.clone());
        }
    }
    peaks
}

/// The places of a period whose passes show the largest of some force or movement.
pub fn largest_places(period: &Period) -> Vec<usize> {
    let outcomes: Vec<Vec<f64>> = period.outcomes().map(values).collect();
    let count = outcomes.first().map_or(0, Vec::len);
    let mut places: Vec<usize> = (0..count)
        .filter_map(|value| {
            (0..outcomes.len()).max_by(|&a, &b| outcomes[a][value].total_cmp(&outcomes[b][value]))
        })
        .collect();
    places.sort_unstable();
    places.dedup();
    places
}

/// The largest of every force and movement so far.
#[derive(Debug, Clone, Default)]
struct Extent(Vec<f64>);

impl Extent {
    fn with(mut self, outcome: &PassOutcome) -> Self {
        let values = values(outcome);
        self.0.resize(values.len(), 0.0);
        for (most, value) in self.0.iter_mut().zip(values) {
            *most = most.max(value);
        }
        self
    }

    /// Whether anything in it is noticeably larger than in `other`, where the `largest` of all is this.
    fn exceeds(&self, other: &Self, largest: &Self) -> bool {
        let scale = |values: &[f64]| values.iter().fold(0.0_f64, |most, value| most.max(*value));
        let (movements, forces) = largest.0.split_at(MOVEMENTS.min(largest.0.len()));
        let scales = [scale(movements), scale(forces)];
        let at = |other: &Self, place: usize| other.0.get(place).copied().unwrap_or(0.0);
        self.0.iter().enumerate().any(|(place, value)| {
            value - at(other, place) > NOTICEABLE * scales[usize::from(place >= MOVEMENTS)]
        })
    }
}

/// Number of movements among the [`values`], which come first.
const MOVEMENTS: usize = 4;

/// Movements and forces of which the largest counts.
fn values(outcome: &PassOutcome) -> Vec<f64> {
    let PassOutcome {
        force,
        peak,
        lowest,
        upstream_displacement,
        downstream_displacement,
        ..
    } = outcome;
    let movements = [
        *upstream_displacement,
        -upstream_displacement,
        *downstream_displacement,
        -downstream_displacement,
    ];
    let forces = [
        peak.upstream,
        peak.downstream,
        -lowest.upstream,
        -lowest.downstream,
        force.upstream,
        force.downstream,
        -force.upstream,
        -force.downstream,
        outcome.max_compression,
        outcome.max_tension,
    ];
    let clamps = outcome.restraints.iter().flat_map(|force| [*force, -force]);
    movements.into_iter().chain(forces).chain(clamps).collect()
}
