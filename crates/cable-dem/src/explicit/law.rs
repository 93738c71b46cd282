//! Friction laws as the explicit step takes them: one node, one step, no branch.

use super::tanh::tanh;
use crate::{Friction, FrictionLaw};

/// A friction law at a fixed time step. Given a node's velocity after the elastic forces \[m/s\], how far its duct moves in
/// the step \[m\] and the friction before \[N/m\]: the velocity with friction, and the friction after.
pub(super) trait ContactLaw: Copy {
    /// Whether the friction that acts in a step is that of its start; else it is found with the velocity.
    const LAGS: bool;

    fn step(self, velocity: f64, duct: f64, friction: f64) -> (f64, f64);
}

/// Constants of one law at one time step.
#[derive(Debug, Clone, Copy)]
pub(super) struct Constants {
    /// q \[N/m\].
    limit: f64,
    /// Δt \[s\].
    time_step: f64,
    /// Δt/m′ \[m·s/kg\].
    per_mass: f64,
    /// q b/2 or b/2, or 1/Δt for Coulomb's law.
    factor: f64,
}

impl Constants {
    pub fn new(friction: Friction, mass_per_metre: f64, time_step: f64) -> Self {
        let limit = friction.limit();
        Self {
            limit,
            time_step,
            per_mass: time_step / mass_per_metre,
            factor: match friction.law() {
                FrictionLaw::Coulomb => 1.0 / time_step,
                FrictionLaw::ElasticPlastic { shape_factor } => 0.5 * limit * shape_factor,
                FrictionLaw::Sigmoid { shape_factor } => 0.5 * shape_factor,
            },
        }
    }
}

/// f ← clamp(f + (q b/2) Δs, −q, q): return mapping of the elastic predictor.
#[derive(Debug, Clone, Copy)]
pub(super) struct ElasticPlastic(pub Constants);

/// f = q tanh(b Δs/2).
#[derive(Debug, Clone, Copy)]
pub(super) struct Sigmoid(pub Constants);

/// The friction that stops the slip, returned to ±q where that is too much (J. J. Moreau's time stepping, node by node,
/// as the masses are lumped).
#[derive(Debug, Clone, Copy)]
pub(super) struct Coulomb(pub Constants);

impl ContactLaw for ElasticPlastic {
    const LAGS: bool = true;

    #[inline]
    fn step(self, velocity: f64, duct: f64, friction: f64) -> (f64, f64) {
        let velocity = velocity + self.0.per_mass * friction;
        let trial = friction + self.0.factor * (duct - self.0.time_step * velocity);
        (velocity, trial.max(-self.0.limit).min(self.0.limit))
    }
}

impl ContactLaw for Sigmoid {
    const LAGS: bool = true;

    #[inline]
    fn step(self, velocity: f64, duct: f64, friction: f64) -> (f64, f64) {
        let velocity = velocity + self.0.per_mass * friction;
        (
            velocity,
            self.0.limit * tanh(self.0.factor * (duct - self.0.time_step * velocity)),
        )
    }
}

impl ContactLaw for Coulomb {
    const LAGS: bool = false;

    #[inline]
    fn step(self, velocity: f64, duct: f64, _: f64) -> (f64, f64) {
        let stopping = (duct * self.0.factor - velocity) / self.0.per_mass;
        let friction = stopping.max(-self.0.limit).min(self.0.limit);
        (velocity + self.0.per_mass * friction, friction)
    }
}
