//! The textbook's axisymmetric finite element, to be compared with: four nodes, bilinear, full integration (T. J. R. Hughes,
//! *The Finite Element Method* (1987), chapter 4). It locks as ν → 1/2.

use ground_field::Soil;

/// Three-point Gauss rule on [−1, 1]: abscissa and weight.
const GAUSS: [(f64, f64); 3] = [
    (-0.774_596_669_241_483_4, 5.0 / 9.0),
    (0.0, 8.0 / 9.0),
    (0.774_596_669_241_483_4, 5.0 / 9.0),
];
/// ν = 1/2 is taken as this.
const LARGEST_POISSON_RATIO: f64 = 0.499_99;

/// A mesh in the (r, z) half-plane; an element's nodes run round its corners, r to z.
pub struct Mesh {
    pub nodes: Vec<[f64; 2]>,
    pub elements: Vec<[usize; 4]>,
}

/// Shape functions, their derivatives, radius and determinant of the Jacobian at a point of an element.
pub struct Shape {
    pub value: [f64; 4],
    pub d_r: [f64; 4],
    pub d_z: [f64; 4],
    pub radius: f64,
    pub determinant: f64,
}

impl Mesh {
    /// Rectangles between `radii` and `depths`, row by row.
    pub fn rectangular(radii: &[f64], depths: &[f64]) -> Self {
        let (width, down) = (radii.len(), depths.len() - 1);
        let first = (0..(width - 1) * down).map(|e| e % (width - 1) + e / (width - 1) * width);
        Self {
            nodes: depths
                .iter()
                .flat_map(|&z| radii.iter().map(move |&r| [r, z]))
                .collect(),
            elements: first.map(|n| [n, n + 1, n + width + 1, n + width]).collect(),
        }
    }

    /// The shape functions at (ξ, η) of an element.
    pub fn shape(&self, element: usize, xi: f64, eta: f64) -> Shape {
        let signs = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
        let value = signs.map(|(sx, se)| 0.25 * (1.0 + sx * xi) * (1.0 + se * eta));
        let d_xi = signs.map(|(sx, se)| 0.25 * sx * (1.0 + se * eta));
        let d_eta = signs.map(|(sx, se)| 0.25 * se * (1.0 + sx * xi));
        let nodes = self.elements[element].map(|node| self.nodes[node]);
        let sum =
            |of: &[f64; 4], c: usize| -> f64 { of.iter().zip(&nodes).map(|(w, node)| w * node[c]).sum() };
        let [r_xi, z_xi, r_eta, z_eta] = [sum(&d_xi, 0), sum(&d_xi, 1), sum(&d_eta, 0), sum(&d_eta, 1)];
        let determinant = r_xi * z_eta - z_xi * r_eta;
        Shape {
            value,
            d_r: std::array::from_fn(|k| (z_eta * d_xi[k] - z_xi * d_eta[k]) / determinant),
            d_z: std::array::from_fn(|k| (r_xi * d_eta[k] - r_eta * d_xi[k]) / determinant),
            radius: sum(&value, 0),
            determinant,
        }
    }

    /// Stiffness per radian of an element of `soil`, over (u_r, u_z) node by node.
    pub fn stiffness(&self, element: usize, soil: Soil) -> [[f64; 8]; 8] {
        let mut matrix = [[0.0; 8]; 8];
        for (xi, eta, weight) in GAUSS.iter().flat_map(|&(x, v)| GAUSS.map(|(e, w)| (x, e, v * w))) {
            let shape = self.shape(element, xi, eta);
            let columns: [[f64; 4]; 8] = std::array::from_fn(|k| shape.strain(k));
            for (i, row) in matrix.iter_mut().enumerate() {
                let stress = stress(soil, columns[i]);
                for (entry, strain) in row.iter_mut().zip(&columns) {
                    let work: f64 = stress.iter().zip(strain).map(|(s, e)| s * e).sum();
                    *entry += weight * shape.determinant * shape.radius * work;
                }
            }
        }
        matrix
    }

    /// Displacements (u_r, u_z) node by node under `force`, `given` where `fixed`; none if the stiffness is not positive definite.
    pub fn solve(
        &self,
        fixed: &[bool],
        given: &[f64],
        force: &[f64],
        soil: impl Fn(usize) -> Soil,
    ) -> Option<Vec<f64>> {
        let spread = |nodes: &[usize; 4]| {
            nodes
                .iter()
                .max()
                .zip(nodes.iter().min())
                .map_or(0, |(a, b)| a - b)
        };
        let band = 2 * self.elements.iter().map(spread).max().unwrap_or(0) + 2;
        // Row i holds the entries of columns i − band + 1 to i.
        let mut rows = vec![vec![0.0; band]; fixed.len()];
        let mut right = force.to_vec();
        for (element, nodes) in self.elements.iter().enumerate() {
            let matrix = self.stiffness(element, soil(element));
            let dofs: [usize; 8] = std::array::from_fn(|k| 2 * nodes[k / 2] + k % 2);
            for (&i, row) in dofs.iter().zip(&matrix) {
                for (&j, entry) in dofs.iter().zip(row) {
                    if fixed[j] {
                        right[i] -= entry * given[j];
                    } else if !fixed[i] && j <= i {
                        rows[i][band - 1 + j - i] += entry;
                    }
                }
            }
        }
        for i in 0..fixed.len() {
            if fixed[i] {
                rows[i][band - 1] = 1.0;
                right[i] = given[i];
            }
        }
        for i in 0..rows.len() {
            let (above, rest) = rows.split_at_mut(i);
            let row = &mut rest[0];
            for (j, other) in above.iter().enumerate().skip(i.saturating_sub(band - 1)) {
                // The entries of both rows left of column j.
                let (start, place) = ((i + 1).saturating_sub(band), band - 1 + j - i);
                let count = j - start;
                let known: f64 = (row[place - count..place]
                    .iter()
                    .zip(&other[band - 1 - count..band - 1]))
                .map(|(a, b)| a * b)
                .sum();
                row[place] = (row[place] - known) / other[band - 1];
            }
            let square: f64 = row[..band - 1].iter().map(|v| v * v).sum();
            row[band - 1] = (row[band - 1] - square).sqrt();
            if row[band - 1].is_nan() || row[band - 1] <= 0.0 {
                return None;
            }
        }
        for i in 0..rows.len() {
            let first = i.saturating_sub(band - 1);
            let known: f64 = (first..i).map(|j| rows[i][band - 1 + j - i] * right[j]).sum();
            right[i] = (right[i] - known) / rows[i][band - 1];
        }
        for i in (0..rows.len()).rev() {
            right[i] /= rows[i][band - 1];
            for j in i.saturating_sub(band - 1)..i {
                right[j] -= rows[i][band - 1 + j - i] * right[i];
            }
        }
        Some(right)
    }
}

impl Shape {
    /// Strain (ε_r, ε_z, ε_θ, γ_rz) for 1 of degree of freedom `k`.
    pub fn strain(&self, k: usize) -> [f64; 4] {
        let (r, z) = (self.d_r[k / 2], self.d_z[k / 2]);
        if k.is_multiple_of(2) {
            [r, 0.0, self.value[k / 2] / self.radius, z]
        } else {
            [0.0, z, 0.0, r]
        }
    }
}

/// Stress (r, z, θ, rz) from strain, tension positive.
pub fn stress(soil: Soil, strain: [f64; 4]) -> [f64; 4] {
    let nu = soil.poisson_ratio().min(LARGEST_POISSON_RATIO);
    let shear = soil.young_modulus() / (2.0 * (1.0 + nu));
    let pressure = 2.0 * shear * nu / (1.0 - 2.0 * nu) * (strain[0] + strain[1] + strain[2]);
    let normal = |k: usize| 2.0 * shear * strain[k] + pressure;
    [normal(0), normal(1), normal(2), shear * strain[3]]
}
