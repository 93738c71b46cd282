//! The cable's clamps on the nodes of a mesh.
//!
//! A clamp between two nodes is a spring on each of them, by the lever rule, which bears its share of the clamp's holding force.

use friction_chain::Clamp;

use crate::{DuctedCable, Mesh, Restraint};

/// A clamp nearer to a node than this share of the spacing is on it alone.
const ON_NODE: f64 = 1e-9;

/// Which share of which clamp of the cable each clamp of its chain is.
#[derive(Debug, Clone)]
pub(crate) struct ClampShares(Vec<ClampShare>);

#[derive(Debug, Clone)]
struct ClampShare {
    /// The clamp's place among the cable's restraints, and its side: 0 before it, 1 after it; 2 for both where it is on its node.
    place: (usize, usize),
    node: usize,
    /// \[N/m\]
    stiffness: f64,
    /// \[N\]
    holds: f64,
}

impl ClampShares {
    /// Those of `cable` on `mesh`.
    pub fn new(cable: &DuctedCable, mesh: &Mesh) -> Self {
        let mut shares = Vec::new();
        for (restraint, clamp) in cable.restraints().iter().enumerate() {
            let (left, share) = mesh.place(clamp.position);
            for (side, node, share) in [(0, left, 1.0 - share), (1, left + 1, share)] {
                if share > ON_NODE && clamp.stiffness > 0.0 {
                    shares.push(ClampShare {
                        place: (restraint, if share < 1.0 - ON_NODE { side } else { 2 }),
                        node,
                        stiffness: share * clamp.stiffness,
                        holds: share * clamp.holds.unwrap_or(f64::INFINITY),
                    });
                }
            }
        }
        Self(shares)
    }

    /// The clamps of the chain, which stick, where those of the cable have slipped by `slips` on the nodes before and after them \[m\].
    pub fn clamps(&self, slips: &[[f64; 2]]) -> Vec<Clamp> {
        let clamp =
            |(share, slip): (&ClampShare, f64)| Clamp::new(share.node, share.stiffness, share.holds, slip);
        self.0.iter().zip(self.slips(slips)).map(clamp).collect()
    }

    /// How far each clamp of the chain has slipped where those of the cable have by `slips` on the nodes before and after them \[m\].
    pub fn slips(&self, slips: &[[f64; 2]]) -> Vec<f64> {
        let slip =
            |&ClampShare {
                 place: (restraint, side),
                 ..
             }: &ClampShare| { slips.get(restraint).map_or(0.0, |slips| slips[side.min(1)]) };
        self.0.iter().map(slip).collect()
    }

    /// How far a clamp of the chain has slipped whose node is displaced by `u` \[m\] and that bears its part of these `forces` on all
    /// `restraints` \[N\].
    pub fn slip_under(&self, index: usize, forces: &[f64], restraints: &[Restraint], u: f64) -> f64 {
        let (restraint, _) = self.0[index].place;
        u - forces[restraint] / restraints[restraint].stiffness
    }

    /// Writes the `slip` of one clamp of the chain \[m\] to those of the cable's clamps.
    pub fn store(&self, index: usize, slip: f64, slips: &mut Vec<[f64; 2]>) {
        let (restraint, side) = self.0[index].place;
        slips.resize(slips.len().max(restraint + 1), [0.0; 2]);
        match side {
            2 => slips[restraint] = [slip; 2],
            side => slips[restraint][side] = slip,
        }
    }

    /// Writes the slips of all clamps of the chain that can slip.
    pub fn store_all(&self, clamps: &[Clamp], slips: &mut Vec<[f64; 2]>) {
        for (index, clamp) in clamps
            .iter()
            .enumerate()
            .filter(|(_, clamp)| clamp.holds.is_finite())
        {
            self.store(index, clamp.slip, slips);
        }
    }

    /// Forces of the cable on each of its own clamps, the `restraints` \[N\], positive toward growing x, from the displacement \[m\] of any node.
    pub fn forces(&self, clamps: &[Clamp], restraints: &[Restraint], u: impl Fn(usize) -> f64) -> Vec<f64> {
        let mut forces = vec![0.0; restraints.len()];
        for (share, clamp) in self.0.iter().zip(clamps) {
            forces[share.place.0] += clamp.force(u(clamp.node));
        }
        for (force, clamp) in forces.iter_mut().zip(restraints) {
            let holds = clamp.holds.unwrap_or(f64::INFINITY);
            *force = force.clamp(-holds, holds);
        }
        forces
    }
}
