//! The largest and least forces and movements of a day.

use cable_dem::{EndForces, PassOutcome};

use crate::period::{difference, largest};

/// Extremes of the cable at rest over a day: after every pass and every change of temperature.
#[derive(Debug, Clone, PartialEq)]
pub struct Extremes {
    /// Largest force on each end \[N\].
    pub most: EndForces,
    /// Least force on each end \[N\].
    pub least: EndForces,
    /// Largest compression along the cable \[N\].
    pub compression: f64,
    /// Largest tension along the cable \[N\].
    pub tension: f64,
    /// Each end's farthest place toward growing x \[m\].
    pub forward: [f64; 2],
    /// Each end's farthest place toward falling x \[m\].
    pub backward: [f64; 2],
    /// Least and largest force on each clamp \[N\].
    pub restraints: Vec<[f64; 2]>,
}

impl Extremes {
    /// Over these outcomes; of none all largest values are −∞ and all least ones ∞.
    pub(super) fn of<'o>(outcomes: impl Iterator<Item = &'o PassOutcome>) -> Self {
        let (least, most) = (f64::INFINITY, f64::NEG_INFINITY);
        let ends = |force| EndForces {
            upstream: force,
            downstream: force,
        };
        let mut extremes = Self {
            most: ends(most),
            least: ends(least),
            compression: most,
            tension: most,
            forward: [most; 2],
            backward: [least; 2],
            restraints: Vec::new(),
        };
        outcomes.for_each(|outcome| extremes.see(outcome));
        extremes
    }

    /// Takes account of an outcome.
    fn see(&mut self, outcome: &PassOutcome) {
        let force = outcome.force;
        self.most.upstream = self.most.upstream.max(force.upstream);
        self.most.downstream = self.most.downstream.max(force.downstream);
        self.least.upstream = self.least.upstream.min(force.upstream);
        self.least.downstream = self.least.downstream.min(force.downstream);
        self.compression = self.compression.max(outcome.max_compression);
        self.tension = self.tension.max(outcome.max_tension);
        let places = [outcome.upstream_displacement, outcome.downstream_displacement];
        for (end, place) in places.into_iter().enumerate() {
            self.forward[end] = self.forward[end].max(place);
            self.backward[end] = self.backward[end].min(place);
        }
        let none = [f64::INFINITY, f64::NEG_INFINITY];
        self.restraints.resize(outcome.restraints.len(), none);
        for ([least, most], force) in self.restraints.iter_mut().zip(&outcome.restraints) {
            (*least, *most) = (least.min(*force), most.max(*force));
        }
    }

    fn forces(&self) -> [f64; 6] {
        let (most, least) = (self.most, self.least);
        let ends = [most.upstream, most.downstream, least.upstream, least.downstream];
        let [a, b, c, d] = ends;
        [a, b, c, d, self.compression, self.tension]
    }

    /// Largest force in size \[N\].
    pub fn largest_force(&self) -> f64 {
        largest(&self.forces())
    }

    /// How far the end moves that moves farther \[m\].
    fn range(&self) -> f64 {
        largest(&difference(&self.forward, &self.backward))
    }

    /// Largest difference to `other`: of a force as a share of the largest, or of `least.0` \[N\] if that
    /// is more, on a clamp also of the largest on a clamp; of a movement as a share of the range, or of
    /// `least.1` \[m\].
    pub fn difference(&self, other: &Self, least: (f64, f64)) -> (f64, f64) {
        let scale = self.largest_force().max(least.0);
        let forces = largest(&difference(&self.forces(), &other.forces()));
        let (own, others) = (self.restraints.as_flattened(), other.restraints.as_flattened());
        let clamps = largest(&difference(own, others)) / largest(own).max(scale);
        let forward = largest(&difference(&self.forward, &other.forward));
        let moved = forward.max(largest(&difference(&self.backward, &other.backward)));
        ((forces / scale).max(clamps), moved / self.range().max(least.1))
    }
}
