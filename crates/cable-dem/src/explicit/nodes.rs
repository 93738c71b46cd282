//! One explicit step.

use super::energy::EnergyBalance;
use super::lumped::Lumped;
use crate::{CableState, EndForces, FrictionLaw};

/// Motion and energy accounts of all nodes.
#[derive(Debug, Clone)]
pub(super) struct MovingNodes {
    /// u \[m\].
    displacement: Vec<f64>,
    /// v \[m/s\], half a step back.
    velocity: Vec<f64>,
    /// f \[N/m\].
    friction: Vec<f64>,
    /// D \[m\].
    pub duct: Vec<f64>,
    /// ΔD and plastic slip of the step before \[m\].
    before: Vec<[f64; 2]>,
    /// ΔD of the current step \[m\].
    increment: Vec<f64>,
    /// Work of the duct, heat, and its absolute amount \[J\].
    work: f64,
    heat: f64,
    gross: f64,
}

/// Friction of one node over one step of time.
#[derive(Debug, Clone, Copy)]
struct NodeFriction {
    law: FrictionLaw,
    /// Friction limit that makes the law's slope \[N/m\].
    limit: f64,
    /// Δt \[s\], and Δt/m′.
    time_step: f64,
    per_mass: f64,
}

impl NodeFriction {
    /// Given the node's `velocity` after the elastic forces \[m/s\], how far its duct moves in the
    /// step \[m\] and the `friction` before \[N/m\], with the limit `q` \[N/m\]: its velocity with
    /// friction, and the friction after.
    fn act(self, velocity: f64, duct: f64, friction: f64, q: f64) -> (f64, f64) {
        // All but Coulomb friction are found after the step that they act in.
        let rubbed = velocity + self.per_mass * friction;
        let slip = duct - self.time_step * rubbed;
        match self.law {
            // The friction that stops the slip, returned to ±q where that is too much (J. J.
            // Moreau's time stepping, node by node, as the masses are lumped).
            FrictionLaw::Coulomb => {
                let stopping = (duct / self.time_step - velocity) / self.per_mass;
                let friction = stopping.max(-q).min(q);
                (velocity + self.per_mass * friction, friction)
            }
            // f ← clamp(f + (q b/2) Δs, −q, q): return mapping of the elastic predictor.
            FrictionLaw::ElasticPlastic { shape_factor } => {
                let trial = friction + 0.5 * self.limit * shape_factor * slip;
                (rubbed, trial.max(-q).min(q))
            }
            FrictionLaw::Sigmoid { shape_factor } => {
                (rubbed, q * (0.5 * shape_factor * (self.limit / q) * slip).tanh())
            }
        }
    }
}

impl MovingNodes {
    /// At rest in `state`.
    pub fn new(state: &CableState) -> Self {
        let nodes = state.friction.len();
        let zeros = || vec![0.0; nodes];
        Self {
            displacement: state.displacement.clone(),
            velocity: zeros(),
            friction: state.friction.clone(),
            duct: zeros(),
            before: vec![[0.0; 2]; nodes],
            increment: zeros(),
            work: 0.0,
            heat: 0.0,
            gross: 0.0,
        }
    }

    /// One step of `time_step` \[s\]; `displacement` writes where the duct stands after it \[m\].
    pub fn step(&mut self, lumped: &mut Lumped, displacement: impl Fn(&mut [f64]), time_step: f64) {
        displacement(&mut self.increment);
        lumped.chain.press(|i| self.displacement[i], 0.0);
        for (duct, increment) in self.duct.iter_mut().zip(&mut self.increment) {
            let before = std::mem::replace(duct, *increment);
            *increment -= before;
        }
        // v ← v + Δt (w p − (K + S) u)/m.
        let per_mass = time_step / lumped.mass_per_metre;
        for (i, velocity) in self.velocity.iter_mut().enumerate() {
            *velocity -= per_mass
                * lumped
                    .chain
                    .balancing_friction(&self.displacement, &lumped.load, i);
        }
        let mut gripped = 0.0;
        for grip in &mut lumped.grips {
            let (force, heat) = grip.bear(self.displacement[grip.node]);
            gripped += heat;
            self.velocity[grip.node] -= per_mass * force * lumped.chain.nodes[grip.node].per_tributary;
        }
        let friction = NodeFriction {
            law: lumped.cable.friction().law(),
            limit: lumped.cable.friction().limit(),
            time_step,
            per_mass,
        };
        let compliance = lumped.elastic_compliance();
        // Coulomb friction is found with the velocity; any other that acts in a step is that of its start.
        let found_at_once = friction.law == FrictionLaw::Coulomb;
        let (mut work, mut heat, mut gross) = (0.0, 0.0, 0.0);
        for i in 0..self.velocity.len() {
            let (increment, before) = (self.increment[i], self.friction[i]);
            let (mut velocity, mut after) =
                friction.act(self.velocity[i], increment, before, lumped.chain.nodes[i].limit);
            // Fixed ends do not move; their friction follows their own slip.
            let is_held = !lumped.chain.free.nodes().contains(&i);
            if is_held {
                (velocity, after) = (
                    0.0,
                    lumped
                        .held
                        .after_slip(before, increment, lumped.chain.nodes[i].limit),
                );
            }
            let moved = time_step * velocity;
            (self.velocity[i], self.friction[i]) = (velocity, after);
            self.displacement[i] += moved;
            // What is left of the slip apart from its elastic part, γ Δf.
            let slip = increment - moved - compliance * (after - before);
            let acting = if found_at_once { after } else { before };
            // Friction acts from one half step to the next: on half the slip of either step.
            let weight = 0.5 * lumped.chain.nodes[i].tributary * acting;
            let [earlier, plastic] = std::mem::replace(&mut self.before[i], [increment, slip]);
            let done = weight * (plastic + slip);
            work += weight * (earlier + increment);
            heat += done;
            // A held node cannot chatter; what its friction returns is the stretch of the cable within its half element.
            gross += if is_held { done } else { done.abs() };
        }
        self.work += work;
        self.heat += heat + gripped;
        self.gross += gross + gripped;
    }

    pub fn end_forces(&self, lumped: &Lumped) -> EndForces {
        lumped.end_forces(&self.displacement, &self.friction)
    }

    /// Displacement of a node \[m\].
    pub fn displacement(&self, node: usize) -> f64 {
        self.displacement[node]
    }

    /// Writes displacement and friction to `state`.
    pub fn store(&self, state: &mut CableState) {
        state.displacement.copy_from_slice(&self.displacement);
        state.friction.copy_from_slice(&self.friction);
    }

    /// ½ Σ m v² \[J\].
    pub fn kinetic_energy(&self, lumped: &Lumped) -> f64 {
        0.5 * lumped.mass_per_metre * lumped.weighted(|i| self.velocity[i].powi(2))
    }

    /// The accounts of a pass that began in `state` with the `elastic` energy \[J\].
    pub fn energy(
        &self,
        lumped: &Lumped,
        (state, elastic): (&CableState, f64),
        peak_kinetic: f64,
    ) -> EnergyBalance {
        let stored = lumped.stored_energy(&state.friction);
        let moved = self.displacement.iter().zip(&state.displacement);
        let body_work = moved
            .zip(&lumped.load)
            .map(|((after, before), load)| load * (after - before));
        EnergyBalance {
            duct_work: self.work,
            body_work: body_work.sum(),
            elastic: lumped.elastic_energy(&self.displacement) - elastic,
            kinetic: self.kinetic_energy(lumped),
            stored: lumped.stored_energy(&self.friction) - stored,
            dissipated: self.heat,
            returned: 0.5 * (self.gross - self.heat),
            peak_kinetic,
            initial: elastic + stored,
            reference: 0.0,
        }
    }
}
