//! The ground's stability maps on coarser grids: with its guards on, no model is wrong anywhere, and the maps can tell.

use creepage_validation::ground_map::GroundMap;
use creepage_validation::map::Outcome;
use creepage_validation::stability::{burmister, fem};
use creepage_validation::{bilinear, file};
use ground_field::Soil;

/// Every cell of the crate is right, or refused with a typed error; at most `refused` of them are.
fn never_wrong(map: &GroundMap, refused: usize) {
    assert_eq!(map.never_wrong(), Ok(()));
    let found = map.grid.count(0, Outcome::Refused);
    assert!(found <= refused, "{found} refused");
    assert!(map.grid.count(0, Outcome::Right) > 0);
}

#[test]
fn burmister_is_right_everywhere_and_transfer_matrices_are_not() {
    let map = burmister::map(7, 8).unwrap();
    never_wrong(&map, 0);
    let grid = map.grid;
    // The judge sees what it is there for: lost digits, and overflow.
    assert!(grid.count(1, Outcome::Wrong) > 5 && grid.count(1, Outcome::Failed) > 5);
    assert!(grid.count(1, Outcome::Right) > 20);
}

/// A corner of both maps that is quick enough for every run of the tests.
#[test]
#[ignore = "ten seconds: .ci/run runs it"]
fn elements_are_never_wrong_on_the_coarsest_grid() {
    never_wrong(&fem::layered(2, 2).unwrap(), 0);
}

fn rows(name: &str) -> Vec<Vec<f64>> {
    let name = format!("tests/data/published_smith_griffiths_5_17_{name}.csv");
    let text = std::fs::read_to_string(file(&name)).unwrap();
    let numbers = |line: &str| {
        line.split(',')
            .map(|field| field.parse().unwrap_or(f64::NAN))
            .collect()
    };
    text.lines().skip(1).map(numbers).collect()
}

/// The element that locks is the textbook's own: its published stiffness, displacements and stresses.
#[test]
fn smith_griffiths_5_17() {
    let node_rows = rows("nodes");
    let element_rows = rows("elements");
    let mesh = bilinear::Mesh {
        nodes: node_rows.iter().map(|row| [row[1], row[2]]).collect(),
        elements: (element_rows.iter())
            .map(|row| [2, 3, 4, 5].map(|k| row[k] as usize))
            .collect(),
    };
    let soils = [Soil::new(100.0, 0.3).unwrap(), Soil::new(1000.0, 0.45).unwrap()];
    let soil = |element: usize| soils[element_rows[element][1] as usize - 1];

    for row in rows("element_stiffness") {
        let element = row[0] as usize;
        let matrix = mesh.stiffness(element, soil(element));
        for (found, published) in matrix[row[1] as usize].iter().zip(&row[2..]) {
            assert!(
                (found - published).abs() <= 1e-5 * published.abs(),
                "element {element}: {found} {published}"
            );
        }
    }

    // Held sideways on the axis and the outer edge, and fully at the bottom.
    let held = |&[r, y]: &[f64; 2]| [r == 0.0 || r == 30.0 || y == -10.0, y == -10.0];
    let fixed: Vec<bool> = mesh.nodes.iter().flat_map(held).collect();
    let load = |row: &Vec<f64>| row.get(5).copied().filter(|load| load.is_finite());
    let force: Vec<f64> = node_rows
        .iter()
        .flat_map(|row| [0.0, load(row).unwrap_or(0.0)])
        .collect();
    let found = mesh.solve(&fixed, &[0.0; 24], &force, soil).unwrap();
    for (u, row) in found.chunks_exact(2).zip(&node_rows) {
        assert!(
            (u[0] - row[3]).abs() < 1e-9 && (u[1] - row[4]).abs() < 1e-9,
            "{u:?} {row:?}"
        );
    }

    let points = [-0.6_f64.sqrt(), 0.0, 0.6_f64.sqrt()];
    for row in rows("gauss_stress") {
        let (element, point) = (row[0] as usize, row[1] as usize);
        let shape = mesh.shape(element, points[point % 3], points[point / 3]);
        let mut strain = [0.0; 4];
        for (k, &node) in mesh.elements[element].iter().enumerate() {
            for c in 0..2 {
                let column = shape.strain(2 * k + c);
                strain = std::array::from_fn(|i| strain[i] + found[2 * node + c] * column[i]);
            }
        }
        for (stress, published) in bilinear::stress(soil(element), strain).iter().zip(&row[2..]) {
            assert!(
                (stress - published).abs() < 1e-7,
                "element {element}, point {point}: {stress} {published}"
            );
        }
    }
}
