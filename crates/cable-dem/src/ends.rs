//! What a load cell at an end of the cable reads.

use crate::step::Support;
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
/// | spring s, beside clamps with c on that node | F s/(s + c) | s u: F also accelerates the half element |
///
/// At rest s u is the same, but for a stiff spring u is a small difference of large numbers and has no digits left.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct EndForces {
    /// At x = 0.
    pub upstream: f64,
    /// At x = length.
    pub downstream: f64,
}

/// Reads the ends of one cable on one mesh.
#[derive(Debug, Clone)]
pub(crate) struct EndReader {
    /// k = EA/h \[N/m\].
    stiffness: f64,
    /// w = h/2 \[m\].
    tributary: f64,
    last: usize,
    /// s/(s + c) of a spring that clamps share its node with, 1 of a fixed end, 0 of a free one;
    /// upstream and downstream.
    shares: [f64; 2],
    /// Stiffness of a spring whose node a clamp that slips is on too \[N/m\]: its displacement is what it reads.
    springs: [Option<f64>; 2],
    /// Where it bears nothing \[m\].
    positions: [f64; 2],
    /// Body force on either end node \[N\].
    body: [f64; 2],
}

impl EndReader {
    pub fn new(cable: &DuctedCable, mesh: &Mesh) -> Self {
        let last = mesh.elements();
        let supports = Support::of(cable, mesh);
        let body = cable.body_loads(mesh);
        let share = |node: usize, end: End| {
            let on_node = supports.iter().filter(|support| support.node == node);
            let all: f64 = on_node.filter_map(|support| support.stiffness).sum();
            match end.stiffness() {
                Some(spring) if spring > 0.0 => spring / all,
                Some(_) => 0.0,
                None => 1.0,
            }
        };
        let spring = |node: usize, end: End| {
            let slips = supports
                .iter()
                .any(|support| support.node == node && support.slips);
            end.stiffness().filter(|stiffness| slips && *stiffness > 0.0)
        };
        Self {
            springs: [spring(0, cable.upstream()), spring(last, cable.downstream())],
            positions: cable.end_positions(),
            stiffness: cable.axial_stiffness() / mesh.spacing(),
            tributary: mesh.tributary_length(0),
            last,
            body: [body[0], body[last]],
            shares: [share(0, cable.upstream()), share(last, cable.downstream())],
        }
    }

    /// Force on each end of a cable whose heat has the force `thermal` \[N\], from the displacement \[m\] and friction \[N/m\] of any node.
    pub fn read(
        &self,
        thermal: f64,
        displacement: impl Fn(usize) -> f64,
        friction: impl Fn(usize) -> f64,
    ) -> EndForces {
        let force = |side: usize, node: usize, inner: usize, outward: f64| {
            if self.shares[side] == 0.0 {
                return 0.0;
            }
            if let Some(spring) = self.springs[side] {
                return outward * spring * (displacement(node) - self.positions[side]);
            }
            let chain = self.stiffness * (displacement(inner) - displacement(node));
            let inward = chain + self.tributary * friction(node) + self.body[side];
            self.shares[side] * (outward * inward + thermal)
        };
        EndForces {
            upstream: force(0, 0, 1, -1.0),
            downstream: force(1, self.last, self.last - 1, 1.0),
        }
    }
}
