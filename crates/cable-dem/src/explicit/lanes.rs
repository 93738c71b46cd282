//! One explicit step, as loops over plain slices that the compiler can vectorise.
//!
//! Displacements carry a ghost at either end, the mirror image of the first inner node: with half the mass at the ends
//! the same stencil then holds at every node.

use super::energy::EnergyBalance;
use crate::lumped::Lumped;
use crate::{CableState, EndForces, FrictionLaw};

/// State and energy accounts of all nodes.
#[derive(Debug, Clone)]
pub(super) struct Lanes {
    /// u \[m\], with a ghost at either end.
    displacement: Vec<f64>,
    /// v \[m/s\], half a step back.
    pub velocity: Vec<f64>,
    /// f \[N/m\].
    friction: Vec<f64>,
    /// Friction of the step before.
    before: Vec<f64>,
    /// D \[m\].
    pub duct: Vec<f64>,
    /// ΔD of the current step.
    pub increment: Vec<f64>,
    /// ΔD of the step before.
    earlier: Vec<f64>,
    /// Plastic slip of the current step.
    slip: Vec<f64>,
    /// Plastic slip of the step before.
    plastic: Vec<f64>,
    /// Accounts per metre of cable \[J/m\]: heat, its absolute amount, work of the duct.
    heat: Vec<f64>,
    gross: Vec<f64>,
    work: Vec<f64>,
}

impl Lanes {
    /// At rest in `state`.
    pub fn new(state: &CableState) -> Self {
        let nodes = state.friction.len();
        let zeros = || vec![0.0; nodes];
        let mut displacement = vec![0.0; nodes + 2];
        displacement[1..=nodes].copy_from_slice(&state.displacement);
        Self {
            displacement,
            velocity: zeros(),
            friction: state.friction.clone(),
            before: zeros(),
            duct: zeros(),
            increment: zeros(),
            earlier: zeros(),
            slip: zeros(),
            plastic: zeros(),
            heat: zeros(),
            gross: zeros(),
            work: zeros(),
        }
    }

    /// One step of `time_step` \[s\]; the duct's increments stand in `increment`.
    ///
    /// `law` is the friction of one node, without branches: given its velocity after the elastic forces \[m/s\], how far its duct moves
    /// in the step \[m\] and the friction before \[N/m\], the velocity with friction, and the friction after.
    pub fn step(
        &mut self,
        lumped: &Lumped,
        law: impl Fn(f64, f64, f64) -> (f64, f64) + Copy,
        time_step: f64,
    ) {
        let n = self.velocity.len();
        let u = &mut self.displacement;
        (u[0], u[n + 1]) = (u[2], u[n - 1]);
        let per_bend = time_step * lumped.stiffness / (lumped.mass_per_metre * lumped.mesh.spacing());
        accelerate(&mut self.velocity, u, per_bend);
        for &(node, spring) in &lumped.springs {
            self.velocity[node] -= time_step * spring / lumped.mass(node) * u[node + 1];
        }
        if lumped.cable.body_force() != 0.0 {
            for (node, velocity) in self.velocity.iter_mut().enumerate() {
                *velocity += time_step * lumped.body[node] / lumped.mass(node);
            }
        }
        std::mem::swap(&mut self.friction, &mut self.before);
        let (v, increment) = (&mut self.velocity, &self.increment);
        rub(v, &mut self.friction, &self.before, increment, law);
        // Fixed ends do not move; their friction follows their own slip.
        let held = [0, n - 1].map(|node| lumped.holds(node).then_some(node));
        for node in held.into_iter().flatten() {
            v[node] = 0.0;
            self.friction[node] = lumped.held.after_slip(self.before[node], increment[node]);
        }
        let compliance = lumped.elastic_compliance();
        for i in 0..n {
            let moved = time_step * v[i];
            u[i + 1] += moved;
            // What is left of the slip beside its elastic part, γ Δf.
            self.slip[i] = increment[i] - moved - compliance * (self.friction[i] - self.before[i]);
        }
        // Coulomb friction is found with the velocity; any other that acts in a step is that of its start.
        let found_at_once = lumped.cable.friction().law() == FrictionLaw::Coulomb;
        let acting = if found_at_once {
            &self.friction
        } else {
            &self.before
        };
        for (work, done) in self.work.iter_mut().zip(done(acting, &self.earlier, increment)) {
            *work += done;
        }
        let accounts = self.heat.iter_mut().zip(&mut self.gross);
        for ((heat, gross), done) in accounts.zip(done(acting, &self.plastic, &self.slip)) {
            *heat += done;
            *gross += done.abs();
        }
        // A held node cannot chatter; what its friction returns is the stretch of the cable within its half element.
        for node in held.into_iter().flatten() {
            self.gross[node] = self.heat[node];
        }
        std::mem::swap(&mut self.plastic, &mut self.slip);
        std::mem::swap(&mut self.earlier, &mut self.increment);
    }

    pub fn end_forces(&self, lumped: &Lumped) -> EndForces {
        let n = self.velocity.len();
        lumped.end_forces(&self.displacement[1..=n], &self.friction)
    }

    /// Writes displacement and friction to `state`.
    pub fn store(&self, state: &mut CableState) {
        let n = self.velocity.len();
        state.displacement.copy_from_slice(&self.displacement[1..=n]);
        state.friction.copy_from_slice(&self.friction);
    }

    /// The accounts of a pass that began in `state`.
    pub fn energy(&self, lumped: &Lumped, state: &CableState, peak_kinetic: f64) -> EnergyBalance {
        let n = self.velocity.len();
        let sum = |lane: &[f64]| lumped.weighted(|i| lane[i]);
        let elastic = lumped.elastic_energy(&state.displacement);
        let stored = lumped.stored_energy(&state.friction);
        let dissipated = sum(&self.heat);
        EnergyBalance {
            duct_work: sum(&self.work),
            body_work: lumped.body_work(&state.displacement, &self.displacement[1..=n]),
            elastic: lumped.elastic_energy(&self.displacement[1..=n]) - elastic,
            kinetic: lumped.kinetic_energy(&self.velocity),
            stored: lumped.stored_energy(&self.friction) - stored,
            dissipated,
            returned: 0.5 * (sum(&self.gross) - dissipated),
            peak_kinetic,
            initial: elastic + stored,
            reference: 0.0,
        }
    }
}

/// v ← v + c (u_{i−1} − 2 u_i + u_{i+1}); `u` has a ghost at either end.
#[inline]
fn accelerate(v: &mut [f64], u: &[f64], c: f64) {
    let n = v.len();
    let (left, middle, right) = (&u[..n], &u[1..=n], &u[2..n + 2]);
    for i in 0..n {
        v[i] += c * ((left[i] - middle[i]) + (right[i] - middle[i]));
    }
}

#[inline]
fn rub(
    v: &mut [f64],
    friction: &mut [f64],
    before: &[f64],
    increment: &[f64],
    law: impl Fn(f64, f64, f64) -> (f64, f64),
) {
    let n = v.len();
    let (friction, before, increment) = (&mut friction[..n], &before[..n], &increment[..n]);
    for i in 0..n {
        (v[i], friction[i]) = law(v[i], increment[i], before[i]);
    }
}

/// Work of `friction`, which acts from one half step to the next: on half the slip of either step.
#[inline]
fn done(friction: &[f64], earlier: &[f64], now: &[f64]) -> impl Iterator<Item = f64> {
    let slips = earlier.iter().zip(now);
    friction
        .iter()
        .zip(slips)
        .map(|(friction, (earlier, now))| 0.5 * friction * (earlier + now))
}
