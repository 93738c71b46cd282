//! Axisymmetric quadrilaterals: shape functions, stiffness, strain.
//!
//! The displacement (`u_r`, `u_z`) is interpolated from nodes; the strain is `ε_r` = `u_r,r`; `ε_z` = `u_z,z`; `ε_θ` = `u_r/r`;
//! `γ_rz` = `u_r,z` + `u_z,r`; all integrals are per radian: ∫ … r dr dz. Degrees of freedom run (`u_r`, `u_z`) node by node.
//!
//! [`Quadrilateral::Quadratic9`] is the working element, [`Quadrilateral::Linear4`] the textbook one that published
//! solutions can be compared with. Nodes run round the corners with a positive Jacobian (r to z), then for the nine-node
//! element the mid-sides 1–2, 2–3, 3–4, 4–1 and the centre.
//!
//! # Locking
//!
//! Near ν = 1/2 the plain element is far too stiff. With [`Volumetric::Projected`] the dilatation enters the λ term only
//! through its least-squares projection onto discontinuous {1, ξ, η} (nine nodes; {1} for four): the displacement form of
//! the Q9/P₋₁ mixed element, which satisfies the inf–sup condition and keeps its order for every ν < 1/2.
//!
//! # References
//!
//! T. J. R. Hughes, *The Finite Element Method* (1987), sections 4.4–4.5; D. Boffi, F. Brezzi, M. Fortin, *Mixed Finite
//! Element Methods and Applications* (2013), section 8.6; I. M. Smith, D. V. Griffiths, L. Margetts, *Programming the
//! Finite Element Method*, 5th ed. (2014), section 5.

#![allow(
    clippy::needless_range_loop,
    reason = "matrix algebra reads best by its indices"
)]

use crate::FemError;
use crate::material::Elasticity;

/// Three-point Gauss rule on \[−1, 1\]: abscissa and weight.
pub(crate) const GAUSS_3: [(f64, f64); 3] = [
    (-0.774_596_669_241_483_4, 5.0 / 9.0),
    (0.0, 8.0 / 9.0),
    (0.774_596_669_241_483_4, 5.0 / 9.0),
];

/// Six-point Gauss rule on \[−1, 1\]: abscissa and weight.
pub(crate) const GAUSS_6: [(f64, f64); 6] = [
    (-0.932_469_514_203_152, 0.171_324_492_379_170_35),
    (-0.661_209_386_466_264_5, 0.360_761_573_048_138_6),
    (-0.238_619_186_083_196_9, 0.467_913_934_572_691),
    (0.238_619_186_083_196_9, 0.467_913_934_572_691),
    (0.661_209_386_466_264_5, 0.360_761_573_048_138_6),
    (0.932_469_514_203_152, 0.171_324_492_379_170_35),
];

/// Most nodes an element has.
pub const MAX_NODES: usize = 9;
/// Most degrees of freedom an element has.
pub const MAX_DOFS: usize = 2 * MAX_NODES;

/// A square matrix over an element's degrees of freedom, of which the leading block is used.
pub type ElementMatrix = [[f64; MAX_DOFS]; MAX_DOFS];

/// Kind of quadrilateral.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Quadrilateral {
    /// Four nodes, bilinear.
    Linear4,
    /// Nine nodes, biquadratic.
    Quadratic9,
}

/// How the dilatation enters the stiffness; see the [module documentation](self).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Volumetric {
    /// As it is: the plain displacement element, which locks as ν → 1/2.
    Full,
    /// Projected, free of locking.
    Projected,
}

/// Shape functions and their derivatives in physical coordinates at one point of an element.
#[derive(Debug, Clone, Copy)]
pub struct Shape {
    /// Shape functions.
    pub value: [f64; MAX_NODES],
    /// Their derivatives with respect to r \[1/m\].
    pub d_r: [f64; MAX_NODES],
    /// Their derivatives with respect to z \[1/m\].
    pub d_z: [f64; MAX_NODES],
    /// Radius of the point \[m\].
    pub radius: f64,
    /// Second coordinate of the point \[m\].
    pub depth: f64,
    /// Determinant of the Jacobian \[m²\].
    pub determinant: f64,
}

/// Quadratic Lagrange polynomials on nodes −1, 1, 0, in that order.
fn quadratic(x: f64) -> ([f64; 3], [f64; 3]) {
    (
        [0.5 * x * (x - 1.0), 0.5 * x * (x + 1.0), 1.0 - x * x],
        [x - 0.5, x + 0.5, -2.0 * x],
    )
}

/// Index pairs (in ξ, in η) into [`quadratic`]'s order for the nine nodes.
const NINE: [(usize, usize); 9] = [
    (0, 0),
    (1, 0),
    (1, 1),
    (0, 1),
    (2, 0),
    (1, 2),
    (2, 1),
    (0, 2),
    (2, 2),
];

impl Quadrilateral {
    /// Number of nodes.
    pub fn nodes(self) -> usize {
        match self {
            Self::Linear4 => 4,
            Self::Quadratic9 => 9,
        }
    }

    /// Number of degrees of freedom.
    pub fn dofs(self) -> usize {
        2 * self.nodes()
    }

    /// Elements along one interval between the lines of a rectangular mesh, whose nodes are the lines and the mid-points.
    pub(crate) fn per_interval(self) -> usize {
        match self {
            Self::Linear4 => 2,
            Self::Quadratic9 => 1,
        }
    }

    /// Shape functions at `x` in \[−1, 1\] of an edge, along which its nodes are even.
    /// Of two nodes the third entry is unused.
    pub(crate) fn edge_shape(self, x: f64) -> [f64; 3] {
        match self {
            Self::Linear4 => [0.5 * (1.0 - x), 0.5 * (1.0 + x), 0.0],
            Self::Quadratic9 => [0.5 * x * (x - 1.0), 1.0 - x * x, 0.5 * x * (x + 1.0)],
        }
    }

    /// Terms of the projected dilatation: {1} or {1, ξ, η}.
    fn pressure_terms(self) -> usize {
        match self {
            Self::Linear4 => 1,
            Self::Quadratic9 => 3,
        }
    }

    /// Shape functions and their derivatives with respect to (ξ, η).
    fn reference(self, xi: f64, eta: f64) -> [[f64; MAX_NODES]; 3] {
        let mut out = [[0.0; MAX_NODES]; 3];
        match self {
            Self::Linear4 => {
                for (k, (sx, se)) in [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)]
                    .into_iter()
                    .enumerate()
                {
                    out[0][k] = 0.25 * (1.0 + sx * xi) * (1.0 + se * eta);
                    out[1][k] = 0.25 * sx * (1.0 + se * eta);
                    out[2][k] = 0.25 * se * (1.0 + sx * xi);
                }
            }
            Self::Quadratic9 => {
                let (x, dx) = quadratic(xi);
                let (e, de) = quadratic(eta);
                for (k, (i, j)) in NINE.into_iter().enumerate() {
                    out[0][k] = x[i] * e[j];
                    out[1][k] = dx[i] * e[j];
                    out[2][k] = x[i] * de[j];
                }
            }
        }
        out
    }

    /// Shape functions at (ξ, η) of the element with these corner and other `nodes` (r, z).
    pub fn shape(self, nodes: &[[f64; 2]], xi: f64, eta: f64) -> Shape {
        let [value, d_xi, d_eta] = self.reference(xi, eta);
        // Rows: derivative with respect to ξ, to η; columns: r, z.
        let mut jacobian = [[0.0; 2]; 2];
        let mut at = [0.0; 2];
        for (k, node) in nodes.iter().enumerate().take(self.nodes()) {
            for c in 0..2 {
                jacobian[0][c] += d_xi[k] * node[c];
                jacobian[1][c] += d_eta[k] * node[c];
                at[c] += value[k] * node[c];
            }
        }
        let determinant = jacobian[0][0] * jacobian[1][1] - jacobian[0][1] * jacobian[1][0];
        let mut d_r = [0.0; MAX_NODES];
        let mut d_z = [0.0; MAX_NODES];
        for k in 0..self.nodes() {
            d_r[k] = (jacobian[1][1] * d_xi[k] - jacobian[0][1] * d_eta[k]) / determinant;
            d_z[k] = (jacobian[0][0] * d_eta[k] - jacobian[1][0] * d_xi[k]) / determinant;
        }
        Shape {
            value,
            d_r,
            d_z,
            radius: at[0],
            depth: at[1],
            determinant,
        }
    }

    /// Stiffness per radian of the element with these `nodes`, by a 3 × 3 Gauss rule.
    ///
    /// `elasticity` gives the moduli at (r, z). On failure the Jacobian determinant that was not positive is returned
    /// as [`FemError::Degenerate`] with `element` as its index.
    ///
    /// # Errors
    ///
    /// [`FemError::Degenerate`].
    pub fn stiffness(
        self,
        element: usize,
        nodes: &[[f64; 2]],
        volumetric: Volumetric,
        elasticity: impl Fn(f64, f64) -> Elasticity,
    ) -> Result<ElementMatrix, FemError> {
        let dofs = self.dofs();
        let terms = self.pressure_terms();
        let mut matrix = [[0.0; MAX_DOFS]; MAX_DOFS];
        // ∫ φφᵀ, ∫ λ φφᵀ and ∫ φ θᵀ for the projection.
        let mut mass = [[0.0; 3]; 3];
        let mut weighted_mass = [[0.0; 3]; 3];
        let mut coupling = [[0.0; MAX_DOFS]; 3];
        for (eta, weight_eta) in GAUSS_3 {
            for (xi, weight_xi) in GAUSS_3 {
                let shape = self.shape(nodes, xi, eta);
                if shape.determinant.is_nan() || shape.determinant <= 0.0 {
                    return Err(FemError::Degenerate {
                        element,
                        determinant: shape.determinant,
                    });
                }
                let moduli = elasticity(shape.radius, shape.depth);
                let weight = weight_eta * weight_xi * shape.determinant * shape.radius;
                self.add_shear(&shape, moduli.shear * weight, &mut matrix);
                let dilatation = self.dilatation(&shape);
                match volumetric {
                    Volumetric::Full => {
                        let scale = moduli.lame * weight;
                        for i in 0..dofs {
                            for j in 0..=i {
                                matrix[i][j] += scale * dilatation[i] * dilatation[j];
                            }
                        }
                    }
                    Volumetric::Projected => {
                        let phi = [1.0, xi, eta];
                        for p in 0..terms {
                            for q in 0..terms {
                                mass[p][q] += weight * phi[p] * phi[q];
                                weighted_mass[p][q] += weight * moduli.lame * phi[p] * phi[q];
                            }
                            for i in 0..dofs {
                                coupling[p][i] += weight * phi[p] * dilatation[i];
                            }
                        }
                    }
                }
            }
        }
        if volumetric == Volumetric::Projected {
            solve_small(&mut mass, &mut coupling, terms);
            for i in 0..dofs {
                let mut row = [0.0; 3];
                for (q, entry) in row.iter_mut().enumerate().take(terms) {
                    *entry = (0..terms).map(|p| coupling[p][i] * weighted_mass[p][q]).sum();
                }
                for j in 0..=i {
                    matrix[i][j] += (0..terms).map(|q| row[q] * coupling[q][j]).sum::<f64>();
                }
            }
        }
        for i in 0..dofs {
            for j in 0..i {
                matrix[j][i] = matrix[i][j];
            }
        }
        Ok(matrix)
    }

    /// The dilatation tr ε as a row over the degrees of freedom.
    fn dilatation(self, shape: &Shape) -> [f64; MAX_DOFS] {
        let mut row = [0.0; MAX_DOFS];
        for k in 0..self.nodes() {
            row[2 * k] = shape.d_r[k] + shape.value[k] / shape.radius;
            row[2 * k + 1] = shape.d_z[k];
        }
        row
    }

    /// Adds `scale` × (2 ε:ε without the shear's doubling), the G term, to the lower triangle.
    fn add_shear(self, shape: &Shape, scale: f64, matrix: &mut ElementMatrix) {
        for a in 0..self.nodes() {
            let (ra, za, ha) = (
                scale * shape.d_r[a],
                scale * shape.d_z[a],
                2.0 * scale * shape.value[a] / (shape.radius * shape.radius),
            );
            for b in 0..=a {
                let (rb, zb, nb) = (shape.d_r[b], shape.d_z[b], shape.value[b]);
                let (rr, zz) = (ra * rb, za * zb);
                matrix[2 * a][2 * b] += 2.0 * rr + ha * nb + zz;
                matrix[2 * a][2 * b + 1] += za * rb;
                matrix[2 * a + 1][2 * b] += ra * zb;
                matrix[2 * a + 1][2 * b + 1] += 2.0 * zz + rr;
            }
        }
    }

    /// Strain (`ε_r`, `ε_z`, `ε_θ`, `γ_rz`) at (ξ, η) from the element's `displacement` (`u_r`, `u_z` node by node).
    ///
    /// On the axis `ε_θ` = `ε_r`, its limit.
    pub fn strain(self, nodes: &[[f64; 2]], displacement: &[f64], xi: f64, eta: f64) -> [f64; 4] {
        let shape = self.shape(nodes, xi, eta);
        let mut strain = [0.0; 4];
        let mut u_r = 0.0;
        for (k, u) in displacement.chunks_exact(2).enumerate().take(self.nodes()) {
            strain[0] += shape.d_r[k] * u[0];
            strain[1] += shape.d_z[k] * u[1];
            strain[3] += shape.d_z[k] * u[0] + shape.d_r[k] * u[1];
            u_r += shape.value[k] * u[0];
        }
        strain[2] = if shape.radius > 0.0 {
            u_r / shape.radius
        } else {
            strain[0]
        };
        strain
    }
}

/// Replaces `right` by `mass`⁻¹ `right`, by elimination; `mass` is symmetric positive definite of order `terms`.
fn solve_small(mass: &mut [[f64; 3]; 3], right: &mut [[f64; MAX_DOFS]; 3], terms: usize) {
    for p in 0..terms {
        for q in p + 1..terms {
            let factor = mass[q][p] / mass[p][p];
            for s in p..terms {
                mass[q][s] -= factor * mass[p][s];
            }
            for i in 0..MAX_DOFS {
                right[q][i] -= factor * right[p][i];
            }
        }
    }
    for p in (0..terms).rev() {
        for i in 0..MAX_DOFS {
            let known: f64 = (p + 1..terms).map(|s| mass[p][s] * right[s][i]).sum();
            right[p][i] = (right[p][i] - known) / mass[p][p];
        }
    }
}
