//! The cable as masses and springs, M ü + K u + S u = w (f + p), and one explicit step of it.
//!
//! Node i carries the mass m_i = w_i m′ and the friction w_i f_i of its tributary length w_i (h, and h/2 at the ends), and hangs on its
//! neighbours by springs k = EA/h. End springs and clamps are springs S to the ground; a fixed end does not move.

use friction_chain::{Chain, Clamp};

use super::energy::EnergyBalance;
use crate::chain::{Bends, chain};
use crate::clamps::ClampShares;
use crate::ends::EndReader;
use crate::error::positive;
use crate::fixed_end_friction::FixedEndFriction;
use crate::{CableError, CableState, DuctedCable, EndForces, FrictionLaw, Mesh};

/// Masses, springs and supports of one cable on one mesh, their motion, and the accounts of their energy.
#[derive(Debug, Clone)]
pub(super) struct MovingNodes {
    pub cable: DuctedCable,
    pub mesh: Mesh,
    /// m′ \[kg/m\].
    pub mass_per_metre: f64,
    /// K + S, without clamps.
    pub chain: Chain,
    bends: Bends,
    pub shares: ClampShares,
    /// Clamps, apart from the chain.
    pub clamps: Vec<Clamp>,
    /// Loads of every node \[N\]: body force w p, and springs of ends that are held elsewhere.
    load: Vec<f64>,
    /// Friction of held nodes.
    held: FixedEndFriction,
    ends: EndReader,
    /// u \[m\].
    pub displacement: Vec<f64>,
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
    /// Elastic energy at the start \[J\].
    initial: f64,
}

impl MovingNodes {
    pub fn new(cable: DuctedCable, mesh: Mesh, mass_per_metre: f64) -> Result<Self, CableError> {
        positive("mass_per_metre", mass_per_metre)?;
        mesh.check_length(cable.length())?;
        let shares = ClampShares::new(&cable, &mesh);
        let clamps = shares.stuck(&[]);
        let zeros = || vec![0.0; mesh.nodes()];
        Ok(Self {
            mass_per_metre,
            chain: chain(&cable, &mesh, clamps.clone())?,
            bends: Bends::new(&cable, &mesh),
            shares,
            clamps,
            load: cable.loads(&mesh, 0.0),
            held: FixedEndFriction::new(&cable, &mesh),
            ends: EndReader::new(&cable, &mesh, true),
            displacement: zeros(),
            velocity: zeros(),
            friction: zeros(),
            duct: zeros(),
            before: vec![[0.0; 2]; mesh.nodes()],
            increment: zeros(),
            work: 0.0,
            heat: 0.0,
            gross: 0.0,
            initial: 0.0,
            cable,
            mesh,
        })
    }

    /// Begins a pass at rest in `state`.
    pub fn begin(&mut self, state: &CableState) {
        self.displacement.copy_from_slice(&state.displacement);
        self.friction.copy_from_slice(&state.friction);
        self.velocity.fill(0.0);
        self.before.fill([0.0; 2]);
        self.clamps = self.shares.stuck(&state.clamp_slips);
        (self.work, self.heat, self.gross) = (0.0, 0.0, 0.0);
        self.initial = self.elastic_energy();
    }

    /// Writes displacement, friction and slips of clamps to `state`.
    pub fn store(&self, state: &mut CableState) {
        state.displacement.copy_from_slice(&self.displacement);
        state.friction.copy_from_slice(&self.friction);
        self.shares.store(&self.clamps, &mut state.clamp_slips);
    }

    /// One step of `time_step` \[s\]; `displacement` writes where the duct stands after it \[m\].
    pub fn step(&mut self, displacement: impl Fn(&mut [f64]), time_step: f64) {
        displacement(&mut self.increment);
        self.bends.press(&mut self.chain, |i| self.displacement[i], 0.0);
        for (duct, increment) in self.duct.iter_mut().zip(&mut self.increment) {
            let before = std::mem::replace(duct, *increment);
            *increment -= before;
        }
        let per_mass = time_step / self.mass_per_metre;
        let gripped = self.accelerate(per_mass);
        let friction = self.cable.friction();
        let compliance = self.elastic_compliance();
        let coulomb = friction.law() == FrictionLaw::Coulomb;
        let (mut work, mut heat, mut gross) = (0.0, 0.0, 0.0);
        for i in 0..self.velocity.len() {
            let (increment, before) = (self.increment[i], self.friction[i]);
            let limit = self.chain.nodes()[i].limit;
            let is_held = !self.chain.free().nodes().contains(&i);
            let (velocity, after) = if is_held {
                // Fixed ends do not move; their friction follows their own slip.
                (0.0, self.held.after_slip(before, increment, limit))
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
            let weight = 0.5 * self.chain.nodes()[i].tributary * acting;
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
    fn accelerate(&mut self, per_mass: f64) -> f64 {
        let (chain, u) = (&self.chain, &self.displacement);
        for (i, velocity) in self.velocity.iter_mut().enumerate() {
            *velocity -= per_mass * chain.balancing_friction(u, &self.load, i);
        }
        let mut gripped = 0.0;
        for clamp in &mut self.clamps {
            let [force, heat] = clamp.bear(u[clamp.node]);
            gripped += heat;
            self.velocity[clamp.node] -= per_mass * force * chain.nodes()[clamp.node].per_tributary;
        }
        gripped
    }

    /// Force on each end \[N\], compression positive.
    pub fn end_forces(&self) -> EndForces {
        self.ends
            .read(0.0, |i| self.displacement[i], |i| self.friction[i])
    }

    /// Σ w_i value(i) over all nodes.
    pub fn weighted(&self, value: impl Fn(usize) -> f64) -> f64 {
        let nodes = self.chain.nodes().iter().enumerate();
        nodes.map(|(i, node)| node.tributary * value(i)).sum()
    }

    /// ½ Σ m v² \[J\].
    pub fn kinetic_energy(&self) -> f64 {
        0.5 * self.mass_per_metre * self.weighted(|i| self.velocity[i].powi(2))
    }

    /// ½ uᵀ(K + S) u + ½ γ Σ w f² \[J\], clamps that slip as they are now: in springs, and in the contact's shear.
    fn elastic_energy(&self) -> f64 {
        let u = &self.displacement;
        let of_clamp = |clamp: &Clamp| 0.5 * clamp.stiffness * (u[clamp.node] - clamp.slip).powi(2);
        let gripped: f64 = self.clamps.iter().map(of_clamp).sum();
        let stretched: f64 = u.windows(2).map(|pair| (pair[1] - pair[0]).powi(2)).sum();
        let supported: f64 = (0..u.len()).map(|i| self.chain.spring(i) * u[i] * u[i]).sum();
        let sheared = self.elastic_compliance() * self.weighted(|i| self.friction[i].powi(2));
        0.5 * (self.chain.stiffness() * stretched + supported + sheared) + gripped
    }

    /// γ \[m²/N\] of a contact that shears elastically: 0 for Coulomb's law and for laws without memory.
    fn elastic_compliance(&self) -> f64 {
        if self.cable.friction().law().has_memory() {
            self.cable.friction().compliance()
        } else {
            0.0
        }
    }

    /// The accounts of the pass that began in `state`, whose duct moves by `peak` \[m\] at most.
    pub fn energy(&self, state: &CableState, peak_kinetic: f64, peak: f64) -> EnergyBalance {
        let moved = self.displacement.iter().zip(&state.displacement);
        let body_work = moved
            .zip(&self.load)
            .map(|((after, before), load)| load * (after - before));
        EnergyBalance {
            duct_work: self.work,
            body_work: body_work.sum(),
            elastic: self.elastic_energy() - self.initial,
            kinetic: self.kinetic_energy(),
            dissipated: self.heat,
            returned: 0.5 * (self.gross - self.heat),
            peak_kinetic,
            initial: self.initial,
            reference: self.cable.friction().limit() * self.cable.length() * peak,
        }
    }
}
