//! The cable's clamps on the nodes of a mesh.
//!
//! A clamp between two nodes is a spring on each of them, by the lever rule, which bears its share of the clamp's holding force.

use friction_chain::Clamp;

use crate::{DuctedCable, Mesh, Restraint};

/// A clamp nearer to a node than this share of the spacing is on it alone.
const ON_NODE: f64 = 1e-9;

/// A node's share of a clamp.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ClampState {
    /// How far it has slipped \[m\].
    pub slip: f64,
    /// Force of the cable on it \[N\], positive toward growing x.
    pub force: f64,
}

/// The clamps of a chain, each with the place among the cable's restraints of that whose share it is, and its side: 0 before it, 1 after
/// it; 2 for both where it is on its node.
#[derive(Debug, Clone)]
pub(crate) struct ClampShares(Vec<(usize, usize, Clamp)>);

impl ClampShares {
    /// Those of `cable` on `mesh`.
    pub fn new(cable: &DuctedCable, mesh: &Mesh) -> Self {
        let mut shares = Vec::new();
        for (restraint, clamp) in cable.restraints().iter().enumerate() {
            let (left, share) = mesh.place(clamp.position);
            for (side, node, share) in [(0, left, 1.0 - share), (1, left + 1, share)] {
                if share > ON_NODE && clamp.stiffness > 0.0 {
                    let side = if share < 1.0 - ON_NODE { side } else { 2 };
                    let holds = share * clamp.holds.unwrap_or(f64::INFINITY);
                    let clamp = Clamp::new(node, share * clamp.stiffness, holds);
                    shares.push((restraint, side, clamp));
                }
            }
        }
        Self(shares)
    }

    /// The clamps, whose slips have gone from those `before` to `after` on the nodes before and after each restraint \[m\]: they slide on
    /// where these differ.
    pub fn slid(&self, before: &[[f64; 2]], after: &[[f64; 2]]) -> Vec<Clamp> {
        let clamp = |&(restraint, side, clamp): &(usize, usize, Clamp)| {
            clamp.slid(slip(before, restraint, side), slip(after, restraint, side))
        };
        self.0.iter().map(clamp).collect()
    }

    /// The clamps, which stick, where those of the cable have slipped by `slips`.
    pub fn stuck(&self, slips: &[[f64; 2]]) -> Vec<Clamp> {
        self.slid(slips, slips)
    }

    /// Writes how far the `clamps` have slipped to the `slips` of the cable's, apart from those that never do.
    pub fn store(&self, clamps: &[Clamp], slips: &mut Vec<[f64; 2]>) {
        self.update(clamps, slips, |_, clamp, _| {
            clamp.holds.is_finite().then_some(clamp.slip)
        });
    }

    /// Changes those of the `slips` for which there is a `new` one, from the place of the clamp among all, the clamp and what it was.
    pub fn update(
        &self,
        clamps: &[Clamp],
        slips: &mut Vec<[f64; 2]>,
        new: impl Fn(usize, &Clamp, f64) -> Option<f64>,
    ) {
        for (place, (&(restraint, side, _), clamp)) in self.0.iter().zip(clamps).enumerate() {
            if let Some(slip) = new(place, clamp, slip(slips, restraint, side)) {
                slips.resize(slips.len().max(restraint + 1), [0.0; 2]);
                match side {
                    2 => slips[restraint] = [slip; 2],
                    side => slips[restraint][side] = slip,
                }
            }
        }
    }

    /// Forces of the cable on its `restraints` \[N\], positive toward growing x, from the displacement \[m\] of any node.
    pub fn forces(&self, clamps: &[Clamp], restraints: &[Restraint], u: impl Fn(usize) -> f64) -> Vec<f64> {
        let mut forces = vec![0.0; restraints.len()];
        for ((restraint, ..), clamp) in self.0.iter().zip(clamps) {
            forces[*restraint] += clamp.force(u(clamp.node));
        }
        for (force, clamp) in forces.iter_mut().zip(restraints) {
            let holds = clamp.holds.unwrap_or(f64::INFINITY);
            *force = force.clamp(-holds, holds);
        }
        forces
    }
}

/// How far one share of a clamp has slipped \[m\]; those that are missing have not.
fn slip(slips: &[[f64; 2]], restraint: usize, side: usize) -> f64 {
    slips.get(restraint).map_or(0.0, |slips| slips[side.min(1)])
}
