//! The assembled stiffness: sparse, factored once by Cholesky, solved for any number of loads.
//!
//! Prescribed degrees of freedom are eliminated; the free ones keep the order of the mesh, and faer's approximate minimum
//! degree ordering reduces the fill. Only the lower triangle is stored.
//!
//! A factorisation of a nearly singular matrix may pass without an error, so every solution u is checked. The residual
//! r = f − K u is solved for once more: K⁻¹r is both a correction and an estimate of the error that rounding has left in u.
//! It is applied twice, and if the second is still more than [`LARGEST_CHANGE`] of u the solution is an error.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::llt::factor::LltRegularization;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, LltRef, SymbolicCholesky, SymmetricOrdering, factorize_symbolic_cholesky,
};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMat};
use faer::{Conj, MatMut, Par, Side};

use crate::FemError;
use crate::element::{ElementMatrix, MAX_DOFS, Volumetric};
use crate::material::Elasticity;
use crate::mesh::Mesh;

/// Largest change K⁻¹(f − K u) of an accepted solution u, relative to it (largest components).
pub const LARGEST_CHANGE: f64 = 1e-7;
/// Corrections applied to a solution.
const CORRECTIONS: usize = 2;

const FIXED: usize = usize::MAX;

/// A factored stiffness matrix with some degrees of freedom prescribed.
#[derive(Debug)]
pub struct System {
    /// Free unknown of each degree of freedom, or `FIXED`.
    unknown: Vec<usize>,
    pattern: SymbolicSparseColMat<usize>,
    values: Vec<f64>,
    symbolic: SymbolicCholesky<usize>,
    factor: Vec<f64>,
}

/// Size of a factored system.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SystemSize {
    /// Unknowns after elimination of prescribed ones.
    pub unknowns: usize,
    /// Stored entries of the lower triangle of the stiffness.
    pub matrix_entries: usize,
    /// Stored entries of the Cholesky factor.
    pub factor_entries: usize,
}

impl System {
    /// Assembles and factors the stiffness of `mesh`.
    ///
    /// `prescribed` tells for each degree of freedom whether its displacement is given, `elasticity` the moduli in
    /// element `e` at (r, z).
    ///
    /// # Errors
    ///
    /// [`FemError::Length`], [`FemError::Degenerate`], or [`FemError::Factorisation`] where the mesh is not held or the
    /// numbers do not suffice.
    pub fn new(
        mesh: &Mesh,
        volumetric: Volumetric,
        prescribed: &[bool],
        elasticity: impl Fn(usize, f64, f64) -> Elasticity,
    ) -> Result<Self, FemError> {
        check_length("prescribed", prescribed.len(), mesh.dofs())?;
        let mut count = 0;
        let unknown: Vec<usize> = prescribed
            .iter()
            .map(|&fixed| {
                if fixed {
                    return FIXED;
                }
                count += 1;
                count - 1
            })
            .collect();
        let pattern = pattern(mesh, &unknown, count);
        let mut values = vec![0.0; pattern.row_idx().len()];
        for element in 0..mesh.element_count() {
            let matrix =
                mesh.kind()
                    .stiffness(element, &mesh.element_nodes(element), volumetric, |r, z| {
                        elasticity(element, r, z)
                    })?;
            scatter(mesh.element(element), &matrix, &unknown, &pattern, &mut values);
        }
        let failed = |reason| FemError::Factorisation {
            unknowns: count,
            reason,
        };
        let symbolic = factorize_symbolic_cholesky(
            pattern.as_ref(),
            Side::Lower,
            SymmetricOrdering::Amd,
            CholeskySymbolicParams::default(),
        )
        .map_err(|_| failed("the symbolic factorisation ran out of memory or indices"))?;
        let mut factor = vec![0.0; symbolic.len_val()];
        let scratch = symbolic.factorize_numeric_llt_scratch::<f64>(Par::Seq, faer::prelude::default());
        let mut memory = MemBuffer::try_new(scratch).map_err(|_| failed("out of memory"))?;
        symbolic
            .factorize_numeric_llt(
                &mut factor,
                SparseColMatRef::new(pattern.as_ref(), &values),
                Side::Lower,
                LltRegularization::default(),
                Par::Seq,
                MemStack::new(&mut memory),
                faer::prelude::default(),
            )
            .map_err(|_| failed("it is not positive definite"))?;
        Ok(Self {
            unknown,
            pattern,
            values,
            symbolic,
            factor,
        })
    }

    /// Size of the system.
    pub fn size(&self) -> SystemSize {
        SystemSize {
            unknowns: self.pattern.ncols(),
            matrix_entries: self.values.len(),
            factor_entries: self.factor.len(),
        }
    }

    /// Displacements at all degrees of freedom under `force` (per radian), with the prescribed ones taken from
    /// `displacement`, whose other entries are ignored.
    ///
    /// `force` must already contain −K u of the prescribed displacements; see [`prescribed_force`].
    ///
    /// # Errors
    ///
    /// [`FemError::Length`] or [`FemError::Inaccurate`].
    pub fn solve(&self, force: &[f64], displacement: &[f64]) -> Result<Vec<f64>, FemError> {
        self.solve_within(force, displacement, LARGEST_CHANGE)
    }

    /// The same with another limit in the place of [`LARGEST_CHANGE`].
    ///
    /// # Errors
    ///
    /// As for [`System::solve`].
    pub fn solve_within(
        &self,
        force: &[f64],
        displacement: &[f64],
        allowed: f64,
    ) -> Result<Vec<f64>, FemError> {
        check_length("force", force.len(), self.unknown.len())?;
        check_length("displacement", displacement.len(), self.unknown.len())?;
        let mut right = vec![0.0; self.pattern.ncols()];
        for (&unknown, &value) in self.unknown.iter().zip(force) {
            if unknown != FIXED {
                right[unknown] = value;
            }
        }
        let mut solution = right.clone();
        self.back_substitute(&mut solution);
        let mut change = 0.0;
        for _ in 0..CORRECTIONS {
            let mut correction = self.residual(&solution, &right);
            self.back_substitute(&mut correction);
            for (value, change) in solution.iter_mut().zip(&correction) {
                *value += change;
            }
            change = largest(&correction) / largest(&solution).max(f64::MIN_POSITIVE);
        }
        if change.is_nan() || change > allowed {
            return Err(FemError::Inaccurate { change, allowed });
        }
        let mut out = displacement.to_vec();
        for (value, &unknown) in out.iter_mut().zip(&self.unknown) {
            if unknown != FIXED {
                *value = solution[unknown];
            }
        }
        Ok(out)
    }

    fn back_substitute(&self, right: &mut [f64]) {
        let rows = right.len();
        let scratch = self.symbolic.solve_in_place_scratch::<f64>(1, Par::Seq);
        let mut memory = MemBuffer::new(scratch);
        LltRef::new(&self.symbolic, &self.factor).solve_in_place_with_conj(
            Conj::No,
            MatMut::from_column_major_slice_mut(right, rows, 1),
            Par::Seq,
            MemStack::new(&mut memory),
        );
    }

    /// f − K u.
    fn residual(&self, solution: &[f64], right: &[f64]) -> Vec<f64> {
        let mut residual = right.to_vec();
        for column in 0..self.pattern.ncols() {
            for k in self.pattern.col_range(column) {
                let row = self.pattern.row_idx()[k];
                residual[row] -= self.values[k] * solution[column];
                if row != column {
                    residual[column] -= self.values[k] * solution[row];
                }
            }
        }
        residual
    }
}

/// The force −K u of prescribed displacements `displacement` (zero where free), over all degrees of freedom; only
/// elements for which `touches` holds are looked at.
///
/// # Errors
///
/// [`FemError::Length`] or [`FemError::Degenerate`].
pub fn prescribed_force(
    mesh: &Mesh,
    volumetric: Volumetric,
    displacement: &[f64],
    touches: impl Fn(usize) -> bool,
    elasticity: impl Fn(usize, f64, f64) -> Elasticity,
) -> Result<Vec<f64>, FemError> {
    check_length("displacement", displacement.len(), mesh.dofs())?;
    let mut force = vec![0.0; mesh.dofs()];
    for element in (0..mesh.element_count()).filter(|&e| touches(e)) {
        let matrix = mesh
            .kind()
            .stiffness(element, &mesh.element_nodes(element), volumetric, |r, z| {
                elasticity(element, r, z)
            })?;
        let nodes = mesh.element(element);
        for (a, &node) in nodes.iter().enumerate() {
            for c in 0..2 {
                let product: f64 = nodes
                    .iter()
                    .enumerate()
                    .map(|(b, &other)| {
                        let row = &matrix[2 * a + c];
                        row[2 * b] * displacement[2 * other] + row[2 * b + 1] * displacement[2 * other + 1]
                    })
                    .sum();
                force[2 * node + c] -= product;
            }
        }
    }
    Ok(force)
}

fn check_length(name: &'static str, given: usize, expected: usize) -> Result<(), FemError> {
    if given == expected {
        Ok(())
    } else {
        Err(FemError::Length {
            name,
            given,
            expected,
        })
    }
}

fn largest(values: &[f64]) -> f64 {
    // `f64::max` would drop a NaN.
    values.iter().fold(0.0, |most, value| {
        if value.abs() > most || value.is_nan() {
            value.abs()
        } else {
            most
        }
    })
}

/// Lower triangle of the couplings between unknowns that share an element.
fn pattern(mesh: &Mesh, unknown: &[usize], count: usize) -> SymbolicSparseColMat<usize> {
    let mut neighbours: Vec<Vec<usize>> = vec![Vec::new(); mesh.nodes().len()];
    for nodes in mesh.elements() {
        for &node in nodes {
            // Only later nodes: the unknowns are numbered along the nodes.
            neighbours[node].extend(nodes.iter().copied().filter(|&other| other >= node));
        }
    }
    let mut col_ptr = Vec::with_capacity(count + 1);
    let mut row_idx = Vec::new();
    col_ptr.push(0);
    for (node, list) in neighbours.iter_mut().enumerate() {
        list.sort_unstable();
        list.dedup();
        for component in 0..2 {
            let column = unknown[2 * node + component];
            if column == FIXED {
                continue;
            }
            let rows = list
                .iter()
                .flat_map(|&other| [unknown[2 * other], unknown[2 * other + 1]]);
            row_idx.extend(rows.filter(|&row| row != FIXED && row >= column));
            col_ptr.push(row_idx.len());
        }
    }
    SymbolicSparseColMat::new_checked(count, count, col_ptr, None, row_idx)
}

/// Adds an element's matrix to the lower triangle.
fn scatter(
    nodes: &[usize],
    matrix: &ElementMatrix,
    unknown: &[usize],
    pattern: &SymbolicSparseColMat<usize>,
    values: &mut [f64],
) {
    let mut places = [FIXED; MAX_DOFS];
    for (k, &node) in nodes.iter().enumerate() {
        places[2 * k] = unknown[2 * node];
        places[2 * k + 1] = unknown[2 * node + 1];
    }
    let places = &places[..2 * nodes.len()];
    for (b, &column) in places.iter().enumerate().filter(|&(_, &column)| column != FIXED) {
        let range = pattern.col_range(column);
        let start = range.start;
        let rows = &pattern.row_idx()[range];
        for (a, &row) in places.iter().enumerate() {
            if row != FIXED
                && row >= column
                && let Ok(found) = rows.binary_search(&row)
            {
                values[start + found] += matrix[a][b];
            }
        }
    }
}
