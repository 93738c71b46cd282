//! What a load cell at an end of the cable reads.

use crate::clamps::ClampShares;
use crate::{DuctedCable, End, Mesh};

/// Forces at both ends \[N\], compression positive: what load cells there read.
///
/// The half element beyond the middle of the last one balances, with both displacements, friction
/// and body force counted toward the end,
///
/// F = k (u_inner − u_end) + Θ + w (f + p),  w = h/2,
///
/// the chain's force with Θ of its heat ([`crate::CableState::thermal_force`]), and friction and body force on that half: what arrives at the end, of second order in the spacing h wherever the
/// slip near the end is resolved. What of it the end reads depends on what else holds its node:
///
/// | end | reading at rest | while masses move |
/// |---|---|---|
/// | free | 0 | 0 |
/// | fixed | F: a clamp on a node that does not move carries nothing | F |
/// | spring s | F | s u: F also accelerates the half element |
/// | spring s, with clamps on that node | s u | s u |
///
/// At rest s u is the same as F, but for a stiff spring u is a small difference of large numbers and has no digits left.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct EndForces {
    /// At x = 0.
    pub upstream: f64,
    /// At x = length.
    pub downstream: f64,
}

/// How the force on an end is read.
#[derive(Debug, Clone, Copy)]
enum Reading {
    /// Nothing holds the end.
    Nothing,
    /// From the force of the chain: the end alone holds its node.
    Chain,
    /// From the displacement of its spring \[N/m\]: clamps hold its node too.
    Spring(f64),
}

/// Reads the ends of one cable on one mesh.
#[derive(Debug, Clone)]
pub(crate) struct EndReader {
    /// k = EA/h \[N/m\].
    stiffness: f64,
    /// w = h/2 \[m\].
    tributary: f64,
    last: usize,
    /// What is read upstream and downstream.
    reads: [Reading; 2],
    /// Where it bears nothing \[m\].
    positions: [f64; 2],
    /// Body force on either end node \[N\].
    body: [f64; 2],
}

impl EndReader {
    /// Of `cable` on `mesh`. While masses move, the force of the chain also accelerates the half element at an end: then springs are read by
    /// their displacements.
    pub fn new(cable: &DuctedCable, mesh: &Mesh, moves: bool) -> Self {
        let last = mesh.elements();
        let clamps = ClampShares::new(cable, mesh).stuck(&[]);
        let reading = |node: usize, end: End| match end {
            End::Free | End::Spring(0.0) => Reading::Nothing,
            End::Spring(spring) if moves || clamps.iter().any(|clamp| clamp.node == node) => {
                Reading::Spring(spring)
            }
            _ => Reading::Chain,
        };
        Self {
            reads: [reading(0, cable.upstream()), reading(last, cable.downstream())],
            positions: cable.end_positions(),
            stiffness: cable.axial_stiffness() / mesh.spacing(),
            tributary: mesh.tributary_length(0),
            last,
            body: [0, last].map(|node| cable.body_load(mesh, node)),
        }
    }

    /// Force on each end of a cable whose heat has the force `thermal` \[N\], from the displacement \[m\] and friction \[N/m\] of any node.
    pub fn read(
        &self,
        thermal: f64,
        displacement: impl Fn(usize) -> f64,
        friction: impl Fn(usize) -> f64,
    ) -> EndForces {
        let force = |side: usize, node: usize, inner: usize, outward: f64| match self.reads[side] {
            Reading::Nothing => 0.0,
            Reading::Spring(spring) => outward * spring * (displacement(node) - self.positions[side]),
            Reading::Chain => {
                let chain = self.stiffness * (displacement(inner) - displacement(node));
                let inward = chain + self.tributary * friction(node) + self.body[side];
                outward * inward + thermal
            }
        };
        EndForces {
            upstream: force(0, 0, 1, -1.0),
            downstream: force(1, self.last, self.last - 1, 1.0),
        }
    }
}
