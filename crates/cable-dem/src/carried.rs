//! A cable at rest from one mesh to another.

use crate::{CableError, CableState, Mesh};

/// The cable of `state` on another `mesh` of the duct, with displacements along cubics through four nodes; a clamp has slipped as far on both
/// of its nodes. On its own mesh it is the same to the last bit. Not yet at rest ([`crate::RestingCable::settle`]).
///
/// # Errors
///
/// [`CableError::InvalidParameter`] unless the mesh is as long.
pub fn carried(state: &CableState, mesh: &Mesh) -> Result<CableState, CableError> {
    state.mesh().check_length(mesh.length())?;
    if *state.mesh() == mesh.nodes_alone() {
        return Ok(state.clone());
    }
    let last = state.mesh().elements();
    let read = |values: &[f64], node: usize| {
        let (left, share) = state.mesh().place(mesh.spacing() * node as f64);
        let first = left.saturating_sub(1).min(last.saturating_sub(3));
        let at = (left - first) as f64 + share;
        let nodes = &values[first..=(first + 3).min(last)];
        let weight = |i: usize| {
            let others = (0..nodes.len()).filter(|j| *j != i);
            others
                .map(|j| (at - j as f64) / (i as f64 - j as f64))
                .product::<f64>()
        };
        nodes.iter().enumerate().map(|(i, value)| weight(i) * value).sum()
    };
    let all = |values: &[f64]| (0..mesh.nodes()).map(|node| read(values, node)).collect();
    let mut carried = CableState::from_parts(mesh, all(state.displacement()), all(state.friction()))?;
    let ends = [state.friction()[0], state.friction()[last]];
    let u = state.displacement();
    (carried.displacement[0], carried.displacement[mesh.elements()]) = (u[0], u[last]);
    carried = carried
        .with_end_friction(ends)
        .with_thermal_force(state.thermal_force())?;
    carried.clamp_slips = state
        .clamp_slips
        .iter()
        .map(|[before, after]| [0.5 * (before + after); 2])
        .collect();
    Ok(carried)
}
