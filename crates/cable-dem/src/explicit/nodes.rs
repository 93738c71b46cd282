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
        let per_mass = time_step / lumped.mass_per_metre;
        let gripped = self.accelerate(lumped, per_mass);
        let friction = lumped.cable.friction();
        let compliance = lumped.elastic_compliance();
        let coulomb = friction.law() == FrictionLaw::Coulomb;
        let (mut work, mut heat, mut gross) = (0.0, 0.0, 0.0);
        for i in 0..self.velocity.len() {
            let (increment, before) = (self.increment[i], self.friction[i]);
            let limit = lumped.chain.nodes[i].limit;
            let is_held = !lumped.chain.free.nodes().contains(&i);
            let (velocity, after) = if is_held {
                // Fixed ends do not move; their friction follows their own slip.
                (0.0, lumped.held.after_slip(before, increment, limit))
            } else if coulomb {
                // The friction that stops the slip, returned to ±q where that is too much (J. J. Moreau's time stepping, node by
                // node, as the masses are lumped).
                let stopping = (increment / time_step - self.velocity[i]) / per_mass;
                let after = stopping.max(-limit).min(limit);
                (self.velocity[i] + per_mass * after, after)
            } else {
                // All but Coulomb friction are found after the step that they act in.
                let velocity = self.velocity[i] + per_mass * before;
                let slip = increment - time_step * velocity;
                (velocity, friction.after_slip_within(before, slip, limit))
            };
            let moved = time_step * velocity;
            (self.velocity[i], self.friction[i]) = (velocity, after);
            self.displacement[i] += moved;
            // What is left of the slip apart from its elastic part, γ Δf.
            let slip = increment - moved - compliance * (after - before);
            let acting = if coulomb { after } else { before };
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

    /// v ← v + Δt (w p − (K + S) u)/m, with `per_mass` Δt/m′. Returned: the heat of clamps that slip \[J\].
    fn accelerate(&mut self, lumped: &mut Lumped, per_mass: f64) -> f64 {
        let (chain, u) = (&lumped.chain, &self.displacement);
        for (i, velocity) in self.velocity.iter_mut().enumerate() {
            *velocity -= per_mass * chain.balancing_friction(u, &lumped.load, i);
        }
        let mut gripped = 0.0;
        for grip in &mut lumped.grips {
            let (force, heat) = grip.bear(u[grip.node]);
            gripped += heat;
            self.velocity[grip.node] -= per_mass * force * chain.nodes[grip.node].per_tributary;
        }
        gripped
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
