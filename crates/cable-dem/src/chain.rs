//! The cable as a chain of nodes with bounded friction, as the implicit step takes it.

use friction_chain::{Chain, Clamp, rounding};

use crate::section::{Section, limit_of, shares};
use crate::{CableError, DuctedCable, End, Mesh};

/// Share of the friction limit up to which rounding may blur equilibrium.
const MAX_ROUNDING: f64 = 1e-3;

/// The chain of `cable` on `mesh` in `clamps`, without force in it.
pub(crate) fn chain(cable: &DuctedCable, mesh: &Mesh, clamps: Vec<Clamp>) -> Result<Chain, CableError> {
    let limit = |node| limit_of(shares(cable.sections(), mesh, node), 0.0);
    let limits: Vec<f64> = (0..mesh.nodes()).map(limit).collect();
    let ends = [cable.upstream(), cable.downstream()].map(End::stiffness);
    let (stiffness, compliance) = (cable.axial_stiffness(), cable.friction().compliance());
    Ok(Chain::new(
        stiffness,
        mesh.spacing(),
        compliance,
        &limits,
        ends,
        clamps,
    )?)
}

/// Refuses a cable whose elastic forces rounding blurs when the displacements `u` \[m\], or those of the duct with their `peak`, act on it.
pub(crate) fn check_precision(
    cable: &DuctedCable,
    mesh: &Mesh,
    u: &[f64],
    peak: f64,
) -> Result<(), CableError> {
    let (axial_stiffness, spacing) = (cable.axial_stiffness(), mesh.spacing());
    let largest = u.iter().fold(peak, |largest, u| largest.max(u.abs()));
    let share = rounding(axial_stiffness / spacing, spacing) * largest / cable.least_limit();
    // Written so that NaN fails.
    if share <= MAX_ROUNDING {
        Ok(())
    } else {
        Err(CableError::Precision {
            share,
            axial_stiffness,
            spacing,
        })
    }
}

/// Nodes whose friction limit grows with the force in the cable, and the shares of the sections they lie on.
#[derive(Debug, Clone)]
pub(crate) struct Bends(Vec<(usize, Vec<(f64, Section)>)>);

impl Bends {
    /// Those of `cable` on `mesh`.
    pub fn new(cable: &DuctedCable, mesh: &Mesh) -> Self {
        let sections = cable.sections();
        if sections.iter().all(|section| section.bend == 0.0) {
            return Self(Vec::new());
        }
        let shares = |node| shares(sections, mesh, node).map(|(share, section)| (share, *section));
        let nodes = (0..mesh.nodes()).filter(|&node| shares(node).any(|(_, section)| section.bend > 0.0));
        Self(nodes.map(|node| (node, shares(node).collect())).collect())
    }

    /// Whether the duct is straight.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Lets the cable of `chain` press on the bends with the force that displacements `u` \[m\] and the `thermal_force` \[N\] make. Returned:
    /// the largest change of a friction limit, as a share of it.
    pub fn press(&self, chain: &mut Chain, u: impl Fn(usize) -> f64, thermal_force: f64) -> f64 {
        let last = chain.nodes().len() - 1;
        let mut change = 0.0_f64;
        for (i, shares) in &self.0 {
            let (before, after) = (i.saturating_sub(1), (i + 1).min(last));
            let stretch = (u(after) - u(before)) / (after - before) as f64;
            let shares = shares.iter().map(|(share, section)| (*share, section));
            let limit = limit_of(shares, thermal_force - chain.stiffness() * stretch);
            change = change.max((limit - chain.nodes()[*i].limit).abs() / limit);
            chain.set_limit(*i, limit);
        }
        change
    }
}
