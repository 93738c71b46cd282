//! The elements on their own: a published solution, patch test, rigid modes, locking, order of convergence.

#![allow(
    clippy::needless_range_loop,
    reason = "matrix algebra reads best by its indices"
)]

use layered_fem::element::{ElementMatrix, Quadrilateral, Volumetric};
use layered_fem::material::Elasticity;
use layered_fem::mesh::Mesh;
use layered_fem::system::{System, prescribed_force};

fn rows(text: &str) -> Vec<Vec<f64>> {
    text.lines()
        .skip(1)
        .map(|line| {
            line.split(',')
                .map(|field| field.parse().unwrap_or(f64::NAN))
                .collect()
        })
        .collect()
}

/// Solves with `displacement` prescribed where `fixed`, and the forces given elsewhere.
fn solve(
    mesh: &Mesh,
    volumetric: Volumetric,
    fixed: &[bool],
    displacement: &[f64],
    force: &[f64],
    elasticity: impl Fn(usize, f64, f64) -> Elasticity + Copy,
) -> Vec<f64> {
    let system = System::new(mesh, volumetric, fixed, elasticity).unwrap();
    let mut total = prescribed_force(mesh, volumetric, displacement, |_| true, elasticity).unwrap();
    for (value, given) in total.iter_mut().zip(force) {
        *value += given;
    }
    system.solve(&total, displacement).unwrap()
}

#[test]
fn smith_griffiths_5_17() {
    let node_rows = rows(include_str!("data/published_smith_griffiths_5_17_nodes.csv"));
    let element_rows = rows(include_str!("data/published_smith_griffiths_5_17_elements.csv"));
    let nodes: Vec<[f64; 2]> = node_rows.iter().map(|row| [row[1], row[2]]).collect();
    let elements: Vec<Vec<usize>> = element_rows
        .iter()
        .map(|row| row[2..6].iter().map(|&node| node as usize).collect())
        .collect();
    let mesh = Mesh::new(Quadrilateral::Linear4, nodes, &elements).unwrap();
    let soils = [Elasticity::new(100.0, 0.3), Elasticity::new(1000.0, 0.45)];
    let material = |element: usize, _: f64, _: f64| soils[element_rows[element][1] as usize - 1];

    let stiffness = rows(include_str!(
        "data/published_smith_griffiths_5_17_element_stiffness.csv"
    ));
    for row in &stiffness {
        let element = row[0] as usize;
        let matrix = Quadrilateral::Linear4
            .stiffness(element, &mesh.element_nodes(element), Volumetric::Full, |r, z| {
                material(element, r, z)
            })
            .unwrap();
        for (found, published) in matrix[row[1] as usize].iter().zip(&row[2..]) {
            assert!(
                (found - published).abs() <= 1e-5 * published.abs(),
                "element {element}: {found} {published}"
            );
        }
    }

    // Held sideways on the axis and the outer edge, and fully at the bottom.
    let fixed: Vec<bool> = mesh
        .nodes()
        .iter()
        .flat_map(|&[r, y]| [r == 0.0 || r == 30.0 || y == -10.0, y == -10.0])
        .collect();
    let force: Vec<f64> = node_rows
        .iter()
        .flat_map(|row| {
            [
                0.0,
                row.get(5).copied().filter(|load| load.is_finite()).unwrap_or(0.0),
            ]
        })
        .collect();
    let found = solve(&mesh, Volumetric::Full, &fixed, &[0.0; 24], &force, material);
    for (u, row) in found.chunks_exact(2).zip(&node_rows) {
        assert!(
            (u[0] - row[3]).abs() < 1e-9 && (u[1] - row[4]).abs() < 1e-9,
            "{u:?} {row:?}"
        );
    }

    let a = 0.6_f64.sqrt();
    let points = [-a, 0.0, a];
    for row in rows(include_str!(
        "data/published_smith_griffiths_5_17_gauss_stress.csv"
    )) {
        let (element, point) = (row[0] as usize, row[1] as usize);
        let local: Vec<f64> = mesh
            .element(element)
            .iter()
            .flat_map(|&n| [found[2 * n], found[2 * n + 1]])
            .collect();
        let strain = Quadrilateral::Linear4.strain(
            &mesh.element_nodes(element),
            &local,
            points[point % 3],
            points[point / 3],
        );
        for (stress, published) in material(element, 0.0, 0.0).stress(strain).iter().zip(&row[2..]) {
            assert!(
                (stress - published).abs() < 1e-7,
                "element {element}, point {point}: {stress} {published}"
            );
        }
    }
}

/// Four distorted elements round one inner corner, nine nodes each; interior nodes are not prescribed.
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
    let mut elements = Vec::new();
    for (i, j) in [(0, 0), (1, 0), (0, 1), (1, 1)] {
        let c = [i + 3 * j, i + 1 + 3 * j, i + 4 + 3 * j, i + 3 + 3 * j].map(|k| corner[k]);
        let mut list: Vec<usize> = c.iter().map(|&p| index(p)).collect();
        for k in 0..4 {
            list.push(index(middle(&[c[k], c[(k + 1) % 4]])));
        }
        list.push(index(middle(&c)));
        elements.push(list);
    }
    Mesh::new(Quadrilateral::Quadratic9, nodes, &elements).unwrap()
}

#[test]
fn patch_test_on_distorted_elements() {
    // A state of constant strain in axisymmetry: u_r = a r, u_z = b z + c.
    let exact = |[r, z]: [f64; 2]| [0.3 * r, -0.7 * z + 0.2];
    let mesh = distorted();
    for volumetric in [Volumetric::Full, Volumetric::Projected] {
        let inside = |[r, z]: [f64; 2]| r > 1.01 && r < 2.99 && z > 0.05 && z < 1.95;
        // The outer sides are bent, so the free nodes are told by their elements: those shared by all four or by two.
        let shared = |node: usize| mesh.elements().filter(|list| list.contains(&node)).count() > 1;
        let free = |node: usize| {
            shared(node) && inside(mesh.nodes()[node]) || mesh.elements().any(|list| list[8] == node)
        };
        let fixed: Vec<bool> = (0..mesh.nodes().len())
            .flat_map(|node| [!free(node); 2])
            .collect();
        let displacement: Vec<f64> = mesh
            .nodes()
            .iter()
            .zip(fixed.chunks_exact(2))
            .flat_map(|(&node, fixed)| if fixed[0] { exact(node) } else { [0.0; 2] })
            .collect();
        assert!(fixed.iter().filter(|&&f| !f).count() >= 10);
        let force = vec![0.0; mesh.dofs()];
        let found = solve(&mesh, volumetric, &fixed, &displacement, &force, |_, _, _| {
            Elasticity::new(10.0, 0.3)
        });
        for (u, &node) in found.chunks_exact(2).zip(mesh.nodes()) {
            let truth = exact(node);
            assert!(
                (u[0] - truth[0]).abs() < 1e-13 && (u[1] - truth[1]).abs() < 1e-13,
                "{volumetric:?} {u:?} {truth:?}"
            );
        }
    }
}

/// Whether a symmetric matrix of order `n` is positive definite, by elimination.
fn positive_definite(mut matrix: ElementMatrix, n: usize) -> bool {
    for p in 0..n {
        if matrix[p][p] <= 1e-9 {
            return false;
        }
        for q in p + 1..n {
            let factor = matrix[q][p] / matrix[p][p];
            for s in p..n {
                matrix[q][s] -= factor * matrix[p][s];
            }
        }
    }
    true
}

#[test]
fn vertical_translation_is_the_only_rigid_mode() {
    let nine = distorted();
    let four = [[1.0, 0.0], [2.0, 0.2], [2.2, 1.0], [0.8, 1.1]];
    for (kind, nodes, volumetric) in [
        (Quadrilateral::Linear4, four.to_vec(), Volumetric::Full),
        (
            Quadrilateral::Quadratic9,
            nine.element_nodes(0).to_vec(),
            Volumetric::Full,
        ),
        (
            Quadrilateral::Quadratic9,
            nine.element_nodes(3).to_vec(),
            Volumetric::Projected,
        ),
    ] {
        let mut matrix = kind
            .stiffness(0, &nodes, volumetric, |_, _| Elasticity::new(1.0, 0.3))
            .unwrap();
        let n = kind.dofs();
        for row in matrix.iter().take(n) {
            let force: f64 = row.iter().skip(1).step_by(2).sum();
            assert!(force.abs() < 1e-14, "{kind:?}: {force}");
        }
        assert!(!positive_definite(matrix, n));
        // With that mode made stiff nothing soft remains.
        for i in (1..n).step_by(2) {
            for j in (1..n).step_by(2) {
                matrix[i][j] += 1.0;
            }
        }
        assert!(
            positive_definite(matrix, n),
            "{kind:?} {volumetric:?} has a spurious mode"
        );
    }
}

/// A rectangle r in \[1, 2\], z in \[0, 1\] of n × n elements of either kind.
fn rectangle(kind: Quadrilateral, n: usize, r: (f64, f64), z: (f64, f64)) -> Mesh {
    let lines = |(from, to): (f64, f64), n: usize| -> Vec<f64> {
        (0..=n)
            .map(|k| from + (to - from) * k as f64 / n as f64)
            .collect()
    };
    if kind == Quadrilateral::Quadratic9 {
        return Mesh::rectangular(kind, &lines(r, n), &lines(z, n));
    }
    let (radii, depths) = (lines(r, n), lines(z, n));
    let nodes = depths
        .iter()
        .flat_map(|&z| radii.iter().map(move |&r| [r, z]))
        .collect();
    let elements: Vec<Vec<usize>> = (0..n * n)
        .map(|e| {
            let first = e % n + (e / n) * (n + 1);
            vec![first, first + 1, first + n + 2, first + n + 1]
        })
        .collect();
    Mesh::new(kind, nodes, &elements).unwrap()
}

/// Largest nodal error, relative to the largest displacement, with the exact field prescribed on the whole boundary.
fn boundary_value_error(kind: Quadrilateral, volumetric: Volumetric, n: usize, nu: f64) -> f64 {
    // A point load on a half-space, away from its singular point (K. L. Johnson, Contact Mechanics, eq. 3.18).
    let exact = |[r, z]: [f64; 2]| {
        let d = r.hypot(z);
        [
            r * z / d.powi(3) - (1.0 - 2.0 * nu) * r / (d * (d + z)),
            z * z / d.powi(3) + 2.0 * (1.0 - nu) / d,
        ]
    };
    let (r, z) = ((0.0, 1.5), (0.5, 2.0));
    let mesh = rectangle(kind, n, r, z);
    let edge = |[a, b]: [f64; 2]| a == r.0 || a == r.1 || b == z.0 || b == z.1;
    let fixed: Vec<bool> = mesh
        .nodes()
        .iter()
        .flat_map(|&node| {
            [
                edge(node),
                edge(node) && node[0] != r.0 || node[1] == z.0 || node[1] == z.1,
            ]
        })
        .collect();
    let displacement: Vec<f64> = mesh
        .nodes()
        .iter()
        .zip(fixed.chunks_exact(2))
        .flat_map(|(&node, fixed)| {
            let u = exact(node);
            [
                if fixed[0] { u[0] } else { 0.0 },
                if fixed[1] { u[1] } else { 0.0 },
            ]
        })
        .collect();
    let found = solve(
        &mesh,
        volumetric,
        &fixed,
        &displacement,
        &vec![0.0; mesh.dofs()],
        |_, _, _| Elasticity::new(1.0, nu),
    );
    let mut worst = 0.0_f64;
    for (u, &node) in found.chunks_exact(2).zip(mesh.nodes()) {
        let truth = exact(node);
        worst = worst.max((u[0] - truth[0]).abs()).max((u[1] - truth[1]).abs());
    }
    worst / exact([0.0, 0.5])[1]
}

#[test]
fn observed_order_of_convergence() {
    for (kind, volumetric, least) in [
        // The hoop strain u_r/r costs the bilinear element its last half order at the axis.
        (Quadrilateral::Linear4, Volumetric::Full, 1.0),
        (Quadrilateral::Quadratic9, Volumetric::Full, 2.8),
        (Quadrilateral::Quadratic9, Volumetric::Projected, 2.8),
    ] {
        let errors = [8, 16, 32, 64].map(|n| boundary_value_error(kind, volumetric, n, 0.35));
        for pair in errors.windows(2).skip(1) {
            let order = (pair[0] / pair[1]).log2();
            assert!(
                order > least,
                "{kind:?} {volumetric:?}: order {order} of {errors:?}"
            );
        }
    }
}

#[test]
fn nothing_locks_near_incompressibility() {
    let error = |kind, volumetric, nu| boundary_value_error(kind, volumetric, 12, nu);
    let compressible = error(Quadrilateral::Quadratic9, Volumetric::Projected, 0.3);
    for nu in [0.49, 0.499, 0.4999, 0.49999] {
        let found = error(Quadrilateral::Quadratic9, Volumetric::Projected, nu);
        assert!(
            found < 2.0 * compressible,
            "ν = {nu}: {found:.1e} against {compressible:.1e} at 0.3"
        );
    }
    // The textbook element does lock: the check can fail.
    let textbook = |nu| error(Quadrilateral::Linear4, Volumetric::Full, nu);
    assert!(textbook(0.4999) > 2.0 * textbook(0.3));
}

#[test]
fn malformed_meshes_are_errors() {
    let square = vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    assert!(Mesh::new(Quadrilateral::Linear4, square.clone(), &[vec![0, 1, 2]]).is_err());
    assert!(Mesh::new(Quadrilateral::Linear4, square.clone(), &[vec![0, 1, 2, 4]]).is_err());
    let soil = |_: usize, _: f64, _: f64| Elasticity::new(1.0, 0.3);
    let clockwise = Mesh::new(Quadrilateral::Linear4, square.clone(), &[vec![0, 3, 2, 1]]).unwrap();
    assert!(System::new(&clockwise, Volumetric::Full, &[false; 8], soil).is_err());
    let mesh = Mesh::new(Quadrilateral::Linear4, square, &[vec![0, 1, 2, 3]]).unwrap();
    assert!(System::new(&mesh, Volumetric::Full, &[false; 7], soil).is_err());
    // Nothing holds it up: either the factorisation fails or the residual tells.
    let system = System::new(&mesh, Volumetric::Full, &[false; 8], soil);
    let force = [0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];
    assert!(system.and_then(|system| system.solve(&force, &[0.0; 8])).is_err());
}
