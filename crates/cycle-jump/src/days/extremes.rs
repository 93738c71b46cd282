//! The largest and least forces and movements of a day.

use cable_dem::{EndForces, PassOutcome};

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
    /// Of nothing yet.
    pub fn none() -> Self {
        let (least, most) = (f64::INFINITY, f64::NEG_INFINITY);
        Self {
            most: ends(most, most),
            least: ends(least, least),
            compression: most,
            tension: most,
            forward: [most; 2],
            backward: [least; 2],
            restraints: Vec::new(),
        }
    }

    /// Takes account of the cable at rest as `seen`.
    pub fn see(&mut self, seen: &PassOutcome) {
        let displacement = [seen.upstream_displacement, seen.downstream_displacement];
        self.join(&Self {
            most: seen.force,
            least: seen.force,
            compression: seen.max_compression,
            tension: seen.max_tension,
            forward: displacement,
            backward: displacement,
            restraints: seen.restraints.iter().map(|force| [*force; 2]).collect(),
        });
    }

    /// Takes account of another day.
    pub fn join(&mut self, other: &Self) {
        *self = self.with(other, f64::max, f64::min);
    }

    /// Largest force in size \[N\].
    pub fn largest_force(&self) -> f64 {
        [
            self.most.upstream,
            self.most.downstream,
            self.least.upstream,
            self.least.downstream,
            self.compression,
            self.tension,
        ]
        .into_iter()
        .fold(0.0, |largest, force| largest.max(force.abs()))
    }

    /// Largest force on a clamp, in size \[N\].
    fn on_clamps(&self) -> f64 {
        let forces = self.restraints.iter().flatten();
        forces.fold(0.0, |largest, force| largest.max(force.abs()))
    }

    /// How far the end moves that moves farther \[m\].
    pub fn range(&self) -> f64 {
        (self.forward[0] - self.backward[0]).max(self.forward[1] - self.backward[1])
    }

    /// What this day has beside `other`.
    #[must_use]
    pub fn less(&self, other: &Self) -> Self {
        self.with(other, |a, b| a - b, |a, b| a - b)
    }

    /// This day with all of `change` added.
    #[must_use]
    pub fn plus(&self, change: &Self) -> Self {
        self.with(change, |a, b| a + b, |a, b| a + b)
    }

    /// The same day with the cable moved as a whole by `distance` \[m\].
    #[must_use]
    pub fn moved(&self, distance: f64) -> Self {
        let mut moved = self.clone();
        for place in moved.forward.iter_mut().chain(&mut moved.backward) {
            *place += distance;
        }
        moved
    }

    /// Largest difference to `other`: of a force as a share of the largest, or of `least.0` \[N\], on a clamp also of the largest on a clamp,
    /// of a movement as a share of the range,
    /// or of `least.1` \[m\].
    pub fn difference(&self, other: &Self, least: (f64, f64)) -> (f64, f64) {
        let apart = self.less(other);
        let scale = self.largest_force().max(least.0);
        let force = (apart.largest_force() / scale).max(apart.on_clamps() / self.on_clamps().max(scale));
        let moved = apart.forward.into_iter().chain(apart.backward);
        let moved = moved.fold(0.0_f64, |most, moved| most.max(moved.abs()));
        (force, moved / self.range().max(least.1))
    }

    /// `upper` of what is a largest value and `lower` of what is a least one.
    fn with(&self, other: &Self, upper: impl Fn(f64, f64) -> f64, lower: impl Fn(f64, f64) -> f64) -> Self {
        let both = |a: [f64; 2], b: [f64; 2], f: &dyn Fn(f64, f64) -> f64| [f(a[0], b[0]), f(a[1], b[1])];
        let of = |a: EndForces, b: EndForces, f: &dyn Fn(f64, f64) -> f64| {
            ends(f(a.upstream, b.upstream), f(a.downstream, b.downstream))
        };
        // Nothing yet has no clamps either.
        let restraints = match &self.restraints[..] {
            [] => other.restraints.clone(),
            own => own
                .iter()
                .zip(&other.restraints)
                .map(|(a, b)| [lower(a[0], b[0]), upper(a[1], b[1])])
                .collect(),
        };
        Self {
            restraints,
            most: of(self.most, other.most, &upper),
            least: of(self.least, other.least, &lower),
            compression: upper(self.compression, other.compression),
            tension: upper(self.tension, other.tension),
            forward: both(self.forward, other.forward, &upper),
            backward: both(self.backward, other.backward, &lower),
        }
    }
}

fn ends(upstream: f64, downstream: f64) -> EndForces {
    EndForces { upstream, downstream }
}
