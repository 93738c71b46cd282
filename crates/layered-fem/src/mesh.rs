//! A mesh of nine-node quadrilaterals in the (r, z) half-plane, numbered like a rectangle.

use crate::element::{Corners, NODES, PLACES};

/// Nodes, and elements in columns and rows.
#[derive(Debug, Clone)]
pub(crate) struct Mesh {
    /// Coordinates (r, z) of the nodes \[m\].
    pub nodes: Vec<[f64; 2]>,
    /// Node indices of each element, row by row.
    pub elements: Vec<[usize; NODES]>,
    /// Elements in a row.
    pub across: usize,
}

impl Mesh {
    /// Rectangles between the lines `radii` and `depths` \[m\], both strictly increasing.
    ///
    /// The node in column `i` and row `j` of the (2n+1) × (2m+1) lattice of corners and mid-points has the index
    /// `i + (2n+1) j`.
    pub(crate) fn rectangular(radii: &[f64], depths: &[f64]) -> Self {
        let (columns, rows) = (with_midpoints(radii), with_midpoints(depths));
        let width = columns.len();
        let (across, down) = (width / 2, rows.len() / 2);
        let row = |&z: &f64| columns.iter().map(move |&r| [r, z]);
        let element = |element: usize| {
            let first = 2 * (element % across + element / across * width);
            PLACES.map(|(i, j)| first + i + j * width)
        };
        Self {
            nodes: rows.iter().flat_map(row).collect(),
            elements: (0..across * down).map(element).collect(),
            across,
        }
    }

    pub(crate) fn corners(&self, element: usize) -> Corners {
        self.elements[element].map(|node| self.nodes[node])
    }

    /// Number of degrees of freedom: two a node, (`u_r`, `u_z`).
    pub(crate) fn dofs(&self) -> usize {
        2 * self.nodes.len()
    }
}

pub(crate) fn with_midpoints(lines: &[f64]) -> Vec<f64> {
    let mut out = Vec::with_capacity(2 * lines.len());
    for pair in lines.windows(2) {
        out.extend([pair[0], 0.5 * (pair[0] + pair[1])]);
    }
    out.extend(lines.last());
    out
}
