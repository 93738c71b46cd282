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

use crate::cholesky::dofs;
use crate::element::{GAUSS_3, GAUSS_6, Shape, edge_shape};
use crate::grading::{Band, Lines};
use crate::material::HalfSpace;
use crate::mesh::Mesh;
use crate::system::System;

/// Edges of elements along `lines`: the lattice index of the first node, and both ends \[m\].
fn edges(lines: &[f64]) -> impl Iterator<Item = (usize, f64, f64)> {
    let ends = lines.windows(2).enumerate();
    ends.map(|(index, pair)| (2 * index, pair[0], pair[1]))
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
    for (first, left, right) in edges(&lines.radii) {
        let end = right.min(contact_radius);
        if end <= left {
            break;
        }
        for (x, weight) in GAUSS_3 {
            let half = 0.5 * (end - left);
            let r = left + half * (1.0 + x);
            let shape = edge_shape(2.0 * (r - left) / (right - left) - 1.0);
            for (k, value) in shape.into_iter().enumerate() {
                force[2 * node(lines, first + k, 0) + 1] += pressure * weight * half * r * value;
            }
        }
    }
    force
}

/// Force on every degree of freedom under a unit point load, for the unknown u* of the [module documentation](self); `edge` is I `u_B`.
pub(crate) fn point(system: &System, lines: &Lines, near: HalfSpace, edge: &[f64]) -> Vec<f64> {
    let mesh = &system.mesh;
    let mut force = vec![0.0; mesh.dofs()];
    let (columns, rows) = (lines.block_columns, lines.bands[0].end);
    for row in 0..rows {
        for column in 0..columns {
            let element = column + row * mesh.across;
            let reaction = system.reaction(element, edge);
            for (dof, value) in dofs(&mesh.elements[element]).into_iter().zip(reaction) {
                force[dof] += value;
            }
            add_mismatch(mesh, element, near, &lines.bands[0], &mut force);
        }
    }
    // −∮ (σ_B n)·v along the bottom outward and along the side downward.
    let (outer, depth) = (lines.radii[columns], lines.depths[rows]);
    let bottom = edges(&lines.radii[..=columns]).map(|(first, left, right)| {
        let nodes = [0, 1, 2].map(|k| node(lines, first + k, 2 * rows));
        (nodes, (left, depth), (right, depth))
    });
    let side = edges(&lines.depths[..=rows]).map(|(first, top, end)| {
        let nodes = [0, 1, 2].map(|k| node(lines, 2 * columns, first + k));
        (nodes, (outer, top), (outer, end))
    });
    for (nodes, start, end) in bottom.chain(side) {
        let (half_r, half_z) = (0.5 * (end.0 - start.0), 0.5 * (end.1 - start.1));
        for (x, weight) in GAUSS_6 {
            let (r, z) = (start.0 + half_r * (1.0 + x), start.1 + half_z * (1.0 + x));
            let stress = near.stress(r, z);
            // The outward normal, times half the edge's length, is (half_z, half_r).
            let traction_r = stress.radial * half_z + stress.shear * half_r;
            let traction_z = stress.shear * half_z + stress.vertical * half_r;
            for (at, value) in nodes.into_iter().zip(edge_shape(x)) {
                force[2 * at] -= weight * r * value * traction_r;
                force[2 * at + 1] -= weight * r * value * traction_z;
            }
        }
    }
    force
}

/// The closed form at the nodes on the block's boundary, zero elsewhere.
pub(crate) fn edge_displacement(mesh: &Mesh, lines: &Lines, near: HalfSpace) -> Vec<f64> {
    let mut edge = vec![0.0; mesh.dofs()];
    let (last_column, last_row) = (2 * lines.block_columns, 2 * lines.bands[0].end);
    let bottom = (0..=last_column).map(|column| (column, last_row));
    let side = (0..last_row).map(|row| (last_column, row));
    for (column, row) in bottom.chain(side) {
        let at = node(lines, column, row);
        let [r, z] = mesh.nodes[at];
        let u = near.displacement(r, z);
        edge[2 * at] = u.radial;
        edge[2 * at + 1] = u.vertical;
    }
    edge
}

/// −∫ ((E(z) − E₀)/E₀) `σ_B` : ε(v) over one element, where the modulus is not that of the surface.
fn add_mismatch(mesh: &Mesh, element: usize, near: HalfSpace, band: &Band, force: &mut [f64]) {
    let corners = mesh.corners(element);
    let surface = band.layer.young_modulus_at(0.0);
    for (eta, weight_eta) in GAUSS_6 {
        for (xi, weight_xi) in GAUSS_6 {
            let shape = Shape::at(&corners, xi, eta);
            let mismatch = (band.layer.young_modulus_at(shape.depth) - surface) / surface;
            if mismatch == 0.0 {
                continue;
            }
            let weight = -mismatch * weight_eta * weight_xi * shape.determinant * shape.radius;
            let stress = near.stress(shape.radius, shape.depth);
            for (k, &at) in mesh.elements[element].iter().enumerate() {
                force[2 * at] += weight
                    * (stress.radial * shape.d_r[k]
                        + stress.hoop * shape.value[k] / shape.radius
                        + stress.shear * shape.d_z[k]);
                force[2 * at + 1] += weight * (stress.vertical * shape.d_z[k] + stress.shear * shape.d_r[k]);
            }
        }
    }
}
