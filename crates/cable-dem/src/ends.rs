//! What a load cell at an end of the cable reads.

use crate::step::Support;
use crate::{DuctedCable, End, Mesh};

/// Forces at both ends \[N\], compression positive: what load cells there read.
///
/// The half element beyond the middle of the last one balances
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

/// Whether inertia takes part in the balance of the end nodes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Balance {
    AtRest,
    Moving,
}

/// Reads the ends of one cable on one mesh.
#[derive(Debug, Clone)]
pub(crate) struct EndReader {
    /// k = EA/h \[N/m\].
    stiffness: f64,
    /// w = h/2 \[m\].
    tributary: f64,
    last: usize,
    ends: [Reading; 2],
    /// Body force on either end node \[N\], as it stands upstream and downstream.
    body: [f64; 2],
}

#[derive(Debug, Clone, Copy)]
struct Reading {
    end: End,
    /// s/(s + c) of a spring, beside clamps on the same node.
    share: f64,
}

impl EndReader {
    pub fn new(cable: &DuctedCable, mesh: &Mesh) -> Self {
        let last = mesh.elements();
        let supports = Support::of(cable, mesh);
        let body = cable.loads(mesh, 0.0);
        let reading = |node: usize, end: End| {
            let all = supports.iter().find(|support| support.node == node);
            let all = all.and_then(|support| support.stiffness).unwrap_or(0.0);
            let share = match end {
                End::Spring(spring) if spring > 0.0 => spring / all,
                End::Free | End::Spring(_) => 0.0,
                End::Fixed => 1.0,
            };
            Reading { end, share }
        };
        Self {
            stiffness: cable.axial_stiffness() / mesh.spacing(),
            tributary: mesh.tributary_length(0),
            last,
            body: [body[0], body[last]],
            ends: [reading(0, cable.upstream()), reading(last, cable.downstream())],
        }
    }

    /// Force on each end of a cable whose heat has the force `thermal` \[N\], from the displacement \[m\] and friction \[N/m\] of any node.
    pub fn read(
        &self,
        balance: Balance,
        thermal: f64,
        displacement: impl Fn(usize) -> f64,
        friction: impl Fn(usize) -> f64,
    ) -> EndForces {
        let force = |side: usize, node: usize, inner: usize, outward: f64| {
            let Reading { end, share } = self.ends[side];
            match end {
                End::Free => 0.0,
                End::Spring(spring) if balance == Balance::Moving => outward * spring * displacement(node),
                End::Spring(_) | End::Fixed => {
                    let chain = self.stiffness * (displacement(inner) - displacement(node));
                    let inward = chain + self.tributary * friction(node) + self.body[side];
                    share * (outward * inward + thermal)
                }
            }
        };
        EndForces {
            upstream: force(0, 0, 1, -1.0),
            downstream: force(1, self.last, self.last - 1, 1.0),
        }
    }
}
