//! The largest and least forces and movements of a day.

use cable_dem::PassOutcome;

use crate::period::{difference, largest};

/// A least and a largest value.
type Range = [f64; 2];

/// The range of no values.
const NONE: Range = [f64::INFINITY, f64::NEG_INFINITY];

/// Extremes of the cable at rest over a day: after every pass and every change of temperature.
#[derive(Debug, Clone, PartialEq)]
pub struct Extremes {
    /// Minimum and maximum force on the upstream and the downstream end \[N\].
    pub force: [Range; 2],
    /// Minimum and maximum displacement of the upstream and the downstream end \[m\].
    pub displacement: [Range; 2],
    /// Largest compression along the cable \[N\].
    pub compression: f64,
    /// Largest tension along the cable \[N\].
    pub tension: f64,
    /// Minimum and maximum force on each clamp \[N\].
    pub restraints: Vec<Range>,
}

impl Extremes {
    /// Over these outcomes; of none all largest values are −∞ and all least ones ∞.
    pub(super) fn of<'o>(outcomes: impl Iterator<Item = &'o PassOutcome>) -> Self {
        let mut extremes = Self {
            force: [NONE; 2],
            displacement: [NONE; 2],
            compression: NONE[1],
            tension: NONE[1],
            restraints: Vec::new(),
        };
        outcomes.for_each(|outcome| extremes.see(outcome));
        extremes
    }

    /// Takes account of an outcome.
    fn see(&mut self, outcome: &PassOutcome) {
        let widen = |range: &mut Range, value: f64| *range = [range[0].min(value), range[1].max(value)];
        widen(&mut self.force[0], outcome.force.upstream);
        widen(&mut self.force[1], outcome.force.downstream);
        widen(&mut self.displacement[0], outcome.upstream_displacement);
        widen(&mut self.displacement[1], outcome.downstream_displacement);
        self.compression = self.compression.max(outcome.max_compression);
        self.tension = self.tension.max(outcome.max_tension);
        self.restraints.resize(outcome.restraints.len(), NONE);
        for (range, force) in self.restraints.iter_mut().zip(&outcome.restraints) {
            widen(range, *force);
        }
    }

    fn forces(&self) -> Vec<f64> {
        let ends = self.force.as_flattened().iter().copied();
        ends.chain([self.compression, self.tension]).collect()
    }

    /// Largest force in size \[N\].
    pub fn largest_force(&self) -> f64 {
        largest(&self.forces())
    }

    /// Largest difference to `other`: of a force as a share of the largest, or of `least.0` \[N\]
    /// if that is more, on a clamp also of the largest on a clamp; of a movement as a share of the
    /// larger range of both ends, or of `least.1` \[m\].
    pub fn difference(&self, other: &Self, least: (f64, f64)) -> (f64, f64) {
        let apart =
            |own: &[Range], other: &[Range]| largest(&difference(own.as_flattened(), other.as_flattened()));
        let scale = self.largest_force().max(least.0);
        let force = largest(&difference(&self.forces(), &other.forces())) / scale;
        let on_clamps = largest(self.restraints.as_flattened()).max(scale);
        let clamps = apart(&self.restraints, &other.restraints) / on_clamps;
        let range = self.displacement.map(|[least, most]| most - least);
        let moved = apart(&self.displacement, &other.displacement) / largest(&range).max(least.1);
        (force.max(clamps), moved)
    }
}
