//! Sparse Cholesky factorisation by nested dissection of the mesh.
//!
//! The rectangle of elements is halved across its longer side again and again, down to single elements. On the way back the halves are
//! joined, and every unknown that no other element touches is eliminated ([`crate::front`]); what is left couples the unknowns on
//! the rectangle's edge. For n unknowns the factor so has O(n log n) entries and costs O(n^1.5) operations, the least there can
//! be on such a mesh (A. George, SIAM J. Numer. Anal. 10 (1973) 345–363).

use std::ops::Range;

use crate::element::{DOFS, ElementMatrix, NODES};
use crate::front::eliminate;
use crate::mesh::Mesh;

/// In the place of an unknown: a degree of freedom whose displacement is prescribed.
pub(crate) const FIXED: usize = usize::MAX;

/// The Cholesky factor, in the order of elimination.
#[derive(Debug, Default)]
pub(crate) struct Factor {
    fronts: Vec<Front>,
}

/// Columns of the factor that were made together.
#[derive(Debug)]
struct Front {
    /// The unknowns eliminated, then those they are coupled with.
    unknowns: Vec<usize>,
    /// Their columns, each as long as `unknowns`; above the diagonal without meaning.
    columns: Vec<f64>,
}

/// Some elements' stiffness once their inner unknowns are eliminated.
struct Part {
    /// Its unknowns, and how many of these elements touch each.
    unknowns: Vec<(usize, u8)>,
    /// Lower triangle, column by column.
    matrix: Vec<f64>,
}

impl Factor {
    /// Factors the stiffness of `mesh`, whose elements have the `matrices`; `unknown` numbers the free degrees of freedom.
    /// `None` if it is not positive definite.
    pub(crate) fn new(mesh: &Mesh, matrices: &[ElementMatrix], unknown: &[usize]) -> Option<Self> {
        let mut touching = vec![0; unknown.len()];
        for dof in mesh.elements.iter().flat_map(dofs) {
            if unknown[dof] != FIXED {
                touching[unknown[dof]] += 1;
            }
        }
        let mut dissection = Dissection {
            mesh,
            matrices,
            unknown,
            touching,
            place: vec![0; unknown.len()],
            factor: Self::default(),
        };
        dissection.eliminate(0..mesh.across, 0..mesh.elements.len() / mesh.across.max(1))?;
        Some(dissection.factor)
    }

    /// Replaces `right` by the solution.
    pub(crate) fn solve(&self, right: &mut [f64]) {
        let mut local = Vec::new();
        for front in &self.fronts {
            front.gather(right, &mut local);
            for (k, column) in front.columns.chunks_exact(local.len()).enumerate() {
                local[k] /= column[k];
                let solved = local[k];
                for (value, entry) in local[k + 1..].iter_mut().zip(&column[k + 1..]) {
                    *value -= entry * solved;
                }
            }
            for (&unknown, &value) in front.unknowns.iter().zip(&local) {
                right[unknown] = value;
            }
        }
        for front in self.fronts.iter().rev() {
            front.gather(right, &mut local);
            for (k, column) in front.columns.chunks_exact(local.len()).enumerate().rev() {
                let pairs = local[k + 1..].iter().zip(&column[k + 1..]);
                let known: f64 = pairs.map(|(x, l)| x * l).sum();
                local[k] = (local[k] - known) / column[k];
            }
            for (&unknown, &value) in front.unknowns.iter().zip(&local).take(front.count()) {
                right[unknown] = value;
            }
        }
    }
}

impl Front {
    fn count(&self) -> usize {
        self.columns.len() / self.unknowns.len()
    }

    fn gather(&self, values: &[f64], local: &mut Vec<f64>) {
        local.clear();
        local.extend(self.unknowns.iter().map(|&unknown| values[unknown]));
    }
}

struct Dissection<'a> {
    mesh: &'a Mesh,
    matrices: &'a [ElementMatrix],
    /// Number of each degree of freedom among the unknowns, or `FIXED`.
    unknown: &'a [usize],
    /// Elements that touch each unknown.
    touching: Vec<u8>,
    /// Place of each unknown in the front at hand.
    place: Vec<usize>,
    factor: Factor,
}

impl Dissection<'_> {
    /// Eliminates what lies inside a rectangle of elements, and returns what is left.
    fn eliminate(&mut self, columns: Range<usize>, rows: Range<usize>) -> Option<Part> {
        let [first, second] = if columns.len() > 1 && columns.len() >= rows.len() {
            let middle = columns.start.midpoint(columns.end);
            [(columns.start..middle, rows.clone()), (middle..columns.end, rows)]
        } else if rows.len() > 1 {
            let middle = rows.start.midpoint(rows.end);
            [(columns.clone(), rows.start..middle), (columns, middle..rows.end)]
        } else {
            // One element, or none.
            let element = |(column, row)| self.element(column + row * self.mesh.across);
            let parts: Vec<Part> = columns.zip(rows).map(element).collect();
            return self.join(&parts);
        };
        let first = self.eliminate(first.0, first.1)?;
        let second = self.eliminate(second.0, second.1)?;
        self.join(&[first, second])
    }

    /// The stiffness of one element over its unknowns.
    fn element(&self, element: usize) -> Part {
        let dofs = dofs(&self.mesh.elements[element]).map(|dof| self.unknown[dof]);
        let free: Vec<usize> = (0..DOFS).filter(|&k| dofs[k] != FIXED).collect();
        let matrix = &self.matrices[element];
        let column = |&b: &usize| free.iter().map(move |&a| matrix[a][b]);
        Part {
            unknowns: free.iter().map(|&k| (dofs[k], 1)).collect(),
            matrix: free.iter().flat_map(column).collect(),
        }
    }

    /// Adds up `parts` and eliminates the unknowns that no other element touches.
    fn join(&mut self, parts: &[Part]) -> Option<Part> {
        let mut unknowns: Vec<(usize, u8)> = parts.iter().flat_map(|part| &part.unknowns).copied().collect();
        unknowns.sort_unstable();
        unknowns.dedup_by(|next, first| {
            let same = next.0 == first.0;
            first.1 += if same { next.1 } else { 0 };
            same
        });
        let inner = |&(unknown, elements): &(usize, u8)| elements == self.touching[unknown];
        unknowns.sort_by_key(|entry| !inner(entry));
        let (order, count) = (unknowns.len(), unknowns.partition_point(inner));
        for (place, &(unknown, _)) in unknowns.iter().enumerate() {
            self.place[unknown] = place;
        }
        let mut matrix = vec![0.0; order * order];
        for part in parts {
            let places = part.unknowns.iter().map(|&(unknown, _)| self.place[unknown]);
            let places: Vec<usize> = places.collect();
            let columns = part.matrix.chunks_exact(places.len().max(1));
            for (b, (&column, entries)) in places.iter().zip(columns).enumerate() {
                for (&row, entry) in places.iter().zip(entries).skip(b) {
                    matrix[row.max(column) + order * row.min(column)] += entry;
                }
            }
        }
        eliminate(&mut matrix, order, count)?;
        let column = |column: usize| &matrix[order * column + count..order * (column + 1)];
        let rest = Part {
            matrix: (count..order).flat_map(column).copied().collect(),
            unknowns: unknowns[count..].to_vec(),
        };
        if count > 0 {
            matrix.truncate(order * count);
            matrix.shrink_to_fit();
            self.factor.fronts.push(Front {
                unknowns: unknowns.into_iter().map(|(unknown, _)| unknown).collect(),
                columns: matrix,
            });
        }
        Some(rest)
    }
}

/// Degrees of freedom of an element's nodes.
pub(crate) fn dofs(nodes: &[usize; NODES]) -> [usize; DOFS] {
    std::array::from_fn(|k| 2 * nodes[k / 2] + k % 2)
}

#[cfg(test)]
impl Factor {
    /// Its entries, those above the diagonal without a meaning left out.
    pub(crate) fn entries(&self) -> usize {
        let entries = |front: &Front| {
            let (order, count) = (front.unknowns.len(), front.count());
            count * order - count * count.saturating_sub(1) / 2
        };
        self.fronts.iter().map(entries).sum()
    }
}
