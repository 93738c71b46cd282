//! Loads on the mesh, per radian and for a unit force: the point load, the disc, and the far field.
//!
//! # Point load
//!
//! The singular field of a point load cannot be meshed. In a block B of whole elements around the load, inside the top
//! layer, the unknown is therefore the difference w = u − `u_B` from the half-space closed form `u_B` with the soil at the
//! surface; outside B it is u itself. Adding the weak forms of both parts, with the traction continuous across ∂B:
//!
//! ```text
//! a(u*, v) = a_B(I u_B, v) − ∮_∂B (σ_B n)·v − ∫_B ((E(z) − E₀)/E₀) σ_B : ε(v)
//! ```
//!
//! where u* is w at nodes inside B and u at all others, and I `u_B` has the nodal values of `u_B` on ∂B and zero inside. The
//! last term vanishes where the top layer is uniform. Everything in it is smooth on the scale of the block, and the closed
//! form appears only there: a reference field in the whole ground would have to be cancelled by the mesh wherever the top
//! layer is much softer than what lies below.
//!
//! # Disc
//!
//! Uniform pressure is integrated exactly against the surface shape functions, up to the disc's edge inside an element: no
//! line of the mesh needs to lie there, so one factorisation serves every contact radius.

use std::f64::consts::PI;

use crate::FemError;
use crate::element::{GAUSS_3, GAUSS_6, Quadrilateral, Volumetric};
use crate::grading::Lines;
use crate::half_space::HalfSpace;
use crate::material::Elasticity;
use crate::mesh::{Mesh, with_midpoints};

/// Edges of elements along `lines`: the lattice index of the first node, and both ends \[m\].
fn edges(kind: Quadrilateral, lines: &[f64]) -> impl Iterator<Item = (usize, f64, f64)> {
    let lattice = with_midpoints(lines);
    let step = 2 / kind.per_interval();
    (0..lattice.len().saturating_sub(1))
        .step_by(step)
        .map(move |first| (first, lattice[first], lattice[first + step]))
}

/// Shape functions of an edge of `kind` with their places along it.
fn edge_shape(kind: Quadrilateral, x: f64) -> impl Iterator<Item = (usize, f64)> {
    let nodes = 1 + 2 / kind.per_interval();
    kind.edge_shape(x).into_iter().take(nodes).enumerate()
}

/// Node (column, row) of the lattice of corners and mid-points.
fn node(lines: &Lines, column: usize, row: usize) -> usize {
    column + row * (2 * lines.radii.len() - 1)
}

/// Force on every degree of freedom under uniform pressure of total force 1 on a disc of `contact_radius`.
pub(crate) fn disc(mesh: &Mesh, lines: &Lines, contact_radius: f64) -> Vec<f64> {
    let mut force = vec![0.0; mesh.dofs()];
    // Per radian the pressure 1/(π a²) acts on ∫ r dr.
    let pressure = 1.0 / (PI * contact_radius * contact_radius);
    for (first, left, right) in edges(mesh.kind(), &lines.radii) {
        let end = right.min(contact_radius);
        if end <= left {
            break;
        }
        for (x, weight) in GAUSS_3 {
            let half = 0.5 * (end - left);
            let r = left + half * (1.0 + x);
            for (k, value) in edge_shape(mesh.kind(), 2.0 * (r - left) / (right - left) - 1.0) {
                force[2 * node(lines, first + k, 0) + 1] += pressure * weight * half * r * value;
            }
        }
    }
    force
}

/// Force on every degree of freedom under a unit point load, for the unknown u* of the [module documentation](self).
///
/// # Errors
///
/// [`FemError::Degenerate`] only.
pub(crate) fn point(
    mesh: &Mesh,
    lines: &Lines,
    volumetric: Volumetric,
    near: HalfSpace,
    elasticity: impl Fn(usize, f64, f64) -> Elasticity,
    young_modulus: impl Fn(f64) -> f64,
) -> Result<Vec<f64>, FemError> {
    let mut force = vec![0.0; mesh.dofs()];
    let per_interval = mesh.kind().per_interval();
    let columns = (lines.radii.len() - 1) * per_interval;
    let (block_columns, block_rows) = (
        lines.block_columns * per_interval,
        lines.block_rows * per_interval,
    );
    let (last_column, last_row) = (2 * lines.block_columns, 2 * lines.block_rows);
    let edge = edge_displacement(mesh, lines, near);
    for row in 0..block_rows {
        for column in 0..block_columns {
            let element = column + row * columns;
            let coordinates = mesh.element_nodes(element);
            let nodes = mesh.element(element);
            if row + 1 == block_rows || column + 1 == block_columns {
                let matrix = mesh.kind().stiffness(element, &coordinates, volumetric, |r, z| {
                    elasticity(element, r, z)
                })?;
                for (a, &at) in nodes.iter().enumerate() {
                    for c in 0..2 {
                        force[2 * at + c] += nodes
                            .iter()
                            .enumerate()
                            .map(|(b, &other)| {
                                matrix[2 * a + c][2 * b] * edge[2 * other]
                                    + matrix[2 * a + c][2 * b + 1] * edge[2 * other + 1]
                            })
                            .sum::<f64>();
                    }
                }
            }
            add_mismatch(mesh, element, near, &young_modulus, &mut force);
        }
    }
    // −∮ (σ_B n)·v: downward normal at the bottom, outward at the side.
    let (outer, bottom) = (lines.radii[lines.block_columns], lines.depths[lines.block_rows]);
    for (first, left, right) in edges(mesh.kind(), &lines.radii[..=lines.block_columns]) {
        let half = 0.5 * (right - left);
        for (x, weight) in GAUSS_6 {
            let r = left + half * (1.0 + x);
            let stress = near.stress(r, bottom);
            for (k, value) in edge_shape(mesh.kind(), x) {
                let at = node(lines, first + k, last_row);
                force[2 * at] -= weight * half * r * value * stress[3];
                force[2 * at + 1] -= weight * half * r * value * stress[1];
            }
        }
    }
    for (first, top, end) in edges(mesh.kind(), &lines.depths[..=lines.block_rows]) {
        let half = 0.5 * (end - top);
        for (x, weight) in GAUSS_6 {
            let stress = near.stress(outer, top + half * (1.0 + x));
            for (k, value) in edge_shape(mesh.kind(), x) {
                let at = node(lines, last_column, first + k);
                force[2 * at] -= weight * half * outer * value * stress[0];
                force[2 * at + 1] -= weight * half * outer * value * stress[3];
            }
        }
    }
    Ok(force)
}

/// The closed form at the nodes on the block's boundary, zero elsewhere.
pub(crate) fn edge_displacement(mesh: &Mesh, lines: &Lines, near: HalfSpace) -> Vec<f64> {
    let mut edge = vec![0.0; mesh.dofs()];
    let (last_column, last_row) = (2 * lines.block_columns, 2 * lines.block_rows);
    let bottom = (0..=last_column).map(|column| (column, last_row));
    let side = (0..last_row).map(|row| (last_column, row));
    for (column, row) in bottom.chain(side) {
        let at = node(lines, column, row);
        let [r, z] = mesh.nodes()[at];
        let u = near.displacement(r, z);
        edge[2 * at] = u[0];
        edge[2 * at + 1] = u[1];
    }
    edge
}

/// −∫ ((E(z) − E₀)/E₀) `σ_B` : ε(v) over one element, where the modulus is not that of the surface.
fn add_mismatch(
    mesh: &Mesh,
    element: usize,
    near: HalfSpace,
    young_modulus: &impl Fn(f64) -> f64,
    force: &mut [f64],
) {
    let coordinates = mesh.element_nodes(element);
    let surface = near.young_modulus();
    for (eta, weight_eta) in GAUSS_6 {
        for (xi, weight_xi) in GAUSS_6 {
            let shape = mesh.kind().shape(&coordinates, xi, eta);
            let mismatch = (young_modulus(shape.depth) - surface) / surface;
            if mismatch == 0.0 {
                continue;
            }
            let weight = -mismatch * weight_eta * weight_xi * shape.determinant * shape.radius;
            let stress = near.stress(shape.radius, shape.depth);
            for (k, &at) in mesh.element(element).iter().enumerate() {
                force[2 * at] += weight
                    * (stress[0] * shape.d_r[k]
                        + stress[2] * shape.value[k] / shape.radius
                        + stress[3] * shape.d_z[k]);
                force[2 * at + 1] += weight * (stress[1] * shape.d_z[k] + stress[3] * shape.d_r[k]);
            }
        }
    }
}
