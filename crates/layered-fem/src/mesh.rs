//! A mesh of quadrilaterals in the (r, z) half-plane, and the rectangular meshes of layered ground.

use crate::FemError;
use crate::element::{MAX_NODES, Quadrilateral};

/// Nodes and elements of one kind.
#[derive(Debug, Clone)]
pub struct Mesh {
    kind: Quadrilateral,
    nodes: Vec<[f64; 2]>,
    /// Node indices, `kind.nodes()` an element.
    connectivity: Vec<usize>,
}

impl Mesh {
    /// A mesh of `nodes` (r, z) \[m\] and elements given by their node indices, in the order that
    /// [`crate::element`] describes.
    ///
    /// # Errors
    ///
    /// [`FemError::Connectivity`] for a wrong number of nodes or an index beyond the nodes.
    pub fn new(kind: Quadrilateral, nodes: Vec<[f64; 2]>, elements: &[Vec<usize>]) -> Result<Self, FemError> {
        for (element, list) in elements.iter().enumerate() {
            if list.len() != kind.nodes() {
                return Err(FemError::Connectivity {
                    element,
                    problem: "wrong number of nodes",
                });
            }
            if list.iter().any(|&node| node >= nodes.len()) {
                return Err(FemError::Connectivity {
                    element,
                    problem: "a node that does not exist",
                });
            }
        }
        Ok(Self {
            kind,
            nodes,
            connectivity: elements.concat(),
        })
    }

    /// Rectangles of `kind` between the lines `radii` and `depths` \[m\], both strictly increasing, and the lines half-way
    /// between these: nine-node elements fill an interval, four-node elements half of one, so that both kinds have the same
    /// nodes.
    ///
    /// Nodes are numbered along r first: the node in column `i` and row `j` of the (2n+1) × (2m+1) lattice of corners and
    /// mid-points has the index `i + (2n+1) j`; so are the elements.
    pub fn rectangular(kind: Quadrilateral, radii: &[f64], depths: &[f64]) -> Self {
        let across = with_midpoints(radii);
        let down = with_midpoints(depths);
        let width = across.len();
        let nodes = down
            .iter()
            .flat_map(|&z| across.iter().map(move |&r| [r, z]))
            .collect();
        let step = 2 / kind.per_interval();
        // Columns and rows of an element's nodes, from its first.
        let offsets: &[(usize, usize)] = match kind {
            Quadrilateral::Linear4 => &[(0, 0), (1, 0), (1, 1), (0, 1)],
            Quadrilateral::Quadratic9 => &[
                (0, 0),
                (2, 0),
                (2, 2),
                (0, 2),
                (1, 0),
                (2, 1),
                (1, 2),
                (0, 1),
                (1, 1),
            ],
        };
        let mut connectivity = Vec::with_capacity(9 * radii.len() * depths.len());
        for row in (0..down.len().saturating_sub(1)).step_by(step) {
            for column in (0..width.saturating_sub(1)).step_by(step) {
                let first = column + row * width;
                connectivity.extend(offsets.iter().map(|&(a, b)| first + a + b * width));
            }
        }
        Self {
            kind,
            nodes,
            connectivity,
        }
    }

    /// Kind of the elements.
    pub fn kind(&self) -> Quadrilateral {
        self.kind
    }

    /// Coordinates (r, z) of the nodes \[m\].
    pub fn nodes(&self) -> &[[f64; 2]] {
        &self.nodes
    }

    /// Number of elements.
    pub fn element_count(&self) -> usize {
        self.connectivity.len() / self.kind.nodes()
    }

    /// Node indices of one element; none where there is no such element.
    pub fn element(&self, element: usize) -> &[usize] {
        self.elements().nth(element).unwrap_or_default()
    }

    /// All elements' node indices in turn.
    pub fn elements(&self) -> impl Iterator<Item = &[usize]> {
        self.connectivity.chunks_exact(self.kind.nodes())
    }

    /// Coordinates of one element's nodes; only the first `kind.nodes()` entries are meant.
    pub fn element_nodes(&self, element: usize) -> [[f64; 2]; MAX_NODES] {
        let mut coordinates = [[0.0; 2]; MAX_NODES];
        for (slot, &node) in coordinates.iter_mut().zip(self.element(element)) {
            *slot = self.nodes[node];
        }
        coordinates
    }

    /// Number of degrees of freedom: two a node, (`u_r`, `u_z`).
    pub fn dofs(&self) -> usize {
        2 * self.nodes.len()
    }
}

/// The lines and the mid-points between them.
pub(crate) fn with_midpoints(lines: &[f64]) -> Vec<f64> {
    let mut out = Vec::with_capacity(2 * lines.len());
    for pair in lines.windows(2) {
        out.extend([pair[0], 0.5 * (pair[0] + pair[1])]);
    }
    out.extend(lines.last());
    out
}
