//! How far two computations of the same passes are apart.
//!
//! All forces count by which limits, designs and reports judge, place by place: in the cable those
//! on its ends and the largest compression and tension after a pass, on each end the largest and
//! the least during it, on each clamp those after it and during it. A force in the cable or on an
//! end is relative to the largest at its place in that pass, a force on a clamp to the largest on
//! that clamp in the run; if a tenth of the largest of all in the run is more, or what friction
//! holds on a centimetre of cable, they are relative to that. A movement of an end is relative to
//! the largest of the run, or to a tenth of the duct's own. A clamp moves in proportion to its
//! force.

use cable_dem::PassOutcome;
use cycle_jump::Record;
use ground_field::DuctMotion;

use creepage_plan::ground::peak;
use creepage_scene::Scene;

/// Forces below this share of the largest one of the run are compared with that share of it,
/// and movements of an end below this share of the duct's largest.
pub const SMALL: f64 = 0.1;

/// The length of cable \[m\] on which friction holds a force that does not count.
const SHORT: f64 = 0.01;

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
        let (force, movement) = (share, share);
        Self { force, movement }
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

/// The record of this `pass`, if it is among these.
pub fn record_of(records: &[Record], pass: u64) -> Option<&Record> {
    let place = records.binary_search_by_key(&pass, |record| record.pass);
    place.ok().map(|place| &records[place])
}

/// Difference of every pass that both have.
pub fn differences(a: &[Record], b: &[Record], scale: Scale) -> Vec<Shares> {
    let whole = Whole::of(a, scale);
    let of_both = a.iter().filter_map(|record| {
        let same = record_of(b, record.pass)?;
        let (a, b) = (places(&record.outcome), places(&same.outcome));
        let own = |place: usize| match place {
            MOVEMENT.. => whole.places[place],
            _ => largest(&a[place]).max(whole.force),
        };
        Some(shares_between(&a, &b, own))
    });
    of_both.collect()
}

/// The largest of these differences.
pub fn difference(a: &[Record], b: &[Record], scale: Scale) -> Shares {
    differences(a, b, scale).into_iter().collect()
}

/// Difference of the largest and least forces and movements in two sets of passes, each relative to
/// the largest at its place.
pub fn extremes_difference(a: &[Record], b: &[Record], scale: Scale) -> Shares {
    let whole = Whole::of(a, scale);
    let at = |place: usize| whole.places[place];
    let least = shares_between(&extremes(a, f64::min), &extremes(b, f64::min), at);
    least.max(shares_between(&extremes(a, f64::max), &extremes(b, f64::max), at))
}

/// Largest force on an end during a pass or in the cable after it, in size \[N\].
pub fn largest_force(outcome: &PassOutcome) -> f64 {
    let places = places(outcome);
    places[..MOVEMENT].iter().map(largest).fold(0.0, f64::max)
}

/// The larger in size of two forces.
pub fn larger(a: f64, b: f64) -> f64 {
    if b.abs() > a.abs() { b } else { a }
}

/// Forces or movements at a place, as many for each.
type Values = [f64; 4];

/// The place of the movements of the ends: before it the cable and its upstream and downstream end,
/// behind it the clamps.
const MOVEMENT: usize = 3;

/// Forces and movements of a pass, place by place.
fn places(outcome: &PassOutcome) -> Vec<Values> {
    let (force, peak, lowest) = (outcome.force, outcome.peak, outcome.lowest);
    let inside = [outcome.max_compression, outcome.max_tension];
    let moved = [outcome.upstream_displacement, outcome.downstream_displacement];
    let mut places = vec![
        [force.upstream, force.downstream, inside[0], inside[1]],
        [peak.upstream, lowest.upstream, 0.0, 0.0],
        [peak.downstream, lowest.downstream, 0.0, 0.0],
        [moved[0], moved[1], 0.0, 0.0],
    ];
    let clamps = outcome.restraints.iter().zip(&outcome.restraint_ranges);
    places.extend(clamps.map(|(&force, &[least, most])| [force, least, most, 0.0]));
    places
}

/// The largest difference at any place, as a share of what `whole` gives for it: a clamp moves with
/// its force.
fn shares_between(a: &[Values], b: &[Values], whole: impl Fn(usize) -> f64) -> Shares {
    let of_place = |(place, (a, b)): (usize, (&Values, &Values))| {
        let apart = a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        let share = if apart == 0.0 { 0.0 } else { apart / whole(place) };
        Shares {
            force: if place == MOVEMENT { 0.0 } else { share },
            movement: if place < MOVEMENT { 0.0 } else { share },
        }
    };
    a.iter().zip(b).enumerate().map(of_place).collect()
}

/// What the passes of a run are compared with.
struct Whole {
    /// The largest at each place \[N or m\], if that counts.
    places: Vec<f64>,
    /// The least force that others are compared with \[N\].
    force: f64,
}

impl Whole {
    fn of(records: &[Record], scale: Scale) -> Self {
        let all = [f64::min, f64::max].map(|bound| extremes(records, bound));
        let all = all[0].iter().zip(&all[1]);
        let mut places: Vec<f64> = all.map(|(a, b)| largest(a).max(largest(b))).collect();
        let forces = places.iter().enumerate().filter(|(place, _)| *place != MOVEMENT);
        let force = forces.fold(scale.force, |most, (_, place)| most.max(SMALL * place));
        for (place, most) in places.iter_mut().enumerate() {
            *most = most.max(if place == MOVEMENT { scale.movement } else { force });
        }
        Self { places, force }
    }
}

/// The least or the largest of each value of each place, and nothing.
fn extremes(records: &[Record], bound: fn(f64, f64) -> f64) -> Vec<Values> {
    let mut extremes: Vec<Values> = Vec::new();
    for record in records {
        let places = places(&record.outcome);
        extremes.resize(places.len().max(extremes.len()), [0.0; 4]);
        for (most, value) in extremes.as_flattened_mut().iter_mut().zip(places.as_flattened()) {
            *most = bound(*most, *value);
        }
    }
    extremes
}

fn largest(values: &Values) -> f64 {
    values.iter().fold(0.0, |most, value| most.max(value.abs()))
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
            outcome.restraint_ranges = vec![[-800.0, 500.0]];
        });
        let fine = pass(&[500.0], |outcome| {
            outcome.restraint_ranges = vec![[-840.0, 500.0]];
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
