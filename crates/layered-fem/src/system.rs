//! The stiffness of a mesh, factored once, solved for any number of loads.
//!
//! A factorisation of a nearly singular matrix may pass without an error, so every solution u is checked. The residual
//! r = f − K u is solved for once more: K⁻¹r is both a correction and an estimate of the error that rounding has left in u.
//! It is applied twice, and if the second is still more than is allowed the solution is an error.

use crate::FemError;
use crate::cholesky::{FIXED, Factor, dofs};
use crate::element::{DOFS, ElementMatrix, stiffness};
use crate::material::Elasticity;
use crate::mesh::Mesh;

/// Minimum change K⁻¹(f − K u) of a solution u, relative to it (largest components), that may be asked for.
pub(crate) const MIN_CHANGE: f64 = 1e-7;
const CORRECTIONS: usize = 2;

/// A factored stiffness matrix with some degrees of freedom prescribed.
#[derive(Debug)]
pub(crate) struct System {
    pub mesh: Mesh,
    matrices: Vec<ElementMatrix>,
    /// The unknowns: degrees of freedom that are not prescribed.
    pub unknowns: Vec<usize>,
    pub factor: Factor,
}

impl System {
    /// Factors the stiffness of `mesh`; `prescribed` says for each degree of freedom whether its displacement is given,
    /// `elasticity` gives the moduli in element `e` at (r, z).
    ///
    /// # Errors
    ///
    /// [`FemError::Degenerate`], or [`FemError::Factorisation`] if the mesh is not held or the numbers do not suffice.
    pub(crate) fn new(
        mesh: Mesh,
        prescribed: &[bool],
        elasticity: impl Fn(usize, f64, f64) -> Elasticity,
    ) -> Result<Self, FemError> {
        let unknowns: Vec<usize> = (0..prescribed.len()).filter(|&dof| !prescribed[dof]).collect();
        let mut number = vec![FIXED; prescribed.len()];
        for (unknown, &dof) in unknowns.iter().enumerate() {
            number[dof] = unknown;
        }
        let matrix = |e| stiffness(&mesh.corners(e), |r, z| elasticity(e, r, z));
        let matrices: Vec<ElementMatrix> = (0..mesh.elements.len()).map(matrix).collect::<Result<_, _>>()?;
        let factor = Factor::new(&mesh, &matrices, &number).ok_or(FemError::Factorisation)?;
        Ok(Self {
            mesh,
            matrices,
            unknowns,
            factor,
        })
    }

    /// Displacements at all degrees of freedom under `force` (per radian), where the prescribed ones have the values in `given`,
    /// which is zero elsewhere. A last correction may change them by `allowed` of themselves.
    ///
    /// # Errors
    ///
    /// [`FemError::Inaccurate`].
    pub(crate) fn solve(&self, force: &[f64], given: &[f64], allowed: f64) -> Result<Vec<f64>, FemError> {
        let mut displacement = given.to_vec();
        let mut change = 0.0;
        for _ in 0..=CORRECTIONS {
            let residual = self.residual(force, &displacement);
            let mut correction: Vec<f64> = self.unknowns.iter().map(|&dof| residual[dof]).collect();
            self.factor.solve(&mut correction);
            for (&dof, change) in self.unknowns.iter().zip(&correction) {
                displacement[dof] += change;
            }
            change = largest(&correction) / largest(&displacement).max(f64::MIN_POSITIVE);
        }
        if change <= allowed {
            Ok(displacement)
        } else {
            Err(FemError::Inaccurate { change, allowed })
        }
    }

    /// f − K u.
    fn residual(&self, force: &[f64], displacement: &[f64]) -> Vec<f64> {
        let mut residual = force.to_vec();
        for (element, nodes) in self.mesh.elements.iter().enumerate() {
            for (dof, value) in dofs(nodes).into_iter().zip(self.reaction(element, displacement)) {
                residual[dof] -= value;
            }
        }
        residual
    }

    /// K u of one element.
    pub(crate) fn reaction(&self, element: usize, displacement: &[f64]) -> [f64; DOFS] {
        let local = dofs(&self.mesh.elements[element]).map(|dof| displacement[dof]);
        self.matrices[element].map(|row| row.iter().zip(&local).map(|(k, u)| k * u).sum())
    }
}

fn largest(values: &[f64]) -> f64 {
    // `f64::max` would drop a NaN.
    let sizes = values.iter().map(|value| value.abs());
    sizes.fold(
        0.0,
        |most, size| if size > most || size.is_nan() { size } else { most },
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    use ground_field::Soil;

    /// Four distorted elements round one inner corner.
    fn distorted() -> Mesh {
        let corner = [
            [1.0, 0.0],
            [2.2, -0.1],
            [3.0, 0.0],
            [0.9, 1.2],
            [1.8, 0.9],
            [3.1, 1.1],
            [1.0, 2.0],
            [2.1, 2.2],
            [3.0, 2.0],
        ];
        let mut nodes: Vec<[f64; 2]> = Vec::new();
        let mut index = |point: [f64; 2]| {
            nodes
                .iter()
                .position(|n| (n[0] - point[0]).hypot(n[1] - point[1]) < 1e-9)
                .unwrap_or_else(|| {
                    nodes.push(point);
                    nodes.len() - 1
                })
        };
        let middle = |points: &[[f64; 2]]| {
            let n = points.len() as f64;
            [0, 1].map(|c| points.iter().map(|p| p[c]).sum::<f64>() / n)
        };
        let elements = [(0, 0), (1, 0), (0, 1), (1, 1)].map(|(i, j)| {
            let c = [i + 3 * j, i + 1 + 3 * j, i + 4 + 3 * j, i + 3 + 3 * j].map(|k| corner[k]);
            let sides: [[f64; 2]; 4] = std::array::from_fn(|k| middle(&[c[k], c[(k + 1) % 4]]));
            let points = c.into_iter().chain(sides).chain([middle(&c)]);
            let list: Vec<usize> = points.map(&mut index).collect();
            std::array::from_fn(|k| list[k])
        });
        Mesh {
            nodes,
            elements: elements.to_vec(),
            across: 2,
        }
    }

    fn soil(young_modulus: f64, poisson_ratio: f64) -> Elasticity {
        Elasticity::new(Soil::new(young_modulus, poisson_ratio).unwrap())
    }

    #[test]
    fn patch_test_on_distorted_elements() {
        // A state of constant strain in axisymmetry: u_r = a r, u_z = b z + c.
        let exact = |[r, z]: [f64; 2]| [0.3 * r, -0.7 * z + 0.2];
        let mesh = distorted();
        let inside = |[r, z]: [f64; 2]| r > 1.01 && r < 2.99 && z > 0.05 && z < 1.95;
        // The outer sides are bent, so the free nodes are known by their elements: those shared by all four or by two.
        let shared = |node: usize| mesh.elements.iter().filter(|list| list.contains(&node)).count() > 1;
        let free = |node: usize| {
            shared(node) && inside(mesh.nodes[node]) || mesh.elements.iter().any(|list| list[8] == node)
        };
        let fixed: Vec<bool> = (0..mesh.nodes.len()).flat_map(|node| [!free(node); 2]).collect();
        let displacement: Vec<f64> = mesh
            .nodes
            .iter()
            .zip(fixed.chunks_exact(2))
            .flat_map(|(&node, fixed)| if fixed[0] { exact(node) } else { [0.0; 2] })
            .collect();
        assert!(fixed.iter().filter(|&&f| !f).count() >= 10);
        let system = System::new(mesh, &fixed, |_, _, _| soil(10.0, 0.3)).unwrap();
        let force = vec![0.0; displacement.len()];
        let found = system.solve(&force, &displacement, MIN_CHANGE).unwrap();
        for (u, &node) in found.chunks_exact(2).zip(&system.mesh.nodes) {
            let truth = exact(node);
            assert!(
                (u[0] - truth[0]).abs() < 1e-13 && (u[1] - truth[1]).abs() < 1e-13,
                "{u:?} {truth:?}"
            );
        }
    }

    /// Whether a symmetric matrix is positive definite, by elimination.
    fn positive_definite(mut matrix: ElementMatrix) -> bool {
        for p in 0..DOFS {
            if matrix[p][p] <= 1e-9 {
                return false;
            }
            let pivot = matrix[p];
            for row in &mut matrix[p + 1..] {
                let factor = row[p] / pivot[p];
                for (value, other) in row[p..].iter_mut().zip(&pivot[p..]) {
                    *value -= factor * other;
                }
            }
        }
        true
    }

    #[test]
    fn vertical_translation_is_the_only_rigid_mode() {
        for element in [0, 3] {
            let mut matrix = stiffness(&distorted().corners(element), |_, _| soil(1.0, 0.3)).unwrap();
            for row in &matrix {
                let force: f64 = row.iter().skip(1).step_by(2).sum();
                assert!(force.abs() < 1e-14, "{force}");
            }
            assert!(!positive_definite(matrix));
            // With that mode made stiff nothing soft remains.
            for row in matrix.iter_mut().skip(1).step_by(2) {
                for value in row.iter_mut().skip(1).step_by(2) {
                    *value += 1.0;
                }
            }
            assert!(positive_definite(matrix), "a spurious mode");
        }
    }

    /// Largest nodal error, relative to the largest displacement, with the exact field prescribed on the whole boundary of n × n
    /// elements.
    fn boundary_value_error(n: usize, nu: f64) -> f64 {
        // A point load on a half-space, away from its singular point (K. L. Johnson, Contact Mechanics, eq. 3.18).
        let exact = |[r, z]: [f64; 2]| {
            let d = r.hypot(z);
            [
                r * z / d.powi(3) - (1.0 - 2.0 * nu) * r / (d * (d + z)),
                z * z / d.powi(3) + 2.0 * (1.0 - nu) / d,
            ]
        };
        let (r, z) = ((0.0, 1.5), (0.5, 2.0));
        let lines = |(from, to): (f64, f64)| -> Vec<f64> {
            (0..=n)
                .map(|k| from + (to - from) * k as f64 / n as f64)
                .collect()
        };
        let mesh = Mesh::rectangular(&lines(r), &lines(z));
        let edge = |[a, b]: [f64; 2]| a == r.0 || a == r.1 || b == z.0 || b == z.1;
        let fixed: Vec<bool> = mesh
            .nodes
            .iter()
            .flat_map(|&node| {
                [
                    edge(node),
                    edge(node) && node[0] != r.0 || node[1] == z.0 || node[1] == z.1,
                ]
            })
            .collect();
        let given = |(&node, fixed): (&[f64; 2], &[bool])| {
            let u = exact(node);
            [0, 1].map(|c| if fixed[c] { u[c] } else { 0.0 })
        };
        let displacement: Vec<f64> = mesh
            .nodes
            .iter()
            .zip(fixed.chunks_exact(2))
            .flat_map(given)
            .collect();
        let system = System::new(mesh, &fixed, |_, _, _| soil(1.0, nu)).unwrap();
        let force = vec![0.0; displacement.len()];
        let found = system.solve(&force, &displacement, MIN_CHANGE).unwrap();
        let errors = found.chunks_exact(2).zip(&system.mesh.nodes).map(|(u, &node)| {
            let truth = exact(node);
            (u[0] - truth[0]).abs().max((u[1] - truth[1]).abs())
        });
        errors.fold(0.0, f64::max) / exact([0.0, 0.5])[1]
    }

    #[test]
    fn observed_order_of_convergence() {
        let errors = [8, 16, 32, 64].map(|n| boundary_value_error(n, 0.35));
        for pair in errors.windows(2).skip(1) {
            let order = (pair[0] / pair[1]).log2();
            assert!(order > 2.8, "order {order} of {errors:?}");
        }
    }

    #[test]
    fn what_cannot_be_solved_is_an_error() {
        let lines = [0.0, 1.0];
        let square = Mesh::rectangular(&lines, &lines);
        let mut clockwise = square.clone();
        for node in &mut clockwise.nodes {
            node.swap(0, 1);
        }
        assert!(matches!(
            System::new(clockwise, &[false; 18], |_, _, _| soil(1.0, 0.3)),
            Err(FemError::Degenerate)
        ));
        let no_number = |_: usize, _: f64, _: f64| Elasticity {
            shear: f64::NAN,
            lame: 1.0,
        };
        assert!(System::new(square.clone(), &[false; 18], no_number).is_err());
        // Nothing holds it up: either the factorisation fails or the residual shows it.
        let system = System::new(square.clone(), &[false; 18], |_, _, _| soil(1.0, 0.3));
        let mut force = [0.0; 18];
        force[1] = 1.0;
        assert!(
            system
                .and_then(|system| system.solve(&force, &[0.0; 18], MIN_CHANGE))
                .is_err()
        );
        // All of it held, or no element at all: nothing is left to solve.
        let system = System::new(square, &[true; 18], |_, _, _| soil(1.0, 0.3)).unwrap();
        assert_eq!(system.solve(&force, &[1.0; 18], MIN_CHANGE), Ok(vec![1.0; 18]));
        for lines in [&[][..], &[0.0]] {
            let mesh = Mesh::rectangular(lines, &[0.0, 1.0]);
            let held = vec![true; mesh.dofs()];
            assert!(System::new(mesh, &held, |_, _, _| soil(1.0, 0.3)).is_ok());
        }
    }
}
