//! How far two computations of the same passes are apart.
//!
//! All forces count by which limits, designs and reports judge, place by place: in the cable those
//! on its ends and the largest compression and tension after a pass, on each end the largest and
//! the least during it, on each clamp that after it. A force in the cable or on an end is relative
//! to the largest at its place in that pass, a force on a clamp to the largest on that clamp in the
//! run; if a tenth of the largest of all in the run is more, or what friction holds on a centimetre
//! of cable, they are relative to that. A movement of an end is relative to the largest of the run,
//! or to a tenth of the duct's own. A clamp moves in proportion to its force.

use cable_dem::PassOutcome;
use cycle_jump::Record;
use ground_field::DuctMotion;

use crate::ground::peak;
use crate::scene::Scene;
use crate::tuning::meshes::{SHORT, SMALL};

/// A share of the forces and one of the movements.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[must_use]
pub struct Shares {
    pub force: f64,
    pub movement: f64,
}

impl Shares {
    /// The same share of both.
    pub fn both(share: f64) -> Self {
        Self {
            force: share,
            movement: share,
        }
    }

    /// `f` of each share and that of another.
    pub fn map(self, other: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        Self {
            force: f(self.force, other.force),
            movement: f(self.movement, other.movement),
        }
    }

    pub fn max(self, other: Self) -> Self {
        self.map(other, f64::max)
    }

    /// What is left without `other`.
    pub fn less(self, other: Self) -> Self {
        self.map(other, |a, b| a - b)
    }

    /// Whether both are at most as large as `allowed`.
    pub fn is_within(self, allowed: Self) -> bool {
        self.force <= allowed.force && self.movement <= allowed.movement
    }

    pub fn times(self, factor: f64) -> Self {
        self.map(self, |share, _| factor * share)
    }

    /// The larger of the two.
    pub fn worse(self) -> f64 {
        self.force.max(self.movement)
    }
}

impl std::ops::Add for Shares {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        self.map(other, |a, b| a + b)
    }
}

/// The largest of all.
impl FromIterator<Shares> for Shares {
    fn from_iter<I: IntoIterator<Item = Self>>(shares: I) -> Self {
        shares.into_iter().fold(Self::default(), Self::max)
    }
}

/// Forces and movements of a scene that are too small to count.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Scale {
    /// \[N\]
    pub force: f64,
    /// \[m\]
    pub movement: f64,
}

impl Scale {
    /// Of a scene whose duct moves by `motions`.
    pub fn new(scene: &Scene, motions: &[DuctMotion]) -> Self {
        Self {
            force: SHORT * scene.friction_limit(),
            movement: SMALL * peak(motions),
        }
    }

    /// Whether nothing slips in any of these passes, or so little that the forces it leaves do not
    /// count: on a coarse mesh a spring at the end may move where elsewhere a finer one would show
    /// slip.
    pub fn is_still(&self, records: &[Record]) -> bool {
        records.iter().all(|record| {
            let outcome = &record.outcome;
            outcome.dissipated == 0.0 || outcome.max_compression.max(outcome.max_tension) < self.force
        })
    }
}

/// Difference of every pass that both have.
pub fn differences(a: &[Record], b: &[Record], scale: Scale) -> Vec<Shares> {
    let whole = Whole::of(a, scale);
    let of_both = a.iter().filter_map(|record| {
        let same = b.binary_search_by_key(&record.pass, |other| other.pass).ok()?;
        Some((&record.outcome, &b[same].outcome))
    });
    of_both.map(|(a, b)| whole.difference(a, b)).collect()
}

/// The largest of these differences.
pub fn difference(a: &[Record], b: &[Record], scale: Scale) -> Shares {
    differences(a, b, scale).into_iter().collect()
}

/// Difference of the largest and least forces and movements in two sets of passes, each relative to
/// the largest at its place.
pub fn extremes_difference(a: &[Record], b: &[Record], scale: Scale) -> Shares {
    let whole = Whole::of(a, scale);
    let bounds = |records: &[Record]| {
        let forces = records.iter().map(|record| forces(&record.outcome));
        let moved = records.iter().map(|record| vec![movements(&record.outcome)]);
        (extremes(forces), extremes(moved))
    };
    let ((forces, moved), (other_forces, other_moved)) = (bounds(a), bounds(b));
    let largest_forces = whole.places.iter().map(|largest| largest.max(whole.force));
    let force = forces.iter().zip(&other_forces).zip(largest_forces);
    let force = force.map(|((a, b), largest)| share(apart(a, b), largest));
    let movement = moved
        .iter()
        .zip(&other_moved)
        .map(|(a, b)| share(apart(a, b), whole.movement));
    Shares {
        force: force.fold(0.0, f64::max),
        movement: movement.fold(0.0, f64::max),
    }
}

/// Largest force on an end during a pass or in the cable after it, in size \[N\].
pub fn largest_force(outcome: &PassOutcome) -> f64 {
    let places = forces(outcome);
    places[..CLAMPS]
        .iter()
        .map(|place| largest(place))
        .fold(0.0, f64::max)
}

/// Forces at a place, as many for each.
type Values = [f64; 4];

/// Number of places before the clamps: the cable, its upstream and its downstream end.
const CLAMPS: usize = 3;

/// Forces of a pass, place by place.
fn forces(outcome: &PassOutcome) -> Vec<Values> {
    let PassOutcome {
        force, peak, lowest, ..
    } = outcome;
    let mut places = vec![
        [
            force.upstream,
            force.downstream,
            outcome.max_compression,
            outcome.max_tension,
        ],
        [peak.upstream, lowest.upstream, 0.0, 0.0],
        [peak.downstream, lowest.downstream, 0.0, 0.0],
    ];
    let clamps = outcome.restraints.iter().zip(&outcome.restraint_ranges);
    places.extend(clamps.map(|(&force, &[least, most])| [force, least, most, 0.0]));
    places
}

/// Movements of the ends.
fn movements(outcome: &PassOutcome) -> Values {
    [
        outcome.upstream_displacement,
        outcome.downstream_displacement,
        0.0,
        0.0,
    ]
}

/// What the passes of a run are compared with.
struct Whole {
    /// Largest force at each place \[N\].
    places: Vec<f64>,
    /// The least force \[N\] and movement \[m\] that others are compared with.
    force: f64,
    movement: f64,
}

impl Whole {
    fn of(records: &[Record], scale: Scale) -> Self {
        let mut places = Vec::new();
        let mut movement = scale.movement;
        for Record { outcome, .. } in records {
            let forces = forces(outcome);
            places.resize(forces.len().max(places.len()), 0.0);
            for (most, values) in places.iter_mut().zip(forces) {
                *most = f64::max(*most, largest(&values));
            }
            movement = movement.max(largest(&movements(outcome)));
        }
        Self {
            force: places
                .iter()
                .fold(scale.force, |most, place| most.max(SMALL * place)),
            places,
            movement,
        }
    }

    /// Difference of one pass.
    fn difference(&self, a: &PassOutcome, b: &PassOutcome) -> Shares {
        let places = forces(a).into_iter().zip(forces(b)).enumerate();
        let shares = places.map(|(place, (a, b))| {
            let own = if place < CLAMPS {
                largest(&a)
            } else {
                self.places[place]
            };
            share(apart(&a, &b), own.max(self.force))
        });
        let (mut force, mut on_clamps) = (0.0_f64, 0.0_f64);
        for (place, share) in shares.enumerate() {
            force = force.max(share);
            if place >= CLAMPS {
                on_clamps = on_clamps.max(share);
            }
        }
        let moved = share(apart(&movements(a), &movements(b)), self.movement);
        Shares {
            force,
            movement: moved.max(on_clamps),
        }
    }
}

/// The least and the largest of each value of each place.
fn extremes(all: impl Iterator<Item = Vec<Values>>) -> Vec<[f64; 8]> {
    let mut extremes = Vec::new();
    for places in all {
        extremes.resize(places.len().max(extremes.len()), [0.0; 8]);
        for (bounds, values) in extremes.iter_mut().zip(places) {
            let (least, most) = bounds.split_at_mut(values.len());
            for ((least, most), value) in least.iter_mut().zip(most).zip(values) {
                *least = f64::min(*least, value);
                *most = f64::max(*most, value);
            }
        }
    }
    extremes
}

fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |most, value| most.max(value.abs()))
}

/// The largest difference of two lists of values.
fn apart(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).fold(0.0, |most, (a, b)| most.max((a - b).abs()))
}

/// part/whole; nothing of nothing is nothing.
fn share(part: f64, whole: f64) -> f64 {
    if part == 0.0 { 0.0 } else { part / whole }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SCALE: Scale = Scale {
        force: 1.0,
        movement: 1e-6,
    };

    /// One pass that leaves 100 N on both ends and in the cable, and some forces on clamps.
    fn pass(restraints: &[f64], change: impl Fn(&mut PassOutcome)) -> [Record; 1] {
        let mut outcome = PassOutcome::default();
        for ends in [&mut outcome.force, &mut outcome.peak, &mut outcome.lowest] {
            (ends.upstream, ends.downstream) = (100.0, 100.0);
        }
        outcome.max_compression = 100.0;
        outcome.restraints = restraints.to_vec();
        outcome.restraint_ranges = restraints.iter().map(|force| [*force; 2]).collect();
        change(&mut outcome);
        [Record {
            pass: 1,
            outcome,
            interpolated: false,
        }]
    }

    #[test]
    fn forces_during_a_pass_count_relative_to_the_largest_on_their_end() {
        let coarse = pass(&[], |outcome| outcome.peak.downstream = 400.0);
        let fine = pass(&[], |outcome| outcome.peak.downstream = 420.0);
        assert_eq!(difference(&coarse, &fine, SCALE).force, 20.0 / 400.0);
        let fine = pass(&[], |outcome| {
            outcome.peak.downstream = 400.0;
            outcome.lowest.upstream = 99.0;
        });
        assert_eq!(difference(&coarse, &fine, SCALE).force, 1.0 / 100.0);
    }

    #[test]
    fn a_force_on_a_clamp_counts_relative_to_the_largest_on_that_clamp() {
        let coarse = pass(&[500.0, 60.0], |_| {});
        let of = |first, second| {
            let difference = difference(&coarse, &pass(&[first, second], |_| {}), SCALE);
            assert_eq!(
                difference.force, difference.movement,
                "a clamp moves with its force"
            );
            difference.force
        };
        assert_eq!(of(505.0, 60.0), 5.0 / 500.0);
        assert_eq!(of(500.0, 63.0), 3.0 / 60.0);
        // Relative to a tenth of the largest of all, if that is more.
        let coarse = pass(&[500.0, 6.0], |_| {});
        let fine = pass(&[500.0, 7.0], |_| {});
        assert_eq!(difference(&coarse, &fine, SCALE).force, 1.0 / 50.0);
    }

    #[test]
    fn a_force_on_a_clamp_during_a_pass_counts_too() {
        let coarse = pass(&[500.0], |outcome| {
            outcome.restraint_ranges = vec![[-800.0, 500.0]]
        });
        let fine = pass(&[500.0], |outcome| {
            outcome.restraint_ranges = vec![[-840.0, 500.0]]
        });
        assert_eq!(difference(&coarse, &fine, SCALE).force, 40.0 / 800.0);
    }

    #[test]
    fn extremes_count_at_their_place() {
        let coarse = pass(&[500.0], |outcome| outcome.lowest.upstream = -20.0);
        let fine = pass(&[500.0], |outcome| outcome.lowest.upstream = -30.0);
        assert_eq!(extremes_difference(&coarse, &fine, SCALE).force, 10.0 / 100.0);
        assert_eq!(extremes_difference(&coarse, &coarse, SCALE), Shares::default());
    }
}
