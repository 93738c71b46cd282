//! The cable as a chain of nodes with bounded friction, as the implicit step takes it.

use friction_chain::{Chain, Clamp, Stretch, rounding};

use crate::section::shares;
use crate::{CableError, DuctedCable, End, Mesh};

/// Share of the friction limit up to which rounding may blur equilibrium.
pub(crate) const MAX_ROUNDING: f64 = 1e-3;

/// The chain of `cable` on `mesh` in `clamps`, without force in it.
pub(crate) fn chain(cable: &DuctedCable, mesh: &Mesh, clamps: Vec<Clamp>) -> Result<Chain, CableError> {
    let limit = |node| {
        let shares = shares(cable.sections(), mesh, node);
        shares.map(|(share, section)| share * section.limit).sum()
    };
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

/// Change of a friction limit in a bend, as a share of it, with which a step has found its force; and rounds until then at most.
pub(crate) const PRESSED: f64 = 1e-7;
pub(crate) const MAX_ROUNDS: usize = 100;

/// Nodes whose friction limit grows with the force F in the cable ([`crate::Section::limit_under`]): q = Σ √(a + b F²) over the sections on
/// which a node lies, with the share s of each: a = (s μ N)², b = (s μ/R)². Node, a and b of each, node after node: with squares that are
/// known a pass in bends takes half the time.
#[derive(Debug, Clone)]
pub(crate) struct Bends(Vec<(usize, f64, f64)>);

impl Bends {
    /// Those of `cable` on `mesh`.
    pub fn new(cable: &DuctedCable, mesh: &Mesh) -> Self {
        let sections = cable.sections();
        if sections.iter().all(|section| section.bend == 0.0) {
            return Self(Vec::new());
        }
        let bends = |&node: &usize| shares(sections, mesh, node).any(|(_, section)| section.bend > 0.0);
        let parts = |node| {
            shares(sections, mesh, node).map(move |(share, section)| {
                (
                    node,
                    (share * section.limit).powi(2),
                    (share * section.bend).powi(2),
                )
            })
        };
        Self((0..mesh.nodes()).filter(bends).flat_map(parts).collect())
    }

    /// Whether the duct is straight.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Lets the cable of `chain` press on the bends with the force that displacements `u` \[m\] and the `thermal_force` \[N\] make. Returned:
    /// the largest change of a friction limit, as a share of it.
    pub fn press(&self, chain: &mut Chain, u: impl Fn(usize) -> f64, thermal_force: f64) -> f64 {
        let (lo, hi) = (0, chain.nodes().len() - 1);
        self.press_within(chain, Stretch { lo, hi }, u, thermal_force)
    }

    /// The same in a part of the chain and on the node at either side of it.
    #[inline]
    pub fn press_within(
        &self,
        chain: &mut Chain,
        part: Stretch,
        u: impl Fn(usize) -> f64,
        thermal_force: f64,
    ) -> f64 {
        let (last, stiffness) = (chain.nodes().len() - 1, chain.stiffness());
        let mut change = 0.0_f64;
        let from = self.0.partition_point(|(node, ..)| node + 1 < part.lo);
        let to = self.0.partition_point(|(node, ..)| *node <= part.hi + 1);
        for parts in self.0[from..to].chunk_by(|one, next| one.0 == next.0) {
            let i = parts[0].0;
            let (before, after) = (i.saturating_sub(1), (i + 1).min(last));
            let stretch = (u(after) - u(before)) / (after - before) as f64;
            let squared = (thermal_force - stiffness * stretch).powi(2);
            let limit: f64 = parts.iter().map(|(_, a, b)| (a + b * squared).sqrt()).sum();
            change = change.max((limit - chain.nodes()[i].limit).abs() / limit);
            chain.set_limit(i, limit);
        }
        change
    }
}
