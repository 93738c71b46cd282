//! The least and the largest force along a cable at rest.

use crate::{CableState, DuctedCable};

/// A clamp nearer to a node than this share of the spacing counts as on it.
const AT_NODE: f64 = 1e-6;

/// Minimum and maximum force along the cable \[N\]. Friction and body force change it evenly on either half of an element, so that it
/// is largest in its middle, at a node, or beside a clamp, where it jumps. An element with a clamp within it is pulled from both
/// sides: the force beside the clamp follows from its neighbours.
pub(crate) fn extremes(state: &CableState, cable: &DuctedCable) -> (f64, f64) {
    let (mesh, f, u) = (state.mesh(), state.friction(), state.displacement());
    let h = mesh.spacing();
    let stiffness = cable.axial_stiffness() / h;
    let force = |element: usize| stiffness * (u[element] - u[element + 1]) + state.thermal_force;
    let body = cable.body_loads(mesh);
    let drag = |node: usize| f[node] + body[node] / mesh.tributary_length(node);
    let before = |node: usize| force(node - 1) + 0.5 * h * drag(node);
    let after = |node: usize| force(node) - 0.5 * h * drag(node);
    let clamps = cable.restraints().iter().filter(|clamp| clamp.stiffness > 0.0);
    let places: Vec<(usize, f64)> = clamps
        .map(|clamp| mesh.place(clamp.position))
        .filter(|(_, share)| (AT_NODE..1.0 - AT_NODE).contains(share))
        .collect();
    let (mut least, mut largest) = (f64::INFINITY, f64::NEG_INFINITY);
    let mut note = |force: f64| {
        least = if force < least { force } else { least };
        largest = if force > largest { force } else { largest };
    };
    let mut left = drag(0);
    for element in 0..mesh.elements() {
        let (middle, right) = (force(element), drag(element + 1));
        if !places.iter().any(|(clamped, _)| *clamped == element) {
            note(middle - 0.5 * h * left);
            note(middle);
            note(middle + 0.5 * h * right);
        }
        left = right;
    }
    for (element, share) in places {
        if element > 0 {
            note(before(element) + share * h * drag(element));
        }
        if element + 1 < mesh.elements() {
            note(after(element + 1) - (1.0 - share) * h * drag(element + 1));
        }
    }
    (least, largest)
}
