//! The nine-node axisymmetric quadrilateral: shape functions and stiffness.
//!
//! The displacement (`u_r`, `u_z`) is interpolated from nodes; the strain is `ε_r` = `u_r,r`; `ε_z` = `u_z,z`; `ε_θ` = `u_r/r`;
//! `γ_rz` = `u_r,z` + `u_z,r`; all integrals are per radian: ∫ … r dr dz. Degrees of freedom run (`u_r`, `u_z`) node by node.
//! Nodes run round the corners with a positive Jacobian (r to z), then the mid-sides 1–2, 2–3, 3–4, 4–1 and the centre.
//!
//! # Locking
//!
//! Near ν = 1/2 the plain element is far too stiff. Here the dilatation enters the λ term only through its least-squares
//! projection onto discontinuous {1, ξ, η}: the displacement form of the Q9/P₋₁ mixed element, which satisfies the inf–sup
//! condition and keeps its order for every ν < 1/2.
//!
//! # References
//!
//! T. J. R. Hughes, *The Finite Element Method* (1987), sections 4.4–4.5; D. Boffi, F. Brezzi, M. Fortin, *Mixed Finite
//! Element Methods and Applications* (2013), section 8.6.

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

pub(crate) const NODES: usize = 9;
pub(crate) const DOFS: usize = 2 * NODES;
/// Terms of the projected dilatation: {1, ξ, η}.
const TERMS: usize = 3;

/// Coordinates (r, z) of an element's nodes \[m\].
pub(crate) type Corners = [[f64; 2]; NODES];
/// A square matrix over an element's degrees of freedom.
pub(crate) type ElementMatrix = [[f64; DOFS]; DOFS];

/// Shape functions and their derivatives in physical coordinates at one point of an element.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Shape {
    /// Shape functions.
    pub value: [f64; NODES],
    /// Their derivatives with respect to r \[1/m\].
    pub d_r: [f64; NODES],
    /// Their derivatives with respect to z \[1/m\].
    pub d_z: [f64; NODES],
    /// Radius of the point \[m\].
    pub radius: f64,
    /// Depth of the point \[m\].
    pub depth: f64,
    /// Determinant of the Jacobian \[m²\].
    pub determinant: f64,
}

/// Quadratic Lagrange polynomials on nodes −1, 0, 1, and their slopes.
fn quadratic(x: f64) -> ([f64; 3], [f64; 3]) {
    (
        [0.5 * x * (x - 1.0), 1.0 - x * x, 0.5 * x * (x + 1.0)],
        [x - 0.5, -2.0 * x, x + 0.5],
    )
}

/// Columns and rows of an element's nodes in the lattice of corners and mid-points.
pub(crate) const PLACES: [(usize, usize); NODES] = [
    (0, 0),
    (2, 0),
    (2, 2),
    (0, 2),
    (1, 0),
    (2, 1),
    (1, 2),
    (0, 1),
    (1, 1),
];

/// Shape functions at `x` in \[−1, 1\] of an edge whose three nodes follow each other.
pub(crate) fn edge_shape(x: f64) -> [f64; 3] {
    quadratic(x).0
}

impl Shape {
    /// Shape functions at (ξ, η) of the element with these nodes.
    pub(crate) fn at(nodes: &Corners, xi: f64, eta: f64) -> Self {
        let ((x, dx), (e, de)) = (quadratic(xi), quadratic(eta));
        let value = PLACES.map(|(i, j)| x[i] * e[j]);
        let d_xi = PLACES.map(|(i, j)| dx[i] * e[j]);
        let d_eta = PLACES.map(|(i, j)| x[i] * de[j]);
        let sum = |weights: &[f64; NODES], c: usize| -> f64 {
            let pairs = weights.iter().zip(nodes);
            pairs.map(|(weight, node)| weight * node[c]).sum()
        };
        let [r_xi, z_xi, r_eta, z_eta] = [sum(&d_xi, 0), sum(&d_xi, 1), sum(&d_eta, 0), sum(&d_eta, 1)];
        let determinant = r_xi * z_eta - z_xi * r_eta;
        Self {
            value,
            d_r: std::array::from_fn(|k| (z_eta * d_xi[k] - z_xi * d_eta[k]) / determinant),
            d_z: std::array::from_fn(|k| (r_xi * d_eta[k] - r_eta * d_xi[k]) / determinant),
            radius: sum(&value, 0),
            depth: sum(&value, 1),
            determinant,
        }
    }

    /// The dilatation tr ε as a row over the degrees of freedom.
    fn dilatation(&self) -> [f64; DOFS] {
        let mut row = [0.0; DOFS];
        for k in 0..NODES {
            row[2 * k] = self.d_r[k] + self.value[k] / self.radius;
            row[2 * k + 1] = self.d_z[k];
        }
        row
    }

    /// Adds `scale` × (2 ε:ε without the shear's doubling), the G term, to the lower triangle.
    fn add_shear(&self, scale: f64, matrix: &mut ElementMatrix) {
        for a in 0..NODES {
            let (ra, za) = (scale * self.d_r[a], scale * self.d_z[a]);
            let ha = 2.0 * scale * self.value[a] / (self.radius * self.radius);
            for b in 0..=a {
                let (rb, zb, nb) = (self.d_r[b], self.d_z[b], self.value[b]);
                let (rr, zz) = (ra * rb, za * zb);
                matrix[2 * a][2 * b] += 2.0 * rr + ha * nb + zz;
                matrix[2 * a][2 * b + 1] += za * rb;
                matrix[2 * a + 1][2 * b] += ra * zb;
                matrix[2 * a + 1][2 * b + 1] += 2.0 * zz + rr;
            }
        }
    }
}

/// Stiffness per radian of the element with these nodes, by a 3 × 3 Gauss rule; `elasticity` gives the moduli at (r, z).
///
/// # Errors
///
/// [`FemError::Degenerate`] if the Jacobian determinant is not positive.
pub(crate) fn stiffness(
    nodes: &Corners,
    elasticity: impl Fn(f64, f64) -> Elasticity,
) -> Result<ElementMatrix, FemError> {
    let mut matrix = [[0.0; DOFS]; DOFS];
    // ∫ φφᵀ, ∫ λ φφᵀ and ∫ φ θᵀ for the projection.
    let mut mass = [[0.0; TERMS]; TERMS];
    let mut weighted_mass = [[0.0; TERMS]; TERMS];
    let mut coupling = [[0.0; DOFS]; TERMS];
    for (eta, weight_eta) in GAUSS_3 {
        for (xi, weight_xi) in GAUSS_3 {
            let shape = Shape::at(nodes, xi, eta);
            let determinant = shape.determinant;
            if determinant.is_nan() || determinant <= 0.0 {
                return Err(FemError::Degenerate);
            }
            let moduli = elasticity(shape.radius, shape.depth);
            let weight = weight_eta * weight_xi * determinant * shape.radius;
            shape.add_shear(moduli.shear * weight, &mut matrix);
            let dilatation = shape.dilatation();
            let phi = [1.0, xi, eta];
            for p in 0..TERMS {
                for q in 0..TERMS {
                    mass[p][q] += weight * phi[p] * phi[q];
                    weighted_mass[p][q] += weight * moduli.lame * phi[p] * phi[q];
                }
                for i in 0..DOFS {
                    coupling[p][i] += weight * phi[p] * dilatation[i];
                }
            }
        }
    }
    solve_small(&mut mass, &mut coupling);
    for i in 0..DOFS {
        let row: [f64; TERMS] =
            std::array::from_fn(|q| (0..TERMS).map(|p| coupling[p][i] * weighted_mass[p][q]).sum());
        for j in 0..=i {
            matrix[i][j] += (0..TERMS).map(|q| row[q] * coupling[q][j]).sum::<f64>();
            matrix[j][i] = matrix[i][j];
        }
    }
    Ok(matrix)
}

/// Replaces `right` by `mass`⁻¹ `right`, by elimination; `mass` is symmetric positive definite.
fn solve_small(mass: &mut [[f64; TERMS]; TERMS], right: &mut [[f64; DOFS]; TERMS]) {
    for p in 0..TERMS {
        for q in p + 1..TERMS {
            let factor = mass[q][p] / mass[p][p];
            for s in p..TERMS {
                mass[q][s] -= factor * mass[p][s];
            }
            for i in 0..DOFS {
                right[q][i] -= factor * right[p][i];
            }
        }
    }
    for p in (0..TERMS).rev() {
        for i in 0..DOFS {
            let known: f64 = (p + 1..TERMS).map(|s| mass[p][s] * right[s][i]).sum();
            right[p][i] = (right[p][i] - known) / mass[p][p];
        }
    }
}
