//! The cable as masses and springs: M ü + K u + S u = w (f + p).
//!
//! Node i carries the mass m_i = w_i m′ and the friction w_i f_i of its tributary length w_i (h, and h/2 at the ends),
//! and hangs on its neighbours by springs k = EA/h. End springs and clamps are springs S to the ground; a fixed end does
//! not move.

use crate::ends::EndReader;
use crate::error::checked;
use crate::step::{FixedEndFriction, Support};
use crate::{CableError, DuctedCable, End, EndForces, Mesh};

/// Masses, springs and supports of one cable on one mesh.
#[derive(Debug, Clone)]
pub(crate) struct Lumped {
    pub cable: DuctedCable,
    pub mesh: Mesh,
    /// m′ \[kg/m\].
    pub mass_per_metre: f64,
    /// k = EA/h \[N/m\].
    pub stiffness: f64,
    /// Springs to the ground (node, stiffness \[N/m\]), ascending by node.
    pub springs: Vec<(usize, f64)>,
    /// Body force w p of every node \[N\].
    pub body: Vec<f64>,
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
        let springs = Support::of(&cable, &mesh)
            .into_iter()
            .filter_map(|support| Some((support.node, support.stiffness.filter(|s| *s > 0.0)?)));
        Ok(Self {
            mass_per_metre,
            stiffness: cable.axial_stiffness() / mesh.spacing(),
            springs: springs.collect(),
            body: cable.loads(&mesh, 0.0),
            held: FixedEndFriction::new(&cable, &mesh),
            ends: EndReader::new(&cable, &mesh),
            cable,
            mesh,
        })
    }

    /// Mass of node i \[kg\].
    pub fn mass(&self, i: usize) -> f64 {
        self.mass_per_metre * self.mesh.tributary_length(i)
    }

    /// Whether `node` is a fixed end.
    pub fn holds(&self, node: usize) -> bool {
        let (first, last) = (self.cable.upstream(), self.cable.downstream());
        (node == 0 && first == End::Fixed) || (node == self.mesh.elements() && last == End::Fixed)
    }

    /// ½ uᵀ(K + S) u \[J\].
    pub fn elastic_energy(&self, u: &[f64]) -> f64 {
        let stretched: f64 = u.windows(2).map(|pair| (pair[1] - pair[0]).powi(2)).sum();
        let supported: f64 = self.springs.iter().map(|&(node, s)| s * u[node] * u[node]).sum();
        0.5 * (self.stiffness * stretched + supported)
    }

    /// Work of the body force as the cable moves from `before` to `after` \[J\].
    pub fn body_work(&self, before: &[f64], after: &[f64]) -> f64 {
        let moved = before.iter().zip(after).map(|(before, after)| after - before);
        self.body
            .iter()
            .zip(moved)
            .map(|(load, moved)| load * moved)
            .sum()
    }

    /// ½ Σ m v² \[J\].
    pub fn kinetic_energy(&self, v: &[f64]) -> f64 {
        0.5 * self.mass_per_metre * self.weighted(|i| v[i] * v[i])
    }

    /// ½ γ Σ w f² \[J\]: energy in the contact's shear; 0 for Coulomb's law and for laws without memory.
    pub fn stored_energy(&self, f: &[f64]) -> f64 {
        let compliance = self.elastic_compliance();
        if compliance.is_infinite() {
            return 0.0;
        }
        0.5 * compliance * self.weighted(|i| f[i] * f[i])
    }

    /// γ \[m²/N\] of a contact that shears elastically: 0 for Coulomb's law and for laws without memory.
    pub fn elastic_compliance(&self) -> f64 {
        let friction = self.cable.friction();
        if friction.law().has_memory() {
            friction.compliance()
        } else {
            0.0
        }
    }

    /// q·D·L \[J\]: work of friction at its limit over a displacement `peak` of the duct.
    pub fn reference_work(&self, peak: f64) -> f64 {
        self.cable.friction().limit() * self.cable.length() * peak
    }

    /// Σ w_i value(i) over all nodes.
    pub fn weighted(&self, value: impl Fn(usize) -> f64) -> f64 {
        let last = self.mesh.elements();
        let sum: f64 = (0..=last).map(&value).sum();
        self.mesh.spacing() * (sum - 0.5 * (value(0) + value(last)))
    }

    /// Force on each end \[N\], compression positive, from displacement and friction of a cable that may be moving.
    pub fn end_forces(&self, u: &[f64], f: &[f64]) -> EndForces {
        let mut forces = self.ends.read(0.0, |i| u[i], |i| f[i]);
        // The force of the chain on a spring also accelerates the half element there.
        if let End::Spring(spring) = self.cable.upstream() {
            forces.upstream = -spring * u[0];
        }
        if let End::Spring(spring) = self.cable.downstream() {
            forces.downstream = spring * u[u.len() - 1];
        }
        forces
    }
}
