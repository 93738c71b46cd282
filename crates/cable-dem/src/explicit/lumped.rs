//! The cable as masses and springs: M ü + K u + S u = w (f + p).
//!
//! Node i carries the mass m_i = w_i m′ and the friction w_i f_i of its tributary length w_i (h,
//! and h/2 at the ends), and hangs on its neighbours by springs k = EA/h. End springs and clamps
//! are springs S to the ground; a fixed end does not move.

use crate::ends::EndReader;
use crate::error::checked;
use crate::step::{Chain, FixedEndFriction, Grip};
use crate::{CableError, DuctedCable, End, EndForces, Mesh};

/// Masses, springs and supports of one cable on one mesh.
#[derive(Debug, Clone)]
pub(crate) struct Lumped {
    pub cable: DuctedCable,
    pub mesh: Mesh,
    /// m′ \[kg/m\].
    pub mass_per_metre: f64,
    /// K + S.
    pub chain: Chain,
    /// Clamps.
    pub grips: Vec<Grip>,
    /// Body force w p of every node \[N\].
    pub load: Vec<f64>,
    /// Friction of held nodes.
    pub held: FixedEndFriction,
    ends: EndReader,
}

impl Lumped {
    pub fn new(cable: DuctedCable, mesh: Mesh, mass_per_metre: f64) -> Result<Self, CableError> {
        checked("mass_per_metre", mass_per_metre, "finite and positive", |v| {
            v > 0.0
        })?;
        mesh.check_length(cable.length())?;
        Ok(Self {
            mass_per_metre,
            chain: Chain::new(&cable, &mesh),
            grips: Vec::new(),
            load: cable.loads(&mesh, 0.0),
            held: FixedEndFriction::new(&cable, &mesh),
            ends: EndReader::new(&cable, &mesh),
            cable,
            mesh,
        })
    }

    /// ½ uᵀ(K + S) u \[J\], clamps that slip as they are now.
    pub fn elastic_energy(&self, u: &[f64]) -> f64 {
        let gripped = self
            .grips
            .iter()
            .map(|grip| grip.energy(u[grip.node]))
            .sum::<f64>();
        let stretched: f64 = u.windows(2).map(|pair| (pair[1] - pair[0]).powi(2)).sum();
        let supported: f64 = (0..u.len()).map(|i| self.chain.spring(i) * u[i] * u[i]).sum();
        0.5 * (self.chain.stiffness * stretched + supported) + gripped
    }

    /// ½ γ Σ w f² \[J\]: energy in the contact's shear; 0 for Coulomb's law and for laws without
    /// memory.
    pub fn stored_energy(&self, f: &[f64]) -> f64 {
        let compliance = self.elastic_compliance();
        if compliance.is_infinite() {
            return 0.0;
        }
        0.5 * compliance * self.weighted(|i| f[i] * f[i])
    }

    /// γ \[m²/N\] of a contact that shears elastically: 0 for Coulomb's law and for laws without
    /// memory.
    pub fn elastic_compliance(&self) -> f64 {
        if self.cable.friction().law().has_memory() {
            self.chain.compliance
        } else {
            0.0
        }
    }

    /// Σ w_i value(i) over all nodes.
    pub fn weighted(&self, value: impl Fn(usize) -> f64) -> f64 {
        let nodes = self.chain.nodes.iter().enumerate();
        nodes.map(|(i, node)| node.tributary * value(i)).sum()
    }

    /// Force on each end \[N\], compression positive, from displacement and friction of a cable
    /// that may be moving.
    pub fn end_forces(&self, u: &[f64], f: &[f64]) -> EndForces {
        let mut forces = self.ends.read(0.0, |i| u[i], |i| f[i]);
        // The force of the chain on a spring also accelerates the half element there.
        if let End::Spring(spring) = self.cable.upstream() {
            forces.upstream = -spring * (u[0] - self.cable.end_positions()[0]);
        }
        if let End::Spring(spring) = self.cable.downstream() {
            forces.downstream = spring * (u[u.len() - 1] - self.cable.end_positions()[1]);
        }
        forces
    }
}
