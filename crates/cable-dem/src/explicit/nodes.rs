//! One explicit step.

use super::energy::EnergyBalance;
use crate::lumped::Lumped;
use crate::{CableState, EndForces, FrictionLaw};

/// Motion and energy accounts of all nodes.
#[derive(Debug, Clone)]
pub(super) struct MovingNodes {
    /// u \[m\].
    displacement: Vec<f64>,
    /// v \[m/s\], half a step back.
    pub velocity: Vec<f64>,
    /// f \[N/m\].
    friction: Vec<f64>,
    /// D \[m\].
    pub duct: Vec<f64>,
    /// ΔD and plastic slip of the step before \[m\].
    before: Vec<[f64; 2]>,
    /// ΔD of the current step \[m\].
    pub increment: Vec<f64>,
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

    /// One step of `time_step` \[s\]; the duct's increments stand in `increment`.
    ///
    /// `law` is the friction of one node: given its velocity after the elastic forces \[m/s\], how far its duct moves in the step \[m\] and
    /// the friction before \[N/m\], the velocity with friction, and the friction after.
    pub fn step(
        &mut self,
        lumped: &Lumped,
        law: impl Fn(f64, f64, f64) -> (f64, f64) + Copy,
        time_step: f64,
    ) {
        self.accelerate(lumped, time_step);
        let last = self.velocity.len() - 1;
        let compliance = lumped.elastic_compliance();
        // Coulomb friction is found with the velocity; any other that acts in a step is that of its start.
        let found_at_once = lumped.cable.friction().law() == FrictionLaw::Coulomb;
        let (mut work, mut heat, mut gross) = (0.0, 0.0, 0.0);
        for i in 0..=last {
            let (increment, friction) = (self.increment[i], self.friction[i]);
            let (mut velocity, mut after) = law(self.velocity[i], increment, friction);
            // Fixed ends do not move; their friction follows their own slip.
            let is_held = (i == 0 || i == last) && lumped.holds(i);
            if is_held {
                (velocity, after) = (0.0, lumped.held.after_slip(friction, increment));
            }
            let moved = time_step * velocity;
            (self.velocity[i], self.friction[i]) = (velocity, after);
            self.displacement[i] += moved;
            // What is left of the slip apart from its elastic part, γ Δf.
            let slip = increment - moved - compliance * (after - friction);
            let acting = if found_at_once { after } else { friction };
            // Friction acts from one half step to the next: on half the slip of either step.
            let weight = if i == 0 || i == last { 0.25 } else { 0.5 } * acting;
            let [earlier, plastic] = std::mem::replace(&mut self.before[i], [increment, slip]);
            let done = weight * (plastic + slip);
            work += weight * (earlier + increment);
            heat += done;
            // A held node cannot chatter; what its friction returns is the stretch of the cable within its half element.
            gross += if is_held { done } else { done.abs() };
        }
        let spacing = lumped.mesh.spacing();
        self.work += spacing * work;
        self.heat += spacing * heat;
        self.gross += spacing * gross;
    }

    /// v ← v + Δt (w p − (K + S) u)/m.
    fn accelerate(&mut self, lumped: &Lumped, time_step: f64) {
        let (u, v) = (&self.displacement, &mut self.velocity);
        let last = v.len() - 1;
        // An end has half the mass and one neighbour.
        let per_bend = time_step * lumped.stiffness / (lumped.mass_per_metre * lumped.mesh.spacing());
        v[0] += 2.0 * per_bend * (u[1] - u[0]);
        v[last] += 2.0 * per_bend * (u[last - 1] - u[last]);
        for (v, u) in v[1..].iter_mut().zip(u.windows(3)) {
            *v += per_bend * ((u[0] - u[1]) + (u[2] - u[1]));
        }
        for &(node, spring) in &lumped.springs {
            v[node] -= time_step * spring / lumped.mass(node) * u[node];
        }
        if lumped.cable.body_force() != 0.0 {
            for (node, velocity) in v.iter_mut().enumerate() {
                *velocity += time_step * lumped.body[node] / lumped.mass(node);
            }
        }
    }

    pub fn end_forces(&self, lumped: &Lumped) -> EndForces {
        lumped.end_forces(&self.displacement, &self.friction)
    }

    /// Writes displacement and friction to `state`.
    pub fn store(&self, state: &mut CableState) {
        state.displacement.copy_from_slice(&self.displacement);
        state.friction.copy_from_slice(&self.friction);
    }

    /// The accounts of a pass that began in `state`.
    pub fn energy(&self, lumped: &Lumped, state: &CableState, peak_kinetic: f64) -> EnergyBalance {
        let elastic = lumped.elastic_energy(&state.displacement);
        let stored = lumped.stored_energy(&state.friction);
        EnergyBalance {
            duct_work: self.work,
            body_work: lumped.body_work(&state.displacement, &self.displacement),
            elastic: lumped.elastic_energy(&self.displacement) - elastic,
            kinetic: lumped.kinetic_energy(&self.velocity),
            stored: lumped.stored_energy(&self.friction) - stored,
            dissipated: self.heat,
            returned: 0.5 * (self.gross - self.heat),
            peak_kinetic,
            initial: elastic + stored,
            reference: 0.0,
        }
    }
}
